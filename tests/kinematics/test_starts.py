"""Starts of a search: which joints of known assemblies they keep, and that ball joints stand anywhere alike."""

import numpy as np
import pytest

import assur
from assur.joint_graph.tree import joint_graph
from assur.kinematics.starts import REDRAWN, by_chance, mixed, redrawn
from assur.numerics import rotations


def test_joints_of_known_assemblies_are_kept_or_exchanged_whole():
    delta, rng = assur.load("delta_4s"), np.random.default_rng(0)
    known = by_chance(delta, 2, rng)
    for start in mixed(delta, known, 8, rng):
        for place in joint_graph(delta).slices.values():
            assert any(np.array_equal(start[place], row[place]) for row in known)
    kept = [
        np.array_equal(start[place], known[k % 2][place])
        for k, start in enumerate(redrawn(delta, known, 40, rng))
        for place in joint_graph(delta).slices.values()
    ]
    assert np.mean(kept) == pytest.approx(1.0 - REDRAWN, abs=0.1)


def test_ball_joints_stand_anywhere_alike():
    """The mean of a rotation matrix over all rotations is zero, and none is turned by more than half a turn."""
    delta = assur.load("delta_4s")
    start = by_chance(delta, 4000, np.random.default_rng(0))
    for place in joint_graph(delta).turns[:2]:
        assert np.max(np.linalg.norm(start[:, place], axis=1)) <= np.pi
        mean = np.mean(rotations.from_vector(start[:, place]), axis=0)
        assert np.max(np.abs(mean)) < 5 * np.sqrt(1 / 3 / 4000)
