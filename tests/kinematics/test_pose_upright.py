"""Where three angles lose a direction (theta a right angle), or a quaternion its sign (a half turn).

What is true of the mechanism there does not depend on the coordinates of its pose.
"""

import numpy as np
import pytest

import assur
from assur.kinematics.certified.certify import certified_direct, certified_inverse
from assur.kinematics.certified.result import answer, undetermined
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.rates.velocity import velocity_map_at
from assur.kinematics.status import Status
from assur.numerics import rotations
from assur.performance.indices import indices_at
from assur.results.json_text import json_text
from spherical import ANGLES, OBLIQUE, QUATERNION, spherical

UPRIGHT, LEVEL = np.array([0.0, -np.pi / 2, -3.0]), np.array([0.1, 0.1, 0.1])


@pytest.fixture(scope="module")
def both(tmp_path_factory):
    """One oblique spherical mechanism, its pose by angles and by a quaternion."""
    folder = tmp_path_factory.mktemp("upright")
    paths = [spherical(folder, pose, OBLIQUE, name) for pose, name in ((ANGLES, "angles"), (QUATERNION, "quaternion"))]
    return [assur.load(path) for path in paths]


def rotation_of(pose):
    return rotations.from_angles(*pose) if len(pose) == 3 else rotations.from_quaternion(pose)


def test_the_inverse_problem_is_solved_where_theta_is_a_right_angle(both):
    by_angles = both[0].inverse(UPRIGHT)
    by_quaternion = both[1].inverse(rotations.to_quaternion(rotations.from_angles(*UPRIGHT)))
    assert len(by_angles) == len(by_quaternion) == 8
    inputs = [np.sort(found.inputs[found.exists].round(6), axis=0) for found in (by_angles, by_quaternion)]
    assert np.allclose(*inputs, atol=1e-5)
    assert {item.status for item in by_angles} == {item.status for item in by_quaternion} == {Status.regular}


def test_its_solutions_are_proved_there_too(both):
    found = certified_inverse(both[0], UPRIGHT)
    assert len(found) == 8
    assert not found.undecided


def test_measures_do_not_depend_on_the_coordinates(both):
    joints = both[0].inverse(LEVEL).joints
    joints = np.concatenate([joints, both[0].inverse(UPRIGHT).joints])
    here, there = (instantaneous(record, joints) for record in both)
    for name, value in here.measures.items():
        assert np.allclose(value, there.measures[name], rtol=1e-9)
    assert here.no_rates.tolist() == [False] * 8 + [True] * 8
    assert not there.no_rates.any()


def test_rates_of_angles_are_those_of_the_angular_velocity(both):
    joints = both[0].inverse(LEVEL).joints[0]
    rates = [velocity_map_at(record, joints).output([0.3, -0.2, 0.5]) for record in both]
    step = 1e-6
    turn = (rotation_of(LEVEL + step * rates[0]) - rotation_of(LEVEL - step * rates[0])) @ rotation_of(LEVEL).T
    turned = np.array([turn[2, 1], turn[0, 2], turn[1, 0]]) / (2 * step)
    assert np.allclose(turned, rates[1], rtol=1e-6)


def test_indices_say_that_j_does_not_exist_and_keep_the_transmission(both):
    joints = both[0].inverse(UPRIGHT).joints[:1]
    here, there = (indices_at(record, joints) for record in both)
    assert here.status.tolist() == [Status.undecided]
    assert np.isnan(here["condition"]).all()
    assert np.allclose(here["transmission"], there["transmission"])


@pytest.mark.parametrize("inputs", [(10, 20, -15), (0, 0, 0), (90, 90, 90)])
@pytest.mark.parametrize("pose", [ANGLES, QUATERNION])
def test_every_bound_of_a_certificate_is_a_number(tmp_path, pose, inputs):
    """The Agile Eye has poses with theta = 90 deg at all inputs, and half turns at those of home."""
    record = assur.load(spherical(tmp_path, pose))
    found = certified_direct(record, np.radians(inputs))
    floats = record.direct(np.radians(inputs))
    assert "null" not in json_text({"poses": [item.pose for item in answer(found).solutions]})
    for item in found:
        own = next(one.pose for one in floats if one.mode == item.mode)
        turns = 2 * np.pi * np.round((item.pose.middle - own) / (2 * np.pi))  # angles but for whole turns
        assert np.all((item.pose.low - 1e-9 <= own + turns) & (own + turns <= item.pose.high + 1e-9)), item.mode
        told = [k for k, name in enumerate(record.platform.pose) if name not in undetermined(record, item.pose)]
        assert np.max(item.pose.width[told], initial=0.0) < 1e-6
