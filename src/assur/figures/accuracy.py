"""How far tolerances move the platform: the ellipsoid of its errors, and what each tolerance has in them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.figures.context import Context
from assur.figures.index_maps import drawn
from assur.figures.machine_and_bars import Bars, machine_beside_bars
from assur.figures.plane_map import plane_of_lengths
from assur.figures.plots import mode_words, no_workspace
from assur.figures.spec import Drawing, FigureKind
from assur.kinematics.status import Status
from assur.kinematics.validation.check import METRES
from assur.machine.accuracy.error_maps import TURNED, error_maps, toleranced
from assur.machine.accuracy.pose_errors import PoseErrors, pose_errors_at
from assur.results.answers.indices import MapAnswer
from assur.workspace.index_maps import IndexMaps

FloatArray = NDArray[np.float64]
NODES = 30
MILLI, MICRO = 1e3, 1e6
"""mrad in a rad, µm in a metre."""
ROUNDED = 1e-6
"""In mrad, and as a share of the largest: below it is rounding."""


def drawn_errors(context: Context) -> PoseErrors:
    """Those of the configuration that is drawn, worked out once.

    Errors:
        UsageError: the inputs do not hold the platform there.
    """
    solved = context.kept("errors", lambda: pose_errors_at(context.record, context.drawn_joints))
    if solved.status != Status.regular:
        raise UsageError(f"the inputs do not hold the platform where it is drawn: it is {solved.status.name} there")
    return solved


def _untold(context: Context) -> str:
    """Why there are no figures of errors; empty where there are."""
    try:
        toleranced(context.record)
        sums = drawn_errors(context).worst_case
    except UsageError as error:
        return f"{error.message}; {error.hint}" if error.hint else error.message
    return "" if np.all(np.isfinite(sums)) else "a tolerance is of what does not assemble alone, and links do not bend"


def _axes(solved: PoseErrors) -> tuple[FloatArray, FloatArray]:
    """Standard deviations (3,) of the displacement along principal directions, columns (3, 3); the largest first."""
    variances, ways = np.linalg.eigh(solved.covariance[:3, :3])
    sizes = np.sqrt(np.maximum(variances[::-1], 0.0))
    return np.where(sizes > ROUNDED * sizes[0], sizes, 0.0), ways[:, ::-1]


def _caption(context: Context) -> str:
    solved = drawn_errors(context)
    sizes = ", ".join(f"{size * _micro(solved):.3g}" for size in _axes(solved)[0])
    bars = " and (c) turns it" if _turns(solved) else ""
    return (
        "How far the tolerances of the file move the platform while the inputs are held, to first order. (a) The"
        f" ellipsoid of one standard deviation of its point, not to scale: {sizes} µm. (b) How far each tolerance"
        f" at its bound moves the point{bars}, the largest of them."
    )


def _micro(solved: PoseErrors) -> float:
    """µm in the mechanism's unit."""
    return MICRO * METRES[solved.record.unit]


def _turns(solved: PoseErrors) -> dict[str, float]:
    """By what each tolerance at its bound turns the platform, in mrad; those that do not are left out."""
    own = _sizes(solved, slice(3, 6), MILLI)
    least = ROUNDED * max(1.0, *own.values())
    return {name: size for name, size in own.items() if size > least}


def _sizes(solved: PoseErrors, part: slice, unit: float) -> dict[str, float]:
    """How long the displacement or the rotation is that each tolerance at its bound makes."""
    rows = solved.sensitivity
    return {name: unit * bound * float(np.linalg.norm(rows[name][part])) for name, bound in solved.bounds.items()}


def _draw(context: Context) -> Drawing:
    solved = drawn_errors(context)
    micro = _micro(solved)
    moves, turns = _sizes(solved, slice(3), micro), _turns(solved)
    sizes, ways = _axes(solved)
    lists = [Bars(moves, "displacement (µm)"), *([Bars(turns, "rotation (mrad)")] if turns else [])]
    told = [f"{size * micro:.3g} µm" for size in sizes]
    shape = ways * (np.maximum(sizes, ROUNDED * sizes[0]) / sizes[0] if sizes[0] > 0.0 else 0.0)
    figure = machine_beside_bars(context, shape, told, {}, lists)
    units = {"deviations": context.record.unit, "displacement": "µm", "rotation": "mrad"}
    data = {"deviations": sizes, "directions": ways.T, "displacement": moves, "rotation": turns, "units": units}
    return Drawing(figure, data)


def _maps(context: Context) -> IndexMaps:
    plane = plane_of_lengths(context, NODES)
    return context.kept(
        "error maps", lambda: error_maps(context.record, context.workspace, plane.names, plane.held, NODES)
    )


def _shown(maps: IndexMaps) -> dict[str, MapAnswer]:
    """All but that of a rotation where there is none."""
    return {
        name: item for name, item in maps.maps.items() if name != TURNED or np.nanmax(item.values, initial=0.0) > 0.0
    }


def errors_drawn(context: Context, maps: IndexMaps) -> Drawing:
    """Maps of errors, colours by decades; that of a rotation is left out where there is none."""
    return drawn(context, replace(maps, maps=_shown(maps)), by_decades=True)


def _map_caption(context: Context) -> str:
    told = "; ".join(f"${item.symbol}$: {item.meaning}" for item in _shown(_maps(context)).values())
    return (
        f"How far the tolerances of the file move the platform over one plane ({mode_words(context)}), inputs held, to"
        f" first order. {told}. Colours by decades: errors grow without bound towards parallel singularities."
    )


ACCURACY = FigureKind("accuracy", "Accuracy", _untold, _caption, _draw)
ERRORS = FigureKind(
    "errors",
    "Errors over one plane",
    lambda context: _untold(context) or no_workspace(context),
    _map_caption,
    lambda context: errors_drawn(context, _maps(context)),
)
