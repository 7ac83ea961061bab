"""Criteria over intervals: they enclose what the kernels give at every pose, in every mechanism with a closed form."""

from dataclasses import replace

import mpmath
import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.model.pose import is_angle
from assur.numerics.intervals.functions import from_degrees
from assur.numerics.intervals.interval import Interval, common
from assur.numerics.recording import interval_program
from assur.workspace.bounds import bounds
from assur.workspace.certified import criteria as module
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.criteria import criteria
from assur.workspace.certified.planes import BoxQuestion
from assur.workspace.domain import box_of
from assur.workspace.fields import closed_form_fields

RNG = np.random.default_rng(2)
NAMES = [name for name in assur.names() if assur.load(name).closed_form is not None]
ZENG = assur.load("zeng2019")


@pytest.mark.parametrize("name", NAMES)
def test_margins_and_factors_of_poses_lie_within_those_of_their_boxes(name):
    record = assur.load(name)
    asked = criteria(record, factors=("parallel",))
    box = box_of(record, None, asked.slice.free)
    low, high = np.array(box.low)[:, None], np.array(box.high)[:, None]
    size = 0.02 * (high - low)
    start = low + RNG.uniform(size=(len(low), 300)) * (high - low - size)
    points = start + RNG.uniform(size=start.shape) * size
    over = asked.over([Interval.of(a, b) for a, b in zip(start, start + size, strict=True)])
    sloped = asked.sloped([Interval.of(a, b) for a, b in zip(start, start + size, strict=True)], list(start + size / 2))
    mode = record.modes.default_working
    fields = {
        **closed_form_fields(record, mode, None, asked.slice)[0],
        **closed_form_fields(record, mode, None, asked.slice)[1],
    }
    reached = np.ones(300, dtype=bool)
    for margin in asked.margins:
        reached &= fields[margin](tuple(points)) >= 0
    assert np.sum(reached) > 10
    for output in (*asked.margins, *asked.names):
        value = np.broadcast_to(fields[output](tuple(points)), (300,))
        slack = 1e-9 * (1 + np.abs(value))
        for number in (over[output], sloped[output].whole):
            within = (number.low <= value + slack) & (value - slack <= number.high)
            assert np.all(within[reached])


def test_a_pose_that_is_not_reached_for_an_inner_radicand_is_never_certain():
    asked = criteria(ZENG)
    found = asked.over([Interval.of(85.0), Interval.of(0.0), Interval.of(400.0)])
    assert found["n_alpha"].negative
    assert found["M12"].defined  # the root inside is that of max(n_alpha, 0)


def test_constants_of_strokes_are_enclosed_not_rounded():
    record, constants = assur.load("planar_3rrr"), []
    names = [item.name for item in record.inputs]

    def keep(constant):
        constants.append(constant)
        return float(constant.middle)

    bounds(record, {names[0]: (0.1, 0.7)}, keep)
    bounds(ZENG, {"yA1": (0.1, 0.7)}, keep)
    with mpmath.workdps(40):
        first, last = mpmath.mpf(0.1), mpmath.mpf(0.7)
        middle, half = (first + last) / 2, (last - first) / 2
        wanted = [mpmath.cos(middle), mpmath.sin(middle), mpmath.cos(half), -first, last]
        for constant, value in zip(constants, wanted, strict=True):
            assert mpmath.mpf(float(constant.low)) <= value <= mpmath.mpf(float(constant.high))
    assert all(float(constant.width) < 1e-14 for constant in constants)


def test_a_held_angle_is_enclosed_not_rounded():
    record = assur.load("planar_3rrr")
    pose = {"x": 0.1, "y": 0.05}
    point = [Interval.of(pose[name]) for name in ("x", "y")]
    held = criteria(record, held={"phi": 0.3}).over(point)
    free = criteria(record).over([*point, Interval.of(0.3)])
    for name in held:
        assert float(held[name].width) > 0
        assert not np.any(common(held[name], free[name])[1])


def test_a_held_angle_in_degrees_is_any_that_its_float_was_converted_from():
    record, angle = assur.load("planar_3rrr"), float(np.radians(175.0))
    point, free = [Interval.of(0.0), Interval.of(0.0)], criteria(record)
    held = criteria(record, held={"phi": angle}).over(point)
    wide, narrow = (free.over([*point, angles]) for angles in (from_degrees(angle), Interval.of(angle)))
    for name, found in held.items():
        assert found.low <= wide[name].low <= wide[name].high <= found.high
    assert any(narrow[name].width < 0.9 * wide[name].width for name in held)


def test_what_is_asked_for():
    asked = criteria(ZENG, factors=("parallel", "serial", "constraint"))
    assert asked.factors["parallel"] == ("u1_minus_u2", "w", "v", "sin_alpha_minus_beta")
    assert asked.factors["constraint"]
    assert asked.nonsingular.regular == (*asked.regular, *asked.names)
    assert asked.analytic
    assert criteria(ZENG, strokes={"yA1": (-300, 300)}).used == (True, True, True)


@pytest.mark.parametrize("name", NAMES)
def test_kernels_hold_no_number_that_was_rounded(monkeypatch, name):
    """A third written as 1 / 3 would be rounded before intervals see it."""
    tapes, true = [], module.folded

    def kept(tape):
        tapes.append(tape)
        return true(tape)

    monkeypatch.setattr(module, "folded", kept)
    criteria(assur.load(name), factors=("parallel", "serial", "constraint"))
    numbers = {item.number for item in tapes[0].operations if item.name == "number"}
    assert numbers
    assert all(number * 4 == round(number * 4) or abs(number) in (1e-30, 1e9) for number in numbers)


def test_misuse():
    with pytest.raises(UnknownNameError):
        criteria(ZENG, mode="+")
    with pytest.raises(UnknownNameError):
        criteria(ZENG, held={"q": 1.0})
    with pytest.raises(UsageError):
        criteria(replace(ZENG, closed_form=None))


KINDS = ("parallel", "serial", "constraint")


def boxes_of(box, used, rng):
    """Boxes (k, N) inside a box: large, small, flat, of points alone, and some that go on without an end."""
    low, high = np.array(box.low)[used], np.array(box.high)[used]
    count = 64
    start = low[:, None] + rng.random((len(low), 5 * count)) * (high - low)[:, None]
    share = np.repeat([0.3, 1e-3, 1e-12, 0.0, 0.0], count)
    end = start + share * (high - low)[:, None] * rng.random(start.shape)
    end[0, 3 * count :] += 1e-2  # flat but for one coordinate
    end[:, 4 * count :] = start[:, 4 * count :]
    return Boxes(start, end)


@pytest.mark.parametrize("name", NAMES)
def test_machine_code_has_the_bits_of_numpy_for_every_mechanism(name, monkeypatch):
    """Values and slopes, so that no proof depends on which of both was used."""
    record, rng = assur.load(name), np.random.default_rng(7)
    asked = criteria(record, factors=KINDS).nonsingular
    frame = BoxQuestion(asked, box_of(record, None, asked.slice.free), asked.used)
    boxes = boxes_of(frame.box, np.array(asked.used), rng)
    given = frame.whole(boxes.intervals)
    finite = rng.random(len(boxes)) > 0.1
    endless = [
        item if is_angle(axis) or not has else replace(item, low=np.where(finite, item.low, -np.inf))
        for axis, has, item in zip(asked.slice.free, asked.used, given, strict=True)
    ]
    answers = []
    for done in (interval_program._Done(work=interval_program.REPAID), interval_program._Done(compilable=False)):
        monkeypatch.setattr(interval_program, "_DONE", done)
        answers.append((asked.over(given), asked.over(endless), asked.sloped(given, frame.middles(boxes.middles))))
    for one, two in zip(*answers, strict=True):
        assert list(one) == list(two)
        for key, number in one.items():
            for first, second in zip(parts_of(number), parts_of(two[key]), strict=True):
                for part in ("low", "high", "defined"):
                    np.testing.assert_array_equal(*np.broadcast_arrays(getattr(first, part), getattr(second, part)))


def parts_of(number):
    if isinstance(number, Interval):
        return [number]
    return [number.centre, number.whole, *(slope for slope in number.slopes if slope is not None)]
