import numpy as np
import pytest

import assur
from assur.kinematics.certified.certify import certified_direct
from assur.kinematics.certified.matching import BOTH
from assur.kinematics.certified.roots import nearest_rows
from assur.numerics.intervals.interval import Interval


def legs_of(record, pose):
    return record.inverse(pose).inputs[0]


def test_a_half_turn_of_the_platform_is_no_exception():
    """There the tangent of half the angle is infinite, and the polynomial loses its leading coefficient."""
    record = assur.load("planar_3rpr")
    inputs = legs_of(record, [3.0, 9.0, np.pi])
    found = certified_direct(record, inputs)
    assert found.proved
    floats = record.direct(inputs)
    assert len(found) == int(np.sum(floats.exists))
    turned = [np.abs(np.abs(item.pose.middle[2]) - np.pi) < 1e-9 for item in found]
    assert sum(turned) == 1
    assert {item.how for item in found} == {BOTH}  # the roots alone hold the poses, not only as many


@pytest.mark.parametrize("seed", range(4))
def test_number_of_poses_changes_with_the_legs(seed):
    record = assur.load("planar_3rpr")
    rng = np.random.default_rng(seed)
    inputs = legs_of(record, rng.uniform([-8, -8, -3], [8, 8, 3]))
    found, floats = certified_direct(record, inputs), record.direct(inputs)
    assert found.proved
    assert len(found) == int(np.sum(floats.exists))


def test_a_double_root_is_undecided():
    """Where two poses meet: bisection between inputs with more poses and with fewer."""
    record = assur.load("planar_3rpr")
    low, high = legs_of(record, [1.0, 2.0, 0.3]), np.array([1.0, 2.0, 3.0])
    most = len(record.direct(low))
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if len(record.direct(middle)) >= most else (low, middle)
    found = certified_direct(record, low)
    assert not found.proved
    assert "phi" in {item.name for item in found.undecided}


def test_branches_at_one_pose_are_different_rows_of_the_float_answer():
    """Limbs that stand in two ways at a pose: two branches, each with a name of its own."""
    poses = np.array([[1.0, 2.0], [5.0, 5.0], [1.0, 2.0], [np.nan, np.nan]])
    exists = np.array([True, True, True, False])
    ends = np.array([[1.0, 2.0], [5.0, 5.0], [1.0, 2.0], [1.0, 2.0]])
    assert nearest_rows(Interval.of(ends - 1e-9, ends + 1e-9), poses, exists) == [0, 1, 2, 0]
    assert nearest_rows(Interval.of(ends, ends), poses, np.zeros(4, dtype=bool)) == []
