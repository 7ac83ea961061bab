"""Laws of the position problem: a closed form is a claim about the joint graph, and these check it."""

from __future__ import annotations

import numpy as np
import pytest

from assur.kinematics.closure import characteristic_length, closure_error
from assur.kinematics.modes import mode_text
from assur.kinematics.status import NEAR_SINGULAR, Status, closed_form_of, relative_factors
from assur.model.joint_graph import frames
from assur.model.points import quantity

SHAPES = [(), (1,), (3, 1, 2)]


def test_home_closes_and_is_in_the_default_modes(mechanism):
    length = characteristic_length(mechanism)
    assert closure_error(mechanism, mechanism.home_values) < 1e-11 * length
    working = [np.sign(quantity(mechanism, f, mechanism.home_values)) for f in mechanism.modes.working.values()]
    assembly = [np.sign(quantity(mechanism, f, mechanism.home_values)) for f in mechanism.modes.assembly.values()]
    assert mode_text(working) == mechanism.modes.default_working
    assert mode_text(assembly) == mechanism.modes.default_assembly


def test_every_inverse_solution_closes_the_whole_joint_graph(mechanism, poses):
    found = mechanism.inverse(poses)
    assert np.any(found.exists)
    assert np.max(found.residuals[found.exists]) < 1e-11 * characteristic_length(mechanism)


def test_every_direct_solution_closes_the_whole_joint_graph(mechanism, regular):
    found = mechanism.direct(np.array([inputs for _, _, inputs, _ in regular]))
    assert np.any(found.exists)
    assert np.max(found.residuals[found.exists]) < 1e-10 * characteristic_length(mechanism)


def test_joint_values_carry_the_pose_and_the_inputs(mechanism, regular):
    for pose, _, inputs, joints in regular[:40]:
        rotation, origin = frames(mechanism, joints)[mechanism.platform.link]
        point = rotation @ mechanism.platform.point + origin
        for name, value in zip(mechanism.platform.pose, pose, strict=True):
            assert point["xyz".index(name)] == pytest.approx(value, abs=1e-9)
        printed = [item.sign * joints[item.coordinate.index] + item.offset for item in mechanism.inputs]
        assert printed == pytest.approx(list(inputs), abs=1e-9)


def test_declared_constant_orientation_is_constant(mechanism, regular):
    turned = [frames(mechanism, joints)[mechanism.platform.link][0] for _, _, _, joints in regular]
    spread = np.max(np.abs(np.array(turned) - np.eye(3)))
    assert (spread < 1e-12) == (mechanism.platform.orientation == "constant")


def test_modes_are_the_signs_of_the_named_quantities(mechanism, regular):
    for _, mode, _, joints in regular:
        signs = [np.sign(quantity(mechanism, formula, joints)) for formula in mechanism.modes.working.values()]
        assert mode_text(signs) == mode


def test_assembly_modes_are_the_signs_of_the_named_quantities(mechanism, regular):
    found = mechanism.direct(np.array([inputs for _, _, inputs, _ in regular]))
    for row, branch in zip(*np.nonzero(found.exists & (found.status == Status.regular)), strict=True):
        joints = found.joints[row, branch]
        signs = [np.sign(quantity(mechanism, formula, joints)) for formula in mechanism.modes.assembly.values()]
        assert mode_text(signs) == mode_text(found.modes[row, branch])


def test_direct_of_inverse_returns_the_pose(mechanism, regular):
    inputs = np.array([inputs for _, _, inputs, _ in regular])
    found = mechanism.direct(inputs)
    for row, (pose, _, _, _) in enumerate(regular):
        gaps = np.linalg.norm(found.poses[row][found.exists[row]] - pose, axis=-1)
        assert np.min(gaps) < 1e-7 * characteristic_length(mechanism)


def test_inverse_of_direct_returns_the_inputs(mechanism, regular):
    inputs = np.array([inputs for _, _, inputs, _ in regular])
    direct = mechanism.direct(inputs)
    good = direct.exists & (direct.status == Status.regular)
    back = mechanism.inverse(direct.poses[good])
    wanted = np.broadcast_to(inputs[:, None, :], direct.inputs.shape)[good]
    gaps = np.abs(_turned(mechanism, back.inputs - wanted[:, None, :])).max(axis=-1)
    assert np.max(np.min(np.where(back.exists, gaps, np.inf), axis=-1)) < 1e-6 * characteristic_length(mechanism)


def _turned(mechanism, differences):
    """Differences of angles to the nearest turn."""
    angular = np.array([item.coordinate.kind == "angle" for item in mechanism.inputs])
    return np.where(angular, (differences + np.pi) % (2 * np.pi) - np.pi, differences)


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_batch_shapes_agree_with_single_problems(mechanism, regular, shape):
    count = int(np.prod(shape))
    poses = np.array([pose for pose, _, _, _ in regular[:count]]).reshape(*shape, -1)
    inputs = np.array([inputs for _, _, inputs, _ in regular[:count]]).reshape(*shape, -1)
    inverse, direct = mechanism.inverse(poses), mechanism.direct(inputs)
    branches = len(inverse.modes_asked)
    assert inverse.inputs.shape == (*shape, branches, len(mechanism.inputs))
    assert direct.poses.shape == (*shape, len(direct.modes_asked), len(mechanism.platform.pose))
    for index in np.ndindex(shape):
        np.testing.assert_array_equal(inverse.inputs[index], mechanism.inverse(poses[index]).inputs)
        np.testing.assert_array_equal(direct.poses[index], mechanism.direct(inputs[index]).poses)
        np.testing.assert_array_equal(direct.status[index], mechanism.direct(inputs[index]).status)


def test_one_mode_is_the_same_as_its_row_of_all_modes(mechanism, regular):
    for pose, mode, inputs, _ in regular[:20]:
        np.testing.assert_allclose(mechanism.inverse(pose, mode).inputs[0], inputs, rtol=0, atol=1e-12)


def test_no_unlabelled_nan(mechanism, poses):
    far = np.concatenate([poses, poses * 10.0])
    for found in (mechanism.inverse(far), mechanism.direct(far)):
        missing = np.isin(found.status, (Status.unreachable, Status.self_motion, Status.undecided))
        assert np.all(np.isfinite(found.poses[found.exists]))
        assert np.all(np.isfinite(found.joints[found.exists]))
        assert np.all(missing | np.isfinite(found.poses).all(axis=-1))


@pytest.mark.parametrize("distance", [1e-3, 1e-6, 1e-9, 1e-12, 0.0])
def test_near_singular_configurations_close_and_are_labelled(mechanism, singular_examples, distance):
    assert singular_examples
    toward = np.random.default_rng(4).normal(size=(8, len(mechanism.platform.pose)))
    for example in singular_examples:
        for step in toward:
            found = mechanism.inverse(example.pose + distance * step, example.mode)
            if not found.exists[0]:
                assert found.failures
                assert all(failure.value < 0 for failure in found.failures)
                continue
            assert found.residuals[0] < 1e-7 * characteristic_length(mechanism)
            sizes = relative_factors(mechanism, found.factors)
            kinds = {item.name: item.kind for item in closed_form_of(mechanism).factor_list}
            least = min(abs(float(size[0])) for name, size in sizes.items() if kinds[name] != "other")
            assert (found.status[0] == Status.regular) == (least > NEAR_SINGULAR)


def test_direct_at_singular_examples_finds_the_pose_or_says_why_not(mechanism, singular_examples):
    for example in singular_examples:
        found = mechanism.direct(example.inputs)
        if found.overall_status == Status.self_motion:
            assert len(found) == 0
            nearest = [np.linalg.norm(curve.poses(4001) - example.pose, axis=-1).min() for curve in found.curves]
        else:
            nearest = np.linalg.norm(found.poses[found.exists] - example.pose, axis=-1)
        assert np.min(nearest) < 1e-2 * characteristic_length(mechanism)


def test_self_motion_is_a_curve_of_assemblies_with_locked_inputs(mechanism, singular_examples):
    moving = [example for example in singular_examples if example.status == Status.self_motion]
    claims = [set(group) for group in closed_form_of(mechanism).self_motion_singular]
    factors = {example.factor.name for example in singular_examples}
    assert moving or not any(group <= factors for group in claims)
    for example in moving:
        found = mechanism.direct(example.inputs)
        assert len(found) == 0
        assert found.curves
        for curve in found.curves:
            joints = curve.joints(41)
            assert np.max(closure_error(mechanism, joints)) < 1e-6 * characteristic_length(mechanism)
            locked = joints[:, mechanism.input_indices]
            np.testing.assert_allclose(locked, np.broadcast_to(locked[0], locked.shape), rtol=0, atol=1e-6)
            spread = np.ptp(curve.poses(41), axis=0).max()
            assert spread > 1e-3 * (curve.interval[1] - curve.interval[0])
