import math
from collections.abc import Callable

import numpy as np
import pytest

from assur.errors import MechanismFileError, UnknownNameError, UsageError
from assur.model.dimensions import with_parameters
from assur.model.mechanism import MechanismRecord

Read = Callable[[str], MechanismRecord]


def test_parameters_may_be_formulas_in_any_order(read: Read, fourbar: str) -> None:
    text = fourbar.replace("value = 40", 'value = "l3/2 + 0*g"').replace("value = 80", 'value = "0.8*g"')
    record = read(text)
    assert list(record.parameters) == ["l1", "l2", "l3", "g", "tilt"]
    assert vars(record.values) == {
        "l1": 40.0, "l2": 120.0, "l3": 80.0, "g": 100.0, "tilt": pytest.approx(math.radians(15)),
    }  # fmt: skip


def test_an_angle_keeps_its_unit_in_the_record_and_is_in_rad_inside(read: Read, fourbar: str) -> None:
    for text, shown in (
        ("15", 15.0),
        ('"pi/12"', 15.0),
        ('"10 deg + 5 deg"', 15.0),
        ('"0.5 rad"', math.degrees(0.5)),
    ):
        record = read(fourbar.replace("tilt = { value = 15", f"tilt = {{ value = {text}"))
        assert record.parameters["tilt"].value == pytest.approx(shown)
        assert record.values.tilt == pytest.approx(math.radians(shown))
        assert record.joints["D"].at == pytest.approx(
            [100 * math.cos(record.values.tilt), 100 * math.sin(record.values.tilt), 0]
        )
    record = read(fourbar.replace('15, unit = "deg"', '0.25, unit = "rad"'))
    assert record.parameters["tilt"].value == record.values.tilt == 0.25


def test_a_pure_number_is_a_parameter_too(read: Read, fourbar: str) -> None:
    text = fourbar.replace("value = 80", 'value = "ratio*g"').replace(
        "[links]", 'ratio = { value = 0.8, unit = "1" }\n\n[links]'
    )
    assert read(text).values.l3 == 80.0


def test_other_values_go_everywhere(read: Read, fourbar: str) -> None:
    record = read(fourbar)
    changed = with_parameters(record, l1=50, tilt=30.0)
    assert changed.values.l2 == 150.0
    assert changed.joints["B"].at.tolist() == [50.0, 0.0, 0.0]
    assert changed.joints["D"].at == pytest.approx([100 * math.cos(math.pi / 6), 50.0, 0.0])
    assert changed.box["x"] == (-40.0, 150.0)
    assert changed.platform.point.tolist() == [75.0, 0.0, 0.0]
    assert changed.home[0] == pytest.approx(math.radians(90))
    again = with_parameters(changed, l2=np.float64(10))
    assert (again.values.l1, again.values.l2) == (50.0, 10.0)
    assert again.overrides == {"l1": 50.0, "tilt": 30.0, "l2": 10.0}
    assert record.values.l1 == 40.0


def test_the_class_of_a_record_is_kept(read: Read, fourbar: str) -> None:
    class Own(MechanismRecord):
        pass

    record = Own(**vars(read(fourbar)))
    assert type(with_parameters(record, l1=41)) is Own


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (0, "0"), (-1.5, "-1.5"), (math.nan, "nan"), (math.inf, "inf"), (True, "True"), (np.True_, "np.True_"),
        ("300", "'300'"), (None, "None"), (1j, "1j"), (10**400, "1" + "0" * 59), ([300], "[300]"),
        (np.array([300.0]), "array([300.])"),
    ],
)  # fmt: skip
def test_a_value_that_may_not_be_is_refused(read: Read, fourbar: str, value: object, shown: str) -> None:
    record = read(fourbar)
    with pytest.raises(UsageError) as caught:
        with_parameters(record, l1=value)
    assert str(caught.value) == (
        f"parameter 'l1' of fourbar (crank) cannot be {shown}; allowed: a positive number in mm"
    )
    assert not isinstance(caught.value, MechanismFileError)


def test_signs_allow_what_they_say(read: Read, fourbar: str) -> None:
    record = read(fourbar.replace("value = 80", 'sign = "nonnegative", value = 80'))
    assert with_parameters(record, l3=0, tilt=-15).values.l3 == 0.0
    with pytest.raises(UsageError, match="cannot be -1; allowed: zero or a positive number in mm"):
        with_parameters(record, l3=-1)


def test_an_unknown_parameter_is_answered_with_the_near_ones(read: Read, fourbar: str) -> None:
    with pytest.raises(UnknownNameError) as caught:
        with_parameters(read(fourbar), tlit=3)
    assert caught.value.choices == ("g", "l1", "l2", "l3", "tilt")
    assert caught.value.hint == "did you mean tilt?"


def test_a_value_that_breaks_a_check_elsewhere_is_refused(read: Read, fourbar: str) -> None:
    record = read(fourbar.replace("value = 80", 'value = "g - l1"'))
    with pytest.raises(UsageError) as caught:
        with_parameters(record, g=30)
    assert str(caught.value) == (
        "fourbar cannot be with g = 30: parameters.l3.value: l3 = g - l1 = -10 mm; allowed: a positive number\n"
        'hint: sign = "any" allows negative values'
    )
    assert with_parameters(record, g=30, l3=5).values.l3 == 5.0


def test_every_cycle_is_told_once(faults: Callable[[str], list[str]], fourbar: str) -> None:
    text = fourbar.replace("value = 40", 'value = "l2/g"').replace("value = 80", 'value = "l3 + l1"')
    found = faults(text.replace("value = 100", 'value = "2*l1"'))
    places = [line.split("; ")[0] for line in found]
    assert len(places) == 2
    assert places[0].startswith("f.toml:9: parameters.l1.value: a formula that needs itself: l1 -> ")
    assert places[1] == "f.toml:11: parameters.l3.value: a formula that needs itself: l3 -> l3"


def test_long_chains_of_formulas_do_not_exhaust_the_stack(read: Read, fourbar: str) -> None:
    count = 3000
    chain = "\n".join(f'p{n} = {{ value = "p{n + 1}" }}' for n in range(count))
    text = fourbar.replace("[parameters]", f"[parameters]\n{chain}\np{count} = {{ value = 7 }}")
    assert read(text).values.p0 == 7.0
