"""Recorded loop equations beside those of `closure`, which are written over arrays."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.closure import _largest, characteristic_length, closing_system, residuals
from assur.kinematics.loop_equations import LoopEquations, about
from assur.kinematics.loop_state import move, state_names, state_of
from assur.model.joint_graph import joint_graph
from assur.numerics import components
from assur.numerics.recording.folding import Folding
from assur.topology.joints import SPHERICAL
from catalogue import each


def _near_home(mechanism, size, count=20):
    """Joint values (n, count) away from home by at most a size, in rad and in characteristic lengths."""
    length = characteristic_length(mechanism)
    units = np.array([length if item.kind == "length" else 1.0 for item in mechanism.coordinates])
    shift = np.random.default_rng(0).uniform(-size, size, (count, len(units))) * units
    return (mechanism.home_values + shift).T


def _evaluated(equations, outputs, state):
    tape = equations.folding.tape(outputs)
    found = tape.evaluate(list(state), list(equations.folding.numbers))
    return {name: np.broadcast_to(value, state.shape[1]) for name, value in found.items()}


@pytest.mark.parametrize("name", each())
def test_gaps_are_those_of_the_closure(name):
    """Anywhere: distances; and rotations, by the chord and by the sine vector of what the closure has as a vector."""
    mechanism = assur.load(name)
    values = _near_home(mechanism, 0.3)
    equations = LoopEquations(mechanism, Folding())
    state, length = state_of(mechanism, values), characteristic_length(mechanism)
    expected = residuals(mechanism, values.T)
    gaps = _evaluated(equations, {str(k): gap for k, gap in enumerate(equations.gaps)}, state)
    found = np.stack([gaps[str(k)] for k in range(len(equations.gaps))], axis=-1).reshape(expected.shape)
    np.testing.assert_allclose(found[..., :3], expected[..., :3], atol=1e-12 * length)
    angle = np.linalg.norm(expected[..., 3:], axis=-1, keepdims=True) / length
    np.testing.assert_allclose(found[..., 3:], expected[..., 3:] / length * np.sinc(angle / np.pi), atol=1e-12)
    chords = {str(k): chord for k, (_, chord) in enumerate(equations.squares)}
    found = np.stack(list(_evaluated(equations, chords, state).values()), axis=-1)
    np.testing.assert_allclose(found, 4.0 * np.sin(angle[..., 0] / 2) ** 2, atol=1e-12)


@pytest.mark.parametrize("name", each())
def test_the_derivative_is_that_of_the_closure_at_assemblies(name):
    """A ball joint's three columns are along the parent's axes here, rates of its rotation vector there."""
    mechanism = assur.load(name)
    home = np.array(mechanism.home_values)
    equations = LoopEquations(mechanism, Folding())
    _, expected = closing_system(mechanism, home[None], None)
    matrix = np.zeros(expected.shape[1:])
    names = {f"{i} {j}": entry for (i, j), entry in equations.derivative.items()}
    for (i, j), value in zip(
        equations.derivative, _evaluated(equations, names, state_of(mechanism, home[:, None])).values(), strict=True
    ):
        matrix[i, j] = value[0] * (characteristic_length(mechanism) if i % 6 >= 3 else 1.0)
    for name_of, joint in mechanism.joints.items():
        if joint.type is SPHERICAL:
            columns = joint_graph(mechanism).slices[name_of]
            matrix[:, columns] = matrix[:, columns] @ components.left_jacobian(home[columns])
    np.testing.assert_allclose(matrix, expected[0], atol=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize("name", ["three_crr", "three_upu", "linear_delta_4s"])
def test_changes_turn_angles_and_ball_joints_and_keep_them_of_unit_length(name):
    mechanism = assur.load(name)
    values = _near_home(mechanism, 0.2)
    size = 1e-3
    equations = LoopEquations(mechanism, Folding())
    moved = equations.moved(dict.fromkeys(range(len(mechanism.coordinates)), size))
    names = state_names(mechanism)
    outputs = {label: part for k, own in names.items() for label, part in zip(own, moved[k], strict=True)}
    state = state_of(mechanism, values)
    after = np.stack(list(_evaluated(equations, outputs, state).values()))
    found, row = values.copy(), 0
    move(mechanism, found, state, after, range(len(state)))
    for k, own in names.items():
        if len(own) > 1:
            np.testing.assert_allclose(np.sum(after[row : row + len(own)] ** 2, axis=0), 1.0, atol=1e-14)
        if len(own) < 4:
            np.testing.assert_allclose(found[k], values[k] + size, atol=1e-9)
        else:
            before, now = (components.from_vector(part[k : k + 3].T) for part in (values, found))
            turn = components.from_vector(np.full(3, size))
            np.testing.assert_allclose(now, turn @ before, atol=1e-8)
        row += len(own)


def test_half_a_turn_is_a_gap():
    """The sine vector vanishes there too; the chord does not."""
    mechanism = assur.load("zeng2019")
    values = np.array(mechanism.home_values)[:, None]
    values[[item.index for item in mechanism.coordinates if item.joint == "D2"]] += np.pi
    equations = LoopEquations(mechanism, Folding())
    squares = {str(k): chord for k, (_, chord) in enumerate(equations.squares)}
    found = max(_evaluated(equations, squares, state_of(mechanism, values)).values(), key=np.max)
    assert float(_largest(residuals(mechanism, values.T))[0]) > 1.0
    assert found == pytest.approx(4.0)


def test_a_rotation_about_any_axis():
    axis, angle = np.array([2.0, -1.0, 2.0]) / 3, 0.7
    found = about(axis, np.cos(angle), np.sin(angle)).astype(float)
    np.testing.assert_allclose(found, components.about_axis(axis, np.array(angle)), atol=1e-15)
    straight = about(np.array([0.0, 0.0, 1.0]), 0.6, 0.8)
    assert straight.tolist() == [[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]]


def test_a_helical_joint_is_refused():
    with pytest.raises(UsageError, match="J3 is helical"):
        LoopEquations(assur.load(Path(__file__).parent / "rates" / "every_type.toml"), Folding())
