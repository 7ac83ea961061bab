"""Laws of errors, for every mechanism: they are differences of poses that are solved again, whatever bends."""

import numpy as np
import pytest

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import assemble
from assur.kinematics.pose import platform_frame
from assur.machine.accuracy.elastic_errors import elastic_errors
from assur.machine.accuracy.geometry_errors import geometry_errors
from assur.machine.accuracy.pose_errors import pose_errors_at
from assur.model.dimensions import with_parameters
from assur.numerics import rotations
from bending import bending
from weighed import place


@pytest.fixture
def errors(mechanism):
    return pose_errors_at(mechanism, place(mechanism)[0])


def test_dimensions_that_are_off_move_the_platform_as_poses_solved_again_say(mechanism, errors):
    """All that assemble at once, each by another share."""
    values, length = errors.values, characteristic_length(mechanism)
    names = [name for name in mechanism.parameters if name in errors.sensitivity and errors.compatible(name)]
    shares = np.random.default_rng(3).uniform(0.2, 1.0, size=len(names))
    step = 1e-5 * length
    once, twice = (_moved(mechanism, values, dict(zip(names, count * step * shares, strict=True))) for count in (1, 2))
    moved = (4.0 * once - twice) / (2.0 * step)  # of a parabola through both and none
    expected = sum(share * errors.sensitivity[name] for name, share in zip(names, shares, strict=True))
    size = np.repeat([1.0, 1.0 / length], 3)
    np.testing.assert_allclose(moved / size, expected / size, atol=1e-5 * (1.0 + np.abs(expected / size).max()))


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


def _with(record, changes):
    """The record with other dimensions, and all that is computed from others as it was."""
    kept = {name: item.value for name, item in record.parameters.items()}
    return with_parameters(
        record.without_closed_form, **kept | {name: kept[name] + step for name, step in changes.items()}
    )


def _held(record, values):
    """Joint values (n,) near `values` that close the loops, the inputs as they are."""
    fixed = [item.coordinate.index for item in record.drives]
    assembled = assemble(record, values[None], near=True, held=fixed)
    assert assembled.closed.all()
    return assembled.values[0]


def _moved(record, values, changes):
    """Displacement and rotation vector (6,) of the platform with other dimensions, the inputs as they are."""
    other = _with(record, changes)
    (turn, at), (second_turn, second_at) = (platform_frame(own, places) for own, places in (
        (record, values[None]), (other, _held(other, values)[None])))  # fmt: skip
    return np.concatenate([second_at[0] - at[0], rotations.to_vector(second_turn[0] @ turn[0].T)])
