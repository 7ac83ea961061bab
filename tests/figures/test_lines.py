"""Lines without what is hidden, against counts and places that solid geometry gives."""

import numpy as np
import pytest

from assur.figures.canvas import View
from assur.figures.lines import line_work
from assur.figures.raster import filled
from assur.scene import mesh
from assur.scene.camera import oblique, orthographic

PAGE, DOTS = (120.0, 120.0), 144.0
MIDDLE = np.array([60.0, 60.0])


def seen(body, camera, scale=1.0):
    view = View(camera, scale, MIDDLE)
    return line_work(body, view, filled(body, view, PAGE, DOTS), DOTS), view


def length(lines):
    return float(np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1).sum())


@pytest.mark.parametrize("camera", [orthographic(30, 25), orthographic(-70, -40), oblique("y", "z", 216, 0.6)])
def test_of_a_box_nine_edges_are_seen_and_they_are_its_own(camera):
    sides = np.diag([20.0, 12.0, 8.0])
    found, view = seen(mesh.box(np.zeros(3), sides, "#808080"), camera)
    assert (len(found.outlines), len(found.creases)) == (6, 3)
    near = np.sign(sides @ camera.toward) @ sides  # the corner next to the reader is in all three creases
    for line in found.creases:
        assert np.min(np.linalg.norm(line - view(near), axis=1)) < 1e-9
    corners = view(np.array([[x, y, z] for x in (-20, 20) for y in (-12, 12) for z in (-8, 8)]))
    gaps = np.linalg.norm(found.outlines[:, :, None] - corners, axis=-1)
    assert np.max(np.min(gaps, axis=-1)) < 1e-9


def test_what_a_plate_covers_is_not_drawn():
    behind = mesh.box(np.zeros(3), np.diag([2.0, 40.0, 4.0]), "#808080")
    plate = mesh.box(np.array([20.0, 0, 0]), np.diag([1.0, 10.0, 30.0]), "#808080")
    camera = orthographic(0, 0)  # Y to the right, Z up
    alone, _ = seen(behind, camera)
    both, view = seen(mesh.joined([behind, plate]), camera)
    pixel = 72.0 / DOTS / 2
    assert length(alone.outlines) == pytest.approx(2 * (80 + 8), abs=4 * pixel)
    # twenty of each long side are behind the plate, whose own outline is whole
    assert length(both.outlines) == pytest.approx(2 * (80 + 8) - 2 * 20 + 2 * (20 + 60), abs=8 * pixel)
    flat = (both.outlines - view(np.zeros(3))).reshape(-1, 2)
    covered = (np.abs(flat[:, 0]) < 10 - 2 * pixel) & (np.abs(flat[:, 1]) < 30 - 2 * pixel)
    assert not np.any(covered)


def test_where_a_pin_leaves_a_plate_there_is_a_circle():
    plate = mesh.box(np.zeros(3), np.diag([30.0, 30.0, 4.0]), "#808080")
    pin = mesh.cylinder(np.array([0.0, 0, -20]), np.array([0.0, 0, 20]), 10.0, "#404040")
    camera = orthographic(0, 60)
    found, view = seen(mesh.joined([plate, pin]), camera)
    flat = (found.creases.reshape(-1, 2) - view(np.array([0.0, 0.0, 4.0]))) / [1.0, np.sin(np.radians(60))]
    on_circle = np.abs(np.linalg.norm(flat, axis=1) - 10.0) < 0.1
    front = on_circle & (flat[:, 1] < 1e-6)
    # the half that is turned to the reader; at its ends the pin's facets are thinner than a pixel
    ends = found.creases[front.reshape(-1, 2).all(axis=1)]
    stretched = ends / [1.0, np.sin(np.radians(60))]
    assert length(stretched) == pytest.approx(np.pi * 10.0, rel=0.08)


def test_a_ball_has_its_outline_only():
    found, view = seen(mesh.ball(np.zeros(3), 25.0, "#808080"), orthographic(17, 33))
    assert len(found.creases) == 0
    reach = np.linalg.norm(found.outlines.reshape(-1, 2) - view(np.zeros(3)), axis=1)
    assert np.all((reach > 24.0) & (reach < 25.0 + 1e-9))
    assert length(found.outlines) == pytest.approx(2 * np.pi * 25.0, rel=0.02)


def test_parts_that_share_a_side_keep_their_own_edges():
    one = mesh.box(np.array([0.0, -10, 0]), np.diag([5.0, 10, 8]), "#808080")
    two = mesh.box(np.array([0.0, 10, 0]), np.diag([5.0, 10, 8]), "#404040")
    found, _ = seen(mesh.joined([one, two]), orthographic(0, 0))
    apart = mesh.box(np.array([0.0, 30, 0]), np.diag([5.0, 10, 8]), "#404040")
    alone, _ = seen(mesh.joined([one, apart]), orthographic(0, 0))
    assert length(found.outlines) == pytest.approx(length(alone.outlines), rel=0.02)


def test_an_empty_page_has_no_lines():
    body = mesh.box(np.array([1000.0, 1000, 1000]), np.eye(3), "#808080")
    found, _ = seen(body, orthographic(10, 80))
    assert len(found.outlines) == len(found.creases) == 0
