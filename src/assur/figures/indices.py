"""Indices: maps of transmission, condition and manipulability in the middle plane of the workspace, all from 0 to 1.

In the transmission maps the thick line is where an index is 0.7: inside it in the last map is the good-transmission
workspace (Wang, Wu and Liu 2010).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from numpy.typing import NDArray

from assur.figures.context import Context
from assur.figures.plane_map import COLOURS, SHOWN, MappedPlane, beyond, coloured, headed, plane_of_lengths, row
from assur.figures.plots import mode_words, no_workspace
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import ORANGE
from assur.figures.written import units
from assur.performance.indices import INDICES, Indices
from assur.performance.transmission import GOOD

FloatArray = NDArray[np.float64]
NODES = 48
LEVELS = [round(0.1 * k, 1) for k in range(1, 10)]
TRANSMISSION_MAPS = ("input_transmission", "output_transmission", "transmission")
JACOBIAN_MAPS = ("condition", "frobenius", "manipulability")


@dataclass(frozen=True, eq=False)
class IndexField:
    """Every index at the nodes (rows, columns) of a plane."""

    plane: MappedPlane
    indices: Indices

    def shares(self, name: str) -> tuple[FloatArray, float]:
        """An index between 0 and 1, and what it was divided by: 1, or the quantile where a velocity's colours end."""
        values = self.indices[name]
        known = values[np.isfinite(values)]
        if INDICES[name].power == 0 or not len(known):
            return values, 1.0
        top = float(np.quantile(known, SHOWN)) or 1.0
        return values / top, top


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
    there = field(context)
    top, unit = there.shares("manipulability")[1], INDICES["manipulability"].unit(there.indices)
    size = f"{top:.4g} {units(unit)}".strip()
    words = (
        f"Indices of $J = J_p^{{-1}}J_q$ ({mode_words(context)}): $1/\\kappa(J)$ in the 2-norm and in the Frobenius"
        f" norm, 0 singular and 1 isotropic, and the manipulability $\\mu = \\sqrt{{\\det JJ^T}}$ divided by {size},"
        f" its {100 * SHOWN:.0f} % quantile."
    )
    if there.indices.length is None:
        return words
    return f"{words} Lengths are divided by the characteristic length {there.indices.length:.4g} {context.record.unit}."


def _draw(context: Context, names: tuple[str, ...], *, good: bool) -> Drawing:
    there = field(context)
    plane, titles = there.plane, [f"${INDICES[name].symbol}$" for name in names]
    figure, maps, bar = row([plane] * len(names), titles, gap=6.0, bottom=14.0, right=20.0, tallest=75.0)
    data = {}
    for name, axes in zip(names, maps, strict=True):
        values, divisor = there.shares(name)
        coloured(axes, plane, values, Normalize(0.0, 1.0), levels=LEVELS, marked={GOOD: ORANGE} if good else None)
        if axes is not maps[0]:
            axes.set_ylabel("")
            axes.tick_params(labelleft=False)
        data[name] = {"values": there.indices[name], "divided_by": divisor}
    headed(figure, plane)
    end = beyond(1.0, *(there.shares(name)[0] for name in names))
    scale_bar = figure.colorbar(ScalarMappable(Normalize(0.0, 1.0), COLOURS), cax=bar, extend=end)
    scale_bar.set_ticks([0.0, *LEVELS[1::2], 1.0])
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
