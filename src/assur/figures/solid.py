"""The model view: bars, pins, sliders, rails and platform in light, with lettered joints and hidden lines left out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from assur.figures.canvas import Canvas, View, fitted
from assur.figures.context import Context
from assur.figures.letters import letter
from assur.figures.lines import LineWork, line_work
from assur.figures.placing import Letters
from assur.figures.raster import SAMPLES, Buffers, filled, lit
from assur.figures.spec import Drawing, FigureKind, always
from assur.figures.style import BLUE, DOTS_PER_INCH, INK, PAPER, SMALL
from assur.results.typeset_text import minus
from assur.scene.bodies import home_skeleton
from assur.scene.camera import Camera, orthographic
from assur.scene.letters import lettered
from assur.scene.mesh import Mesh
from assur.scene.parts import model, unit
from assur.scene.skeleton import Skeleton

FloatArray = NDArray[np.float64]
OUTLINE, CREASE = 0.7, 0.4
"""Widths of lines in points; what a journal prints is not under 0.25."""

HALO, TRIAD, AROUND = 2.2, 15.0, 9.0
"""Width of the white edge of a letter, length of the directions X, Y, Z and room about them, in points."""

BELOW = -14
"""Elevation in degrees from which a mechanism is seen that hangs from its base, whose plate would hide it."""

HIDDEN = 3.0
"""A point is hidden by what is nearer by more than so many units of drawn thickness; pins and plates are thinner."""

LONG, TOGETHER = 2.0, 1.0
"""Letters keep clear of longer lines; points that are nearer on paper share a label; in points."""


def _caption(context: Context) -> str:
    unit = context.record.unit
    values = ", ".join(
        f"{name} = {minus(f'{item.value:g}')}{'' if item.unit in (unit, '1') else f' {item.unit}'}"
        for name, item in context.record.parameters.items()
        if not item.drawn_only
    )
    dimensions = f" with {values} (lengths in {unit})" if values else ""
    return (
        f"Model view of the mechanism{dimensions}. Lengths and axes are those of the joint"
        " graph; thicknesses, rails and base plate are drawn only. A hollow dot is a point that another link hides."
    )


def model_camera(context: Context) -> Camera:
    """The view of a model: of a planar mechanism from above at a slant, of one that hangs from its base from below."""
    usual = orthographic(-62, 52) if context.planar else orthographic(35, BELOW if _hangs(context.skeleton) else 22)
    return context.companion.camera("solid", usual)


def _hangs(skeleton: Skeleton) -> bool:
    """Whether all joints of the base are above the middle of all others."""
    base = [mark.at[2] for mark in skeleton.marks if mark.grounded]
    others = [mark.at[2] for mark in skeleton.marks if not mark.grounded]
    return bool(base and others) and min(base) > float(np.mean(others)) + 1e-9 * skeleton.size


def _draw(context: Context) -> Drawing:
    camera = model_camera(context)
    body = _within_strokes(context)
    mesh = model(body)
    view, page = fitted(camera, mesh.corners.reshape(-1, 3), min(120, context.page), 120, margin=7)
    drawn = paste(page, mesh, view)
    letters = Letters(page)
    for line in np.concatenate([drawn.lines.outlines, drawn.lines.creases]):
        if np.linalg.norm(line[1] - line[0]) > LONG:
            letters.avoid(line)
    name_points(page, view, body, letters, drawn)
    letters.avoid_box(triad(page, mesh, view, np.array([(0.0, 0.0), page.figure.get_size_inches() * 72.0])))
    letters.place()
    return Drawing(page.figure, _data(context, body))


def _within_strokes(context: Context) -> Skeleton:
    """The configuration that is drawn; home where its drives do not go so far, as a leg would come apart."""
    record, drawn = context.record, context.skeleton
    for item in record.inputs:
        value = float(item.printed(drawn.values[item.coordinate.index]))
        if item.stroke and not item.stroke[0] <= value <= item.stroke[1]:
            return home_skeleton(record, context.companion)
    return drawn


@dataclass(frozen=True, eq=False)
class Pasted:
    """What was drawn: its lines in points of the page, and what is nearest where."""

    lines: LineWork
    view: View
    buffers: Buffers

    def hides(self, at: FloatArray, room: float) -> bool:
        """Whether something is nearer than a point (3,) by more than `room`."""
        column, row = np.round(SAMPLES * DOTS_PER_INCH / 72.0 * self.view(at) - 0.5).astype(int)
        height, width = self.buffers.depth.shape
        if not (0 <= row < height and 0 <= column < width):
            return False
        return bool(self.buffers.depth[row, column] > float(self.view.camera.depth(at)) + room)


def name_points(page: Canvas, view: View, skeleton: Skeleton, letters: Letters, drawn: Pasted) -> None:
    """The letters of joints and points, with halos, over everything; those that lie in one place on paper together.

    A point has a dot, a hollow one where another link hides it.
    """
    groups: list[tuple[FloatArray, list[str]]] = []
    for name, at in lettered(skeleton).items():
        if _inside_leg(skeleton, at):
            continue
        place = view(at)
        here = next((names for other, names in groups if np.linalg.norm(place - other) < TOGETHER), None)
        if here is None:
            groups.append((place, [name]))
        else:
            here.append(name)
    halo = [withStroke(linewidth=HALO, foreground=PAPER)]
    placed = lettered(skeleton)
    for place, names in groups:
        hidden = drawn.hides(placed[names[0]], HIDDEN * unit(skeleton))
        fill, edge = (PAPER, INK) if hidden else (INK, PAPER)
        page.disc(place, 1.1, fill, edge, 0.4, order=13)
        letters.avoid_disc(place, 4.0)
        letters.add(place, ", ".join(letter(name) for name in names), clear=4.5, path_effects=halo)


def _inside_leg(skeleton: Skeleton, at: FloatArray) -> bool:
    """Whether a point lies between the ends of a leg that grows longer."""
    for mark in skeleton.marks:
        if mark.telescopes:
            way = mark.at - mark.rail
            share = float((at - mark.rail) @ way) / max(float(way @ way), 1e-300)
            off = np.linalg.norm(at - mark.rail - share * way)
            if 1e-6 < share < 1 - 1e-6 and off < 1e-6 * skeleton.size:
                return True
    return False


def paste(
    page: Canvas, mesh: Mesh, view: View, box: tuple[float, float, float, float] | None = None, weight: float = 1.0
) -> Pasted:
    """A mesh in light on a page, or on a part (left, bottom, width, height) of it in points, and its lines.

    `weight` multiplies the widths of the lines.
    """
    left, bottom, width, height = box or (0.0, 0.0, page.axes.get_xlim()[1], page.axes.get_ylim()[1])
    corner = np.array([left, bottom])
    local = View(view.camera, view.scale, view.offset - corner)
    found = filled(mesh, local, (width, height), DOTS_PER_INCH)
    drawn = line_work(mesh, local, found, DOTS_PER_INCH)
    page.axes.imshow(
        lit(mesh, local, found, DOTS_PER_INCH, edges=False),
        extent=(left, left + width, bottom, bottom + height),
        interpolation="antialiased",
        zorder=2,
        aspect="auto",
    )
    shifted = LineWork(drawn.outlines + corner, drawn.creases + corner)
    for lines, thick in ((shifted.creases, CREASE), (shifted.outlines, OUTLINE)):
        strokes(page, lines, weight * thick)
    return Pasted(shifted, local, found)


def strokes(page: Canvas, lines: FloatArray, width: float, order: float = 2.1, colour: str = INK) -> None:
    """Segments (k, 2, 2) as one path."""
    if not len(lines):
        return
    codes = np.tile([Path.MOVETO, Path.LINETO], len(lines))
    path = Path(lines.reshape(-1, 2), codes)
    path.should_simplify = False  # it would leave out short segments
    page.axes.add_patch(
        PathPatch(
            path, fill=False, edgecolor=colour, linewidth=width, zorder=order, capstyle="round", joinstyle="round"
        )
    )


def triad(page: Canvas, mesh: Mesh, view: View, room: FloatArray) -> FloatArray:
    """The directions X, Y, Z of the base, and the box (2, 2) that they fill, in points.

    They stand in the corner of a box (2, 2) that least of the model covers, if that may be in the lower left one.
    """
    ways = TRIAD * view.camera.project(np.eye(3))
    box = np.array([ways.min(axis=0, initial=0.0) - AROUND, ways.max(axis=0, initial=0.0) + AROUND])
    corners = [
        np.array(
            [
                room[0, 0] - box[0, 0] if left else room[1, 0] - box[1, 0],
                room[0, 1] - box[0, 1] if low else room[1, 1] - box[1, 1],
            ]
        )
        for low in (True, False)
        for left in (True, False)
    ]
    grid = box[0] + np.stack(np.meshgrid(*2 * [np.linspace(0, 1, 8)]), axis=-1).reshape(-1, 2) * (box[1] - box[0])
    triangles = view(mesh.corners.reshape(-1, 3)).reshape(-1, 3, 2)
    at = min(corners, key=lambda corner: _covered(triangles, corner + grid))
    for name, way in zip("XYZ", ways, strict=True):
        if np.linalg.norm(way) > 3.0:
            page.arrow(at, at + way, BLUE, 0.8, 11, head=5)
            page.text(at + way * (1 + 5.5 / np.linalg.norm(way)), f"${name}$", fontsize=SMALL, color=BLUE)
    return np.asarray(at + box)


def _covered(triangles: FloatArray, points: FloatArray) -> int:
    """How many of some points (n, 2) lie in triangles (f, 3, 2)."""
    sides = np.roll(triangles, -1, axis=1) - triangles
    ways = points[:, None, None] - triangles
    turns = sides[..., 0] * ways[..., 1] - sides[..., 1] * ways[..., 0]  # (n, f, 3)
    inside = np.all(turns > 0, axis=2) | np.all(turns < 0, axis=2)
    return int(np.sum(np.any(inside, axis=1)))


def _data(context: Context, skeleton: Skeleton) -> dict[str, Any]:
    return {
        "unit": context.record.unit,
        "parameters": vars(context.record.values),
        "points": skeleton.points,
        "frames": {link: {"rotation": frame[0], "origin": frame[1]} for link, frame in skeleton.frames.items()},
    }


SOLID = FigureKind("solid", "3-D model", always, _caption, _draw)
