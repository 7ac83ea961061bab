"""Directions that nobody chose: perpendicular where they must be, in no special position otherwise."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.topology.directions import NEARLY, unit
from assur.topology.notation import parse_chains
from assur.topology.notation.arbitrary import Arbitrary

vectors = st.tuples(*[st.integers(-3, 3)] * 3).filter(any).map(unit)


def clearance(one, other):
    """The smaller of sine and cosine of the angle between two directions."""
    return min(abs(float(np.dot(one, other))), float(np.linalg.norm(np.cross(one, other))))


@given(st.lists(vectors, max_size=1), st.lists(vectors, max_size=30))
def test_clear_of_everything_that_is_not_forced(normals, others):
    found = Arbitrary().within(normals, others, others[:8])
    assert np.linalg.norm(found) == pytest.approx(1, abs=1e-14)
    for normal in normals:
        assert abs(float(np.dot(found, normal))) < 1e-14
    for other in others:
        forced = normals and np.linalg.norm(np.cross(normals[0], other)) < 1e-9
        assert forced or clearance(found, other) > 2 * NEARLY


@given(vectors, vectors)
def test_two_normals_leave_a_line(one, other):
    across = np.cross(one, other)
    found = Arbitrary().within([one, other], [], [])
    if np.linalg.norm(across) > 1e-9:
        assert np.linalg.norm(np.cross(found, across)) < 1e-9
    assert abs(np.dot(found, one)) < 1e-9


def test_three_normals_leave_nothing():
    assert Arbitrary().within([(1.0, 0, 0), (0, 1.0, 0), (0, 0, 1.0)], [], []) is None


def test_general_axes_of_a_mechanism_are_in_general_position():
    limbs = parse_chains(["U P S"] * 6)
    assert limbs == parse_chains(["U P S"] * 6)
    for limb in limbs:
        one, other, leg = (axis for joint in limb.joints for axis in joint.axes)
        assert abs(np.dot(one, other)) < 1e-14
        assert abs(np.linalg.det([one, other, leg])) > 10 * NEARLY
    axes = [axis for limb in limbs for joint in limb.joints for axis in joint.axes]
    close = [pair for pair in combinations(axes, 2) if clearance(*pair) < 2 * NEARLY]
    assert close == [tuple(limb.joints[0].axes) for limb in limbs]
