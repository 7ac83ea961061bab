"""Contours of a map: lines at round levels that run straight into the border, each with its number on it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize
from matplotlib.path import Path
from matplotlib.patheffects import withStroke
from matplotlib.ticker import LogLocator, MaxNLocator
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from assur.figures.style import INK, PAPER, SMALL
from assur.results.typeset_text import minus

FloatArray = NDArray[np.float64]
RINGS = 3
"""Nodes beyond the border to which values are continued straight; those farther away are not seen."""

MANY = 500.0
"""Ends of a logarithmic scale that differ by more leave only the powers of ten; else there are 1, 2 and 5 of each."""

CLEAR, APART = 9.0, 20.0
"""Of a number at least: its distance from the border and from another number, in points."""

WAYS = tuple((down, right) for down, right in product((-1, 0, 1), repeat=2) if down or right)


def round_levels(colours: Normalize, most: int = 8) -> list[float]:
    """Round levels between the ends of a scale of colours, by decades where it is logarithmic.

    >>> round_levels(Normalize(0.0, 1.0), 5), round_levels(LogNorm(1.5, 60.0))
    ([0.2, 0.4, 0.6, 0.8], [2.0, 5.0, 10.0, 20.0, 50.0])
    """
    low, high = float(colours.vmin or 0.0), float(colours.vmax or 1.0)
    if isinstance(colours, LogNorm) and high > 4 * low:
        ticks = LogLocator(subs=(1.0, 2.0, 5.0) if high < MANY * low else (1.0,)).tick_values(low, high)
    else:
        ticks = MaxNLocator(most, steps=[1, 2, 5, 10]).tick_values(low, high)
    return [float(f"{tick:.12g}") for tick in ticks if low < tick < high]


def continued(values: FloatArray) -> FloatArray:
    """Values (b, a) with numbers where there were none, so that colours and lines reach the border.

    Next to what is known they go on straight, as a line through two nodes does, within its least and its largest;
    elsewhere they are those of the nearest node.
    """
    found = np.array(values, dtype=float)
    known = np.isfinite(found)
    if np.all(known) or not np.any(known):
        return found
    ends = float(np.min(found[known])), float(np.max(found[known]))
    for _ in range(RINGS):
        padded = np.pad(found, 2, constant_values=np.nan)
        guesses = np.stack([2 * _moved(padded, way, 1) - _moved(padded, way, 2) for way in WAYS])
        count = np.sum(np.isfinite(guesses), axis=0)
        mean = np.nansum(guesses, axis=0) / np.maximum(count, 1)
        found = np.where(~np.isfinite(found) & (count > 0), np.clip(mean, *ends), found)
    nearest = distance_transform_edt(~np.isfinite(found), return_distances=False, return_indices=True)
    return np.asarray(found[tuple(nearest)])


def _moved(padded: FloatArray, way: tuple[int, int], steps: int) -> FloatArray:
    """The values (b, a) that lie some steps off in a direction, of values padded by two."""
    rows, columns = padded.shape
    down, right = 2 + steps * way[0], 2 + steps * way[1]
    return padded[down : down + rows - 4, right : right + columns - 4]


def draw_contours(
    axes: Axes,
    nodes: tuple[FloatArray, FloatArray],
    values: FloatArray,
    levels: Sequence[float],
    border: Path,
    marked: Mapping[float, str],
) -> None:
    """Lines of values (b, a) over nodes (a,), (b,) inside a border: thin white ones, thick ones in marked colours.

    Each level has its number once, where it is farthest from the border and from other numbers, if there is room.
    """
    edge = filled(axes.transData.transform(np.concatenate([np.asarray(part) for part in border.to_polygons()])))
    placed: list[FloatArray] = []
    inside = [level for level in sorted({*levels, *marked}) if np.min(values) < level < np.max(values)]
    for level in inside:
        thick, colour = (1.4, marked[level]) if level in marked else (0.5, "white")
        lines = axes.contour(*nodes, values, levels=[level], colors=colour, linewidths=thick)
        lines.set_clip_path(border, axes.transData)
        spot = _spot(axes, lines.allsegs[0], border, edge, placed)
        if spot is not None:
            at, angle = spot
            placed.append(axes.transData.transform(at))
            halo: Any = [withStroke(linewidth=1.6, foreground=PAPER)]
            text = axes.text(at[0], at[1], minus(f"{level:g}"), fontsize=SMALL, color=INK, ha="center", va="center")
            text.set(rotation=angle, zorder=6, path_effects=halo)


def filled(edge: FloatArray) -> FloatArray:
    """Points (k, 2) of a closed line with seven more between each two, so that none are far apart."""
    following = np.roll(edge, -1, axis=0)
    shares = np.linspace(0.0, 1.0, 8, endpoint=False)[:, None, None]
    return np.asarray((edge + shares * (following - edge)).reshape(-1, 2))


def _spot(
    axes: Axes, lines: Sequence[FloatArray], border: Path, edge: FloatArray, placed: Sequence[FloatArray]
) -> tuple[FloatArray, float] | None:
    """Where (2,) on some lines a number has most room, and at which angle in degrees; None where there is none."""
    best: tuple[float, FloatArray, float] | None = None
    for line in (np.asarray(line) for line in lines if len(line) > 2):
        flat = axes.transData.transform(line)
        room = np.min(np.linalg.norm(flat[:, None] - edge, axis=2), axis=1) / CLEAR
        for other in placed:
            room = np.minimum(room, np.linalg.norm(flat - other, axis=1) / APART)
        room[~border.contains_points(line)] = 0.0
        k = int(np.argmax(room[1:-1])) + 1
        if room[k] >= 1.0 and (best is None or room[k] > best[0]):
            way = flat[k + 1] - flat[k - 1]
            best = float(room[k]), line[k], (float(np.degrees(np.arctan2(way[1], way[0]))) + 90) % 180 - 90
    return None if best is None else best[1:]
