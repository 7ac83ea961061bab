"""How the platform gives way: the ellipsoid of its displacements under unit forces, and which links are strained."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from assur.figures.canvas import POINTS, Canvas, View, canvas, inside
from assur.figures.context import Context
from assur.figures.page import side_by_side
from assur.figures.placing import Letters
from assur.figures.sketch import Pen, cloud_of, draw_bodies, draw_ground
from assur.figures.spec import Drawing, FigureKind
from assur.figures.strain_colours import drawn_stiffness, not_held, strain_colours
from assur.figures.style import BLUE, GREY, SKY, SMALL, TEXT
from assur.figures.vibrations import usual_camera
from assur.machine.elasticity.energies import ranked
from assur.machine.elasticity.stiffness import Stiffness
from assur.scene.skeleton import Skeleton

FloatArray = NDArray[np.float64]
LONGEST = 0.22
"""Of the mechanism's size: the longest semi-axis."""
SEEN = 0.04
"""Share of the longest below which a semi-axis is a point on paper: it has no letter."""
MOST = 8
"""Bars of links; what is left is one more."""
BESIDE = 70.0
"""Width in mm that the mechanism needs beside the bars."""
BAR, HEAD, FOOT, SIDE = 4.2, 6.0, 10.0, 24.0
"""Of bars in mm: height of one, room above and below a list, room for names."""
MICRO = 1e6
"""N/m in a N/µm."""


def _caption(context: Context) -> str:
    solved = drawn_stiffness(context)
    stiff = solved.translational[0][0]
    told = ", ".join("rigid" if np.isinf(value) else f"{value / MICRO:.4g}" for value in stiff)
    return (
        "How the platform gives way while the actuators hold their inputs. (a) Displacements of its point under a force"
        f" of one size in every direction, not to scale; principal stiffness {told} N/µm. Darker links are strained"
        " more, in the colours of their bars. (b) Shares of the strain energy under forces of one size along x, y and"
        " z, summed, by links, and (c) by kinds of strain."
    )


def _draw(context: Context) -> Drawing:
    solved = drawn_stiffness(context)
    shares = solved.shares()
    lists = _lists(shares.links), _lists(shares.kinds)
    beside = side_by_side(context.page, 2, BESIDE) == 2
    wide = 0.56 * context.page if beside else context.page
    camera = usual_camera(context)
    ellipsoid = LONGEST * context.skeleton.size * _shape(solved)
    point = _point(context.skeleton)
    cloud = np.concatenate([cloud_of(context.skeleton, context.companion), point + ellipsoid.T, point - ellipsoid.T])
    span = np.ptp(camera.project(cloud), axis=0)
    tall = float(np.clip((wide - 12.0) * span[1] / max(span[0], 1e-300), 30.0, 95.0)) + 14.0
    heights = [HEAD + FOOT + BAR * len(bars) for bars in lists]
    height = max(tall, sum(heights)) if beside else tall + sum(heights)
    page = canvas(context.page, height)
    view = inside(camera, cloud, (6.0, height - tall + 10.0, wide - 12.0, tall - 14.0))
    letters = Letters(page)
    title = np.array([wide / 2, height - tall + 3.5]) * POINTS
    letters.avoid_disc(title, TEXT)
    colours = strain_colours(shares.bent, max(shares.bent.values(), default=1.0))
    pen = Pen(width=1.8, symbol=0.7, colours=dict.fromkeys(context.record.links, GREY) | colours)
    draw_ground(page, view, context.skeleton, context.companion, letters)
    draw_bodies(page, view, context.skeleton, letters, pen)
    _draw_ellipsoid(page, view, point, ellipsoid, solved.translational[0][0], letters)
    page.text(title, "(a)", fontsize=TEXT)
    top, left = (height if beside else height - tall), (wide if beside else 0.0)
    for letter, bars, own, words in zip("bc", lists, heights, ("by links", "by kinds"), strict=True):
        place = (left + SIDE, top - own + FOOT, context.page - left - SIDE - 12.0, own - HEAD - FOOT)
        _draw_bars(page.figure, place, (context.page, height), bars, f"({letter}) energy {words} (%)", colours)
        top -= own
    stiff, ways = (part[0] for part in solved.translational)
    data = {"stiffness": stiff, "directions": ways, "links": shares.links, "kinds": shares.kinds}
    return Drawing(page.figure, data)


def _shape(solved: Stiffness) -> FloatArray:
    """Semi-axes as columns (3, 3), the longest one."""
    stiff, ways = (part[0] for part in solved.translational)
    return np.asarray(ways.T * (stiff[0] / stiff))


def _point(skeleton: Skeleton) -> FloatArray:
    rotation, origin = skeleton.frames[skeleton.record.platform.link]
    return np.asarray(rotation @ skeleton.record.platform.point + origin)


def _lists(shares: Mapping[str, float]) -> list[tuple[str, float]]:
    """The largest first, then what the others have together."""
    own = ranked(shares)
    if len(own) <= MOST + 1:
        return own
    return [*own[:MOST], (f"{len(own) - MOST} others", sum(share for _, share in own[MOST:]))]


def _draw_ellipsoid(
    page: Canvas, view: View, point: FloatArray, axes: FloatArray, stiff: FloatArray, letters: Letters
) -> None:
    """The outline of {A s: |s| = 1} on paper, and its semi-axes with what is stiff along them."""
    middle = view(point)
    flat = (view(point + axes.T) - middle).T
    left, sizes, _ = np.linalg.svd(flat)
    angle = np.linspace(0.0, 2.0 * np.pi, 97)
    rim = middle + np.stack([np.cos(angle), np.sin(angle)], axis=-1) @ (left * sizes).T
    page.polygon(rim, SKY, BLUE, 0.9, 13.0, alpha=0.5)
    for way, size, along in zip(flat.T, np.linalg.norm(axes, axis=0), stiff, strict=True):
        ends = np.array([middle - way, middle + way])
        page.line(ends, 0.8, BLUE, 14.0)
        letters.avoid(ends)
        if size > SEEN * np.max(np.linalg.norm(axes, axis=0)) and np.linalg.norm(way) > 0.0:
            text = f"{along / MICRO:.3g} N/µm"
            letters.add(ends, text, clear=3.0, fontsize=SMALL, color=BLUE)
    letters.avoid(rim)
    letters.place()


def _draw_bars(
    figure: Figure,
    place: tuple[float, float, float, float],
    page: tuple[float, float],
    bars: list[tuple[str, float]],
    words: str,
    colours: Mapping[str, str],
) -> None:
    """Lying bars in a place (left, bottom, width, height) in mm of a page (width, height), in colours by name."""
    axes = figure.add_axes((place[0] / page[0], place[1] / page[1], place[2] / page[0], place[3] / page[1]))
    shares = [100.0 * share for _, share in bars]
    axes.barh(range(len(bars)), shares, color=[colours.get(name, BLUE) for name, _ in bars], height=0.65)
    axes.set_yticks(range(len(bars)), [name for name, _ in bars], fontsize=SMALL)
    axes.invert_yaxis()
    axes.set_xlabel(words, fontsize=TEXT, labelpad=1.5)
    axes.set_xlim(0.0, max(shares, default=1.0))
    for row, share in enumerate(shares):
        axes.text(share, row, f" {share:.1f}", va="center", fontsize=SMALL)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(left=False, labelsize=SMALL)


ELLIPSOID = FigureKind("stiffness", "Stiffness", not_held, _caption, _draw)
