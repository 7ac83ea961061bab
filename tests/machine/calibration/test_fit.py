"""Calibration: dimensions come back from poses that were made with them, with noise within their deviations."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.pose import platform_frame, pose_of
from assur.kinematics.rates.acceleration import joints_in_mode
from assur.machine.calibration.chosen_poses import random_poses
from assur.machine.calibration.fit import calibration
from assur.machine.calibration.identification import identification
from assur.machine.calibration.measured import AT_BASE, FRAME, Measured, measured_of
from assur.numerics.rotations import from_vector, to_vector
from own_machines import own_machine

XY = Measured(("x", "y"), 100.0)
ROUND_TRIPS = [
    ("zeng2019", ("x", "y", "z"), False),
    ("delta_4s", ("x", "y", "z"), True),
    ("delta_4s", ("z",), False),
    ("delta_4s", ("distance",), False),
    ("orthoglide", ("x", "y", "z"), False),
    ("three_rps", ("z", "rx", "ry"), False),
    ("h4_robot", ("x", "y", "z", "phi"), False),
    ("screws", ("x", "y"), False),
    ("three_prr", ("x", "y", "phi"), False),
    ("par4", ("x", "y", "z"), False),
]
TRUE = {"l1": 100.3, "l2": 193.8, "g": 70.1}


@pytest.fixture(scope="module")
def measured():
    """Inputs as they were meant, one of them off by 0.001 rad, and positions of a five-bar with other dimensions."""
    own = assur.load("fivebar", **TRUE)
    random = np.random.default_rng(2)
    poses = np.array([0.0, 224.0]) + random.uniform(-1, 1, size=(14, 2)) * [40, 25]
    inputs = own.inverse(poses, own.modes.default_working).inputs.reshape(14, 2)
    return inputs - [0.001, 0.0], poses, random.normal(size=(14, 2))


def test_a_round_trip_without_noise(measured):
    inputs, poses, _ = measured
    own = calibration(assur.load("fivebar"), inputs, XY, poses)
    for name, value in (TRUE | {"theta1": 0.001, "theta2": 0.0}).items():
        assert own.parameters[name] == pytest.approx(value, abs=1e-8)
    assert own.before > 0.1
    assert own.after < 1e-9
    assert (own.held, own.outliers) == ((), ())


def test_noise_stays_within_deviations_and_what_is_far_beside_is_named(measured):
    inputs, poses, noise = measured
    noisy = poses + 0.01 * noise
    noisy[6] += [0.0, 3.0]
    own = calibration(assur.load("fivebar"), inputs, XY, noisy)
    assert own.outliers == (7,)
    assert own.after == pytest.approx(0.01, rel=0.3)
    for name, value in TRUE.items():
        assert abs(own.parameters[name] - value) < 4.0 * own.sigma[name]


def test_what_is_held_stays_and_what_is_not_told_is_held(measured):
    inputs, poses, _ = measured
    own = calibration(assur.load("fivebar"), inputs, XY, poses, ["g", "theta2"])
    assert own.held == ("g", "theta2")
    assert set(own.parameters) == {"l1", "l2", "theta1"}
    with pytest.raises(UnknownNameError, match="parameter to hold"):
        calibration(assur.load("fivebar"), inputs, XY, poses, ["l9"])


def test_too_few_or_impossible_measurements_are_told(measured):
    inputs, poses, _ = measured
    record = assur.load("fivebar")
    with pytest.raises(UsageError, match="4 numbers are measured, 4 are unknown"):
        calibration(record, inputs[:2], XY, poses[:2])
    with pytest.raises(UsageError, match="measurement 1: no pose of fivebar at these inputs"):
        calibration(assur.load("fivebar", l2=50), np.array([[3.0, 0.1]] * 8), XY, poses[:8])
    for names, refused in ((["w"], UnknownNameError), (["x", "x"], UsageError)):
        with pytest.raises(refused, match="measured"):
            measured_of(record, names)


def bench(record, other, measured, *, seed, frame=AT_BASE, added=0.0, count=16):
    """Inputs as they were meant and readings of a mechanism with other dimensions, the first input off."""
    home = dict(zip(record.platform.pose, pose_of(record, home_values(record)), strict=True))
    near = {name: tuple(home[name] + 0.25 * (end - home[name]) for end in ends) for name, ends in record.box.items()}
    joints = joints_in_mode(other, random_poses(replace(record, box=near), count, seed=seed))
    inputs = np.column_stack([own.printed(joints[:, own.coordinate.index]) for own in other.inputs])
    inputs[:, 0] -= added
    return inputs, measured.read(platform_frame(other, joints), frame)


def other_dimensions(record, seed):
    """Each length by a part in a thousand away, what is zero by as much of the mechanism's; angles as they are."""
    random = np.random.default_rng(seed)
    return {
        name: (item.value * (1.0 + 1e-3 * random.normal()) or 1e-3 * characteristic_length(record))
        for name, item in record.parameters.items()
        if not item.angular
    }


def test_where_the_measuring_frame_is_comes_back_however_it_is_turned():
    record = assur.load("fivebar")
    measured, frame = measured_of(record), (from_vector(np.array([0.0, 0.0, 2.5])), np.array([300.0, -20.0, 0.0]))
    inputs, readings = bench(record, assur.load("fivebar", l1=100.3), measured, seed=3, frame=frame)
    own = calibration(record, inputs, measured, readings, frame=True)
    assert [own.parameters[name] for name in ("frame.x", "frame.y", "frame.rz", "l1")] == pytest.approx(
        [300.0, -20.0, 2.5, 100.3], abs=1e-6
    )
    assert own.held == ("frame.z", "frame.rx", "frame.ry")


def test_slopes_of_readings_are_differences_of_readings():
    """In a turned frame, at a turned platform, of all that can be read."""
    random = np.random.default_rng(1)
    turn, point = from_vector(random.normal(size=3)), random.normal(size=3)
    frame = (from_vector(random.normal(size=3)), random.normal(size=3))
    own = Measured(("x", "y", "z", "rx", "ry", "rz", "phi", "theta", "psi", "distance"), 2.0, (0.1, 0.2, 0.3))
    step = 1e-4 * random.normal(size=6)
    moved = (from_vector(step[3:]) @ turn, point + step[:3])
    first, second = (own.read((place[0][None], place[1][None]), frame)[0] for place in ((turn, point), moved))
    np.testing.assert_allclose(own.off(second, first), own.slopes((turn, point), frame) @ step, atol=1e-6)


@pytest.mark.parametrize(
    ("name", "names", "framed"),
    [
        pytest.param(*row, marks=[] if row[0] == "screws" else pytest.mark.deep, id="-".join((row[0], *row[1])))
        for row in ROUND_TRIPS
    ],
)
def test_round_trips_with_noise_stay_within_their_covariance(name, names, framed):
    """Of what is told: combinations of dimensions, in deviations of their own; and poses of the fit as they were."""
    record = own_machine(name) if name in ("screws", "three_prr", "par4") else assur.load(name)
    measured = measured_of(record, names, (0.1, 0.2, 0.3) if "distance" in names else (0.0, 0.0, 0.0))
    other = record.with_parameters(**other_dimensions(record, 5))
    frame = (
        (from_vector(np.array([0.2, -0.3, 2.0])), measured.length * np.array([0.4, 0.3, -0.2])) if framed else AT_BASE
    )
    inputs, readings = bench(record, other, measured, seed=6, frame=frame, added=1e-3, count=24)
    exact = calibration(record, inputs, measured, readings, frame=framed)
    assert exact.after < 1e-8 * measured.length
    size = 0.05 * exact.before
    noise = size * np.random.default_rng(7).normal(size=readings.shape) / measured.weights
    own = calibration(record, inputs, measured, readings + noise, frame=framed)
    assert list(own.parameters) == list(exact.parameters)
    more = readings.size - len(own.parameters)
    assert own.after * np.sqrt(readings.size / more) == pytest.approx(size, rel=4.0 / np.sqrt(2.0 * more))
    away = np.array([own.parameters[name] - exact.parameters[name] for name in own.parameters])
    scale = np.sqrt(np.diag(own.covariance))
    whitened = np.linalg.solve(np.linalg.cholesky(own.covariance / np.outer(scale, scale)), away / scale)
    assert np.linalg.norm(whitened) < np.sqrt(len(away)) + 3.0
    told = identification(record, random_poses(record, 24), names, frame=framed, centre=measured.centre)
    assert len(own.parameters) == told.rank
    if framed:
        place = [exact.parameters[name] for name in FRAME]
        np.testing.assert_allclose(place, [*frame[1], *to_vector(frame[0])], atol=1e-2 * measured.length)
