"""The painter against a slow one that asks every triangle at every pixel."""

import numpy as np
import pytest

from assur.figures import raster
from assur.figures.canvas import View
from assur.scene import mesh
from assur.scene.camera import oblique, orthographic


def slow(flat, near, width, height):
    face = np.full((height, width), -1)
    for i in range(height):
        for j in range(width):
            best = -np.inf
            for k, (a, b, c) in enumerate(flat):
                matrix = np.array([b - a, c - a]).T
                if abs(np.linalg.det(matrix)) < 1e-12:
                    continue
                s, t = np.linalg.solve(matrix, np.array([j, i]) - a)
                if min(s, t, 1 - s - t) >= 0:
                    depth = near[k] @ [1 - s - t, s, t]
                    if depth > best:
                        best, face[i, j] = depth, k
    return face


def picture(shown, view, size, dots):
    return raster.lit(shown, view, raster.filled(shown, view, size, dots), dots, edges=False)


@pytest.mark.parametrize("seed", range(6))
def test_the_nearest_triangle_is_seen_at_every_pixel(seed):
    rng = np.random.default_rng(seed)
    flat = rng.uniform(-6, 26, size=(12, 3, 2))
    near = rng.uniform(0, 10, size=(12, 3))
    found = raster.buffers(flat, near, np.arange(12), 22, 17)
    wanted = slow(flat, near, 22, 17)
    different = found.face != wanted
    # where two are nearer to one another than the tie, the first is kept
    assert np.mean(different) < 0.01
    assert np.array_equal(found.face >= 0, wanted >= 0)


@pytest.mark.parametrize("camera", [orthographic(35, 22), oblique("y", "z", 211, 0.85)])
def test_a_ball_hides_what_is_behind_it_and_nothing_else(camera):
    behind = mesh.box(-30 * camera.toward, 4 * np.eye(3), "#ff0000")
    before = mesh.box(30 * camera.toward, 4 * np.eye(3), "#0000ff")
    ball = mesh.ball(np.zeros(3), 14.0, "#00ff00")
    view = View(camera, 1.0, np.array([40.0, 40.0]))
    image = picture(mesh.joined([behind, ball, before]), view, (80.0, 80.0), 72.0)
    colours = image[image[..., 3] == 1.0][:, :3]
    assert not np.any((colours[:, 0] > 0.3) & (colours[:, 1] < 0.1))  # the red box is hidden
    assert np.any((colours[:, 2] > 0.3) & (colours[:, 1] < 0.1))  # the blue box is not
    assert np.any(colours[:, 1] > 0.3)


def test_the_picture_is_where_the_page_says():
    view = View(orthographic(0, 90), 2.0, np.array([30.0, 50.0]))
    box = mesh.box(np.array([0.0, 0.0, 0.0]), np.diag([5.0, 2.0, 1.0]), "#ffffff")
    image = picture(box, view, (60.0, 80.0), 144.0)
    assert image.shape == (160, 120, 4)
    rows, columns = np.nonzero(image[..., 3] > 0.5)
    across = np.array([columns.min(), columns.max() + 1]) / 2
    upwards = 80.0 - np.array([rows.max() + 1, rows.min()]) / 2
    corners = view(np.array([[x, y, 0.0] for x in (-5, 5) for y in (-2, 2)]))
    np.testing.assert_allclose(across, [corners[:, 0].min(), corners[:, 0].max()], atol=0.5)
    np.testing.assert_allclose(upwards, [corners[:, 1].min(), corners[:, 1].max()], atol=0.5)


def test_light_comes_from_above():
    view = View(orthographic(20, 30), 1.0, np.zeros(2))
    up, down = raster._light(np.array([[0, 0, 1.0], [0.94, 0.34, 0.0]], dtype=np.float32), view)
    assert up > down
