"""An ellipsoid at the platform's point on the mechanism, beside lists of bars."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from assur.figures.canvas import POINTS, Canvas, View, canvas, inside
from assur.figures.context import Context
from assur.figures.letters import dimension
from assur.figures.page import side_by_side
from assur.figures.placing import Letters
from assur.figures.sketch import Pen, cloud_of, draw_bodies, draw_ground
from assur.figures.style import BLUE, GREY, SKY, SMALL, TEXT
from assur.figures.vibrations import usual_camera
from assur.machine.elasticity.energies import ranked
from assur.scene.skeleton import Skeleton

FloatArray = NDArray[np.float64]
LONGEST = 0.22
"""Of the mechanism's size: the longest semi-axis."""
SEEN = 0.04
"""Share of the longest below which a semi-axis is a point on paper: it has no letter."""
MOST = 8
"""Bars of a list; what is left is one more."""
BESIDE = 70.0
"""Width in mm that the mechanism needs beside the bars."""
BAR, HEAD, FOOT, SIDE = 4.2, 6.0, 10.0, 24.0
"""Of bars in mm: height of one, room above and below a list, room for names."""


@dataclass(frozen=True)
class Bars:
    """A list of bars, in any order: names, lengths, and what they are in words; `shares` add up to a whole."""

    lengths: Mapping[str, float]
    words: str
    shares: bool = False

    @property
    def longest(self) -> list[tuple[str, float]]:
        """The longest first; of shares then what the others have together."""
        own = ranked(self.lengths)
        if not self.shares:
            return own[: MOST + 1]
        if len(own) <= MOST + 1:
            return own
        return [*own[:MOST], (f"{len(own) - MOST} others", sum(length for _, length in own[MOST:]))]


def machine_beside_bars(
    context: Context, axes: FloatArray, told: Sequence[str], colours: Mapping[str, str], lists: Sequence[Bars]
) -> Figure:
    """A page with both.

    Args:
        context: of the mechanism that is drawn.
        axes: semi-axes of the ellipsoid as columns (3, 3), the longest of length 1.
        told: what is written at each.
        colours: of links, and of bars of their names; grey and blue without.
        lists: of bars, from above.
    """
    beside = side_by_side(context.page, 2, BESIDE) == 2
    wide = 0.56 * context.page if beside else context.page
    camera = usual_camera(context)
    ellipsoid = LONGEST * context.skeleton.size * axes
    point = _point(context.skeleton)
    cloud = np.concatenate([cloud_of(context.skeleton, context.companion), point + ellipsoid.T, point - ellipsoid.T])
    span = np.ptp(camera.project(cloud), axis=0)
    tall = float(np.clip((wide - 12.0) * span[1] / max(span[0], 1e-300), 30.0, 95.0)) + 14.0
    heights = [HEAD + FOOT + BAR * len(bars.longest) for bars in lists]
    height = max(tall, sum(heights)) if beside else tall + sum(heights)
    page = canvas(context.page, height)
    view = inside(camera, cloud, (6.0, height - tall + 10.0, wide - 12.0, tall - 14.0))
    letters = Letters(page)
    title = np.array([wide / 2, height - tall + 3.5]) * POINTS
    letters.avoid_disc(title, TEXT)
    draw_ground(page, view, context.skeleton, context.companion, letters)
    of_links = dict.fromkeys(context.record.links, GREY) | dict(colours)
    draw_bodies(page, view, context.skeleton, letters, Pen(width=1.8, symbol=0.7, colours=of_links))
    _draw_ellipsoid(page, view, point, ellipsoid, told, letters)
    page.text(title, "(a)", fontsize=TEXT)
    top, left = (height if beside else height - tall), (wide if beside else 0.0)
    for letter, bars, own in zip("bcd", lists, heights, strict=False):
        place = (left + SIDE, top - own + FOOT, context.page - left - SIDE - 12.0, own - HEAD - FOOT)
        _draw_bars(page.figure, place, (context.page, height), bars, f"({letter}) {bars.words}", colours)
        top -= own
    return page.figure


def _point(skeleton: Skeleton) -> FloatArray:
    rotation, origin = skeleton.frames[skeleton.record.platform.link]
    return np.asarray(rotation @ skeleton.record.platform.point + origin)


def _draw_ellipsoid(
    page: Canvas, view: View, point: FloatArray, axes: FloatArray, told: Sequence[str], letters: Letters
) -> None:
    """The outline of {A s: |s| = 1} on paper, and its semi-axes with what is told of them."""
    middle = view(point)
    flat = (view(point + axes.T) - middle).T
    left, sizes, _ = np.linalg.svd(flat)
    angle = np.linspace(0.0, 2.0 * np.pi, 97)
    rim = middle + np.stack([np.cos(angle), np.sin(angle)], axis=-1) @ (left * sizes).T
    page.polygon(rim, SKY, BLUE, 0.9, 13.0, alpha=0.5)
    for way, size, text in zip(flat.T, np.linalg.norm(axes, axis=0), told, strict=True):
        ends = np.array([middle - way, middle + way])
        page.line(ends, 0.8, BLUE, 14.0)
        letters.avoid(ends)
        if size > SEEN * np.max(np.linalg.norm(axes, axis=0)) and np.linalg.norm(way) > 0.0:
            letters.add(ends, text, clear=3.0, fontsize=SMALL, color=BLUE)
    letters.avoid(rim)
    letters.place()


def _draw_bars(
    figure: Figure,
    place: tuple[float, float, float, float],
    page: tuple[float, float],
    bars: Bars,
    words: str,
    colours: Mapping[str, str],
) -> None:
    """Lying bars in a place (left, bottom, width, height) in mm of a page (width, height), in colours by name."""
    axes = figure.add_axes((place[0] / page[0], place[1] / page[1], place[2] / page[0], place[3] / page[1]))
    names, lengths = [name for name, _ in bars.longest], [length for _, length in bars.longest]
    axes.barh(range(len(names)), lengths, color=[colours.get(name, BLUE) for name in names], height=0.65)
    axes.set_yticks(range(len(names)), [dimension(name) for name in names], fontsize=SMALL)
    axes.invert_yaxis()
    axes.set_xlabel(words, fontsize=TEXT, labelpad=1.5)
    axes.set_xlim(0.0, max(lengths, default=0.0) or 1.0)
    for row, length in enumerate(lengths):
        text = f"{length:.1f}" if bars.shares else f"{length:.3g}"
        axes.text(length, row, f" {text}", va="center", fontsize=SMALL)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(left=False, labelsize=SMALL)
