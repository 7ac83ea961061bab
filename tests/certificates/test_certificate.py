import itertools
import json
import math
from fractions import Fraction
from itertools import islice

import numpy as np
import pytest

from assur.certificates import certificate as certificate_module
from assur.certificates import leaves
from assur.certificates.certificate import certificate
from assur.certificates.formulas import RegionFormulas
from assur.certificates.tree import TOKEN
from assur.errors import OutputError, UsageError
from assur.model.registry import load_record
from assur.numerics.intervals import interval, rounding
from assur.numerics.intervals.interval import Interval
from assur.verifier.check import verify
from assur.verifier.reading import RefusedError
from assur.workspace.certified.boxes import Boxes
from assur.workspace.region import workspace


def volume(found):
    return tuple(map(float.fromhex, found.claims["volume"]))


@pytest.mark.parametrize(
    ("name", "asked"),
    [
        ("zeng2019", {}),
        ("zeng2019", {"held": {"y": 0.0}, "strokes": {"yA1": (-300, 300)}}),
        ("fivebar", {"strokes": {"theta1": (0.5, 2.5)}}),
        ("planar_3rpr", {"held": {"phi": 0.3}, "strokes": {"rho1": (0, 12), "rho2": (1, 9)}}),
    ],
)
def test_the_sampled_volume_lies_between_the_proved_bounds(name, asked):
    record = load_record(name)
    low, high = volume(certificate(record, **asked, gap=0.02, most=3000))
    sampled = workspace(record, **asked, resolution=48)
    assert low - 2 * sampled.volume_error <= sampled.volume <= high + 2 * sampled.volume_error
    assert 0 < low < high < 1.05 * low


def test_far_away_nothing_is_reached():
    found = certificate(load_record("fivebar"), box={"x": (1000, 1010), "y": (1000, 1010)})
    assert volume(found) == (0.0, 0.0)
    assert found.claims["leaves"] == {"inside": 0, "regular": 0, "outside": 1, "open": 0}


def test_more_leaves_make_the_bounds_closer():
    record = load_record("zeng2019")
    pairs = [volume(certificate(record, gap=1e-9, most=most)) for most in (1, 30, 300, 2000)]
    for (low, high), (closer_low, closer_high) in itertools.pairwise(pairs):
        assert low <= closer_low <= closer_high <= high
    assert pairs[-1][1] - pairs[-1][0] < 0.02 * (pairs[0][1] - pairs[0][0])


def test_volumes_are_rounded_outwards_from_the_exact_sum():
    found = certificate(load_record("zeng2019"), box={"x": (-0.1, 0.3), "y": (0.1, 0.7), "z": (400, 400.1)})
    sides = ((-0.1, 0.3), (0.1, 0.7), (400, 400.1))
    exact = math.prod(Fraction(b) - Fraction(a) for a, b in sides)
    low, high = volume(found)
    assert Fraction(low) < exact < Fraction(high)
    assert high == math.nextafter(low, math.inf)


def test_a_singular_surface_through_a_box_that_is_reached_is_proved():
    """Where w changes sign between two regular leaves it vanishes between them."""
    record = load_record("zeng2019")
    rules = leaves.Leaves(certificate_rules(record))
    rng = np.random.default_rng(2)
    points = rng.uniform([-110, 180], [90, 480], (4000, 2)).T
    found, _ = rules.formulas.over([Interval.of(points[0]), Interval.of(np.zeros(4000)), Interval.of(points[1])])
    inside = np.all([found[f"margins: {name}"].low > 500 for name in ("M12", "M3")], axis=0)
    inside &= found["margins: n_alpha"].low > 0.05
    inside &= found["margins: n_beta"].low > 0.05
    name, near = min(
        ((name, np.argmin(np.where(inside, abs(found[f"factors: {name}"].middle), np.inf))) for name in ("w", "v")),
        key=lambda item: abs(found[f"factors: {item[0]}"].middle[item[1]]),
    )
    x, z = points[:, near]
    assert abs(found[f"factors: {name}"].middle[near]) < 1
    box = {"x": (x - 2, x + 2), "y": (0, 1), "z": (z - 4, z + 4)}
    certified = certificate(record, box=box, kind="box", most=4000)
    assert certified.claims["reached"] == "yes"
    assert certified.claims["regular"] == "no"
    verify(certified.text.encode())


def certificate_rules(record):
    from assur.certificates.formulas import formulas

    return formulas(record)


def test_numbers_in_the_file_are_exact_and_there_is_no_decimal(case, made_of):
    text = made_of(case).text
    json.loads(text, parse_float=pytest.fail, parse_constant=pytest.fail)
    assert text == made_of(case).text


def test_it_is_written_whole(made_of, tmp_path):
    path = made_of("box").write(tmp_path / "c.json")
    assert path.read_text() == made_of("box").text
    with pytest.raises(OutputError, match="does not exist"):
        made_of("box").write(tmp_path / "none" / "c.json")


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"kind": "path"}, "kind: 'path' is none of workspace, box"),
        ({"gap": -1.0}, "gap: -1.0 is no share"),
        ({"gap": math.nan}, "gap: nan is no share"),
        ({"finest": -1.0}, "finest: -1.0"),
        ({"finest": math.inf}, "finest: inf"),
        ({"most": 0}, "most: 0 leaves"),
        ({"box": {"x": (3, 1)}}, "turned round or empty"),
        ({"box": {"x": (0, math.inf)}}, "not finite"),
        ({"mode": "++"}, "unknown working mode"),
        ({"strokes": {"yA9": (0, 1)}}, "unknown input"),
    ],
)
def test_misuse_is_refused(wrong, message):
    with pytest.raises(UsageError, match=message):
        certificate(load_record("zeng2019"), **wrong)


def test_a_mechanism_without_closed_form_is_refused():
    import dataclasses

    with pytest.raises(UsageError, match="no closed form"):
        certificate(dataclasses.replace(load_record("zeng2019"), closed_form=None))


def test_ctrl_c_keeps_what_is_done(monkeypatch):
    calls = []
    honest = leaves.Leaves.tokens

    def stopping(rules, boxes):
        calls.append(len(boxes))
        if len(calls) > 5:
            raise KeyboardInterrupt
        return honest(rules, boxes)

    monkeypatch.setattr(leaves.Leaves, "tokens", stopping)
    found = certificate(load_record("zeng2019"))
    assert len(calls) == 6
    assert found.claims["leaves"]["open"] > 2
    verify(found.text.encode())


# A broken prover: what it writes has a checksum that fits, and the verifier refuses it.


def refused(record, **asked):
    try:
        verify(certificate(record, **asked).text.encode())
    except RefusedError:
        return True
    return False


def thin_boxes():
    """Boxes that end within two floats of where the margin M12 or M3 of the paper vanishes."""
    p = load_record("zeng2019").values
    for x in np.linspace(-60.0, 40.0, 14):
        alpha, beta = (x + p.b - p.d) / p.l4, (x + p.d - p.b) / p.l6
        ends = (
            p.l1 + p.l2 + p.l4 * math.sqrt(1 - alpha * alpha),
            p.l1 + p.l6 + p.l6 * math.sqrt(1 - beta * beta) + p.l7 + p.l8,
        )
        for step in range(-2, 3):
            z = min(ends) + step * math.ulp(512.0)
            yield {"x": (float(x), math.nextafter(float(x), math.inf)), "y": (0.0, 1.0), "z": (z - 1e-12, z)}


@pytest.mark.usefixtures("by_numpy")
def test_a_prover_without_rounding_is_caught(monkeypatch):
    record = load_record("zeng2019")
    asked = [{"box": box, "most": 1} for box in thin_boxes()]
    assert not any(refused(record, **item) for item in asked)
    for name in ("down", "up", "down_sum", "up_sum"):
        monkeypatch.setattr(rounding, name, np.asarray)
    assert len(list(islice(filter(lambda item: refused(record, **item), asked), 3))) == 3


@pytest.mark.usefixtures("by_numpy")
def test_a_prover_that_rounds_inwards_is_caught(monkeypatch):
    for one, two in (("down", "up"), ("down_sum", "up_sum")):
        honest = getattr(rounding, one), getattr(rounding, two)
        monkeypatch.setattr(rounding, one, honest[1])
        monkeypatch.setattr(rounding, two, honest[0])
    caught = (box for box in thin_boxes() if refused(load_record("zeng2019"), box=box, most=1))
    assert len(list(islice(caught, 3))) == 3


@pytest.mark.usefixtures("by_numpy")
@pytest.mark.parametrize("name", ["__mul__", "__sub__", "__add__", "square"])
def test_a_prover_with_a_flipped_sign_is_caught(monkeypatch, name):
    honest = getattr(Interval, name)

    def flipped(*arguments):
        found = honest(*arguments)
        return Interval(-found.high, -found.low, found.defined)

    monkeypatch.setattr(Interval, name, flipped)
    assert refused(load_record("zeng2019"), most=300)


def test_undecided_taken_for_inside_is_caught(monkeypatch):
    honest = leaves.Leaves.tokens
    monkeypatch.setattr(leaves.Leaves, "tokens", lambda *given: np.where(honest(*given) == "b", "i", honest(*given)))
    assert refused(load_record("zeng2019"), most=300)


def test_roots_of_negative_numbers_taken_for_numbers_are_caught(monkeypatch):
    """Without its own margins the root of a negative radicand is what a careless prover would take for zero."""
    honest = RegionFormulas.over

    def careless(rules, box):
        found, real = honest(rules, box)
        whole = {
            name: Interval(np.maximum(v.low, 0.0), np.maximum(v.high, 0.0), v.defined) for name, v in found.items()
        }
        return whole, np.ones_like(real)

    monkeypatch.setattr(RegionFormulas, "over", careless)
    assert refused(load_record("zeng2019"), most=300)


@pytest.mark.usefixtures("by_numpy")
def test_an_operation_without_value_taken_for_defined_is_caught(monkeypatch):
    """Division by an interval with zero in it that leaves bounds as if there were none."""
    honest = interval.Interval.__truediv__

    def careless(one, other):
        found = honest(one, other)
        return Interval(
            np.where(found.defined, found.low, 1.0),
            np.where(found.defined, found.high, 1.0),
            np.ones_like(found.defined),
        )

    record = load_record("fivebar")
    assert not refused(record, most=300)
    monkeypatch.setattr(interval.Interval, "__truediv__", careless)
    monkeypatch.setattr(Interval, "nonzero", property(lambda value: np.ones_like(value.defined)))
    assert refused(record, most=300)


def test_carried_on_with_fewer_leaves_than_there_are_it_grows_no_more():
    record = load_record("zeng2019")
    first = certificate(record, most=300, gap=1e-9)
    again = certificate(record, most=290, gap=1e-9, start=first.to_json())
    assert again.claims["leaves"] == first.claims["leaves"]


@pytest.mark.parametrize("lie", ["i", "r", "b", "o00"])
def test_nothing_that_an_earlier_certificate_says_of_its_leaves_is_believed(lie):
    """Leaves that a forger or a broken prover wrote: carried on, they are judged anew, and the proof holds."""
    record = load_record("zeng2019")
    first = certificate(record, most=100, gap=1e-9)
    false = "".join(token if token.isdigit() else lie for token in TOKEN.findall(first.proof))
    again = certificate(record, most=100, gap=1e-9, start={**first.to_json(), "proof": false})
    assert (again.proof, again.claims) == (first.proof, first.claims)
    verify(again.text.encode())


@pytest.mark.parametrize("start", [{}, {"proof": "b"}])
def test_what_is_no_certificate_is_not_carried_on(start):
    with pytest.raises(UsageError, match="states something else"):
        certificate(load_record("zeng2019"), start=start)


@pytest.mark.parametrize("count", [0, 1, 2, 60])
def test_a_volume_is_the_exact_sum_of_boxes(count):
    """Of any sizes, so that a difference of ends is no float."""
    random = np.random.default_rng(count)
    low = random.normal(size=(3, count)) * 10.0 ** random.integers(-12, 5, size=(3, count))
    high = np.maximum(low + 10.0 ** random.integers(-15, 5, size=(3, count)), np.nextafter(low, np.inf))
    boxes = Boxes(low[:, : count // 2].repeat(2, axis=1), high[:, : count // 2].repeat(2, axis=1))  # some alike
    for some in (boxes, Boxes(low, high)):
        sums = [
            math.prod(Fraction(b) - Fraction(a) for a, b in zip(*sides, strict=True))
            for sides in zip(some.low.T.tolist(), some.high.T.tolist(), strict=True)
        ]
        assert certificate_module._volume(some) == sum(sums)


def test_boxes_of_the_same_sides_are_counted_not_added(monkeypatch):
    """A proof of millions of leaves is written in seconds, also after Ctrl-C."""
    made = []

    def counted(*number):
        made.append(1)
        return Fraction(*number)

    monkeypatch.setattr(certificate_module, "Fraction", counted)
    found = certificate(load_record("zeng2019"), most=3000, gap=1e-9)
    assert len(made) < sum(found.claims["leaves"].values()) / 4
