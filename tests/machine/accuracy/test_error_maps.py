"""Maps of errors say at each node what errors at that pose add to, and refuse what cannot be added."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.machine.accuracy.error_maps import SQUARES, TURNED, WORST, error_maps
from assur.model.machine_data import Tolerance
from assur.workspace.region import workspace

OFF = {"l2": Tolerance(0.05, 0.02), "link4a.l6": Tolerance(0.03, 0.01), "yA1": Tolerance(0.01, 0.005)}


def toleranced(name, off):
    record = assur.load(name)
    return replace(record, machine=replace(record.machine, tolerances=off))


def test_each_node_is_the_pose_by_itself():
    """The largest by every choice of ends."""
    record = toleranced("zeng2019", OFF)
    maps = error_maps(record, workspace(record, resolution=6), ["x", "z"], {"y": 0.0}, nodes=5)
    (_, xs), (_, zs) = maps.axes
    inside = np.argwhere(np.isfinite(maps[WORST]))
    assert 4 < len(inside) < 25
    for row, column in inside[::4]:
        own = record.errors([xs[row], 0.0, zs[column]])
        rows = np.array([own.sensitivity[name] * tolerance.bound for name, tolerance in OFF.items()])
        ends = np.array(np.meshgrid(*[[-1.0, 1.0]] * 3)).reshape(3, -1).T @ rows
        assert maps[WORST][row, column] == pytest.approx(np.linalg.norm(ends[:, :3], axis=1).max(), rel=1e-9)
        assert maps[TURNED][row, column] == pytest.approx(np.linalg.norm(ends[:, 3:], axis=1).max(), rel=1e-9)
        assert maps[SQUARES][row, column] == pytest.approx(np.linalg.norm(own.root_sum_square[:3]), rel=1e-9)


def test_what_does_not_assemble_alone_has_the_numbers_of_links_that_bend():
    record = toleranced("orthoglide", {"leg1.rod_a.L": Tolerance(0.1, 0.03)})
    maps = error_maps(record, workspace(record, resolution=6), ["x"], {"y": 0.0, "z": 0.0}, nodes=3)
    own = record.errors([maps.axes[0][1][1], 0.0, 0.0]).sensitivity["leg1.rod_a.L"]
    assert maps[WORST][1] == pytest.approx(0.1 * np.linalg.norm(own[:3]), rel=1e-6)


def test_a_platform_that_never_turns_has_no_rounding_for_a_rotation():
    record = toleranced("zeng2019", {"l2": Tolerance(0.05, 0.02), "l4": Tolerance(0.05, 0.02)})
    maps = error_maps(record, workspace(record, resolution=6), ["x"], {"y": 0.0, "z": 400.0}, nodes=3)
    assert np.nanmax(maps[TURNED]) == 0.0 < np.nanmin(maps[WORST])


def test_no_tolerances_are_told():
    record = assur.load("fivebar")
    with pytest.raises(UsageError, match="fivebar states no tolerances"):
        error_maps(record, None)
