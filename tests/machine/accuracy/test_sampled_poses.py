"""Samples within tolerances are mechanisms that are solved again, and say how wide proved bounds are."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.machine.accuracy.pose_errors import pose_errors_at
from assur.machine.accuracy.sampled_poses import sampled_poses
from assur.model.machine_data import Tolerance
from assur.numerics import rotations
from copies_off import settled


@pytest.mark.parametrize(
    ("name", "off"),
    [
        ("fivebar", {"l1": 0.05, "rod1.l2": 0.02, "theta1": 1e-3}),
        ("gough_stewart", {"base.a1x": 1e-3, "a2y": 1e-3, "l3": 5e-4}),
        ("planar_3rrr", {"leg1.R": 0.05, "r": 0.05, "q2": 1e-3}),
    ],
)
def test_samples_are_mechanisms_solved_again(name, off):
    """By chords whose derivative is that of differences."""
    record = assur.load(name)
    errors = pose_errors_at(record, record.home_values, bent=False)
    inputs = [item.name for item in record.drives]
    own = sampled_poses(record, errors.values, off, errors.sensitivity, count=50, seed=4)
    assert own.assembled == 62
    ends = np.sign([errors.sensitivity[copy] for copy in off]).T
    drawn = np.random.default_rng(4).uniform(-1.0, 1.0, size=(50, len(off)))
    samples = dict(zip(off, (np.concatenate([ends, -ends, drawn]) * list(off.values())).T, strict=True))
    again = settled(
        record,
        errors.values,
        {copy: row for copy, row in samples.items() if copy not in inputs},
        {copy: row for copy, row in samples.items() if copy in inputs},
    )
    known = dict(zip(("phi", "theta", "psi"), rotations.to_angles(again.turn), strict=True))
    known |= dict(zip("xyz", again.point.T, strict=True))
    for coordinate, (low, high) in own.bounds.items():
        assert (low, high) == pytest.approx((known[coordinate].min(), known[coordinate].max()), abs=1e-8)


def test_ratios_are_of_widths_and_what_lies_outside_is_seen():
    record = assur.load("fivebar")
    machine = replace(record.machine, tolerances={"l1": Tolerance(0.05, 0.02), "theta1": Tolerance(1e-4, 3e-5)})
    errors = replace(record, machine=machine).errors([20.0, 224.0])
    own = errors.sampled(1000)
    proved = errors.proved.bounds
    for name, ratio in own.ratio(proved).items():
        assert ratio == pytest.approx(np.ptp(proved[name]) / np.ptp(own.bounds[name]))
        assert 1.0 - 1e-8 <= ratio < 1.001
    assert own.inside(proved)
    low, high = proved["y"]
    assert not own.inside({**proved, "y": (low, high - 0.01 * (high - low))})
    assert own.ratio({"x": (0.0, 1.0)}).keys() == {"x"}
    with pytest.raises(UsageError, match="fivebar states no tolerances"):
        record.errors([20.0, 224.0]).sampled()


def test_samples_that_do_not_assemble_are_not_counted():
    """One rod of two alone fits no rigid Orthoglide but by its own length: no sample does."""
    record = assur.load("orthoglide")
    errors = pose_errors_at(record, record.home_values, bent=False)
    own = sampled_poses(record, errors.values, {"leg1.rod_a.L": 0.05}, {"leg1.rod_a.L": np.full(6, np.nan)}, count=20)
    assert own.assembled == 12  # ends of what has no sign are the nominal one
    both = sampled_poses(record, errors.values, {"leg1.rod_a.L": 0.05}, {"leg1.rod_a.L": np.ones(6)}, count=20)
    assert (both.assembled, both.bounds) == (0, {})
