"""Following a working mode over a grid: what is reached, what is not, and where the border is."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.joint_graph.points import quantity
from assur.kinematics.closure import closure_error
from assur.kinematics.following.continuation import continued
from assur.kinematics.following.ending import Mode
from assur.kinematics.home import home_values
from assur.kinematics.named_signs import named_signs
from assur.kinematics.pose import pose_of

RECORD = assur.load("fivebar")
HOME = home_values(RECORD)


def plane(count=21, record=RECORD, box=((-330.0, 330.0), (10.0, 320.0))):
    axes = tuple(np.linspace(*pair, count) for pair in box)
    mode = Mode(record, named_signs(record, "inverse", HOME), lambda points: points)
    return continued(mode, axes, (pose_of(RECORD, HOME), HOME))


def test_every_reached_node_is_an_assembly_of_the_mode_at_its_pose():
    found = plane()
    joints = found.joints[found.reached]
    x, y = np.meshgrid(*found.axes, indexing="ij")
    assert np.max(closure_error(RECORD, joints)) < 1e-9 * 194
    np.testing.assert_allclose(pose_of(RECORD, joints), np.stack([x, y], -1)[found.reached], atol=1e-6)
    assert np.all(named_signs(RECORD, "inverse", joints) == named_signs(RECORD, "inverse", HOME))


def test_without_names_of_modes_it_stays_in_the_same_branch():
    """Nothing but the sign of the determinant tells the elbows apart then."""
    bare = replace(RECORD, modes=replace(RECORD.modes, working={}, default_working=""))
    named, found = plane(), plane(record=bare)
    np.testing.assert_array_equal(found.reached, named.reached)
    np.testing.assert_allclose(found.joints[found.reached], named.joints[named.reached], atol=1e-6)


def test_what_is_cut_off_from_home_is_not_reached():
    """Above y = 0 the five-bar's own reach is in one piece; a row of poses across its hole is in two."""
    low = 0.0
    axes = (np.linspace(-330.0, 330.0, 67),)

    def poses(points):
        return np.concatenate([points, np.full_like(points, low)], axis=1)

    x = 190.0
    joints = RECORD.inverse([x, low], mode="-+").joints[0]
    found = continued(Mode(RECORD, named_signs(RECORD, "inverse", joints), poses), axes, (np.array([x]), joints))
    exists = RECORD.inverse(poses(axes[0][:, None]), mode="-+").exists[:, 0]
    assert np.sum(exists & (axes[0] < 0)) > 3
    assert np.sum(found.reached) > 3
    assert not np.any(found.reached & (axes[0] < 0))
    np.testing.assert_array_equal(found.reached[axes[0] > 0], exists[axes[0] > 0])


@pytest.mark.parametrize("x", [0.0, 40.0, -75.0])
def test_the_border_is_where_an_arm_is_stretched(x):
    found = plane()
    p = RECORD.values
    exact = min(np.sqrt((p.l1 + p.l2) ** 2 - (x - side * p.g) ** 2) for side in (1, -1))
    share, joints = found.border(np.array([[x, exact - 9.0]]), np.array([[x, exact + 5.0]]))
    assert 14.0 * share[0] - 9.0 == pytest.approx(0.0, abs=1e-4)
    assert pose_of(RECORD, joints[0])[1] == pytest.approx(exact, abs=0.05)


def test_on_the_edges_of_the_grid_and_of_one_twice_as_coarse_the_border_is_known():
    found = plane()
    p, step = RECORD.values, [axis[1] - axis[0] for axis in found.axes]
    column = int(np.argmin(np.abs(found.axes[0])))
    top = int(np.flatnonzero(found.reached[column])[-1])
    exact = np.sqrt((p.l1 + p.l2) ** 2 - (abs(found.axes[0][column]) + p.g) ** 2)
    for low, high in ((top, top + 1), (top - 1, top + 1), (top, top + 2)):
        ends = np.array([[found.axes[0][column], found.axes[1][k]] for k in (low, high)])
        (share, *_), _ = found.border(ends[:1], ends[1:])
        assert ends[0, 1] + share * (high - low) * step[1] == pytest.approx(exact, abs=1e-3)
    share, joints = found.border(ends[:1], ends[:1] + np.array([0.0, step[1]]))
    place = found.ends.place[column, top, 1]
    assert found.ends.share[place] == share[0]
    np.testing.assert_array_equal(found.ends.joints[place], joints[0])


def test_every_end_is_on_its_way_out_of_the_mode():
    found = plane()
    ends = found.ends
    assert len(ends.share) > 20
    assert np.all(found.reached[tuple(ends.tails.T)])
    assert not np.any(found.reached[tuple(ends.heads.T)])
    tails, heads = (
        np.stack([axis[k] for axis, k in zip(found.axes, nodes.T, strict=True)], axis=1)
        for nodes in (ends.tails, ends.heads)
    )
    on_way = tails + ends.share[:, None] * (heads - tails)
    np.testing.assert_allclose(pose_of(RECORD, ends.joints), on_way, atol=0.1)
    # an elbow is nearly straight there: the sign that names the mode nearly vanishes
    signs = [np.abs(quantity(RECORD, formula, ends.joints)) for formula in RECORD.modes.working.values()]
    inside = [np.abs(quantity(RECORD, formula, HOME)) for formula in RECORD.modes.working.values()]
    assert np.max(np.min(signs, axis=0)) < 0.1 * np.min(inside)


def test_points_far_from_what_is_reached_are_not_tried():
    found = plane()
    answer = found.at(np.array([[0.0, 5000.0], [0.0, 200.0]]))
    assert answer.reached.tolist() == [False, True]
    assert np.isfinite(answer.joints[:, 0]).tolist() == [False, True]


def test_of_the_ways_to_a_node_the_longest_is_chosen():
    ends = plane().ends
    heads = ends.heads[ends.longest]
    assert len(heads) == len(np.unique(ends.heads, axis=0)) < len(ends.heads)
    for head, row in zip(heads, ends.longest, strict=True):
        assert ends.share[row] == np.max(ends.share[np.all(ends.heads == head, axis=1)])
