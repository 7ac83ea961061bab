"""Indices: maps of transmission, condition and manipulability in the middle plane of the workspace.

In the transmission maps the thick line is where an index is 0.7: inside it in the last map is the good-transmission
workspace (Wang, Wu and Liu 2010).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from matplotlib.colors import Normalize
from numpy.typing import NDArray

from assur.figures.context import Context
from assur.figures.contours import round_levels
from assur.figures.plane_map import (
    SHOWN,
    MappedPlane,
    beyond,
    coloured,
    panels,
    plane_of_lengths,
    scale_of,
    with_bar,
)
from assur.figures.plots import mode_words, no_workspace
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import ORANGE
from assur.figures.written import units
from assur.performance.indices import INDICES, Indices
from assur.performance.transmission import GOOD

FloatArray = NDArray[np.float64]
NODES = 48
TRANSMISSION_MAPS = ("input_transmission", "output_transmission", "transmission")
JACOBIAN_MAPS = ("condition", "frobenius", "manipulability")


@dataclass(frozen=True, eq=False)
class IndexField:
    """Every index at the nodes (rows, columns) of a plane."""

    plane: MappedPlane
    indices: Indices


def field(context: Context) -> IndexField:
    """The indices in the middle plane: through the middle of the box, of two lengths where there are two."""
    plane = plane_of_lengths(context, NODES)
    return IndexField(plane, context.indices_at(plane.points))


def _transmission_caption(context: Context) -> str:
    words = (
        f"Transmission indices ({mode_words(context)}): the least input transmission index, the least output"
        f" transmission index, and the least of all; 0 is singular, 1 the best. Thick lines: {GOOD:g}."
    )
    found = context.overall_indices
    if found is None or found.good is None:
        return words
    mean = found.values["transmission"]
    share = f"in {100 * found.good.share:.1f} ± {100 * found.good.share_error:.1f} % of the workspace"
    where = share if found.good.share else "nowhere among the poses sampled"
    return f"{words} The local index is at least {GOOD:g} {where}; its mean is {mean.mean:.3f} ± {mean.mean_error:.3f}."


def _jacobian_caption(context: Context) -> str:
    length = field(context).indices.length
    words = (
        f"Indices of $J = J_p^{{-1}}J_q$ ({mode_words(context)}): $1/\\kappa(J)$ in the 2-norm and in the Frobenius"
        f" norm, 0 singular and 1 isotropic, and the manipulability $\\mu = \\sqrt{{\\det JJ^T}}$, its colours by"
        f" decades up to its {100 * SHOWN:.0f} % quantile."
    )
    if length is None:
        return words
    return f"{words} Lengths are divided by the characteristic length {length:.4g} {context.record.unit}."


def _draw(context: Context, names: tuple[str, ...], *, good: bool) -> Drawing:
    there = field(context)
    plane, data = there.plane, {}
    units_of = {name: INDICES[name].unit(there.indices) for name in names}
    titles = [f"${INDICES[name].symbol}$" + (f" ({units(unit)})" if unit else "") for name, unit in units_of.items()]
    figure, pairs = panels(plane, titles, right=15.0)
    for name, pair in zip(names, pairs, strict=True):
        index, values = INDICES[name], there.indices[name]
        known = values[np.isfinite(values)]
        colours = Normalize(0.0, 1.0) if good else scale_of(known, unbounded=index.unbounded)
        marked = {GOOD: ORANGE} if good else None
        levels = round_levels(colours)
        image = coloured(pair[0], plane, values, colours, levels=levels, marked=marked, ridges=index.unbounded)
        with_bar(pair, image, "none found", beyond(float(colours.vmax or np.inf), known), levels)
        data[name] = {"values": values}
    return Drawing(
        figure,
        {
            "unit": context.record.unit,
            "mode": context.workspace.mode,
            "plane": plane.names,
            "held": plane.held,
            plane.names[0]: plane.xs,
            plane.names[1]: plane.ys,
            "characteristic_length": there.indices.length,
            "maps": data,
        },
    )


TRANSMISSION = FigureKind(
    "transmission",
    "Motion and force transmission",
    no_workspace,
    _transmission_caption,
    partial(_draw, names=TRANSMISSION_MAPS, good=True),
)
MANIPULABILITY = FigureKind(
    "manipulability",
    "Condition and manipulability",
    no_workspace,
    _jacobian_caption,
    partial(_draw, names=JACOBIAN_MAPS, good=False),
)
