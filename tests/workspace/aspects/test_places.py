"""Places: inside, outside, beyond, undecided; and straight lines that join a pose to a box."""

import math

import numpy as np
import pytest

from assur.errors import UsageError
from assur.model.registry import load_record
from assur.workspace.aspects.aspects import aspects
from assur.workspace.aspects.places import holding, point_of, straight
from assur.workspace.domain import Box

RECORD = load_record("fivebar")
FOUND = aspects(RECORD, "-+", {"x": (-300.0, 300.0), "y": (-300.0, 300.0)}, finest=9.375)
TOP = math.sqrt((RECORD.values.l1 + RECORD.values.l2) ** 2 - RECORD.values.g**2)
"""y of P on the axis of symmetry with crank and rod in line."""


def test_a_pose_in_a_box():
    place = FOUND.of({"y": 200.0, "x": 0.0})
    assert (place.status, place.aspect, place.signs["sin_rods"]) == ("inside", "+", 1)
    assert len(place.boxes) == 0


@pytest.mark.parametrize("distance", [1.0, 1e-2, 1e-3])
def test_a_pose_near_the_border_is_joined_by_a_line(distance):
    place = FOUND.of([0.0, TOP - distance])
    assert (place.status, place.aspect) == ("inside", "+")
    assert len(holding(FOUND.search.certain, place.points[0])) == 0
    assert place.box in holding(FOUND.search.certain, place.points[-1])
    ends = place.points[:-1].T, place.points[1:].T
    assert all(np.all((place.boxes.low <= end) & (end <= place.boxes.high)) for end in ends)


def test_above_the_border_nothing_is_reached():
    place = FOUND.of([0.0, TOP + 1e-9])
    assert (place.status, place.aspect) == ("outside", "")
    assert place.why == "reach1, reach2 < 0: not reached"


def test_on_the_border_it_is_undecided():
    place = FOUND.of([0.0, TOP])
    assert place.status in ("undecided", "outside")
    assert place.aspect == ""


def test_beyond_the_box():
    place = FOUND.of([0.0, 400.0])
    assert (place.status, place.why) == ("beyond", "y = 400 is beyond the box, -300 to 300")


def test_a_line_across_a_singularity_is_not_proved():
    one, two = (item.boxes.middles[:, np.argmax(item.boxes.sizes.low)] for item in FOUND.aspects)
    assert straight(FOUND.search, one, two) is None
    assert straight(FOUND.search, one, one + 1.0) is not None


@pytest.mark.parametrize(
    ("pose", "word"),
    [([1.0], "shape"), ({"x": 1.0}, "wanted"), ([math.nan, 0.0], "finite"), ({"x": 1.0, "q": 2.0}, "wanted")],
)
def test_misuse_is_refused(pose, word):
    with pytest.raises(UsageError, match=word):
        point_of(Box(("x", "y"), (0.0, 0.0), (1.0, 1.0)), pose)
