"""Colours of links by their share of a strain energy, the bar of these colours, and whether a file says what bends."""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib as mpl
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize, to_hex
from matplotlib.figure import Figure

from assur.errors import UsageError
from assur.figures.context import Context
from assur.figures.style import INK, SMALL
from assur.kinematics.status import Status
from assur.machine.elasticity.stiffness import Stiffness, stiffness_at
from assur.machine.elasticity.structure import structure

PALETTE = mpl.colormaps["YlOrRd"].resampled(256)
PALEST = 0.25
"""Where the palette begins: what is paler is not seen on paper."""


def no_springs(context: Context) -> str:
    """Why a mechanism has no figures of stiffness; empty where it has."""
    try:
        structure(context.record)
    except UsageError as error:
        return f"{error.message}; {error.hint}" if error.hint else error.message
    return ""


def drawn_stiffness(context: Context) -> Stiffness:
    """That of the configuration that is drawn, worked out once.

    Errors:
        UsageError: the actuators do not hold the platform there.
    """
    solved = context.kept("stiffness", lambda: stiffness_at(context.record, context.drawn_joints[None]))
    status = Status(int(solved.status[0]))
    if status != Status.regular:
        raise UsageError(f"the actuators do not hold the platform where it is drawn: it is {status.name} there")
    return solved


def not_held(context: Context) -> str:
    """Why there is none in the configuration that is drawn, for the file or for the pose; empty where there is."""
    if no_springs(context):
        return no_springs(context)
    try:
        drawn_stiffness(context)
    except UsageError as error:
        return error.message
    return ""


def strain_colours(shares: Mapping[str, float], most: float) -> dict[str, str]:
    """A colour of each link that has a share, `most` the darkest.

    >>> strain_colours({"bar": 0.5, "rod": 0.0}, 0.5)
    {'bar': '#800026', 'rod': '#fed976'}
    """
    return {link: to_hex(PALETTE(PALEST + (1.0 - PALEST) * share / (most or 1.0))) for link, share in shares.items()}


def strain_bar(figure: Figure, place: tuple[float, float, float, float], most: float, words: str) -> None:
    """The bar of these colours from 0 to `most`, in a place (left, bottom, width, height) in shares of a figure."""
    colours = PALETTE(PALEST + (1.0 - PALEST) * mpl.colormaps["gray"](range(256))[:, 0])
    axes = figure.add_axes(place)
    scale = ScalarMappable(Normalize(0.0, 100.0 * most), mpl.colors.ListedColormap(colours))
    bar = figure.colorbar(scale, cax=axes, orientation="horizontal")
    bar.outline.set_edgecolor(INK)
    bar.set_label(words, fontsize=SMALL, labelpad=1.0)
    axes.tick_params(labelsize=SMALL)
