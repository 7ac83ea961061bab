import numpy as np

import assur
from assur.kinematics.border import inputs_of
from assur.kinematics.certified.certify import certified_direct


def test_legs_that_are_all_equal_leave_solutions_undecided_or_prove_all():
    """A symmetric question: what is proved is proved of every solution, or the answer says what is missing."""
    record = assur.load("gough_stewart")
    inputs = np.full(6, float(np.mean(inputs_of(record, record.home_values))))
    found = certified_direct(record, inputs)
    floats = record.direct(inputs)
    assert found.proved == (not found.undecided)
    if found.proved:
        assert len(found) == int(np.sum(floats.exists))


def test_poses_are_held_with_unit_quaternions():
    record = assur.load("gough_stewart")
    found = certified_direct(record, inputs_of(record, record.home_values) * 1.01)
    assert found.proved
    assert "40 complex solutions" in found.right
    assert "that there can be, which the mechanism's file claims (" in found.right
    for item in found:
        norm = sum((item.pose[k].square() for k in range(4, 7)), item.pose[3].square())
        assert norm.contains(1.0)
        assert item.pose.middle[3] >= 0
        legs = record.inverse(item.pose.middle).inputs[0]
        assert np.allclose(legs, found.given, atol=1e-8)
