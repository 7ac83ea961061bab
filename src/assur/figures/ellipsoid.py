"""How the platform gives way: the ellipsoid of its displacements under unit forces, and which links are strained."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.figures.context import Context
from assur.figures.machine_and_bars import Bars, machine_beside_bars
from assur.figures.spec import Drawing, FigureKind
from assur.figures.strain_colours import drawn_stiffness, not_held, strain_colours
from assur.machine.elasticity.stiffness import Stiffness

FloatArray = NDArray[np.float64]
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
    stiff, ways = (part[0] for part in solved.translational)
    lists = [
        Bars({name: 100.0 * share for name, share in own.items()}, f"energy {words} (%)", shares=True)
        for own, words in ((shares.links, "by links"), (shares.kinds, "by kinds"))
    ]
    told = [f"{along / MICRO:.3g} N/µm" for along in stiff]
    colours = strain_colours(shares.bent, max(shares.bent.values(), default=1.0))
    figure = machine_beside_bars(context, _shape(solved), told, colours, lists)
    data = {"stiffness": stiff, "directions": ways, "links": shares.links, "kinds": shares.kinds}
    return Drawing(figure, data)


def _shape(solved: Stiffness) -> FloatArray:
    """Semi-axes as columns (3, 3), the longest one."""
    stiff, ways = (part[0] for part in solved.translational)
    return np.asarray(ways.T * (stiff[0] / stiff))


ELLIPSOID = FigureKind("stiffness", "Stiffness", not_held, _caption, _draw)
