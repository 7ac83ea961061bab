"""Errors of poses: copies of dimensions one by one, what does not assemble, sums, clearances."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import assemble
from assur.kinematics.pose import platform_frame, pose_of
from assur.kinematics.rates.motions import motions
from assur.kinematics.status import Status
from assur.machine.accuracy.error_closure import error_closure
from assur.machine.accuracy.pose_errors import pose_errors_at
from assur.model.machine_data import Tolerance
from assur.numerics import rotations
from own_machines import own_machine

POSE = [-15.4714, 9.6849, 456.3315]


@pytest.fixture(scope="module")
def zeng():
    return assur.load("zeng2019").errors(POSE)


def test_dimensions_of_the_papers_mechanism_act_together_or_not_at_all(zeng):
    rows = zeng.sensitivity
    np.testing.assert_allclose(rows["l7"], rows["l8"], atol=1e-9)
    np.testing.assert_allclose(rows["b"], -rows["d"], atol=1e-9)
    np.testing.assert_allclose(rows["l5"], 0.0, atol=1e-9)
    assert rows["linkS.l5"][4] != 0.0  # one of three short sides alone turns the platform
    assert not zeng.stresses
    assert zeng.units["yA1"] == "mm"
    assert str(zeng).splitlines()[0] == "x, y, z, rx, ry, rz of zeng2019 per unit (regular)"


def test_inputs_move_the_platform_as_the_inverse_of_the_velocity_relation_says(zeng):
    instant = zeng.record.instantaneous(zeng.values)
    rows = np.array([zeng.sensitivity[name][:3] for name in ("yA1", "yA2", "yA3")]).T
    np.testing.assert_allclose(rows, np.linalg.solve(instant.jp, instant.jq), atol=1e-9)


@pytest.mark.parametrize(
    ("name", "copy"),
    [("zeng2019", "link4a.l6"), ("zeng2019", "linkS.l5"), ("zeng2019", "platform.d"), ("delta_4s", "leg1.rod1.l")],
)
def test_one_links_own_copy_is_off_in_its_own_joints(name, copy):
    """Against assemblies of the joint graph with the joints' points moved by hand."""
    record = assur.load(name)
    errors = pose_errors_at(record, record.home_values)
    link, _, parameter = copy.rpartition(".")
    step, ends = 1e-5 * record.parameters[parameter].value, []
    for sense in (-step, step):
        other = assur.load(name, **{parameter: record.parameters[parameter].value + sense})
        joints = dict(record.joints)
        for own in record.joints.values():
            if own.parent == link:
                joints[own.name] = replace(joints[own.name], at=other.joints[own.name].at)
            if own.child == link:
                joints[own.name] = replace(joints[own.name], child_at=other.joints[own.name].child_at)
        changed = replace(record, joints=joints, closed_form=None)
        held = [item.coordinate.index for item in record.drives]
        assembled = assemble(changed, record.home_values[None], held=held, near=True)
        assert assembled.closed.all()
        turn, at = platform_frame(changed, assembled.values)
        ends.append((turn[0], at[0]))
    (turn, at), (second_turn, second_at) = ends
    moved = np.concatenate([second_at - at, rotations.to_vector(second_turn @ turn.T)]) / (2 * step)
    np.testing.assert_allclose(errors.sensitivity[copy], moved, atol=1e-6)


def test_a_single_rod_of_the_orthoglide_does_not_assemble_and_every_rod_bears_it():
    record = assur.load("orthoglide")
    errors = record.errors([0, 0, 0])
    name = "leg1.rod_a.L"
    assert not errors.compatible(name)
    assert errors.compatible("leg1.L")
    assert {"leg1.Da", "leg1.Db", "leg1.Ea", "leg1.Eb"} <= set(errors.stresses[name])
    assert name in errors.settled
    np.testing.assert_allclose(errors.sensitivity[name][:3], [-0.5, 0, 0], atol=1e-6)  # midway, by symmetry
    bare = replace(record, machine=replace(record.machine, links={}))
    assert np.isnan(bare.errors([0, 0, 0]).sensitivity[name]).all()


def test_a_stress_balances_itself_and_does_no_work_in_passive_joints():
    record = assur.load("tsai_platform")
    values = record.home_values
    own = error_closure(record, values)
    errors = pose_errors_at(record, values)
    name, stress = next(iter(errors.stresses.items()))
    _, left_open = own.answer(np.ones((6 * len(record.joints), 1)))
    bare = own.stress(left_open[:, 0])
    for link in record.links:
        if link not in (record.base, record.platform.link):
            total = sum(
                (1.0 if joint.child == link else -1.0) * wrench
                for joint, wrench in zip(record.joints.values(), bare, strict=True)
                if link in (joint.child, joint.parent)
            )
            np.testing.assert_allclose(total, 0.0, atol=1e-9)
    assert max(np.abs(wrench[:3]).max() for wrench in stress.values()) <= 1.0
    assert not errors.compatible(name)


def test_tolerances_add_to_sums_and_a_covariance(zeng):
    tolerances = {"l2": Tolerance(0.05, 0.02), "link4a.l6": Tolerance(0.03, 0.01), "yA1": Tolerance(0.01, 0.005)}
    own = replace(zeng.record, machine=replace(zeng.record.machine, tolerances=tolerances)).errors(POSE)
    rows = np.array([own.sensitivity[name] for name in tolerances])
    bounds, sigmas = np.array([0.05, 0.03, 0.01]), np.array([0.02, 0.01, 0.005])
    np.testing.assert_allclose(own.worst_case, np.abs(rows).T @ bounds)
    np.testing.assert_allclose(own.root_sum_square, np.sqrt((rows**2).T @ bounds**2))
    np.testing.assert_allclose(own.covariance, rows.T @ np.diag(sigmas**2) @ rows)
    wrong = replace(zeng.record, machine=replace(zeng.record.machine, tolerances={"a": Tolerance(1.0, 0.3)}))
    with pytest.raises(UsageError, match="a tolerance of a, which no joint is written with"):
        wrong.errors(POSE)


def test_a_clearance_acts_as_far_as_the_loops_close(zeng):
    """A pin that is loose by 0.01 in a five-bar: as a rod that is longer by it; across the plane it cannot."""
    fivebar = assur.load("fivebar")
    own = replace(fivebar, machine=replace(fivebar.machine, clearances={"B1": 0.01})).errors([0, 224])
    row = own.sensitivity["rod1.l2"]
    np.testing.assert_allclose(own.clearances["B1"][:2], 0.01 * np.abs(row[:2]), rtol=1e-6)
    assert own.clearances["B1"][2] == pytest.approx(0.0, abs=1e-12)


def test_joints_without_dimensions_have_errors_of_inputs_alone():
    fivebar = assur.load("fivebar")
    joints = {name: replace(joint, written=None) for name, joint in fivebar.joints.items()}
    bare = replace(fivebar, joints=joints, platform=replace(fivebar.platform, written=None))
    assert list(pose_errors_at(bare, fivebar.home_values).sensitivity) == ["theta1", "theta2"]


def test_where_there_is_nothing_to_say(zeng):
    fivebar = assur.load("fivebar", l2=150)
    assert fivebar.errors([0, 60]).status == Status.parallel
    far = fivebar.errors([0, 900])
    assert (far.status, far.sensitivity) == (Status.unreachable, {})
    assert np.all(np.isnan(far.values))
    assert (far.corrections, far.uncompensated) == ({}, {})
    with pytest.raises(UsageError, match="2 poses"):
        zeng.record.errors([POSE, POSE])


def test_with_more_drives_than_freedoms_all_of_them_bring_the_pose_back_together():
    """An error that is a motion of the mechanism: none of its four drives moves alone, and they take it back."""
    record = own_machine("two_upr_two_rpu")
    errors = record.errors(pose_of(record, record.home_values))
    motion = motions(record, errors.values)
    along = np.random.default_rng(0).normal(size=motion.null.shape[1])
    angular, velocity = np.split(motion.twists @ along, 2)
    row = np.concatenate([characteristic_length(record) * velocity, angular])
    off = replace(errors, sensitivity={"off": row})
    joints = motion.scale * (motion.null @ along)
    back = [-item.sign * joints[item.coordinate.index] for item in record.drives]
    assert len(back) == 4
    np.testing.assert_allclose(off.corrections["off"], back, atol=1e-9 * np.abs(back).max())
    assert np.all(off.uncompensated["off"] == 0.0)
