from __future__ import annotations

import numpy as np
import pytest

from assur.kinematics.border import inputs_of
from assur.kinematics.pose import pose_of
from assur.mechanism import load, names
from assur.page.ranges import input_ranges, pose_ranges


@pytest.mark.parametrize("name", names())
def test_home_lies_on_every_slider(name):
    record = load(name)
    for ranges, home in (
        (input_ranges(record), inputs_of(record, record.home_values)),
        (pose_ranges(record), pose_of(record, record.home_values)),
    ):
        low, high = np.array(ranges).T
        assert np.all(low < high)
        assert np.all((low <= home) & (home <= high))


@pytest.mark.parametrize("name", names())
def test_a_stroke_is_what_its_slider_covers(name):
    record = load(name)
    for item, (low, high) in zip(record.inputs, input_ranges(record), strict=True):
        if item.stroke is not None:
            assert (low, high) == item.stroke


def test_without_a_stroke_it_covers_what_the_workspace_needs():
    record = load("zeng2019")
    low, high = np.array(input_ranges(record)).T
    grid = np.stack(np.meshgrid(*(np.linspace(*record.box[n], 12) for n in "xyz"), indexing="ij"), axis=-1)
    found = record.inverse(grid.reshape(-1, 3), "++-++")
    needed = found.inputs[found.exists]
    inside = np.mean((low <= needed) & (needed <= high))
    assert inside > 0.99
    assert np.all(high - low < 1.2 * np.ptp(needed, axis=0))


def test_without_a_box_it_lies_around_home(drafted):
    record = load(drafted)
    home = inputs_of(record, record.home_values)
    assert np.allclose(np.mean(input_ranges(record), axis=1), home)
