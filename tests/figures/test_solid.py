"""The model view as a journal prints it: vectors over shading, letters in the clear, fonts inside the file."""

from functools import cache

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.patches import PathPatch

import assur
from assur.figures import catalogue as figures
from assur.figures.canvas import POINTS, canvas, inside
from assur.figures.letters import letter
from assur.figures.model import lettered
from assur.figures.solid import model_camera, triad
from assur.scene.camera import plane
from assur.scene.companion import Companion
from assur.scene.shapes import Ball, Cuboid

SHOWN = ("fivebar", "zeng2019", "gough_stewart")
THINNEST = 0.25
"""Points; thinner lines break up in print."""


@cache
def drawn(name):
    context = figures.Context(assur.load(name))
    return context, figures.drawing(context.record, "solid", context).figure


@pytest.fixture(params=SHOWN)
def page(request):
    return drawn(request.param)


def texts(figure):
    return [item for item in figure.axes[0].texts if item.get_text()]


def test_points_have_letters_but_those_inside_a_leg(page):
    context, figure = page
    found = {part for item in texts(figure) for part in item.get_text().split(", ")}
    wanted = set(lettered(context.skeleton))
    if context.record.name == "gough_stewart":
        wanted = {name for name in wanted if name[0] not in "EF"}  # on tubes and rods
    assert {letter(name) for name in wanted} | {"$X$", "$Y$", "$Z$"} == found


def test_letters_are_whole_apart_and_over_everything(page):
    _, figure = page
    renderer = FigureCanvasAgg(figure).get_renderer()
    boxes = [item.get_window_extent(renderer) for item in texts(figure)]
    width, height = figure.get_size_inches() * figure.dpi
    for box in boxes:
        assert box.x0 >= 0
        assert box.y0 >= 0
        assert box.x1 <= width
        assert box.y1 <= height
    for k, one in enumerate(boxes):
        for two in boxes[:k]:
            across = min(one.x1, two.x1) - max(one.x0, two.x0)
            upward = min(one.y1, two.y1) - max(one.y0, two.y0)
            assert min(across, upward) <= 0.5  # boxes have room about the letters
    others = [item for item in figure.axes[0].get_children() if item not in texts(figure)]
    assert min(item.get_zorder() for item in texts(figure)) > max(
        item.get_zorder() for item in others if item in [*figure.axes[0].images, *figure.axes[0].patches]
    )
    assert all(item.get_path_effects() for item in texts(figure) if item.get_text() not in ("$X$", "$Y$", "$Z$"))


def test_lines_are_vectors_as_wide_as_print_needs(page):
    _, figure = page
    strokes = [item for item in figure.axes[0].patches if isinstance(item, PathPatch)]
    assert len(strokes) == 2
    assert all(len(item.get_path().vertices) > 40 for item in strokes)
    lines = [*figure.axes[0].patches, *figure.axes[0].lines]
    assert min(item.get_linewidth() for item in lines) >= THINNEST
    assert len(figure.axes[0].images) == 1  # light only


def test_a_pdf_bears_its_fonts_and_an_svg_needs_none():
    _, figure = drawn("fivebar")
    pdf = figures.encoded(figure, "pdf")
    assert b"/FontFile2" in pdf  # TrueType, Type 42
    assert b"/Type3" not in pdf
    svg = figures.encoded(figure, "svg").decode()
    assert svg.count("<image ") == 1
    assert "<text" not in svg
    assert len(svg) < 1_000_000


@pytest.mark.parametrize(("name", "hangs"), [("delta_4s", True), ("linear_delta_4s", True), ("three_rps", False)])
def test_a_mechanism_that_hangs_from_its_base_is_seen_from_below(name, hangs):
    """Unless its companion says otherwise, as those of the catalogue do."""
    context = figures.Context(assur.load(name))
    context.__dict__["companion"] = Companion()
    assert (model_camera(context).toward[2] < 0) == hangs


def test_the_directions_stand_where_the_model_does_not():
    """In the lower left corner if they may; else in another one."""
    lower_left = Cuboid(np.array([-0.7, -0.7, 0.0]), 0.3 * np.eye(3)).mesh("#000000")
    camera = plane("x", "y")
    for mesh, free in ((Ball(np.zeros(3), 0.3).mesh("#000000"), (True, True)), (lower_left, (False, True))):
        view = inside(camera, np.array([[-1.0, -1, 0], [1, 1, 0]]), (0.0, 0.0, 60.0, 60.0))
        page = canvas(60.0, 60.0)
        room = np.array([[0.0, 0.0], [60.0, 60.0]]) * POINTS
        box = triad(page, mesh, view, room)
        assert tuple(box.mean(axis=0) < room.mean(axis=0)) == free
        assert np.all(box[0] >= room[0] - 1e-9)
        assert np.all(box[1] <= room[1] + 1e-9)
