"""Maps of what is held: each node as at its pose; speeds by the velocity map."""

import numpy as np
import pytest

import assur
from assur.machine.forces.capacity import capacity
from assur.machine.forces.capacity_maps import capacity_maps, tops
from assur.workspace.region import workspace


def test_each_node_is_as_at_its_pose():
    record = assur.load("fivebar")
    maps = capacity_maps(record, workspace(record, resolution=8), nodes=6)
    inside = np.argwhere(np.isfinite(maps["sphere"]))
    assert len(inside) > 10
    for i, j in inside[::5]:
        pose = [maps.axes[0][1][i], maps.axes[1][1][j]]
        held = capacity(record, pose)
        assert maps["sphere"][i, j] == pytest.approx(held.sphere)
        assert maps["gravity"][i, j] == pytest.approx(held.utilisation.max())
        assert maps["along y"][i, j] == pytest.approx(held.per_axis[1, 1])
        per_rate = np.linalg.inv(record.velocity_map(pose).matrix * 1e-3)
        speeds = [record.machine.actuators[name].speed for name in ("A1", "A2")]
        assert maps["speed"][i, j] == pytest.approx(np.min(speeds / np.linalg.norm(per_rate, axis=1)))
    assert "gravity" not in tops(maps)  # it acts across the plane
    assert 0.0 < tops(maps)["along y"] < maps.maps["along y"].most.value
