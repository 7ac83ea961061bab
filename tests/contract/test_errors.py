"""Laws of errors, for every mechanism: they are differences of poses that are solved again, whatever bends."""

import numpy as np
import pytest

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.validation.check import METRES
from assur.machine.accuracy.elastic_errors import elastic_errors
from assur.machine.accuracy.geometry_errors import geometry_errors
from assur.machine.accuracy.pose_errors import pose_errors_at
from bending import bending, by_multipliers, yielding
from copies_off import moved
from own_machines import every_mechanism
from weighed import place

mechanism = every_mechanism()


@pytest.fixture
def errors(mechanism):
    return pose_errors_at(mechanism, place(mechanism)[0])


def test_copies_that_are_off_move_the_platform_as_poses_solved_again_say(mechanism, errors):
    """Of whole dimensions, of one limb's, of one link's, and inputs, one by one; what does not assemble stays open."""
    names, inputs = list(errors.sensitivity), [item.name for item in mechanism.drives]
    length = characteristic_length(mechanism)
    of_lengths = np.array([errors.units[name] == mechanism.unit for name in names])
    steps = 1e-5 * np.where(of_lengths, length, 1.0)
    (above, left), (below, _) = (
        moved(mechanism, errors.values, *(_each(names, sense * steps, own, inputs) for own in (False, True)))
        for sense in (1.0, -1.0)
    )
    degrees = np.array([np.radians(1.0) if errors.units[name] == "deg" else 1.0 for name in names])
    again = (above - below) * (degrees / (2.0 * steps))[:, None]
    stated, size = np.array(list(errors.sensitivity.values())), np.repeat([1.0, 1.0 / length], 3)
    fits = np.array([errors.compatible(name) for name in names])
    np.testing.assert_allclose(
        (again / size)[fits], (stated / size)[fits], atol=1e-7 * np.abs(stated / size)[fits].max()
    )
    assert np.all(left[fits] < 1e-7 * steps[fits])
    assert np.all(left[~fits] > 1e-7 * steps[~fits])


def test_inputs_that_bring_the_pose_back_leave_what_no_calibration_takes_away(mechanism, errors):
    """Dimensions off one by one, the inputs corrected, poses solved again."""
    names = [name for name in errors.uncompensated if errors.compatible(name)]
    length, size = characteristic_length(mechanism), np.repeat([1.0, 1.0 / characteristic_length(mechanism)], 3)
    one = np.array([np.radians(1.0) if errors.units[name] == "deg" else 1.0 for name in names])
    steps = 1e-5 * np.array([length if errors.units[name] == mechanism.unit else 1.0 for name in names])
    added = (np.array([errors.corrections[name] for name in names]) * (steps / one)[:, None]).T
    above, below = (
        moved(
            mechanism,
            errors.values,
            {name: sense * row for name, row in zip(names, np.diag(steps), strict=True)},
            {item.name: sense * row for item, row in zip(mechanism.drives, added, strict=True)},
        )[0]
        for sense in (1.0, -1.0)
    )
    again = (above - below) * (one / (2.0 * steps))[:, None] / size
    stated = np.array([errors.uncompensated[name] for name in names]) / size
    largest = max(np.abs(errors.sensitivity[name] / size).max() for name in names)
    np.testing.assert_allclose(again, stated, atol=1e-7 * largest)


def test_what_assembles_moves_it_the_same_whether_links_bend_or_not(mechanism, errors):
    """And inputs move it as the motion of the joint graph says."""
    values = errors.values
    own = geometry_errors(mechanism, values)
    settled = elastic_errors(bending(mechanism), values, own.twists.transpose(1, 2, 0))
    settled[:3] += own.point.T
    for name, row in zip(own.names, settled.T, strict=True):
        if errors.compatible(name):
            np.testing.assert_allclose(row, errors.sensitivity[name], atol=1e-7 * (1 + np.abs(row).max()))
    assert all(errors.compatible(item.name) for item in mechanism.inputs)


def test_what_does_not_assemble_settles_where_multipliers_say(mechanism):
    """Beams, joints and gears that yield, every copy of every dimension off by itself."""
    record, values = yielding(bending(mechanism)), place(mechanism)[0]
    own = geometry_errors(mechanism, values)
    off = own.twists.transpose(1, 2, 0)
    settled = elastic_errors(record, values, off)
    again = by_multipliers(record, values, off=off)[0]
    length = characteristic_length(mechanism)
    again[:3] /= METRES[mechanism.unit]
    size = np.repeat([length, 1.0], 3)[:, None]
    np.testing.assert_allclose(settled / size, again / size, atol=1e-7 * np.abs(again / size).max(), rtol=0.0)


def _each(names, steps, driven, inputs):
    """Copy, or input where `driven`, -> what it is off by (P,) where each of all is so alone."""
    rows = steps * np.eye(len(names))
    return {name: row for name, row in zip(names, rows, strict=True) if (name in inputs) == driven}
