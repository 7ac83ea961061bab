"""Rays: directions that leave no gap, and the border and the sliver along it that a ray meets."""

import numpy as np
import pytest

from assur.model.registry import load_record
from assur.singularity.directions import directions
from assur.singularity.parallel_factors import ParallelFactors
from assur.singularity.rays import Brackets, Rays


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
    rays = Rays(ParallelFactors(load_record("zeng2019"), "++-++", [0, 1, 2], "numpy"))
    poses, down = np.array([[0.0, 0.0, 241.0]]), np.array([[[0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]])
    first = rays.brackets(poses, down, np.zeros(1), np.full(1, 20.0), 16)
    assert first.low[0, 0] < 3.877 < first.high[0, 0]
    assert first.high[0, 0] - first.low[0, 0] == pytest.approx(20.0 / 16)
    assert np.isinf(first.low[0, 1])
    length = rays.pinned(poses, down[:, 0], Brackets(first.low[:, 0], first.high[:, 0], first.at_border[:, 0]))
    values, reached = rays.factors.at(poses + length[:, None] * down[:, 0])
    assert reached.all()
    assert np.min(np.abs(values)) < 1e-9


def test_the_border_is_found_and_what_is_beyond_it_is_out_of_reach():
    record = load_record("fivebar")
    rays = Rays(ParallelFactors(record, record.modes.default_working, [0, 1], "numpy"))
    pose, way = np.array([[0.0, 200.0]]), np.array([[0.0, 1.0]])
    beyond = rays.border(pose, way, np.zeros(1), np.full(1, 1000.0))
    _, reached = rays.factors.at(np.concatenate([pose + way * beyond, pose + way * (beyond - 1000.0 / 2**8)]))
    assert reached.tolist() == [False, True]


def test_in_a_line_there_are_two_ways():
    rays = Rays(ParallelFactors(load_record("zeng2019"), "++-++", [2], "numpy"))
    lengths, rows, singular = rays.nearest(np.array([[0.0, 0.0, 241.0]]), 100.0)
    assert lengths[0] == pytest.approx(3.8768, abs=1e-4)
    assert rays.factors.names[rows[0]] == "v"
    assert singular[0, :2].tolist() == [0.0, 0.0]
