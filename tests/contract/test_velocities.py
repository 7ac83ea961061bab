"""Laws of the velocity problem: against differences, against the null space of the joint graph, and the factors."""

import numpy as np
import pytest

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import closure_jacobian, mobility
from assur.kinematics.modes import all_modes
from assur.kinematics.pose import pose_rates
from assur.kinematics.rates.velocity import printed_velocity_map
from assur.kinematics.status import closed_form_of


def _inputs(mechanism, pose, mode):
    return mechanism.inverse(pose, mode).inputs[0]


def _well_conditioned(mechanism, regular, units, limit=30.0):
    """Regular configurations whose Jacobian, lengths in units of the characteristic length, is well conditioned."""
    matrices = [mechanism.velocity_map(pose, mode).matrix for pose, mode, _, _ in regular]
    own = [np.linalg.cond(matrix / units[:, None] * _input_units(mechanism)) for matrix in matrices]
    chosen = [item for item, condition in zip(regular, own, strict=True) if condition < limit]
    assert len(chosen) > 5
    return chosen[:25]


def test_jacobian_agrees_with_central_differences(mechanism, regular, units, moved):
    rng = np.random.default_rng(3)
    for pose, mode, _, _ in _well_conditioned(mechanism, regular, units):
        velocity = rng.normal(size=len(units)) * units
        step = 1e-6
        ahead, behind = (_inputs(mechanism, moved(pose, side * step * velocity), mode) for side in (1, -1))
        rates = _nearest_turn(mechanism, ahead - behind) / (2 * step)
        here = mechanism.velocity_map(pose, mode)
        np.testing.assert_allclose(here.input(velocity), rates, rtol=1e-5, atol=1e-5 * np.abs(rates).max())
        np.testing.assert_allclose(here.output(rates) / units, velocity / units, rtol=0, atol=1e-4)


def _nearest_turn(mechanism, differences):
    angular = np.array([item.coordinate.kind == "angle" for item in mechanism.inputs])
    return np.where(angular, (differences + np.pi) % (2 * np.pi) - np.pi, differences)


def test_jacobian_agrees_with_the_null_space_of_the_joint_graph(mechanism, regular, units):
    for pose, mode, _, joints in regular[:25]:
        null = _null_space(mechanism, joints, int(mobility(mechanism, joints).rank))
        platform = pose_rates(mechanism, joints) @ null
        rates = np.array([item.sign * null[item.coordinate.index] for item in mechanism.inputs])
        here = mechanism.velocity_map(pose, mode)
        left, right = here.jp @ platform, here.jq @ rates
        np.testing.assert_allclose(left, right, rtol=0, atol=1e-9 * max(np.abs(left).max(), np.abs(right).max()))
        scaled = [platform / units[:, None], rates / _input_units(mechanism)[:, None]]
        moving = np.linalg.matrix_rank(np.concatenate(scaled), tol=1e-7)
        assert moving == len(mechanism.inputs)


def _null_space(mechanism, joints, rank):
    """Rates (n, F) that keep the loops closed, lengths counted in units of the characteristic length."""
    length = characteristic_length(mechanism)
    units = np.array([length if item.kind == "length" else 1.0 for item in mechanism.coordinates])
    _, _, rows = np.linalg.svd(closure_jacobian(mechanism, joints) * units)
    return units[:, None] * rows[rank:].T


def test_determinants_are_the_products_of_their_factors(mechanism, poses):
    form = closed_form_of(mechanism)
    found = mechanism.inverse(poses)
    for k, mode in enumerate(all_modes(mechanism, "inverse")):
        real = found.exists[:, k]
        if not np.any(real):
            continue
        here = mechanism.velocity_map(poses[real], mode)
        turned = np.prod([item.sign for item in mechanism.inputs])  # from joint values to printed inputs
        for kind, determinant in (("parallel", here.det_jp), ("serial", turned * here.det_jq)):
            named = [found.factors[item.name][real, k] for item in form.factor_list if item.kind == kind]
            scale = np.prod([np.abs(values).max() + 1e-300 for values in named])
            np.testing.assert_allclose(determinant, np.prod(named, axis=0), rtol=1e-9, atol=1e-11 * scale)


def test_printed_jacobian_gives_the_same_motion(mechanism, regular, units):
    if closed_form_of(mechanism).as_printed is None:
        return
    for pose, mode, _, _ in _well_conditioned(mechanism, regular, units):
        ours, printed = mechanism.velocity_map(pose, mode), printed_velocity_map(mechanism, pose, mode)
        np.testing.assert_allclose(ours.matrix, printed.matrix, rtol=1e-8, atol=1e-9 * np.abs(ours.matrix).max())


def test_acceleration_agrees_with_second_differences(mechanism, regular, units, moved):
    rng = np.random.default_rng(5)
    compared = 0
    for pose, mode, _, _ in _well_conditioned(mechanism, regular, units, limit=20.0)[:12]:
        velocity, curvature = rng.normal(size=(2, len(units))) * units
        step = 1e-4
        path = [_inputs(mechanism, _on_path(moved, pose, t, velocity, curvature), mode) for t in (-step, 0, step)]
        if not np.all(np.isfinite(path)):
            continue
        rates = _nearest_turn(mechanism, path[2] - path[0]) / (2 * step)
        second = (_nearest_turn(mechanism, path[2] - path[1]) - _nearest_turn(mechanism, path[1] - path[0])) / step**2
        compared += 1
        found_velocity, found_acceleration = mechanism.acceleration(pose, rates, second, mode)
        np.testing.assert_allclose(found_velocity / units, velocity / units, rtol=0, atol=1e-3)
        scale = max(np.abs(second / _input_units(mechanism)).max(), 1.0)
        np.testing.assert_allclose(found_acceleration / units, curvature / units, rtol=0, atol=2e-2 * scale)
    assert compared >= 4


def _input_units(mechanism):
    length = characteristic_length(mechanism)
    return np.array([1.0 if item.coordinate.kind == "angle" else length for item in mechanism.inputs])


def _on_path(moved, pose, time, velocity, curvature):
    """The pose at a time, of one that starts with a velocity (of a rotation: angular) and an acceleration."""
    return moved(pose, time * velocity + time * time / 2 * curvature)


def test_kind_agrees_with_the_rank_of_the_joint_graph(mechanism, singular_examples):
    """A factor group that claims a constraint singularity lowers the rank; every other factor keeps it."""
    form = closed_form_of(mechanism)
    general = int(mobility(mechanism, mechanism.home_values).rank)
    for example in singular_examples:
        zero = {
            name
            for name, value in mechanism.singularity(example.pose, example.mode).relative.items()
            if abs(value) <= 4e-7
        }
        claimed = any(set(group) <= zero for group in form.constraint_singular)
        rank = int(mobility(mechanism, example.joints, threshold=1e-5).rank)
        assert (rank < general) == claimed, (example.factor.name, example.mode, zero)


def test_regular_configurations_keep_the_full_rank(mechanism, regular):
    general = int(mobility(mechanism, mechanism.home_values).rank)
    ranks = mobility(mechanism, np.array([joints for _, _, _, joints in regular])).rank
    assert set(ranks.tolist()) == {general}


@pytest.mark.parametrize("kind", ["parallel", "serial"])
def test_reduced_kind_agrees_with_the_rank_of_the_joint_graph(mechanism, singular_examples, kind, units):
    """Where the closure has full rank: locked inputs leave a motion exactly at parallel, and a locked platform
    leaves the inputs a motion exactly at serial singularities."""
    for example in singular_examples:
        free = mobility(mechanism, example.joints, threshold=1e-5)
        if int(free.rank) < int(mobility(mechanism, mechanism.home_values).rank):
            continue
        null = _null_space(mechanism, example.joints, int(free.rank))
        rates = np.array([null[item.coordinate.index] for item in mechanism.inputs]) / _input_units(mechanism)[:, None]
        platform = pose_rates(mechanism, example.joints) @ null / units[:, None]
        count = len(mechanism.inputs)  # what moves neither, a rod that spins, is left out
        moves_when_locked = np.linalg.svd(rates, compute_uv=False)[count - 1] < 1e-5
        stands_while_driven = np.linalg.svd(platform, compute_uv=False)[count - 1] < 1e-5
        verdict = mechanism.singularity(example.pose, example.mode)
        claimed = verdict.reduced_kind in (kind, "comprehensive")
        found = moves_when_locked if kind == "parallel" else stands_while_driven
        assert found == claimed, (example.factor.name, example.mode, verdict)
