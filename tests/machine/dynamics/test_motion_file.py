"""Files of motions: read in the file's units, and every fault told with its line and key."""

from pathlib import Path

import numpy as np
import pytest

import assur
from assur.errors import MechanismFileError, UsageError
from assur.machine.dynamics.motion_file import motion_of_text, read_motion

HARMONIC = "[harmonic]\ncentre = [0, 224]\namplitude = [10, 5]\nomega = [2, 3]\n"
SAMPLES = "[samples]\nt = [0, 1, 2, 3]\npose = [[0, 224], [1, 224], [2, 224], [3, 224]]\n"
FALL = "pose = [0, 224]\nt_end = 0.5\n"


@pytest.fixture(scope="module")
def fivebar():
    return assur.load("fivebar")


def read(record, text):
    return motion_of_text(record, text, "my.toml")


def faults(record, text):
    """Line, key and what was given, of each fault."""
    with pytest.raises(MechanismFileError) as caught:
        read(record, text)
    return [(item.line, item.path, item.given) for item in caught.value.problems]


def test_a_harmonic_motion_begins_with_its_phase(fivebar):
    way = read(fivebar, HARMONIC + "phase = [0, 1.5707963267948966]\nt_end = 4\ncount = 5").prescribed
    assert way.times.tolist() == [0, 1, 2, 3, 4]
    np.testing.assert_allclose(way.at(np.zeros(1))[0], [[0, 229]])


def test_angles_are_in_the_unit_of_the_mechanism():
    record = assur.load("planar_3rrr")
    text = "[harmonic]\ncentre = [0, 0, 30]\namplitude = [0, 0, 10]\nomega = 1\n"
    pose, rate, _ = read(record, text).prescribed.at(np.zeros(1))
    assert (pose[0, 2], rate[0, 2]) == pytest.approx(np.radians([30, 10]))


def test_samples_are_met(fivebar):
    way = read(fivebar, SAMPLES).prescribed
    np.testing.assert_allclose(way.at(way.times)[0][:, 0], [0, 1, 2, 3], atol=1e-12)


@pytest.mark.parametrize("more", ["[forces]\ntheta1 = 2.5\n", "[forces]\nA1 = 2.5\n"])
def test_constant_forces_by_the_name_of_input_or_joint(more):
    record = assur.load("fivebar")
    name, joint = record.inputs[0].name, record.inputs[0].coordinate.joint
    start = read(record, FALL + more.replace("theta1", name).replace("A1", joint)).release
    assert (start.forces(0.3).tolist(), start.t_end) == ([2.5, 0.0], 0.5)
    assert (start.pose.tolist(), start.velocity.tolist()) == ([0, 224], [0, 0])


def test_forces_in_time_are_straight_between_their_moments(fivebar):
    text = FALL + "velocity = [1, 2]\n[forces]\nt = [0, 1]\nvalues = [[0, 1], [4, 3]]\n"
    start = read(fivebar, text).release
    assert start.forces(0.25).tolist() == [1.0, 1.5]
    assert start.velocity.tolist() == [1, 2]


def test_a_start_may_stand_below_the_forces(fivebar):
    """In TOML what follows a table belongs to it."""
    start = read(fivebar, "[forces]\nt_end = 0.5\npose = [0, 224]\n").release
    assert (start.t_end, start.forces(0.0).tolist()) == (0.5, [0.0, 0.0])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (HARMONIC + "ampltude = [1, 1]", [(5, "harmonic.ampltude", "unknown key")]),
        (HARMONIC.replace("[10, 5]", "[10]"), [(3, "harmonic.amplitude", "a list of 1")]),
        (HARMONIC.replace("[10, 5]", "[10, nan]"), [(3, "harmonic.amplitude[1]", "nan")]),
        (HARMONIC.replace("omega = [2, 3]", ""), [(1, "harmonic.omega", "missing")]),
        (HARMONIC + "count = 2", [(5, "harmonic.count", "2")]),
        (HARMONIC + "t_end = -1", [(5, "harmonic.t_end", "-1")]),
        (HARMONIC.replace("omega = [2, 3]", "omega = 0"), [(1, "harmonic", "fivebar: nothing moves")]),
        (SAMPLES.replace("t = [0, 1, 2, 3]", "t = [0, 2, 1, 3]"), [(2, "samples.t[2]", "1 after 2")]),
        (SAMPLES.replace("t = [0, 1, 2, 3]", "t = [0, 1]"), [(2, "samples.t", "a list of 2")]),
        (SAMPLES.replace(", [3, 224]]", "]"), [(3, "samples.pose", "a list of 3")]),
        (SAMPLES.replace("[3, 224]", "[3]"), [(3, "samples.pose[3]", "a list of 1")]),
        (SAMPLES.replace("[3, 224]", '[3, "x"]'), [(3, "samples.pose[3][1]", '"x"')]),
        (SAMPLES + HARMONIC, [(4, "harmonic", "[samples] and [harmonic]")]),
        (FALL + "[forces]\nq7 = 1\n", [(4, "forces.q7", "unknown key")]),
        ("pose = [0, 224]\n", [(1, "t_end", "missing")]),
        ("t_end = 1\n", [(1, "pose", "missing")]),
        ("harmonic = 3\n", [(1, "harmonic", "3")]),
        ("[harmonics]\n", [(1, "harmonics", "unknown key"), (1, "pose", "missing"), (1, "t_end", "missing")]),
        ("", [(1, "harmonic", "missing")]),
        (FALL + "[forces]\nvalues = [[0, 1], [4, 3]]\n", [(3, "forces.t", "missing")]),
        (FALL + "[forces]\nt = [0, 1]\n", [(3, "forces.values", "missing")]),
        (FALL + "[forces]\nt = [1, 0]\nvalues = [[0, 1], [4, 3]]\n", [(4, "forces.t[1]", "0 after 1")]),
        (FALL + "[forces]\nt = [0, 1]\nvalues = [[0, 1]]\n", [(5, "forces.values", "a list of 1")]),
        (FALL + "[forces]\npose = [0, 0]\n", [(4, "forces.pose", "pose a second time")]),
    ],
)
def test_faults_are_told_by_line_and_key(fivebar, text, expected):
    assert faults(fivebar, text) == expected


def test_a_missing_file_and_one_that_is_not_toml(fivebar, tmp_path):
    with pytest.raises(UsageError):
        read_motion(fivebar, Path(tmp_path / "none.toml"))
    assert faults(fivebar, "[harmonic]\ncentre = [0,,1]\n")[0][0] == 2
