"""Certified workspaces: the paper's volume and sections against quadrature that shares nothing with them."""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import quad

import assur
from assur.errors import UnknownNameError, UsageError
from assur.numerics.intervals import rounding
from assur.workspace.certified import paving as paving_module
from assur.workspace.certified.region import certified_workspace, unit
from assur.workspace.region import workspace

ZENG = assur.load("zeng2019")
P = ZENG.values
BOX = {name: tuple(pair) for name, pair in ZENG.box.items()}


def heights(x):
    """Lowest and highest z at which chains I and II reach x in the mode ++-++, from two circles and two links."""
    d = P.b - P.d
    rise_1, rise_2 = (math.sqrt(max(r * r - q * q, 0.0)) for r, q in ((P.l4, x + d), (P.l6, x - d)))
    first, second = P.l1 + rise_1, P.l1 + P.l7 + P.l8 + rise_2
    low = max(first - P.l2, second - P.l6, BOX["z"][0])
    return low, min(first + P.l2, second + P.l6, BOX["z"][1])


def width_at(z):
    """Length of the x at which z is reached: dense samples, ends by bisection."""
    d = P.b - P.d
    ends = max(BOX["x"][0], -P.l4 - d, d - P.l6), min(BOX["x"][1], P.l4 - d, d + P.l6)

    def inside(x):
        low, high = heights(x)
        return low <= z <= high

    xs = np.linspace(*ends, 20_001)
    there = [inside(x) for x in xs]
    total = 0.0
    for one, two, a, b in zip(xs[:-1], xs[1:], there[:-1], there[1:], strict=True):
        if a and b:
            total += two - one
        elif a != b:
            left, right = one, two
            for _ in range(60):
                middle = (left + right) / 2
                left, right = (middle, right) if inside(middle) == a else (left, middle)
            total += (left - one) if a else (two - left)
    return total


def area():
    d = P.b - P.d
    ends = max(BOX["x"][0], -P.l4 - d, d - P.l6), min(BOX["x"][1], P.l4 - d, d + P.l6)

    def length(x):
        low, high = heights(x)
        return max(high - low, 0.0)

    pieces = np.linspace(*ends, 401)
    return math.fsum(quad(length, a, b, epsabs=1e-9)[0] for a, b in itertools.pairwise(pieces))


def test_the_paper_s_workspace_holds_the_quadrature_within_a_millionth():
    found = certified_workspace(ZENG, gap=1e-6)
    exact = area() * (BOX["y"][1] - BOX["y"][0])
    assert exact == pytest.approx(500 * 45629.17, rel=1e-6)
    assert found.volume[0] < exact < found.volume[1]
    assert found.gap_reached <= 1e-6
    assert (found.unit, found.mode, found.stopped, found.note) == ("mm^3", "++-++", "", "")


def test_the_paper_s_four_sections_hold_the_quadrature():
    found = certified_workspace(ZENG, gap=1e-6)
    assert [item.value for item in found.sections] == list(ZENG.sections)
    assert len(found.sections) == 4
    for item in found.sections:
        exact = 500 * width_at(item.value)
        assert item.area[0] - 1e-4 < exact < item.area[1] + 1e-4
        assert item.area[1] - item.area[0] <= 1e-6 * item.area[1]
        assert (item.coordinate, item.unit) == ("z", "mm^2")


@pytest.mark.usefixtures("by_numpy")
@pytest.mark.parametrize("mutation", ["rounding", "outward", "share"])
def test_wrong_bounds_are_noticed(monkeypatch, mutation):
    """Bounds that are shrunk, and shares that are turned round, fail the tests above."""
    if mutation == "rounding":  # without it the bounds of a box that is a number of whole millimetres are that number
        for name in ("down", "up", "down_sum", "up_sum"):
            monkeypatch.setattr(rounding, name, np.asarray)
        found = certified_workspace(ZENG, gap=1e-6, box={"x": (-40, -39.9), "z": (380, 380.1)}, sections=())
        with pytest.raises(AssertionError):
            assert found.volume[0] < found.volume[1]
        return
    if mutation == "outward":
        true = paving_module._sum

        def shrunk(known):
            found = true(known)
            return type(found)(found.low * (1 + 1e-5), found.high * (1 - 1e-5), found.defined)

        monkeypatch.setattr(paving_module, "_sum", shrunk)
    else:
        from assur.workspace.certified import cuts

        shares = cuts.shares
        monkeypatch.setattr(cuts, "shares", lambda number, reach: shares(-number, reach))
    with pytest.raises((AssertionError, UsageError)):
        test_the_paper_s_workspace_holds_the_quadrature_within_a_millionth()


@pytest.mark.parametrize("name", ["fivebar", "orthoglide", "planar_3rrr", "linear_delta_4r", "delta_4s"])
def test_the_estimate_of_the_solids_agrees_with_the_proof(name):
    record = assur.load(name)
    proved, estimated = certified_workspace(record, gap=0.05, sections=()), workspace(record, resolution=32)
    slack = 5 * estimated.volume_error
    assert proved.volume[0] - slack < estimated.volume < proved.volume[1] + slack
    assert proved.unit == estimated.unit


def test_strokes_boxes_and_held_coordinates_cut_the_region():
    whole = certified_workspace(ZENG, gap=1e-3, sections=())
    short = certified_workspace(ZENG, strokes={"yA1": (-300, 300)}, gap=1e-2, sections=())
    assert short.volume[1] < whole.volume[0]
    part = certified_workspace(ZENG, box={"x": (-40, 0), "y": (0, 1), "z": (380, 400)}, sections=[390.0])
    assert part.volume[0] <= 800 <= part.volume[1]
    assert part.sections[0].area[0] <= 40 <= part.sections[0].area[1]
    plane = certified_workspace(ZENG, held={"y": 0.0}, gap=1e-4, sections=())
    assert plane.unit == "mm^2"
    assert plane.volume[0] < area() < plane.volume[1]


def test_the_sum_of_parts_is_the_whole():
    whole = certified_workspace(ZENG, gap=1e-5, sections=()).volume
    parts = [
        certified_workspace(ZENG, box={"x": pair}, gap=1e-5, sections=()).volume for pair in ((-110, -20), (-20, 90))
    ]
    assert sum(part[0] for part in parts) < whole[1]
    assert whole[0] < sum(part[1] for part in parts)


def test_what_it_would_take_and_interruption():
    found = certified_workspace(ZENG, gap=1e-9, sections=(), most=2000)
    assert found.stopped == "too many boxes"
    assert "the gap 1e-09 would take about" in found.note

    def interrupt(done, total):
        if done > 0.2 * total:
            raise KeyboardInterrupt

    found = certified_workspace(ZENG, gap=1e-4, progress=interrupt)
    assert (found.stopped, found.note) == ("", "") or found.stopped == "interrupted"
    assert len(found.sections) < 4


def test_misuse():
    for options in ({"gap": 0}, {"gap": -1}, {"sections": [1000.0]}, {"box": {"x": (5, 5)}}, {"box": {"x": (9, 5)}}):
        with pytest.raises(UsageError):
            certified_workspace(ZENG, **options)
    with pytest.raises(UsageError):
        certified_workspace(ZENG, finest=0.0)
    with pytest.raises(UnknownNameError):
        certified_workspace(ZENG, mode="++")
    with pytest.raises(UsageError, match="two coordinates"):
        certified_workspace(ZENG, held={"x": 0.0, "y": 0.0}, sections=[400.0])


def test_units():
    assert unit(ZENG, ("x", "y", "z")) == "mm^3"
    assert unit(assur.load("planar_3rrr"), ("x", "y", "phi")).endswith("^2 rad")


def test_a_tenth_of_the_gap_takes_no_more_than_ten_times_the_boxes():
    """Its border is a curve over the two coordinates that count: half the boxes' sides, twice the boxes about it."""

    def boxes(gap):
        paving = certified_workspace(ZENG, gap=gap, sections=()).paving
        return len(paving.inside) + len(paving.outside) + len(paving.boundary)

    assert boxes(1e-5) <= 10 * boxes(1e-4) <= 100 * boxes(1e-3)
