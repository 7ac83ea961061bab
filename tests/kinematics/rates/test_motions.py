"""Motions that keep the loops closed, and their ranks in general."""

from pathlib import Path

import numpy as np
import pytest

import assur
from assur.kinematics.closure import closure_jacobian, mobility
from assur.kinematics.rates.motions import general, general_share, motions

HERE = Path(__file__).parent
DELTA = HERE.parents[1] / "model" / "file" / "delta.toml"


@pytest.mark.parametrize(
    ("what", "closure", "freedoms"),
    [("fivebar", 3, 2), ("zeng2019", 14, 3), (DELTA, 30, 3), (HERE / "upu.toml", 12, 3)],
)
def test_ranks_in_general(what, closure, freedoms):
    ranks = general(assur.load(what))
    assert (ranks.closure, ranks.freedoms, ranks.internal) == (closure, freedoms, 0)
    assert ranks.inputs == ranks.pose == ranks.twists == ranks.related == ranks.moving == freedoms


def test_spinning_rods_are_internal(balls):
    ranks = general(balls)
    assert (ranks.closure, ranks.freedoms, ranks.internal, ranks.twists) == (30, 9, 6, 3)


def test_the_null_space_keeps_the_loops_closed_and_is_all_that_does():
    mechanism = assur.load("zeng2019")
    motion = motions(mechanism, mechanism.home_values)
    matrix = closure_jacobian(mechanism, mechanism.home_values)
    np.testing.assert_allclose(matrix @ (motion.scale[:, None] * motion.null), 0.0, atol=1e-10 * np.abs(matrix).max())
    assert np.linalg.matrix_rank(motion.null) == int(mobility(mechanism, mechanism.home_values).freedoms)


def test_rank_is_that_of_mobility_and_does_not_depend_on_the_place():
    mechanism = assur.load("zeng2019")
    for far in (0.0, 1e3, 1e6, 1e8):
        values = mechanism.home_values.copy()
        values[:3] += far
        assert motions(mechanism, values).ranks.closure == mobility(mechanism, values).rank == 14
    assert closure_jacobian(mechanism, values).shape == (24, 17)


def test_what_is_general_holds_around_home_and_not_at_a_home_that_is_singular():
    """g = l1: the five-bar's cranks and rods on one line are a home at which the closure loses rank."""
    mechanism = assur.load("fivebar", g=100.0)
    flat = mechanism.inverse([194.0, 0.0], "++").joints[0]
    assert motions(mechanism, flat).ranks.closure == 2
    assert general(mechanism).closure == 3
    assert 0.0 < general_share(mechanism) < 1.0
