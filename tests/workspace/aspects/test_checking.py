"""The check of a path finds what is wrong with a path that is wrong."""

from dataclasses import replace

import numpy as np
import pytest

from assur.errors import UsageError
from assur.model.registry import load_record
from assur.workspace.aspects.aspects import aspects
from assur.workspace.aspects.checking import check_path

RECORD = load_record("fivebar")
FOUND = aspects(RECORD, "-+", {"x": (-300.0, 300.0), "y": (-300.0, 300.0)}, finest=9.375)
PATH = FOUND.path([0.0, 200.0], [0.0, -200.0])


def straight_to(end):
    """The straight line with a false certificate: one box about all of it."""
    points = np.array([PATH.points[0], end])
    one = PATH.boxes[:1]
    box = replace(one, low=points.min(axis=0)[:, None], high=points.max(axis=0)[:, None])
    return replace(PATH, points=points, boxes=box)


def test_a_path_through_what_is_not_reached_fails():
    check = check_path(RECORD, FOUND, straight_to([0.0, -200.0]))
    assert (check.covered, check.reached, check.followed) == (True, False, False)
    assert check.stopped
    assert not check.passed


def test_a_path_through_a_singularity_fails():
    inner = FOUND["-"].boxes.middles[:, 0]
    below = replace(PATH, points=np.array([[inner[0], -200.0], inner]), boxes=straight_to([0.0, 0.0]).boxes)
    check = check_path(RECORD, FOUND, below)
    assert check.reached
    assert not check.kept
    assert not check.passed


def test_a_path_beyond_the_strokes_fails():
    narrow = replace(FOUND, strokes={"theta1": (0.0, 0.001)})
    assert not check_path(RECORD, narrow, PATH, follow_it=False).reached


def test_without_a_path_there_is_nothing_to_check():
    with pytest.raises(UsageError, match="no path to check"):
        check_path(RECORD, FOUND, FOUND.path([0.0, 200.0], [0.0, 0.0]))
