"""Wrenches in the joints: equilibrium of every link, no work in passive joints; twists against the closed form's J."""

import numpy as np
import pytest

import assur
from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.rates.motions import input_units
from assur.model.pose import LENGTHS, rate_names
from assur.performance.statics import is_point, transmitted
from catalogue import each


@pytest.fixture(params=each())
def case(request, regular_poses):
    """A mechanism, regular poses, their joint values, and what is transmitted there."""
    mechanism = assur.load(request.param)
    mode = mechanism.modes.default_working
    poses = regular_poses(mechanism, mode, 12)
    joints = mechanism.inverse(poses, mode=mode).joints[:, 0]
    return mechanism, poses, joints, transmitted(mechanism, joints)


def test_every_input_pushes_and_moves_where_the_mechanism_is_regular(case):
    _, _, _, there = case
    assert there.pushes.all()
    assert there.moves.all()


def test_every_link_is_in_equilibrium(case):
    mechanism, _, _, there = case
    free = set(mechanism.links) - {mechanism.base, mechanism.platform.link}
    size = np.abs(there.wrenches).max(axis=(-1, -2))[..., None]
    assert free
    for link in free:
        total = np.zeros(there.at_platform.shape)
        for k, joint in enumerate(mechanism.joints.values()):
            total += there.wrenches[:, :, k] * ((joint.child == link) - (joint.parent == link) * 1.0)
        np.testing.assert_allclose(total / size, 0.0, atol=1e-12)


def test_passive_joints_do_no_work_and_the_input_one_unit(case):
    """About the joint's own centre: a revolute bears no moment about its axis, a ball none, a slide no force along."""
    mechanism, _, joints, there = case
    placed = frames(mechanism, joints)
    driven = {item.coordinate.joint: k for k, item in enumerate(mechanism.inputs)}
    seen = 0
    for k, joint in enumerate(mechanism.joints.values()):
        if joint.type.name not in ("revolute", "prismatic", "spherical"):
            continue
        wrench = there.wrenches[:, :, k]
        moment = wrench[..., :3] - np.cross(there.centres[:, None, k], wrench[..., 3:])
        size = np.maximum(np.abs(there.wrenches).max(axis=(-1, -2)), 1.0)[..., None]
        if joint.type.name == "spherical":
            np.testing.assert_allclose(moment / size, 0.0, atol=1e-9)
        else:
            axis = placed[joint.parent][0] @ joint.axes[0]
            work = np.sum((moment if joint.type.name == "revolute" else wrench[..., 3:]) * axis[:, None], axis=-1)
            expected = np.eye(len(mechanism.inputs))[driven[joint.name]] if joint.name in driven else 0.0
            np.testing.assert_allclose((work - expected) / size[..., 0], 0.0, atol=1e-9)
        seen += 1
    assert seen


def test_the_twists_are_the_columns_of_the_closed_form_s_jacobian(case):
    mechanism, poses, _, there = case
    columns = np.swapaxes(mechanism.velocity_map(poses).matrix * input_units(mechanism), -1, -2)  # (N, F, k)
    length = characteristic_length(mechanism)
    seen = 0
    for k, name in enumerate(rate_names(mechanism.platform.pose)):
        if name in LENGTHS:
            found = length * there.twists[..., 3 + LENGTHS.index(name)]
        elif name in ("wx", "wy", "wz"):
            found = there.twists[..., ("wx", "wy", "wz").index(name)]
        elif name == "phi" and "theta" not in mechanism.platform.pose:
            found = there.twists[..., 2]
        else:
            continue
        np.testing.assert_allclose(found, columns[..., k], rtol=1e-6, atol=1e-7 * np.abs(columns).max())
        seen += 1
    assert seen


def test_the_wrench_at_the_platform_balances_the_joints_on_it(case):
    mechanism, _, _, there = case
    if is_point(mechanism):
        assert not there.at_platform[..., :3].any()
    total = np.zeros(there.at_platform.shape)
    for k, joint in enumerate(mechanism.joints.values()):
        link = mechanism.platform.link
        total += there.wrenches[:, :, k] * ((joint.child == link) - (joint.parent == link) * 1.0)
    np.testing.assert_allclose(total, there.at_platform, atol=1e-9 * max(1.0, np.abs(there.wrenches).max()))


@pytest.mark.parametrize("name", ["delta_4s", "linear_delta_4s", "three_p2us"])
def test_rods_between_balls_are_loaded_along_themselves(name, regular_poses):
    mechanism = assur.load(name)
    mode = mechanism.modes.default_working
    there = transmitted(mechanism, mechanism.inverse(regular_poses(mechanism, mode, 5), mode=mode).joints[:, 0])
    ends = {link: [k for k, joint in enumerate(mechanism.joints.values()) if link in (joint.parent, joint.child)]
            for link in mechanism.links if "rod" in link}  # fmt: skip
    assert [len(pair) for pair in ends.values()] == [2] * 6
    for first, second in ends.values():
        along = there.centres[:, second] - there.centres[:, first]
        np.testing.assert_allclose(np.cross(there.wrenches[:, :, first, 3:], along[:, None]), 0.0, atol=1e-9)
