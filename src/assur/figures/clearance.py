"""The closest pair: two links where they are nearest to one another, the gap as a line with its length."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from assur.figures.canvas import POINTS, Canvas, View, canvas, inside
from assur.figures.configuration import MUTED
from assur.figures.context import Context
from assur.figures.lines import before
from assur.figures.placing import Letters
from assur.figures.raster import filled
from assur.figures.solid import HALO, model_camera, paste, triad
from assur.figures.spec import Drawing
from assur.figures.style import BLUE, INK, LETTER, ORANGE, PAGE, PAPER, RED, TEXT
from assur.model.mechanism import MechanismRecord
from assur.scene.camera import Camera, orthographic
from assur.scene.collisions import Nearest, ends
from assur.scene.mesh import Mesh
from assur.scene.part import Part
from assur.scene.parts import machine, placed
from assur.scene.sizes import thickness
from assur.scene.skeleton import Skeleton, skeleton

FloatArray = NDArray[np.float64]
PAIR = (BLUE, ORANGE)
HEIGHT, HEAD = 92.0, 9.0
"""Of the page and of its heading, in mm."""

GAPS, THICK = 5.0, 16.0
"""Width of the close view: so many gaps, and at least so many thicknesses."""

TRUE = 0.9
"""Least share of its length that the gap keeps on paper in the close view."""

COARSE = 40.0
"""Pixels per inch of the pictures that tell from where the gap is seen."""

RING = 7.0
"""Radius in points of the ring about a gap in the whole view, and about a place where links meet."""


def drawn(record: MechanismRecord, nearest: Nearest) -> Drawing:
    """A pair of links at the configuration where it is nearest: the whole mechanism, and the pair from close by.

    >>> from assur.scene.collisions import collisions
    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> nearest = collisions(record, home_values(record)[None]).pairs[0]
    >>> drawn(record, nearest).data["links"]
    ['base', 'rod2']
    """
    context = Context(record)
    body, gap = skeleton(record, context.companion, nearest.joints), ends(record, nearest)
    solids = _coloured(context, nearest)
    camera = model_camera(context)
    page = canvas(PAGE, HEIGHT)
    half, tall = PAGE / 2, HEIGHT - HEAD
    whole = placed(solids, body)
    _heading(page, record, nearest)
    view = inside(camera, whole.corners.reshape(-1, 3), (3, 3, half - 6, tall - 6))
    _whole(page, whole, view, gap, (half, tall))
    pair = tuple(part for part in solids if part.link in nearest.links)
    _close(page, record, nearest, _near(pair, body, gap, _width(record, nearest)), camera, gap, (half, 0.0, half, tall))
    triad(page, whole, view, np.array([[0.0, 0.0], [half, tall]]) * POINTS)
    data = {
        "unit": record.unit,
        "links": list(nearest.links),
        "parts": list(nearest.parts),
        "clearance": nearest.clearance,
        "thickness": thickness(record),
        "ends": gap,
        "points": body.points,
    }
    return Drawing(page.figure, data)


def _coloured(context: Context, pair: Nearest) -> tuple[Part, ...]:
    """Every part, those of the two links in their colours and all others pale."""
    own = dict(zip(pair.links, PAIR, strict=True))
    return tuple(replace(part, colour=own.get(part.link, MUTED)) for part in machine(context.record))


def _heading(page: Canvas, record: MechanismRecord, pair: Nearest) -> None:
    """The two links in their colours, and how near they come."""
    said = "meet" if not pair.clearance else f"come as near as {pair.clearance:.4g} {record.unit}"
    words = ((pair.links[0], PAIR[0]), (r"$\;$and$\;$", INK), (pair.links[1], PAIR[1]), (rf"$\;${said}", INK))
    left, level = 4 * POINTS, (HEIGHT - 5.5) * POINTS
    renderer = FigureCanvasAgg(page.figure).get_renderer()  # type: ignore[no-untyped-call]  # matplotlib does not say
    for text, colour in words:
        bold = "bold" if colour != INK else "normal"
        drawn = page.text((left, level), text, ha="left", fontsize=LETTER, color=colour, weight=bold)
        left = float(drawn.get_window_extent(renderer).x1)


def _whole(page: Canvas, mesh: Mesh, view: View, gap: FloatArray, size: tuple[float, float]) -> None:
    """The whole mechanism, with a ring about the gap."""
    paste(page, mesh, view, (0.0, 0.0, size[0] * POINTS, size[1] * POINTS), 0.7)
    _ring(page, view(gap.mean(axis=0)), max(RING, 0.6 * float(np.linalg.norm(view(gap[1]) - view(gap[0])))))


def _ring(page: Canvas, at: FloatArray, radius: float) -> None:
    page.disc(at, radius, "none", PAPER, 3.0, 13)
    page.disc(at, radius, "none", RED, 1.2, 13.1)


def _width(record: MechanismRecord, pair: Nearest) -> float:
    return max(GAPS * pair.clearance, THICK * thickness(record))


def _near(pair: tuple[Part, ...], body: Skeleton, gap: FloatArray, width: float) -> Mesh:
    """Those parts of the two links that reach into a ball of the width about the gap; always the nearest ones."""
    kept = []
    for part in pair:
        points = placed((part,), body).corners.reshape(-1, 3)
        low, high = points.min(axis=0), points.max(axis=0)
        middle = gap.mean(axis=0)
        if np.linalg.norm(np.clip(middle, low, high) - middle) < width:
            kept.append(part)
    return placed(tuple(kept), body)


def _close(
    page: Canvas,
    record: MechanismRecord,
    pair: Nearest,
    mesh: Mesh,
    usual: Camera,
    gap: FloatArray,
    box: tuple[float, float, float, float],
) -> None:
    """The pair from close by, in a box (left, bottom, width, height) in mm, the gap in almost true length."""
    left, bottom, width, height = (POINTS * side for side in box)
    scale = min(width, height) / _width(record, pair)
    offset = np.array([left + width / 2, bottom + height / 2])
    camera = _camera(mesh, usual, gap, scale, (width, height))
    view = View(camera, scale, offset - scale * camera.project(gap.mean(axis=0)))
    paste(page, mesh, view, (left, bottom, width, height))
    page.line(np.array([[left, bottom + 6], [left, bottom + height - 6]]), 0.4, INK, 14)
    flat, letters = view(gap), Letters(page)
    if pair.clearance:
        page.line(flat, 3.4, PAPER, 12, solid_capstyle="butt")
        page.line(flat, 1.6, RED, 12.1, solid_capstyle="butt")
        for at in flat:
            page.disc(at, 2.0, RED, PAPER, 0.5, 13)
        halo = [withStroke(linewidth=HALO, foreground=PAPER)]
        letters.add_along(flat, f"{pair.clearance:.4g} {record.unit}", 5.0, color=RED, path_effects=halo)
    else:
        _ring(page, flat.mean(axis=0), RING)
    letters.place()
    names = " and ".join(dict.fromkeys(pair.parts))
    page.text(
        (left + width / 2, bottom + 7),
        names,
        fontsize=TEXT,
        path_effects=[withStroke(linewidth=HALO, foreground=PAPER)],
    )


def _camera(mesh: Mesh, usual: Camera, gap: FloatArray, scale: float, size: tuple[float, float]) -> Camera:
    """The camera nearest to the usual one from which the gap is not hidden and almost in true length."""
    way = gap[1] - gap[0]
    length = float(np.linalg.norm(way))
    if not length:
        return usual
    found = [
        usual,
        *(orthographic(azimuth, elevation) for azimuth, elevation in product(range(0, 360, 30), range(-60, 90, 30))),
    ]
    fair = [item for item in found if np.linalg.norm(item.project(way)) >= TRUE * length]
    fair.sort(key=lambda pair: -float(pair.toward @ usual.toward))
    middle = np.array(size) / 2
    for item in fair:
        view = View(item, scale, middle - scale * item.project(gap.mean(axis=0)))
        seen = before(gap[None], view, filled(mesh, view, size, COARSE), COARSE)
        if np.sum(np.linalg.norm(seen[:, 1] - seen[:, 0], axis=1)) > TRUE * scale * length:
            return item
    return fair[0] if fair else usual
