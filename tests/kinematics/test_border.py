"""Inputs that are printed with a sign and an offset, as no registered mechanism has them."""

import dataclasses

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.answers.at_border import pose_from_border
from assur.kinematics.border import checked_poses
from assur.kinematics.closed_form.sweep import inverse_sweep

ROW_3 = [-15.4714, 9.6849, 456.3315]


@pytest.fixture(params=["zeng2019", "fivebar"])
def plain(request):
    return assur.load(request.param)


@pytest.fixture
def printed(plain):
    """The same mechanism, its first input counted backwards from an offset of 0.25."""
    first = dataclasses.replace(plain.inputs[0], sign=-1.0, offset=0.25)
    return dataclasses.replace(plain, inputs=(first, *plain.inputs[1:]))


def pose(plain):
    return ROW_3 if plain.name == "zeng2019" else [10.0, 200.0]


def test_printed_inputs_are_the_joint_values_turned_and_shifted(plain, printed):
    mode = plain.modes.default_working
    before, now = plain.inverse(pose(plain), mode).inputs[0], printed.inverse(pose(plain), mode).inputs[0]
    assert now[0] == pytest.approx(0.25 - before[0])
    assert now[1:].tolist() == before[1:].tolist()


def test_direct_takes_what_inverse_prints(plain, printed):
    found = printed.direct(printed.inverse(pose(plain), plain.modes.default_working).inputs[0])
    gaps = np.linalg.norm(found.poses[found.exists] - pose(plain), axis=-1)
    assert gaps.min() < 1e-9
    assert np.max(found.residuals[found.exists]) < 1e-9


def test_velocities_and_accelerations_are_those_of_the_printed_inputs(plain, printed):
    mode, at, step = plain.modes.default_working, np.array(pose(plain)), 1e-4
    along = np.linspace(1.0, 2.0, len(at))
    path = [printed.inverse(at + t * along, mode).inputs[0] for t in (-step, 0.0, step)]
    rates, second = (path[2] - path[0]) / (2 * step), (path[2] - 2 * path[1] + path[0]) / step**2
    np.testing.assert_allclose(printed.velocity_map(at, mode).output(rates), along, atol=1e-5)
    _, acceleration = printed.acceleration(at, rates, second, mode)
    np.testing.assert_allclose(acceleration, 0.0, atol=1e-3)


def test_a_sweep_prints_the_same(plain, printed):
    swept = inverse_sweep(printed, [np.array([value]) for value in pose(plain)])
    single = printed.inverse(pose(plain), plain.modes.default_working)
    np.testing.assert_array_equal(swept["inputs"][:, 0], single.inputs[0])
    here = printed.velocity_map(pose(plain))
    assert swept["det_jq"][0] == pytest.approx(float(here.det_jq))


def test_values_are_taken_by_name_as_the_answers_give_them():
    mechanism = assur.load("zeng2019")
    solution = next(iter(mechanism.inverse([-15.4714, 9.6849, 456.3315], "++-++")))
    array = list(solution.joints.values())
    shuffled = dict(reversed(solution.joints.items()))
    for work in (mechanism.instantaneous, mechanism.velocity_map_at):
        np.testing.assert_array_equal(work(shuffled).jp, work(array).jp)
    assert mechanism.singularity_at(shuffled) == mechanism.singularity_at(array)
    assert mechanism.closure_error(shuffled) == mechanism.closure_error(array)
    np.testing.assert_array_equal(mechanism.point("O'", shuffled), mechanism.point("O'", np.array(array)))
    assert mechanism.follow(shuffled, poses=[-15.0, 9.0, 450.0]).stopped is None
    pose = dict(zip("zyx", solution.pose[::-1], strict=True))
    np.testing.assert_array_equal(mechanism.inverse(pose).inputs, mechanism.inverse(solution.pose).inputs)
    columns = {name: np.array([value, value]) for name, value in pose.items()}
    assert mechanism.inverse(columns).batch_shape == (2,)
    with pytest.raises(UnknownNameError, match="'w'"):
        mechanism.inverse({**pose, "w": 0.0})
    with pytest.raises(UsageError, match="no value for y"):
        mechanism.inverse({"x": 0.0, "z": 0.0})


def test_degrees_given_for_radians_are_told_of_radians():
    record = assur.load("three_rps")
    pose = [0.0] * len(record.platform.pose)
    pose[record.platform.pose.index("theta")] = 30.0
    with pytest.raises(UsageError, match=r"np\.radians\(30\)"):
        checked_poses(record, pose)
    checked_poses(record, pose_from_border(record, pose))
    pose[record.platform.pose.index("theta")] = 95.0
    with pytest.raises(UsageError, match="between -90 and 90 deg") as caught:
        pose_from_border(record, pose)
    assert "radians" not in caught.value.hint
