"""The slowest natural vibrations: the machine at rest in grey, deflected, in colours of where the strain energy is."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from assur.figures.canvas import POINTS, Canvas, View, canvas, inside
from assur.figures.context import Context
from assur.figures.joint_forces import no_masses
from assur.figures.page import HIGHEST, side_by_side
from assur.figures.placing import Letters
from assur.figures.sketch import cloud_of, draw_ground
from assur.figures.spec import Drawing, FigureKind
from assur.figures.strain_colours import drawn_stiffness, not_held, strain_bar, strain_colours
from assur.figures.style import INK, PAPER, TEXT
from assur.figures.symbols import joint_symbol
from assur.kinematics.validation.check import METRES
from assur.machine.elasticity.mode_shapes import ModeShape
from assur.machine.elasticity.springs import ACTUATORS
from assur.scene.camera import Camera, oblique, orthographic
from assur.scene.hull import hull

FloatArray = NDArray[np.float64]
FURTHEST = 0.12
"""Of the mechanism's size: how far the point is drawn from rest that moves most."""
LEAST, ACROSS = 40.0, 3
"""Width that a panel needs in mm, and panels in a row at most."""
REST = "#bdbdbd"
BAR, TITLE, EDGE = 13.0, 12.0, 4.0
"""Room in mm for the bar of colours, in each panel for its title and for what stands under the base, and about it."""


def shapes(context: Context) -> tuple[ModeShape, ...]:
    """Of the configuration that is drawn, worked out once."""
    return context.kept("mode shapes", lambda: drawn_stiffness(context).mode_shapes())


def _missing(context: Context) -> str:
    return not_held(context) or no_masses(context) or ("" if shapes(context) else "nothing of it vibrates")


def usual_camera(context: Context) -> Camera:
    """As forces in the joints are drawn."""
    usual = orthographic(-62, 52) if context.planar else oblique("y", "z", 216, 0.6)
    return context.companion.camera("reactions", usual)


def _caption(_context: Context) -> str:
    return (
        "The slowest natural vibrations while the actuators hold their inputs: at rest (grey) and at their largest, not"
        " to scale. Colours are shares of the strain energy, by links that bend; rigid links are black."
    )


def _draw(context: Context) -> Drawing:
    own = shapes(context)
    columns = min(len(own), side_by_side(context.page, ACROSS, LEAST))
    rows, wide = -(-len(own) // columns), context.page / columns
    metre, base = METRES[context.record.unit], context.record.base
    furthest = FURTHEST * context.skeleton.size * metre
    moved = [{link: way / metre for link, way in shape.deflected(furthest).items() if link != base} for shape in own]
    rest = cloud_of(context.skeleton, context.companion)
    cloud = np.concatenate([rest, *(way.reshape(-1, 3) for ways in moved for way in ways.values())])
    camera = usual_camera(context)
    span = np.ptp(camera.project(cloud), axis=0)
    tallest = min(0.9 * wide, (HIGHEST - BAR) / rows - TITLE - EDGE)
    tall = float(np.clip((wide - 2 * EDGE) * span[1] / max(span[0], 1e-300), 20.0, tallest)) + TITLE + EDGE
    height = rows * tall + BAR
    page = canvas(context.page, height)
    most = max((share for shape in own for share in shape.shares.bent.values()), default=0.0)
    for k, (shape, ways) in enumerate(zip(own, moved, strict=True)):
        left, bottom = wide * (k % columns), BAR + tall * (rows - 1 - k // columns)
        view = inside(camera, cloud, (left + EDGE, bottom + TITLE, wide - 2 * EDGE, tall - TITLE - EDGE))
        _draw_rest(page, view, context)
        _draw_deflected(page, view, ways, strain_colours(shape.shares.links, most))
        title = f"({chr(97 + k)}) {shape.frequency:.4g} Hz, actuators {100 * shape.shares.links[ACTUATORS]:.0f} %"
        page.text(np.array([left + wide / 2, bottom + 0.25 * TITLE]) * POINTS, title, fontsize=TEXT)
    if most > 0.0:
        place = (0.5 - 30.0 / context.page, 9.0 / height, 60.0 / context.page, 3.0 / height)
        strain_bar(page.figure, place, most, "strain energy (%)")
    return Drawing(page.figure, {"shapes": [_data(shape) for shape in own]})


def _draw_rest(page: Canvas, view: View, context: Context) -> None:
    """Rods and plates in grey, and what stands on the base."""
    drawn = context.skeleton
    draw_ground(page, view, drawn, context.companion, Letters(page))
    for plate in drawn.plates:
        page.polygon(hull(view(plate.points)), "none", REST, 0.8, 3.0)
    for rod in drawn.rods:
        page.line(view(rod.points), 1.0, REST, 3.0)
    for mark in drawn.marks:
        if mark.grounded:
            joint_symbol(page, view, mark, 4.0, 0.6)


def _draw_deflected(page: Canvas, view: View, ways: Mapping[str, FloatArray], colours: Mapping[str, str]) -> None:
    """Curves of what bends over outlines of what is rigid; of a rigid link with many joints the hull of these."""
    for link, curves in ways.items():
        for curve in curves:
            flat = view(_smooth(curve) if link in colours else curve)
            if link in colours:
                page.line(flat, 1.9, PAPER, 11.0)
                page.line(flat, 1.5, colours[link], 12.0)
            elif len(flat) > 2:
                page.polygon(hull(flat), "none", INK, 0.8, 10.0)
            elif len(flat) > 1:
                page.line(flat, 1.0, INK, 10.0)


def _smooth(curve: FloatArray) -> FloatArray:
    """More points (33, 3) of a deflected beam (k, 3), which is a cubic."""
    along = np.linspace(0.0, 1.0, len(curve))
    return np.asarray(CubicSpline(along, curve)(np.linspace(0.0, 1.0, 33)))


def _data(shape: ModeShape) -> dict[str, object]:
    return {"frequency": shape.frequency, "platform": shape.platform, "shares": shape.shares.links,
            "links": {link: {"rest": rest, "moved": moved} for link, (rest, moved) in shape.links.items()}}  # fmt: skip


VIBRATIONS = FigureKind("vibrations", "Natural vibrations", _missing, _caption, _draw)
