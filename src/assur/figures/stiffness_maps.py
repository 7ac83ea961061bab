"""Maps of the least stiffness over a plane, with the direction in which the platform gives way most."""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.figures.context import Context
from assur.figures.plane_map import MappedPlane, coloured, panels, ridged, with_bar
from assur.figures.spec import Drawing
from assur.figures.style import INK
from assur.machine.elasticity.stiffness_maps import LEAST, MOTORS, WAYS
from assur.model.pose import LENGTHS
from assur.results.json_text import plain
from assur.workspace.index_maps import IndexMaps

FloatArray = NDArray[np.float64]
MICRO = 1e6
"""N/m in a N/um."""
EVEN = 1.2
"""Ends of a bar of colours differ by this factor at least: what changes by less looks even."""
DOT = 2.2
"""Diameter in points: what is seen of a dash across the plane."""
LINES = 11
"""Directions along each axis of a map at most."""


def drawn(context: Context, maps: IndexMaps) -> Drawing:
    """The least stiffness, that of the actuators alone in N/um, and how many times as much it is; colours by decades.

    A dash shows how much of the direction lies in the plane; across it the dash is a point.

    Errors:
        UsageError: maps of one or of three coordinates.
    """
    if len(maps.axes) != 2:
        raise UsageError(f"{len(maps.axes)} coordinates are not a plane", hint="map two, hold the others")
    (first, xs), (second, ys) = maps.axes
    plane = MappedPlane(context, (first, second), maps.held, xs, ys)
    titles = ["links and actuators (N/µm)", "actuators alone (N/µm)", "(b) over (a)"]
    figure, pairs = panels(plane, titles, right=15.0)
    whole, motors = maps[LEAST].T / MICRO, maps[MOTORS].T / MICRO
    soft = [ridged(plane, values**-0.5) for values in (whole, motors)]  # grows with 1 over the distance from a ridge
    finer, root = ridged(plane, np.sqrt(motors / whole))  # where links give way with a higher power of the distance
    shown = [*((finer, values**-2.0) for finer, values in soft), (finer, root**2)]
    images = []
    for pair, values, fine in zip(pairs, (whole, motors, motors / whole), shown, strict=True):
        known = values[np.isfinite(values)]
        low, high = (np.quantile(known, 0.02), known.max()) if len(known) else (0.1, 1.0)
        images.append(coloured(pair[0], *fine, LogNorm(min(low, high / EVEN), high)))
        with_bar(pair, images[-1], "none held")
    if images[0] and first in LENGTHS and second in LENGTHS:
        ways = [maps[WAYS[LENGTHS.index(name)]].T for name in (first, second)]
        for artist in _dashes(pairs[0][0], plane, ways):
            artist.set_clip_path(images[0].get_clip_path())
    return Drawing(figure, plain(maps.answer()))


def _dashes(axes: Axes, plane: MappedPlane, ways: list[FloatArray]) -> list[Artist]:
    """Directions (b, a) without sense, each as long as what of it lies in the plane, and a dot in its middle."""
    rows, columns = (slice(None, None, max(1, -(-len(nodes) // LINES))) for nodes in (plane.ys, plane.xs))
    x, y = np.meshgrid(plane.xs[columns], plane.ys[rows])
    along, up = (part[rows, columns] for part in ways)
    known = np.isfinite(along) & np.isfinite(up)
    size = 0.9 * min(np.diff(plane.xs[columns]).min(initial=np.inf), np.diff(plane.ys[rows]).min(initial=np.inf))
    dashes = axes.quiver(
        x[known], y[known], size * along[known], size * up[known],
        angles="xy", scale_units="xy", scale=1.0, pivot="mid", color=INK, width=0.006,
        headlength=0.0, headaxislength=0.0, headwidth=0.0, minlength=0.0, zorder=6,
    )  # fmt: skip
    return [dashes, *axes.plot(x[known], y[known], ".", color=INK, markersize=DOT, markeredgewidth=0.0, zorder=6)]
