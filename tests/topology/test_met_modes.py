"""Operation modes that are met, held against the joint graph: the assembly closes there, and so does the motion."""

import numpy as np
import pytest

import assur
from assur.derived_topology import operation_modes
from assur.joint_graph.frames import frames
from assur.kinematics.closure import assemble, closure_error, mobility
from assur.kinematics.home import home_values
from assur.numerics import rotations


def assembly(record, mode):
    """Joint values of the example, which says how far each joint is from home."""
    return home_values(record) + np.concatenate([mode.example[name] for name in record.joints])


def turned(record, start):
    """Rotation vectors (N, 3) of the platform, close to an assembly, against the first."""
    near = start + 0.05 * np.random.default_rng(3).normal(size=(40, len(start)))
    near = assemble(record, near, near=True)
    rotation = frames(record, near.values[near.closed])[record.platform.link][0]
    assert len(rotation) > 20
    return rotations.to_vector(np.swapaxes(rotation[:1], -1, -2) @ rotation)


@pytest.fixture(scope="module")
def upu():
    record = assur.load("three_upu")
    return record, {mode.name: mode for mode in operation_modes(record)}


def test_a_3_upu_translates_moves_in_a_plane_and_turns(upu):
    record, modes = upu
    assert set(modes) == {"3T", "2T1R", "3R"}
    for name, axes in {"3T": 0, "2T1R": 1, "3R": 3}.items():
        value = assembly(record, modes[name])
        assert closure_error(record, value[None])[0] < 1e-9
        assert mobility(record, value).freedoms == modes[name].dof == 3
        assert np.sum(np.linalg.svd(turned(record, value), compute_uv=False) > 1e-6) == axes


def test_limbs_with_planar_joints_have_two_modes_and_each_is_there_twice():
    chains = ["R[z] E[x] R[z]", "R[z] E[y] R[z]", "R[z] E[0.6,0.8,0] R[z]"]
    assert [(mode.name, mode.dof) for mode in operation_modes(chains)] == [("3T1R", 4), ("2T1R", 3)]


def test_a_parallelogram_folds_over_and_what_has_crossed_is_named():
    modes = operation_modes(["P(4R)[z] R[z]", "R[z] R[z] R[z]"])
    assert [(mode.crossed, mode.at_home) for mode in modes] == [((), True), (("Pa1",), False)]


def test_drives_that_do_not_fix_a_mode_give_it_no_coupling_degree():
    chains = ["R[z] E[x] R[z]", "R[z] E[y] R[z]", "R[z] E[0.6,0.8,0] R[z]"]
    assert all(mode.coupling_degree is None for mode in operation_modes(chains))
