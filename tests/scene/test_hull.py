"""The hull has every point inside or on it, and only corners."""

import numpy as np

from assur.scene.hull import hull


def test_every_point_is_inside_and_every_corner_turns_left():
    points = np.random.default_rng(2).normal(size=(200, 2))
    corners = hull(points)
    sides = np.roll(corners, -1, axis=0) - corners
    way = points[:, None] - corners[None]
    assert np.all(sides[:, 0] * way[..., 1] - sides[:, 1] * way[..., 0] > -1e-12)
    after = np.roll(sides, -1, axis=0)
    assert np.all(sides[:, 0] * after[:, 1] - sides[:, 1] * after[:, 0] > 0)
