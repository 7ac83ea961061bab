"""Programs of a configuration over dual numbers, against central differences."""

from pathlib import Path

import numpy as np
import pytest

import assur
from assur.joint_graph.frames import flat, frame_numbers
from assur.joint_graph.programs import program
from assur.joint_graph.tree import joint_graph
from assur.numerics import rotations

EVERY_TYPE = Path(__file__).parents[1] / "kinematics" / "rates" / "every_type.toml"


@pytest.mark.parametrize("what", [EVERY_TYPE, "delta_4s"])
def test_frames_move_with_every_joint_type(what):
    mechanism, step = assur.load(what), 1e-6
    values, rates = np.random.default_rng(0).normal(size=(2, 5, len(mechanism.coordinates)))
    asked = np.array(rates)  # of rotation vectors, for angular velocities in the parent's frame
    for place in joint_graph(mechanism).turns:
        asked[:, place] = rotations.vector_rates(values[:, place], rates[:, place])
    frames = program(mechanism, frame_numbers)
    ahead, behind = (frames(mechanism, flat(mechanism, values + sign * step * asked)) for sign in (1, -1))
    differences = (ahead - behind) / (2 * step)
    assert np.abs(differences).max() > 1
    scale = 1 + np.abs(differences).max()
    np.testing.assert_allclose(frames.derivative(mechanism, values, rates), differences, atol=1e-8 * scale)
