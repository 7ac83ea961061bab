"""Dexterity: maps of the local condition index and of the velocity factors in planes through the workspace."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colorbar import Colorbar
from matplotlib.patches import PathPatch
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from assur.figures.context import Context
from assur.figures.coordinates import drawn_span, dress, plane_words, symbol, value_words
from assur.figures.plots import mode_words, no_workspace, outline
from assur.figures.spec import Drawing, Entry
from assur.figures.style import GREY, INK, PAGE, TEXT, new_figure
from assur.kinematics.rates.units import factor_unit, is_mixed
from assur.performance.indices import INDICES

FloatArray = NDArray[np.float64]
NODES = 160
SHOWN = 0.75
"""Colours end at this quantile of a factor that grows without bound towards a singularity."""


@dataclass(frozen=True)
class Measure:
    """What is mapped: its key in the data, its name among the indices, and where its colours end."""

    key: str
    name: str
    quantile: float

    @property
    def symbol(self) -> str:
        """In LaTeX."""
        return INDICES[self.name].symbol


INDEX = Measure("index", "condition", 1.0)
FASTEST = Measure("largest", "largest", SHOWN)
SLOWEST = Measure("smallest", "smallest", 1.0)


def _missing(context: Context) -> str:
    if no_workspace(context):
        return no_workspace(context)
    if not is_mixed(context.record):
        return ""
    return "lengths and angles mix: the figure manipulability maps it, lengths over a stated characteristic length"


def _caption(context: Context) -> str:
    return (
        f"Local condition index ${INDEX.symbol}$ of $J = J_p^{{-1}}J_q$ ({mode_words(context)}):"
        f" 0 is singular, 1 isotropic.{_mean(context)}"
    )


def _mean(context: Context) -> str:
    """Of a followed workspace none is told: each pose would have to be searched for."""
    found = context.mean_index if context.record.closed_form else None
    if found is None or found.value is None or found.error is None:
        return ""
    return f" Its mean over the workspace is {found.value:.4f} ± {found.error:.4f}."


def planes(context: Context) -> list[tuple[str, str, str, float]]:
    """The planes that are mapped: two coordinates, and a third held at a value ("" and 0 in a plane workspace)."""
    box = context.workspace.box
    if len(box.names) == 2:
        return [(box.names[0], box.names[1], "", 0.0)]
    middle = {name: (low + high) / 2 for name, (low, high) in zip(box.names, box.intervals, strict=True)}
    first, second, third = box.names
    sections = [item.value for item in context.workspace.sections if item.area > 0]
    level = sections[len(sections) // 2] if sections else middle[third]
    return [(first, third, second, middle[second]), (first, second, third, level)]


def _factor_caption(measure: Measure, which: str, end: str) -> Callable[[Context], str]:
    def caption(context: Context) -> str:
        unit = factor_unit(context.record, None)
        of_unit = f" in {unit}" if unit else ""
        return (
            f"{which} velocity factor ${measure.symbol}${of_unit}, the {which.lower()} singular"
            f" value of $J = J_p^{{-1}}J_q$ ({mode_words(context)}): by how much the inputs' speed is multiplied in"
            f" that direction.{end}"
        )

    return caption


def _draw(context: Context, measure: Measure) -> Drawing:
    found = planes(context)
    spans = [tuple(drawn_span(context, name) for name in plane[:2]) for plane in found]
    left, gap, bottom, right = 14.0, 18.0, 17.0, 22.0
    room = PAGE - left - right - gap * (len(found) - 1)
    scale = min(90.0 / max(tall for _, tall in spans), room / sum(wide for wide, _ in spans))
    width = left + right + gap * (len(found) - 1) + scale * sum(wide for wide, _ in spans)
    height = bottom + 5.0 + scale * max(tall for _, tall in spans)
    figure = new_figure(width, height)
    maps = [_values(context, plane, measure) for plane in found]
    known = [values[np.isfinite(values)] for _, _, values in maps]
    top = max((float(np.quantile(values, measure.quantile)) for values in known if len(values)), default=0.0) or 1.0
    start, data = left, []
    for k, (plane, (wide, tall), (xs, ys, values)) in enumerate(zip(found, spans, maps, strict=True)):
        axes = figure.add_axes((start / width, bottom / height, scale * wide / width, scale * tall / height))
        image = _map(context, axes, plane, xs, ys, values, top)
        place = f", {symbol(plane[2])} = {value_words(context, plane[2], plane[3])}" if plane[2] else ""
        label = f"({chr(97 + k)}) {plane_words(*plane[:2])}{place}"
        figure.text((start + scale * wide / 2) / width, 1.5 / height, label, ha="center", fontsize=TEXT)
        start += scale * wide + gap
        data.append(
            {
                "plane": plane[:2],
                "held": {plane[2]: plane[3]} if plane[2] else {},
                plane[0]: xs,
                plane[1]: ys,
                measure.key: values,
            }
        )
    bar = figure.add_axes(
        ((width - right + 5.0) / width, bottom / height, 3.5 / width, (height - bottom - 5.0) / height)
    )
    colorbar: Colorbar = figure.colorbar(image, cax=bar, extend=beyond(top, *known))
    unit = "" if measure is INDEX else factor_unit(context.record, None)
    colorbar.set_label(f"${measure.symbol}$" + (f" ({unit})" if unit else ""), fontsize=TEXT)
    colorbar.set_ticks([0.0, *_levels(top)])
    for level in _levels(top):
        colorbar.ax.axhline(level, color="white", linewidth=0.6)
    return Drawing(figure, {"unit": context.record.unit, "mode": context.workspace.mode, "maps": data})


def beyond(top: float, *values: FloatArray) -> Literal["max", "neither"]:
    """The end of a bar of colours: an arrow where there are values beyond it.

    >>> beyond(2.0, np.array([1.0, np.nan]), np.array([3.0])), beyond(3.0, np.array([1.0, 3.0]))
    ('max', 'neither')
    """
    return "max" if any(np.any(item > top * (1 + 1e-9)) for item in values) else "neither"


def _values(
    context: Context, plane: tuple[str, str, str, float], measure: Measure
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Nodes along both coordinates and the measure (len(ys), len(xs)) at them; NaN outside the workspace."""
    box = context.workspace.box
    xs, ys = (np.linspace(box.low[box.axis(name)], box.high[box.axis(name)], NODES) for name in plane[:2])
    grid = np.zeros((NODES, NODES, len(box.names)))
    grid[..., box.axis(plane[0])] = xs
    grid[..., box.axis(plane[1])] = ys[:, None]
    if plane[2]:
        grid[..., box.axis(plane[2])] = plane[3]
    return xs, ys, context.indices_at(grid)[measure.name]


def _map(
    context: Context,
    axes: Axes,
    plane: tuple[str, str, str, float],
    xs: FloatArray,
    ys: FloatArray,
    values: FloatArray,
    top: float,
) -> Any:
    """Colours and level lines, cut off exactly at the border of the workspace."""
    found = context.workspace
    polygons = found.section(plane[3], plane[2]).polygons if plane[2] else found.projection(*plane[:2]).polygons
    shown = _continued(values)
    image = axes.imshow(
        shown,
        origin="lower",
        extent=(xs[0], xs[-1], ys[0], ys[-1]),
        cmap="cividis",
        vmin=0.0,
        vmax=top,
        interpolation="bilinear",
        aspect="auto",
    )
    path = outline(polygons)
    if path is not None and np.any(np.isfinite(shown)):
        lines = axes.contour(xs, ys, shown, levels=_levels(top), colors="white", linewidths=0.6)
        border = PathPatch(path, facecolor="none", edgecolor=INK, linewidth=0.8, zorder=5)
        axes.add_patch(border)
        image.set_clip_path(border)
        lines.set_clip_path(border)
    dress(context, axes, plane[:2])
    axes.tick_params(color=GREY)
    return image


def _levels(top: float) -> list[float]:
    """Round levels between 0 and the largest value, at most ten of them."""
    ticks = MaxNLocator(10, steps=[1, 2, 5, 10]).tick_values(0.0, top)
    return [float(level) for level in ticks if 0.0 < level < top]


def _continued(values: FloatArray) -> FloatArray:
    """Values with two rings of nodes past the border filled from their neighbours, for the eye only."""
    filled = values.copy()
    for _ in range(2):
        padded = np.pad(filled, 1, constant_values=np.nan)
        stack = np.stack(
            [
                padded[1 + i : padded.shape[0] - 1 + i, 1 + k : padded.shape[1] - 1 + k]
                for i in (-1, 0, 1)
                for k in (-1, 0, 1)
            ]
        )
        known = np.isfinite(stack)
        mean = np.where(known, stack, 0.0).sum(axis=0) / np.maximum(known.sum(axis=0), 1)
        filled = np.where(np.isfinite(filled) | ~known.any(axis=0), filled, mean)
    return filled


DEXTERITY = Entry("dexterity", "Local condition index", _missing, _caption, partial(_draw, measure=INDEX))
LARGEST = Entry(
    "fastest",
    "Largest velocity factor",
    _missing,
    _factor_caption(
        FASTEST,
        "Largest",
        f" It grows without bound towards a parallel singularity; colours end at its {100 * SHOWN:.0f} % quantile.",
    ),
    partial(_draw, measure=FASTEST),
)
SMALLEST = Entry(
    "slowest",
    "Smallest velocity factor",
    _missing,
    _factor_caption(SLOWEST, "Smallest", " It is 0 at a serial singularity."),
    partial(_draw, measure=SLOWEST),
)
