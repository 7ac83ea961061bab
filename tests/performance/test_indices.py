"""Indices against their definitions by other formulas, by differences, and at poses where they do not exist."""

import dataclasses

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.rates.motions import input_units, pose_units
from assur.kinematics.rates.units import is_mixed, scaled
from assur.kinematics.status import Status
from assur.performance.indices import INDICES, indices, indices_at
from catalogue import each

ZENG = assur.load("zeng2019")
ROW_3 = [-15.4714, 9.6849, 456.3315]
UNMIXED = [name for name in assur.names() if not is_mixed(assur.load(name))]


def compared(first, second):
    np.testing.assert_allclose(first, second, rtol=1e-6, atol=1e-12)


@pytest.mark.parametrize("name", each())
def test_each_index_is_what_its_formula_says(name, regular_poses):
    mechanism = assur.load(name)
    mode = mechanism.modes.default_working
    poses = regular_poses(mechanism, mode, 20)
    found = indices(mechanism, poses, mode, 70.0)
    assert (found.length, found.unit) == (70.0, "")
    matrix = scaled(mechanism, mechanism.velocity_map(poses, mode).matrix, 70.0)
    transposed = np.swapaxes(matrix, -1, -2)
    inverse = np.linalg.inv(matrix)
    gram = np.linalg.eigvalsh(matrix @ transposed)
    count = matrix.shape[-1]
    compared(found["condition"], 1 / (np.linalg.norm(matrix, 2, (-2, -1)) * np.linalg.norm(inverse, 2, (-2, -1))))
    compared(found["frobenius"], count / np.linalg.norm(matrix, axis=(-2, -1)) / np.linalg.norm(inverse, axis=(-2, -1)))
    compared(found["manipulability"], np.abs(np.linalg.det(matrix)))
    compared(found["largest"], np.sqrt(gram[:, -1]))
    compared(found["smallest"], 1 / np.linalg.norm(inverse, 2, (-2, -1)))
    compared(found["transmission"], np.minimum(found["input_transmission"], found["output_transmission"]))
    assert np.all(found["frobenius"] >= found["condition"] - 1e-12)  # the Frobenius norms' ratio is the milder one
    assert np.all(found["frobenius"] <= 1 + 1e-12)


@pytest.mark.parametrize("name", each())
def test_with_and_without_the_closed_form(name, regular_poses):
    mechanism = assur.load(name)
    mode = mechanism.modes.default_working
    poses = regular_poses(mechanism, mode, 10)
    joints = mechanism.inverse(poses, mode=mode).joints[:, 0]
    first, second = indices(mechanism, poses, mode), indices_at(mechanism, joints)
    assert first.length == second.length
    assert set(second.status.tolist()) <= {Status.regular}
    for index in INDICES:
        np.testing.assert_allclose(first[index], second[index], rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("name", UNMIXED)
def test_without_mixed_units_no_length_changes_a_ratio(name, regular_poses):
    mechanism = assur.load(name)
    mode = mechanism.modes.default_working
    poses = regular_poses(mechanism, mode, 20)
    found = indices(mechanism, poses, mode)
    assert found.length is None
    compared(found.velocity_factors, mechanism.velocity_map(poses, mode).velocity_factors)
    compared(indices(mechanism, poses, mode, 123.0)["condition"], found["condition"])


def test_missing_numbers_are_labelled_and_singular_ones_zero():
    mechanism = assur.load("zeng2019")
    p, x = mechanism.values, ROW_3[0]
    flat = p.l1 + np.sqrt(p.l6**2 - (x - p.b + p.d) ** 2)
    found = indices(mechanism, [ROW_3, [x, 0.0, flat], [90.0, 0.0, 300.0]])
    assert [Status(int(code)).name for code in found.status] == ["regular", "constraint", "unreachable"]
    assert np.isfinite(found["condition"]).tolist() == [True, False, False]
    assert found["transmission"][1] == 0.0
    assert np.isnan(found["transmission"][2])
    assert [Status(code).name for code in found.status] == ["regular", "constraint", "unreachable"]
    assert np.isnan(found.transmission.outputs[2]).all()


def test_a_serial_singularity_has_index_zero():
    """A crank in line with its rod moves nothing along them."""
    mechanism = assur.load("fivebar")
    p = mechanism.values
    reach = p.l1 + p.l2
    pose = [-p.g + reach * np.cos(1.2), reach * np.sin(1.2)]
    found = indices(mechanism, pose)
    assert found["transmission"] == 0.0
    assert found["smallest"] == pytest.approx(0.0, abs=1e-6 * float(found["largest"]))
    near = indices(mechanism, [pose[0] * 1.0 - 1e-9 * np.cos(1.2), pose[1] - 1e-9 * np.sin(1.2)])
    assert 0 <= near["input_transmission"] < 1e-4


@pytest.mark.parametrize("batch", [(), (1,), (3, 1, 2), (0,)])
def test_any_batch_shape(batch):
    mechanism = assur.load("fivebar")
    found = indices(mechanism, np.broadcast_to([10.0, 200.0], (*batch, 2)))
    assert found.status.shape == batch
    assert found.velocity_factors.shape == (*batch, 2)
    assert all(found[name].shape == batch for name in ("smallest", "transmission"))


def test_many_poses_give_what_single_ones_give(monkeypatch, regular_poses):
    mechanism = assur.load("planar_3rrr")
    poses = regular_poses(mechanism, "+++", 20)
    whole = indices(mechanism, poses)
    monkeypatch.setattr("assur.performance.indices.BLOCK", 7)
    for name in INDICES:
        np.testing.assert_allclose(indices(mechanism, poses)[name], whole[name], rtol=1e-12)


def test_a_mechanism_without_closed_form_has_them_too():
    known = assur.load("fivebar")
    bare = dataclasses.replace(known, closed_form=None)
    first, second = indices(known, [10.0, 200.0]), indices(bare, [[10.0, 200.0]], "-+")
    for name in INDICES:
        np.testing.assert_allclose(second[name][0], first[name], rtol=1e-6)
    away = indices(bare, [[900.0, 200.0]], "-+")
    assert Status(int(away.status[0])) == Status.unreachable
    assert np.isnan(away["transmission"][0])


def test_units_of_the_indices():
    found = indices(assur.load("fivebar"), [10.0, 200.0])
    units = {name: index.unit(found) for name, index in INDICES.items()}
    assert (units["manipulability"], units["largest"], units["smallest"]) == ("(mm/rad)^2", "mm/rad", "mm/rad")
    assert all(units[name] == {0: "", 1: "mm/rad", None: "(mm/rad)^2"}[index.power] for name, index in INDICES.items())


def test_misuse():
    mechanism = assur.load("fivebar")
    with pytest.raises(UnknownNameError, match="index"):
        indices(mechanism, [10.0, 200.0])["conditon"]
    with pytest.raises(UsageError, match="pose"):
        indices(mechanism, [1.0, 2.0, 3.0])
    with pytest.raises(UsageError, match="mode"):
        indices(mechanism, [10.0, 200.0], "+++")


@pytest.mark.parametrize("name", assur.names())
def test_the_factors_are_singular_values_of_the_differentiated_inverse(name, regular_poses, slopes):
    mechanism = assur.load(name)
    mode = mechanism.modes.default_working
    poses = regular_poses(mechanism, mode)
    assert len(poses) == 100
    differences = in_one_unit(mechanism, slopes(mechanism, poses, mode))
    known = np.all(np.isfinite(differences), axis=(-1, -2))
    ok = known & (np.linalg.cond(np.where(known[:, None, None], differences, 1.0)) < 1e3)
    assert np.sum(ok) > 80
    exact = np.sort(1 / np.linalg.svd(differences[ok], compute_uv=False), axis=-1)[:, ::-1]
    found = indices(mechanism, poses[ok], mode)
    np.testing.assert_allclose(found.velocity_factors, exact, rtol=1e-3)
    np.testing.assert_allclose(found["condition"], 1 / np.linalg.cond(differences[ok]), rtol=1e-3)


def in_one_unit(mechanism, inverses):
    """J_L^-1 from J^-1 (..., n, k): lengths over the characteristic length where they mix with angles."""
    rates, inputs = pose_units(mechanism), input_units(mechanism)
    return inverses * rates / inputs[:, None] if np.ptp(rates) or np.ptp(inputs) else inverses


def test_the_index_goes_to_zero_towards_a_parallel_singularity():
    p = ZENG.values
    flat = p.l1 + np.sqrt(p.l6**2 - (ROW_3[0] - p.b + p.d) ** 2)
    gaps = np.array([10.0, 1.0, 0.1, 0.01])
    index = indices(ZENG, [[ROW_3[0], 0.0, flat + gap] for gap in gaps])["condition"]
    assert np.all(np.diff(index) < 0)
    assert index[-1] / gaps[-1] == pytest.approx(index[-2] / gaps[-2], rel=0.05)  # linearly
