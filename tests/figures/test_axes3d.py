"""Numbers on axes in space: true, apart, and clear of their axis."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from assur.figures.axes3d import draw_axes
from assur.figures.canvas import canvas, inside
from assur.figures.style import styled
from assur.scene.camera import orthographic

BOXES = [
    (np.array([-120.0, -250.0, 150.0]), np.array([90.0, 250.0, 480.0])),
    (np.array([-300.0, -300.0, -300.0]), np.array([300.0, 300.0, 300.0])),
    (np.array([0.0, 0.0, 0.0]), np.array([0.05, 0.2, 0.1])),
]
"""The second and the third one are as crowded as they come: long numbers on all axes, and a short axis."""


@pytest.mark.parametrize(("low", "high"), BOXES)
@pytest.mark.parametrize("azimuth", [-60, 35, 120])
def test_numbers_and_titles_do_not_touch(low, high, azimuth):
    camera = orthographic(azimuth, 24)
    corners = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    with styled():
        page = canvas(85.0, 85.0)
        view = inside(camera, corners, (16.0, 16.0, 53.0, 53.0))
        draw_axes(page, view, low, high, ["x (mm)", "y (mm)", "z (mm)"], [1.0, 1.0, 1.0])
        renderer = FigureCanvasAgg(page.figure).get_renderer()
        texts = list(page.axes.texts)
        boxes = [item.get_window_extent(renderer) for item in texts]
    for k, (one, text) in enumerate(zip(boxes, texts, strict=True)):
        for two, other in zip(boxes[:k], texts, strict=False):
            across = min(one.x1, two.x1) - max(one.x0, two.x0)
            upward = min(one.y1, two.y1) - max(one.y0, two.y0)
            assert min(across, upward) <= 1.5, (text.get_text(), other.get_text())
    numbers = [item for item in texts if "mm" not in item.get_text()]
    assert len(numbers) >= 5
    ticks = [line.get_xydata() for line in page.axes.lines]
    ticks = [line for line in ticks if len(line) == 2 and np.linalg.norm(line[1] - line[0]) < 4.0]
    for item in numbers:  # on the line of a tick, right beyond it
        at = np.array(item.get_position())
        ways = [(at - foot, (tip - foot) / np.linalg.norm(tip - foot)) for foot, tip in ticks]
        aside = [abs(way[0] * along[1] - way[1] * along[0]) for way, along in ways if 3.0 < way @ along < 25.0]
        assert min(aside) < 1e-6, item.get_text()
    upright = view(corners)[:, 0].min()  # the axis of z is the edge farthest to the left
    for item, box in zip(texts, boxes, strict=True):
        if item in numbers and box.x0 < upright:
            assert box.x1 < upright + 12.0
