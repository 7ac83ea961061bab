"""Sweeps over dimensions: every row is what the mechanism with these dimensions says alone."""

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.closed_form.stored import stored_sweep
from assur.kinematics.closed_form.swept_dimensions import runs
from assur.kinematics.status import Status

NAMES = ("l1", "l2", "x", "y")
GRID = Grid(NAMES, (-40.0, 90.0, -50.0, 60.0), (160.0, 210.0, 50.0, 260.0), (6, 4, 3, 5))


@pytest.mark.parametrize("mode", ["-+", "all"])
def test_every_row_is_that_of_the_mechanism_of_these_dimensions(mode):
    record = assur.load("fivebar")
    sweep = stored_sweep(record, "inverse", GRID, mode, ("inputs", "exists", "status"))
    given = GRID.poses(slice(7, 353))  # no block begins where a mechanism does
    rows, absent = sweep.solve(given), given[0] <= 0.0
    assert np.all(rows["status"][..., absent] == Status.no_mechanism)
    assert np.isnan(rows["inputs"][..., absent]).all()
    seen = set()
    for run in runs(given[:2]):
        l1, l2 = given[:2, run.start]
        if l1 <= 0.0:
            continue
        alone = stored_sweep(
            assur.load("fivebar", l1=l1, l2=l2),
            "inverse",
            Grid(NAMES[2:], GRID.low[2:], GRID.high[2:], GRID.counts[2:]),
            mode,
            ("inputs", "exists", "status"),
        ).solve(given[2:, run])
        for name in sweep.keep:
            np.testing.assert_array_equal(rows[name][..., run], alone[name])
        seen |= set(np.unique(alone["status"]))
    assert {Status.regular, Status.unreachable} <= seen


def test_dimensions_that_the_file_does_not_allow_are_counted_by_their_reason():
    sweep = stored_sweep(assur.load("fivebar"), "inverse", GRID)
    block = sweep.block(GRID.poses(slice(0, GRID.size)))
    reasons = block.counts["refused"]
    assert sum(reasons.values()) == block.counts["status"]["no_mechanism"] == 2 * 4 * 3 * 5
    assert sum("cannot be -40" in reason for reason in reasons) == 1


def test_an_unknown_dimension_is_named():
    grid = Grid(("l9", "x", "y"), (1.0, 0.0, 200.0), (2.0, 0.0, 200.0), (2, 1, 1))
    with pytest.raises(UnknownNameError, match="l9"):
        stored_sweep(assur.load("fivebar"), "inverse", grid)
