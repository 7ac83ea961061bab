import numpy as np
import pytest

import assur
from assur.kinematics.border import inputs_of
from assur.kinematics.certified.legs import Legs
from assur.kinematics.certified.proofs import proofs
from assur.model.pose import has_quaternion
from assur.model.registry import names
from assur.numerics.branch_and_prune import Existing
from assur.numerics.intervals.interval import Interval
from assur.numerics.krawczyk import parts
from catalogue import each

BY_LEGS = [name for name in names() if not has_quaternion(assur.load(name).platform.pose)]


@pytest.mark.parametrize("name", each(BY_LEGS, ("zeng2019", "planar_3rrr", "three_rps")))
def test_the_equations_hold_at_every_pose_and_nowhere_else(name):
    """In its own working mode every pose is a zero within rounding; in another mode, or moved, some equation is not."""
    record = assur.load(name)
    inputs = inputs_of(record, record.home_values) * 1.013
    floats = record.direct(inputs)
    legs, poses = Legs(record, inputs), floats.poses[floats.exists]
    off = 1e-9 * (1 + np.abs(poses))
    near, far = Interval.of(poses - off, poses + off), Interval.of(poses + 0.01 - off, poses + 0.01 + off)
    held = np.zeros(len(poses), dtype=int)
    for label in range(len(legs.modes)):
        labels = np.full(len(poses), label)
        zero, positive = legs(Existing(), parts(near), labels)
        held += np.all([value.contains(0.0) for value in zero] + [~value.negative for value in positive], axis=0)
        zero, _ = legs(Existing(), parts(far), labels)
        assert not np.any(np.all([value.contains(0.0) for value in zero], axis=0))
    assert np.all(held >= 1)


@pytest.mark.parametrize("name", each(BY_LEGS, ("zeng2019", "planar_3rrr", "three_rps")))
def test_every_regular_pose_is_proved_from_the_legs(name):
    record = assur.load(name)
    inputs = inputs_of(record, record.home_values) * 1.013
    floats = record.direct(inputs)
    found = proofs(Legs(record, inputs), floats)
    different = {tuple(pose) for pose in floats.poses[floats.exists].round(7)}
    assert len(found.rows) == len(different)
    for bounds, pose in zip(found.pose, floats.poses[found.rows], strict=True):
        assert np.all(np.abs(bounds.middle - pose) < 1e-7)
