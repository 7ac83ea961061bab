"""The coordinates of a workspace as figures show them: symbols, units, ticks, and by how much an angle is stretched."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator
from numpy.typing import NDArray

from assur.figures.context import Context
from assur.figures.letters import mathematics
from assur.figures.style import SMALL
from assur.kinematics.answers.at_border import angle_at_border
from assur.model.pose import LENGTHS, is_angle
from assur.results.typeset_text import minus
from assur.workspace.domain import Box

FloatArray = NDArray[np.float64]
POINTS = 72.0
"""An inch in points."""

WIDE, HIGH = 3.3, 2.0
"""Room for a number at a tick of an axis across and of one upwards, in heights of its letters."""


def held_words(context: Context) -> str:
    """What is held in the workspace, for a caption; empty where everything varies."""
    held = ", ".join(f"{symbol(name)} = {value_words(context, name, value)}" for name, value in _held(context))
    return f" with {held} held" if held else ""


def _held(context: Context) -> list[tuple[str, float]]:
    return list(context.workspace.slice.held.items())


def symbol(name: str) -> str:
    """A coordinate as mathematics."""
    return f"${mathematics(name) or name}$"


def value_words(context: Context, name: str, value: float) -> str:
    """A value of a coordinate with its unit, e.g. "300 mm" or "−30°"; an angle to four decimals."""
    number = shown(context, name, value)
    rounded = round(number, 4) + 0.0 if is_angle(name) else number
    return f"{minus(f'{rounded:.6g}')}{unit_after(context, angle=is_angle(name))}"


def unit_after(context: Context, *, angle: bool) -> str:
    """The unit as it stands after a number of a length or an angle."""
    return (
        "°" if angle and context.record.angle == "deg" else f" {context.record.angle if angle else context.record.unit}"
    )


def shown(context: Context, name: str, value: float) -> float:
    """A value of a coordinate as axes show it: angles in the mechanism's angle unit."""
    return float(np.round(angle_at_border(context.record, value), 9)) + 0.0 if is_angle(name) else float(value)


def stretch(context: Context) -> FloatArray:
    """By how much each coordinate (m,) is drawn larger: an angle as if its interval were as long as one of lengths.

    Where there are only lengths, or only angles, all by 1.
    """
    box = context.workspace.box
    spans = np.subtract(box.high, box.low)
    angles = np.array([is_angle(name) for name in box.names])
    if np.all(angles) or not np.any(angles):
        return np.ones(len(spans))
    return np.where(angles, float(np.mean(spans[~angles])) / spans, 1.0)


def drawn_span(context: Context, name: str) -> float:
    """Length of the interval of a coordinate as it is drawn."""
    box = context.workspace.box
    k = box.axis(name)
    return float(stretch(context)[k] * (box.high[k] - box.low[k]))


def plane_words(first: str, second: str) -> str:
    """A coordinate plane, e.g. "XOZ"; with an angle the two coordinates."""
    if first in LENGTHS and second in LENGTHS:
        return f"{first.upper()}O{second.upper()}"
    return f"{symbol(first)} and {symbol(second)}"


def dress(context: Context, axes: Axes, box: Box, names: Sequence[str]) -> None:
    """Limits, titles and ticks of a plot of two coordinates over a box of poses."""
    for name, axis, most in zip(names, (axes.xaxis, axes.yaxis), _most_ticks(axes), strict=True):
        low, high = box.intervals[box.axis(name)]
        axis.set_view_interval(low, high, ignore=True)
        axis.set_label_text(axis_title(context, name))
        if is_angle(name) and context.record.angle == "deg":
            ticks = angle_ticks(low, high, min(most, 5))
            axis.set_major_locator(FixedLocator([float(np.radians(tick)) for tick in ticks]))
            axis.set_major_formatter(FuncFormatter(lambda value, _: minus(f"{np.degrees(value):.0f}")))
        else:
            axis.set_major_locator(MaxNLocator(most, steps=[1, 2, 2.5, 5, 10]))


def _most_ticks(axes: Axes) -> tuple[int, int]:
    """Intervals between ticks, across and upwards, for whose numbers there is room; from 2 to 9."""
    letter = SMALL / POINTS * axes.figure.dpi
    room = axes.bbox.width / (WIDE * letter), axes.bbox.height / (HIGH * letter)
    across, upwards = np.clip(room, 2, 9).astype(int).tolist()
    return across, upwards


def angle_ticks(low: float, high: float, most: int = 5) -> list[float]:
    """Round degrees inside an interval in rad, with so many intervals between them at most.

    >>> angle_ticks(-1.0, 1.0), angle_ticks(-1.0, 1.0, 2)
    ([-50.0, -25.0, 0.0, 25.0, 50.0], [-50.0, 0.0, 50.0])
    """
    first, last = np.degrees([low, high])
    ticks = MaxNLocator(most, steps=[1, 1.5, 2, 2.5, 3, 4.5, 5, 6, 9, 10]).tick_values(first, last)
    return [float(tick) for tick in ticks if first - 1e-9 <= tick <= last + 1e-9]


def axis_title(context: Context, name: str) -> str:
    """A pose coordinate with its unit."""
    unit = context.record.unit if not is_angle(name) else "°" if context.record.angle == "deg" else "rad"
    return f"{symbol(name)} ({unit})"
