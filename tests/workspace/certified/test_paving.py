"""Pavings: boxes against the kinematics, pose by pose; volumes that are known; ends that are early."""

import math

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.workspace.certified.criteria import criteria
from assur.workspace.certified.paving import pave
from assur.workspace.domain import Box, box_of

RNG = np.random.default_rng(4)
GAPS = {
    "zeng2019": 1e-4,
    "fivebar": 1e-4,
    "orthoglide": 1e-2,
    "delta_4s": 3e-2,
    "planar_3rrr": 0.1,
    "linear_delta_4r": 3e-2,
}


def paved(name, gap=1e-3, strokes=None, **options):
    record = assur.load(name)
    asked = criteria(record, strokes=strokes)
    box = box_of(record, None, asked.slice.free)
    return record, asked, box, pave(asked, box, gap, **options)


def sampled(boxes, box, names, count):
    """Poses (count, free) spread over boxes, and over the whole extent of the other coordinates."""
    chosen = RNG.integers(len(boxes), size=count)
    low, high = np.array(box.low), np.array(box.high)
    points = low + RNG.uniform(size=(count, len(low))) * (high - low)
    for row, name in enumerate(names):
        own = RNG.choice([0.0, 1.0, 2.0], size=count)  # ends of boxes as often as their middles
        share = np.where(own == 2.0, RNG.uniform(size=count), own)
        start, extent = boxes.low[row, chosen], (boxes.high - boxes.low)[row, chosen]
        points[:, box.names.index(name)] = start + share * extent
    return points


def exists(record, asked, points):
    """Whether the mode reaches poses, by the inverse problem's answers."""
    poses = asked.slice.poses(points)
    return record.inverse(poses, record.modes.default_working).exists[:, 0]


@pytest.mark.parametrize("name", GAPS)
def test_every_pose_of_boxes_inside_is_reached_and_of_boxes_outside_none(name):
    record, asked, box, found = paved(name, GAPS[name])
    assert len(found.inside) > 10
    assert np.all(exists(record, asked, sampled(found.inside, box, found.names, 4000)))
    assert len(found.outside) > 5
    points = sampled(found.outside, box, found.names, 4000)
    there = exists(record, asked, points)
    # the inverse problem forgives margins within rounding below zero, at the very border only
    assert np.mean(there) < 0.01


def test_boxes_fill_the_whole():
    _, _, box, found = paved("fivebar", 1e-3)
    total = sum(float(np.sum(part.sizes.middle)) for part in (found.inside, found.outside, found.boundary))
    assert total == pytest.approx(math.prod(np.subtract(box.high, box.low)), rel=1e-12)


def test_three_cylinders_of_the_orthoglide():
    """Its reach is the common part of three cylinders: 8 (2 - sqrt 2) r^3 (Steinmetz)."""
    record, asked, _, _ = paved("orthoglide", 0.5)
    radius = record.values.L
    around = Box(asked.slice.free, (-1.01 * radius,) * 3, (1.01 * radius,) * 3)
    found = pave(asked, around, 3e-3)
    exact = 8 * (2 - math.sqrt(2)) * radius**3
    assert found.low < exact < found.high
    assert found.high - found.low < 3e-3 * exact


def test_a_box_without_borders_is_known_to_the_last_bits():
    record = assur.load("zeng2019")
    asked = criteria(record)
    found = pave(asked, Box(asked.slice.free, (-40.0, -50.0, 380.0), (0.0, 50.0, 400.0)), 1e-9)
    assert found.low <= 80000.0 <= found.high
    assert found.high - found.low < 1e-8
    assert len(found.boundary) == 0


def test_an_empty_region_has_no_volume():
    record = assur.load("zeng2019")
    asked = criteria(record)
    found = pave(asked, Box(asked.slice.free, (0.0, 0.0, 2000.0), (10.0, 10.0, 2100.0)))
    assert (found.low, found.high, found.stopped) == (0.0, 0.0, "")
    assert len(found.inside) == len(found.boundary) == 0


def test_what_is_not_used_only_gives_length():
    _, _, _, found = paved("zeng2019", 1e-2)
    assert found.names == ("x", "z")
    assert float(found.length.middle) == 500.0
    _, _, _, all_used = paved("zeng2019", 5e-2, strokes={"yA1": (-300, 300)})
    assert all_used.names == ("x", "y", "z")
    assert all_used.high < found.low


@pytest.mark.parametrize("finest", [10.0, 3.0])
def test_boxes_about_the_boundary_are_of_the_finest_size_but_not_below_half_of_it(finest):
    record, asked, box, found = paved("zeng2019", finest={"x": finest, "z": finest})
    extents = found.boundary.high - found.boundary.low
    assert np.all(extents <= finest * (1 + 1e-9))
    assert np.all(extents > 0.4 * finest)
    assert np.all(exists(record, asked, sampled(found.inside, box, found.names, 2000)))
    assert np.mean(exists(record, asked, sampled(found.outside, box, found.names, 2000))) < 0.01
    assert found.low < 22_814_586.4 < found.high


def test_bounds_of_finer_pavings_lie_within_one_another_s():
    coarse, fine = paved("delta_4s", 0.1)[3], paved("delta_4s", 0.02)[3]
    assert coarse.low < fine.high
    assert fine.low < coarse.high
    assert fine.high - fine.low < 0.3 * (coarse.high - coarse.low)


def test_interruption_keeps_what_is_done():
    calls = []

    def progress(done, total):
        calls.append((done, total))
        if len(calls) == 5:
            raise KeyboardInterrupt

    *_, found = paved("zeng2019", 1e-6, progress=progress)
    assert found.stopped == "interrupted"
    assert found.low < 22_814_586.4 < found.high
    assert all(0 <= done <= total for done, total in calls)


def test_too_many_boxes_end_with_the_gap_reached():
    *_, found = paved("zeng2019", 1e-9, most=2500)
    assert found.stopped == "too many boxes"
    assert found.low < 22_814_586.4 < found.high


def test_misuse():
    record = assur.load("zeng2019")
    asked, box = criteria(record), box_of(record, None)
    for gap in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(UsageError, match="gap"):
            pave(asked, box, gap)
    with pytest.raises(UsageError, match="free"):
        pave(criteria(record, held={"y": 0.0}), box)
    with pytest.raises(UsageError, match="extent"):
        pave(asked, box, finest={"x": 0.0, "z": 1.0})
    with pytest.raises(UsageError, match="no extent for z"):
        pave(asked, box, finest={"x": 1.0})
    with pytest.raises(UnknownNameError):
        pave(asked, box, finest={"q": 1.0})
