"""Formulas of motion: against numbers that know no closed form, at other poses than those that simplified them."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.status import Status
from assur.machine.forces.motion_formulas import difference, motion_formulas
from assur.model.registry import load_record
from weighed import weighed

WRITTEN = ["orthoglide", "linear_delta_4r", "three_crr", "three_rrc", "three_rrrp4r", "tsai_platform", "three_upu"]


@pytest.mark.parametrize(
    "name", ["fivebar", "zeng2019", "tripteron", *(pytest.param(name, marks=pytest.mark.deep) for name in WRITTEN)]
)
def test_they_are_the_numbers_of_the_joint_graph(name):
    """With bodies whose centres and inertias lie anywhere, and rotors."""
    assert difference(motion_formulas(weighed(load_record(name)))) < 1e-10


def test_they_hold_up_to_the_border_where_the_numbers_have_a_status():
    """Where the third limb is nearly stretched: a rate of the pose asks for any number of its actuator's."""
    record = assur.load("zeng2019")
    own = motion_formulas(record)
    border = 458.9129351803  # of z at this x and y: M3 = 0
    poses = np.array([[-15.4714, 9.6849, border - away] for away in (1.0, 1e-2, 1e-4, 1e-6, 1e-7)])
    mass, weight, _ = own(poses)
    answer = record.forces(poses)
    assert [Status(int(code)).name for code in answer.status] == ["regular"] * 2 + ["near_singular"] * 3
    np.testing.assert_allclose(answer.mass_matrix, mass, rtol=1e-7)
    np.testing.assert_allclose(answer.gravity, weight, rtol=1e-7, atol=1e-9)


@pytest.mark.deep
def test_the_bias_follows_from_the_mass_matrix():
    """c_i = sum (dM_ij/dx_k - dM_jk/dx_i / 2) v_j v_k, by differences of the formulas."""
    record = weighed(assur.load("zeng2019"))
    own, pose, velocity = motion_formulas(record), np.array([-15.0, 10.0, 440.0]), np.array([100.0, -50.0, 70.0])
    step = 1e-3
    ways = np.array([pose + sense * step * way for way in np.eye(3) for sense in (1, -1)])
    mass, _, _ = own(ways)
    rates = (mass[::2] - mass[1::2]) / (2 * step) * 1e3  # (k, i, j) per m
    v = velocity / 1e3
    bias = np.einsum("kij,j,k->i", rates, v, v) - 0.5 * np.einsum("ijk,j,k->i", rates, v, v)
    np.testing.assert_allclose(bias, record.forces(pose, velocity).bias[0], rtol=1e-6, atol=1e-8)


@pytest.mark.parametrize(
    ("name", "said"), [("three_rps", "poses of lengths alone"), ("linear_delta_4s", "a spin that nothing drives")]
)
def test_what_has_no_formulas_is_told(name, said):
    with pytest.raises(UsageError, match=said):
        motion_formulas(load_record(name))


def test_a_file_without_a_box_is_told_to_have_one():
    record = replace(load_record("fivebar"), box={})
    with pytest.raises(UsageError, match="no box of x, y"):
        motion_formulas(record)
