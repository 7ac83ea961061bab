import numpy as np
import pytest

from assur.scene.camera import oblique, orthographic, plane

CAMERAS = [
    orthographic(35, 22),
    orthographic(-120, -40),
    oblique("y", "z", 211, 0.85),
    oblique("x", "z", 30, 0.5),
    plane("y", "z"),
]


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_line_of_sight_is_what_the_projection_forgets(camera):
    points = np.random.default_rng(0).normal(size=(20, 3))
    moved = points + 7.0 * camera.toward
    np.testing.assert_allclose(camera.project(moved), camera.project(points), atol=1e-12)
    np.testing.assert_allclose(camera.depth(moved) - camera.depth(points), 7.0)


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_picture_is_not_mirrored(camera):
    x, y, z = np.eye(3)
    volume = np.linalg.det(np.vstack([camera.image, camera.toward]))
    assert volume > 0, (x, y, z)


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_front_plane_is_seen_in_true_shape(camera):
    helper = np.eye(3)[np.argmin(np.abs(camera.front))]
    a = np.cross(camera.front, helper)
    b = np.cross(camera.front, a / np.linalg.norm(a))
    points = np.array([0 * a, a, b, 2 * a - b])
    flat = camera.project(points)
    for i in range(4):
        for k in range(i):
            true = np.linalg.norm(points[i] - points[k])
            assert np.linalg.norm(flat[i] - flat[k]) == pytest.approx(true)
