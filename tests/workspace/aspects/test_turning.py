"""Angles without ends: boxes that certainly close a turn, and a planar mechanism whose aspect goes on from 180 deg."""

from fractions import Fraction

import numpy as np
import pytest
from mpmath import mp

from assur.certificates.paths import path_certificate
from assur.kinematics.position import inverse
from assur.model.registry import load_record, names
from assur.numerics.intervals.functions import from_degrees
from assur.workspace.aspects.aspects import aspects
from assur.workspace.aspects.checking import check_path, covered
from assur.workspace.aspects.turning import moved, once, turned, turns
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.planes import judged
from assur.workspace.domain import Box

with mp.workdps(40):
    TWO_PI = Fraction(str(2 * mp.pi))
STARTS = [-np.pi, 0.0, -2.9, 1e-9, 3.0]
RRR = load_record("planar_3rrr", m=180)
"""With rods so long the platform turns fully about the middle."""


@pytest.mark.parametrize("low", STARTS)
def test_the_ends_of_a_whole_turn_meet_and_nothing_counts_twice(low):
    box = turned(Box(("phi",), (low,), (low + 2 * np.pi,)), ["phi"])
    length = Fraction(box.high[0]) - Fraction(box.low[0])
    assert 0 <= length - TWO_PI < Fraction(1, 10**14)
    whole = once(Boxes(np.array([box.low]), np.array([box.high])), [(box.low[0], box.high[0])])
    assert Fraction(-1, 10**14) < Fraction(float(whole.high[0, 0])) - Fraction(box.low[0]) - TWO_PI <= 0


@pytest.mark.parametrize("degrees", [-180.0, -720.0, -213.7, 0.0, 90.0])
@pytest.mark.parametrize("wide", [False, True])
def test_a_turn_in_degrees_is_meant_however_its_ends_are_rounded(degrees, wide):
    low, high = np.radians(degrees), np.radians(degrees + 360)
    if wide:
        low, high = from_degrees(low).low, from_degrees(high).high
    found = turned(Box(("phi",), (float(low),), (float(high),)), ["phi"])
    assert Fraction(found.high[0]) - Fraction(found.low[0]) >= TWO_PI


@pytest.mark.parametrize("high", [np.pi - 1e-6, np.pi + 1e-6, np.pi - 5e-13, np.pi + 5e-13, np.pi - 2e-14, 10.0])
def test_other_intervals_are_left_as_they_are(high):
    box = Box(("x", "phi"), (-np.pi, -np.pi), (np.pi, high))
    assert turned(box, box.names) == box
    assert turned(Box(("x", "phi"), (-np.pi, -np.pi), (np.pi, np.pi)), ["x"]).high == (np.pi, np.pi)


def test_boxes_after_turns_meet_exactly():
    low, high = turned(Box(("phi",), (-np.pi,), (np.pi,)), ["phi"]).intervals[0]
    edges = np.linspace(low, high, 9)
    edges[-1] = high
    ends, order = [(low, high)], np.array([6, 7, 0, 1, 2, 3, 4, 5, 6, 7, 0, 7, 6])
    boxes = Boxes(edges[:-1][None, order], edges[1:][None, order])
    count = turns(boxes, ends)
    assert count.tolist() == [[0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 2, 1, 1]]
    first, last = moved(boxes.low, count, ends)[0], moved(boxes.high, count, ends)[0]
    assert np.all((first[1:] == last[:-1]) | (last[1:] == first[:-1]))
    assert np.all(first < last)


def line(held, low=-np.pi, high=np.pi, **options):
    return aspects(RRR, held=held, box={"phi": (low, high)}, **options)


CENTRE = {"x": 0.0, "y": 0.0}


def test_an_aspect_goes_on_beyond_the_half_turn():
    found, cut = line(CENTRE), line(CENTRE, -np.pi + 1e-6, np.pi)
    assert (found.turning, cut.turning) == (("phi",), ())
    assert len(cut) == len(found) + 1
    start, end = [np.radians(178.0)], [np.radians(-178.0)]
    assert found.of(start).aspect == found.of(end).aspect != ""
    assert cut.of(start).aspect != cut.of(end).aspect


def test_a_path_across_is_proved_and_the_shorter_one():
    found = line(CENTRE)
    path = found.path([np.radians(170.0)], [np.radians(-170.0)])
    assert path.status == "connected"
    np.testing.assert_allclose(np.degrees(path.points[[0, -1], 0]), [170.0, 190.0], atol=1e-9)
    assert np.all(np.diff(path.points[:, 0]) >= 0)
    assert covered(path)
    assert np.all(judged(found.search.frame, path.boxes, shares=False).inside)
    assert check_path(RRR, found, path).passed
    made = path_certificate(RRR, found, path)
    assert (made.claims["reached"], made.claims["regular"]) == ("yes", "yes")
    back = found.path([np.radians(-170.0)], [np.radians(170.0)])
    np.testing.assert_allclose(np.degrees(back.points[[0, -1], 0]), [-170.0, -190.0], atol=1e-9)


def test_in_a_plane_and_from_another_beginning_it_is_the_same_aspect():
    """Where the turn begins does not matter: so many aspects, so large."""
    every = [
        aspects(RRR, held={"y": 0.0}, box={"x": (-30.0, 30.0), "phi": (low, low + 2 * np.pi)}) for low in (-np.pi, 0.5)
    ]
    assert len(every[0]) == len(every[1])
    for one, two in zip(every[0].aspects, every[1].aspects, strict=True):
        assert one.volume[0] < two.volume[1]
        assert two.volume[0] < one.volume[1]


TURNING = [
    name for name in names() if load_record(name).closed_form and {"phi", "psi"} & set(load_record(name).platform.pose)
]


@pytest.mark.parametrize("name", TURNING)
def test_a_whole_turn_changes_nothing(name):
    """Poses an angle's turn apart are one pose to the kernels."""
    record = load_record(name)
    rng = np.random.default_rng(1)
    low, high = np.array([record.box[axis] for axis in record.platform.pose]).T
    poses = rng.uniform(low, high, (50, len(low)))
    answer = inverse(record, poses, record.modes.default_working)
    for axis in {"phi", "psi"} & set(record.platform.pose):
        there = poses.copy()
        there[:, record.platform.pose.index(axis)] += 2 * np.pi
        again = inverse(record, there, record.modes.default_working)
        np.testing.assert_array_equal(answer.exists, again.exists)
        for factor, values in answer.factors.items():
            np.testing.assert_allclose(again.factors[factor], values, rtol=1e-8, atol=1e-8)
