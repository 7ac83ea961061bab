"""Proved poses: samples lie inside, the first order is not far below, and what resists is named."""

import numpy as np
import pytest

import assur
from assur.joint_graph.geometry import characteristic_length
from assur.machine.accuracy.pose_errors import pose_errors_at
from assur.machine.accuracy.proved_poses import proved_poses
from assur.model.pose import LENGTHS, QUATERNION
from assur.numerics import rotations
from bending import bending
from catalogue import each
from copies_off import settled

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
        assert high - low <= 1.0001 * np.ptp(samples)


@pytest.mark.parametrize("name", each(quick=("planar_3rrr",)))
@pytest.mark.parametrize("count", [1000, pytest.param(100_000, marks=pytest.mark.deep)])
def test_samples_of_other_mechanisms_do_too(name, count):
    """Dimensions, copies and inputs, at random and at the ends that are worst to first order, assembled again."""
    record = assur.load(name)
    errors = pose_errors_at(record, record.home_values, bent=False)
    inputs = [item.name for item in record.drives]
    names = [copy for copy in errors.sensitivity if errors.compatible(copy) and copy not in inputs][:6] + inputs
    length = characteristic_length(record)
    off = {copy: 1e-5 * (length if errors.units[copy] == record.unit else 1.0) for copy in names}
    bounds = proved_poses(record, record.home_values, off).bounds
    assert set(bounds) == set(record.platform.pose) - set(QUATERNION)
    worst = np.sign([errors.sensitivity[copy] for copy in names]).T
    drawn = np.random.default_rng(1).uniform(-1.0, 1.0, size=(count, len(names)))
    samples = np.concatenate([worst, -worst, drawn]) * list(off.values())
    own, driven = (
        {copy: row for copy, row in zip(names, samples.T, strict=True) if (copy in inputs) == of_inputs}
        for of_inputs in (False, True)
    )
    after = settled(record, record.home_values, own, driven)
    assert after.left.max() < 1e-11 * length
    angles = dict(zip(("phi", "theta", "psi"), rotations.to_angles(after.turn), strict=True))
    for coordinate, (low, high) in bounds.items():
        reached = angles.get(coordinate, after.point[:, LENGTHS.index(coordinate) if coordinate in LENGTHS else 0])
        slack = 1e-11 * (length if coordinate in LENGTHS else 1.0)  # of the loops, closed in floats
        assert low - slack <= reached.min()
        assert reached.max() <= high + slack
        if coordinate in LENGTHS:
            wider = 1.6 if name in ("h4_robot", "three_rrrp4r") else 1.05
            assert high - low <= wider * np.ptp(reached) + 2.0 * slack


def test_no_bounds_where_tolerances_are_too_wide_or_the_pose_is_singular():
    fivebar = assur.load("fivebar", l2=150)
    near = fivebar.errors([0, 60.2]).values
    wide = proved_poses(fivebar, near, {"l2": 1.0})
    assert (wide.bounds, wide.resists) == ({}, "the tolerances are too wide, or a singularity is too near")
    assert bending(fivebar).errors([0, 224]).proved.resists == "no tolerances are stated"
