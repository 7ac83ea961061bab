"""Proved poses: samples lie inside, the first order is not far below, and what resists is named."""

import numpy as np
import pytest

import assur
from assur.kinematics.closure import assemble
from assur.kinematics.pose import pose_of
from assur.machine.accuracy.pose_errors import pose_errors_at
from assur.machine.accuracy.proved_poses import proved_poses
from assur.model.dimensions import with_parameters
from bending import bending
from catalogue import each

OFF = {"g": 0.02, "crank1.l1": 0.05, "crank2.l1": 0.03, "rod1.l2": 0.05, "rod2.l2": 0.04, "theta1": 1e-4}


def test_a_hundred_thousand_five_bars_lie_inside_and_nearly_fill_the_bounds():
    """Each by two circles on paper."""
    record = assur.load("fivebar")
    values = record.errors([20.0, 224.0]).values
    bounds = proved_poses(record, values, OFF).bounds
    random = np.random.default_rng(5).uniform(-1.0, 1.0, size=(100_000, len(OFF)))
    random[:64] = np.array(np.meshgrid(*[[-1.0, 1.0]] * 6)).reshape(6, -1).T
    g, l1, l1b, l2, l2b, turn = (random * list(OFF.values())).T
    sizes = {name: parameter.value for name, parameter in record.parameters.items()}
    first, second = (item.joint_value(0.0) + values[item.coordinate.index] for item in record.inputs)
    x1 = -sizes["g"] - g + (sizes["l1"] + l1) * np.cos(first + turn)
    y1 = (sizes["l1"] + l1) * np.sin(first + turn)
    x2 = sizes["g"] + g + (sizes["l1"] + l1b) * np.cos(second)
    y2 = (sizes["l1"] + l1b) * np.sin(second)
    apart = np.hypot(x2 - x1, y2 - y1)
    along = (apart**2 + (sizes["l2"] + l2) ** 2 - (sizes["l2"] + l2b) ** 2) / (2 * apart)
    across = np.sqrt((sizes["l2"] + l2) ** 2 - along**2)
    x = x1 + (along * (x2 - x1) - across * (y2 - y1)) / apart
    y = y1 + (along * (y2 - y1) + across * (x2 - x1)) / apart
    for name, samples in (("x", x), ("y", y)):
        low, high = bounds[name]
        assert low <= samples.min()
        assert samples.max() <= high
        assert high - low <= 1.05 * np.ptp(samples)


@pytest.mark.parametrize("name", each(quick=("planar_3rrr",)))
def test_dimensions_and_angles_of_other_mechanisms_do_too(name):
    """Whole dimensions at their bounds, assembled again; spins of rods and what is held twice among them."""
    record = assur.load(name)
    errors = pose_errors_at(record, record.home_values)
    names = [copy for copy in record.parameters if copy in errors.sensitivity and errors.compatible(copy)][:3]
    off = {copy: 1e-4 * max(abs(record.parameters[copy].value), 1.0) for copy in names}
    bounds = proved_poses(record, record.home_values, off).bounds
    assert bounds
    kept = {copy: item.value for copy, item in record.parameters.items()}
    held = [item.coordinate.index for item in record.drives]
    for signs in (np.ones(len(names)), np.array([1.0, -1.0, 1.0])[: len(names)]):
        changes = {copy: kept[copy] + sign * off[copy] for copy, sign in zip(names, signs, strict=True)}
        other = with_parameters(record.without_closed_form, **kept | changes)
        assembled = assemble(other, record.home_values[None], held=held, near=True)
        assert assembled.closed.all()
        pose = dict(zip(record.platform.pose, pose_of(other, assembled.values)[0], strict=True))
        for coordinate, (low, high) in bounds.items():
            slack = 1e-9 * max(1.0, abs(pose[coordinate]))  # of the loops, closed in floats
            assert low - slack <= pose[coordinate] <= high + slack


def test_no_bounds_where_tolerances_are_too_wide_or_the_pose_is_singular():
    fivebar = assur.load("fivebar", l2=150)
    near = fivebar.errors([0, 60.2]).values
    wide = proved_poses(fivebar, near, {"l2": 1.0})
    assert (wide.bounds, wide.resists) == ({}, "the tolerances are too wide, or a singularity is too near")
    assert bending(fivebar).errors([0, 224]).proved.resists == "no tolerances are stated"
