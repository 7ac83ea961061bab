"""Joint values to numbers without trigonometry, and back."""

from __future__ import annotations

import numpy as np
import pytest

import assur
from assur.kinematics.loop_state import move, state_names, state_of
from assur.numerics import rotations


@pytest.mark.parametrize("name", ["three_upu", "linear_delta_4s"])
def test_there_and_back_whole_turns_included(name):
    record = assur.load(name)
    rng = np.random.default_rng(0)
    before = rng.uniform(-9.0, 9.0, (len(record.coordinates), 40))
    wanted = before + rng.uniform(-0.3, 0.3, before.shape)
    found = before.copy()
    state = state_of(record, wanted)
    move(record, found, state_of(record, before), state, range(len(state)))
    np.testing.assert_allclose(state_of(record, found), state * _signs(record, found, wanted), atol=1e-13)
    for k, names in state_names(record).items():
        if len(names) < 4:
            np.testing.assert_allclose(found[k], wanted[k], atol=1e-13)
        else:
            turned = (rotations.from_vector(part[k : k + 3].T) for part in (found, wanted))
            np.testing.assert_allclose(*turned, atol=1e-13)
            near = np.linalg.norm(found[k : k + 3] - before[k : k + 3], axis=0)
            assert np.all(near <= np.linalg.norm(wanted[k : k + 3] - before[k : k + 3], axis=0) + 1e-12)


def _signs(record, found, wanted):
    """A quaternion and its negative are one rotation."""
    signs, row = np.ones_like(state_of(record, found)), 0
    for names in state_names(record).values():
        if len(names) == 4:
            pairs = state_of(record, found)[row : row + 4] * state_of(record, wanted)[row : row + 4]
            signs[row : row + 4] = np.sign(pairs.sum(axis=0))
        row += len(names)
    return signs


def test_a_rotation_by_nothing():
    record = assur.load("linear_delta_4s")
    still = np.zeros((len(record.coordinates), 3))
    state = state_of(record, still)
    found = still.copy()
    move(record, found, state, state, range(len(state)))
    np.testing.assert_array_equal(found, still)


def test_rows_that_did_not_move_stay_to_the_bit():
    record = assur.load("three_upu")
    values = np.random.default_rng(1).uniform(-9, 9, (len(record.coordinates), 5))
    found = values.copy()
    move(record, found, state_of(record, values), state_of(record, values + 0.1), [])
    np.testing.assert_array_equal(found, values)
