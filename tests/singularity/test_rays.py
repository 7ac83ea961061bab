"""Rays: directions that leave no gap, and the border and the sliver along it that a ray meets."""

from __future__ import annotations

import numpy as np
import pytest

from assur.model.registry import load_record
from assur.singularity.rays import Rays, directions


@pytest.mark.parametrize("size", [1, 2, 3])
def test_directions_are_unit_vectors_and_no_gap_is_wider_than_their_spacing(size):
    ways, spacing = directions(size)
    np.testing.assert_allclose(np.linalg.norm(ways, axis=1), 1.0)
    any_way = np.random.default_rng(1).normal(size=(2000, size))
    any_way /= np.linalg.norm(any_way, axis=1, keepdims=True)
    gaps = np.arccos(np.clip(np.max(any_way @ ways.T, axis=1), -1.0, 1.0))
    assert np.max(gaps) <= max(0.85 * spacing, 1e-6)


def test_a_crossing_is_bracketed_and_pinned_where_the_factor_vanishes():
    """Down from 238 mm the paper's v falls to zero; from above no factor does."""
    search = Rays(load_record("zeng2019"), "++-++", [0, 1, 2], "numpy")
    poses, down = np.array([[0.0, 0.0, 241.0]]), np.array([[[0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]])
    low, high, _ = search.crossings(poses, down, np.zeros(1), np.full(1, 20.0), 16)
    assert low[0, 0] < 3.877 < high[0, 0]
    assert high[0, 0] - low[0, 0] == pytest.approx(20.0 / 16)
    assert np.isinf(low[0, 1])
    at = search.pinned(poses, down[:, 0], low[:, 0], high[:, 0])
    values, there = search.sample(poses + at[:, None] * down[:, 0])
    assert there.all()
    assert np.min(np.abs(values)) < 1e-9


def test_the_border_is_found_and_what_is_beyond_it_is_out_of_reach():
    record = load_record("fivebar")
    search = Rays(record, record.modes.default_working, [0, 1], "numpy")
    pose, way = np.array([[0.0, 200.0]]), np.array([[0.0, 1.0]])
    beyond = search.border(pose, way, np.zeros(1), np.full(1, 1000.0))
    _, there = search.sample(np.concatenate([pose + way * beyond, pose + way * (beyond - 1000.0 / 2**8)]))
    assert there.tolist() == [False, True]


def test_in_a_line_there_are_two_ways():
    search = Rays(load_record("zeng2019"), "++-++", [2], "numpy")
    away, which, nearest = search.of(np.array([[0.0, 0.0, 241.0]]), 100.0)
    assert away[0] == pytest.approx(3.8768, abs=1e-4)
    assert search.names[which[0]] == "v"
    assert nearest[0, :2].tolist() == [0.0, 0.0]
