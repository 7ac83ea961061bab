"""Dexterity: maps of the local condition index and of the velocity factors in planes through the workspace."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm

from assur.figures.context import Context
from assur.figures.contours import round_levels
from assur.figures.plane_map import COLOURS, SHOWN, beyond, coloured, planes, row, scale_of
from assur.figures.plots import mode_words, no_workspace
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import TEXT
from assur.kinematics.rates.units import factor_unit, is_mixed
from assur.performance.indices import INDICES
from assur.results.typeset_text import minus

NODES = 160


@dataclass(frozen=True)
class Measure:
    """What is mapped: its key in the data, and its name among the indices."""

    key: str
    name: str

    @property
    def symbol(self) -> str:
        """In LaTeX."""
        return INDICES[self.name].symbol


INDEX = Measure("index", "condition")
FASTEST = Measure("largest", "largest")
SLOWEST = Measure("smallest", "smallest")


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
    mapped = planes(context, NODES)
    titles = [plane.words for plane in mapped]
    figure, axes, bar = row(mapped, titles, gap=18.0, bottom=17.0, right=22.0, tallest=90.0)
    maps = [context.indices_at(plane.points)[measure.name] for plane in mapped]
    known = np.concatenate([values[np.isfinite(values)] for values in maps])
    colours, data = scale_of(known, unbounded=INDICES[measure.name].unbounded), []
    levels = round_levels(colours)
    for place, plane, values in zip(axes, mapped, maps, strict=True):
        coloured(place, plane, values, colours, levels=levels, ridges=INDICES[measure.name].unbounded)
        nodes = dict(zip(plane.names, (plane.xs, plane.ys), strict=True))
        data.append({"plane": plane.names, "held": plane.held, **nodes, measure.key: values})
    extend = beyond(float(colours.vmax or np.inf), known)
    colorbar = figure.colorbar(ScalarMappable(colours, COLOURS), cax=bar, extend=extend)
    unit = "" if measure is INDEX else factor_unit(context.record, None)
    colorbar.set_label(f"${measure.symbol}$" + (f" ({unit})" if unit else ""), fontsize=TEXT)
    ends = [] if isinstance(colours, LogNorm) else [0.0]
    colorbar.set_ticks([*ends, *levels], labels=[minus(f"{level:g}") for level in (*ends, *levels)])
    colorbar.minorticks_off()
    for level in levels:
        colorbar.ax.axhline(level, color="white", linewidth=0.6)
    return Drawing(figure, {"unit": context.record.unit, "mode": context.workspace.mode, "maps": data})


DEXTERITY = FigureKind("dexterity", "Local condition index", _missing, _caption, partial(_draw, measure=INDEX))
LARGEST = FigureKind(
    "fastest",
    "Largest velocity factor",
    _missing,
    _factor_caption(
        FASTEST,
        "Largest",
        " It grows without bound towards a parallel singularity; colours, by decades, end at its"
        f" {100 * SHOWN:.0f} % quantile.",
    ),
    partial(_draw, measure=FASTEST),
)
SMALLEST = FigureKind(
    "slowest",
    "Smallest velocity factor",
    _missing,
    _factor_caption(SLOWEST, "Smallest", " It is 0 at a serial singularity."),
    partial(_draw, measure=SLOWEST),
)
