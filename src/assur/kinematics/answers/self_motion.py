"""Self-motion: the curve on which the platform moves while every input stands still."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from types import SimpleNamespace

import numpy as np
from numpy.typing import NDArray

from assur.kinematics import border
from assur.kinematics.answers.solution import Failure
from assur.kinematics.modes import mode_text
from assur.kinematics.status import closed_form_of, scale
from assur.model.closed_form import Branch
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.numerics.number_types import Floats

FloatArray = NDArray[np.float64]
SAMPLES = 4096
BISECTIONS = 60


@dataclass(frozen=True, eq=False)
class SelfMotionCurve:
    """One arc of a self-motion: the parameter's interval in rad, for one choice of the remaining signs.

    The ends are found by bisection from samples every 2 pi / 4096; an arc shorter than that may be missed. An arc
    across the half turn runs on beyond pi.
    """

    record: MechanismRecord
    inputs: FloatArray
    parameter: str
    interval: tuple[float, float]
    mode: str

    def poses(self, count: int = 65) -> FloatArray:
        """Poses (count, m) along the arc, ends included."""
        branch = self._branch(count)
        return np.stack([np.broadcast_to(border.scalar(value), (count,)) for value in branch.pose], axis=-1)

    def joints(self, count: int = 65) -> FloatArray:
        """Joint values (count, n) along the arc, ends included."""
        form = closed_form_of(self.record)
        found = form.joints(Floats(), kernel_dimensions(self.record), self._branch(count).core)
        values = border.joint_values(self.record, found)
        return np.stack([np.broadcast_to(value, (count,)) for value in values], axis=-1)

    def _branch(self, count: int) -> Branch:
        signs = [1.0 if symbol == "+" else -1.0 for symbol in self.mode]
        return _kernel(self.record, self.inputs, np.linspace(*self.interval, count), signs)


def self_motion_curves(record: MechanismRecord, inputs: FloatArray) -> tuple[SelfMotionCurve, ...]:
    """Every arc of the self-motion at inputs (n,) at which the direct problem degenerates."""
    form = closed_form_of(record)
    if form.self_motion is None:
        return ()
    curves: list[SelfMotionCurve] = []
    for signs in _sign_choices(record):
        mode = mode_text([int(sign) for sign in signs])
        least = partial(_least, record, inputs, signs=signs)
        name = form.self_motion.parameter
        curves += [SelfMotionCurve(record, inputs, name, arc, mode) for arc in _positive_arcs(least)]
    return tuple(curves)


def _kernel(
    record: MechanismRecord, inputs: FloatArray, angle: FloatArray, signs: list[float] | tuple[float, ...]
) -> Branch:
    motion = closed_form_of(record).self_motion
    if motion is None:
        raise AssertionError("no self-motion")
    sign = SimpleNamespace(**dict(zip(motion.signs, signs, strict=True)))
    components = border.input_components(record, np.broadcast_to(inputs, (len(angle), inputs.shape[-1])))
    with np.errstate(divide="ignore", invalid="ignore"):  # where a margin degenerates; it says so
        return motion.kernel(Floats(), kernel_dimensions(record), components, (np.cos(angle), np.sin(angle)), sign)


def has_self_motion(record: MechanismRecord, inputs: FloatArray) -> bool:
    """Whether the self-motion at inputs (n,) has a real arc."""
    grid = np.linspace(-np.pi, np.pi, SAMPLES, endpoint=False)
    return any(bool(np.any(_least(record, inputs, grid, signs) >= 0.0)) for signs in _sign_choices(record))


def _least(record: MechanismRecord, inputs: FloatArray, angle: FloatArray, signs: tuple[float, ...]) -> FloatArray:
    """The smallest margin (N,) along the curve, relative to its scale."""
    margins = list(_relative_margins(record, inputs, angle, signs).values())
    return np.asarray(np.min(margins, axis=0)) if margins else np.ones(np.shape(angle))  # nothing ends the curve


def nearest_miss(record: MechanismRecord, inputs: FloatArray) -> Failure:
    """Why a self-motion has no real arc: the margin that fails at the point of the curves nearest to being real."""
    grid = np.linspace(-np.pi, np.pi, SAMPLES + 1)
    misses = []
    for signs in _sign_choices(record):
        relative = _relative_margins(record, inputs, grid, signs)
        least = np.min(list(relative.values()), axis=0)
        k = int(np.argmax(least))
        misses.append((float(least[k]), min(relative, key=lambda name: relative[name][k])))
    value, name = max(misses)
    margin = next(item for item in closed_form_of(record).direct_margins if item.name == name)
    return Failure(name, value * scale(record, margin.scale), margin.unit, margin.meaning, len(misses))


def _sign_choices(record: MechanismRecord) -> list[tuple[float, ...]]:
    motion = closed_form_of(record).self_motion
    return list(itertools.product((1.0, -1.0), repeat=len(motion.signs))) if motion else []


def _relative_margins(
    record: MechanismRecord, inputs: FloatArray, angle: FloatArray, signs: tuple[float, ...]
) -> dict[str, FloatArray]:
    """Margins (N,) along the curve that must not be negative, divided by their scales."""
    margins = {item.name: item for item in closed_form_of(record).direct_margins if item.zero == "merge"}
    found = _kernel(record, inputs, angle, signs).margins
    return {
        name: np.asarray(value) / scale(record, margins[name].scale) for name, value in found.items() if name in margins
    }


def _positive_arcs(least: Callable[[FloatArray], FloatArray]) -> list[tuple[float, float]]:
    """Arcs of the circle on which a function is not negative, their ends by bisection; (-pi, pi) for all of it.

    An arc that crosses the half turn runs on beyond pi.

    >>> [(round(low, 6), round(high, 6)) for low, high in _positive_arcs(lambda angle: -np.cos(angle))]
    [(1.570796, 4.712389)]
    """
    step = 2 * np.pi / SAMPLES
    grid: FloatArray = np.asarray(-np.pi + step * np.arange(SAMPLES), dtype=np.float64)
    inside = least(grid) >= 0.0
    if np.all(inside):
        return [(-np.pi, np.pi)]
    arcs = []
    for first in np.flatnonzero(inside & ~np.roll(inside, 1)):
        length = int(np.argmin(np.roll(inside, -first)))  # samples until the first that is outside
        last = grid[first] + step * (length - 1)
        arcs.append((_edge(least, grid[first], grid[first] - step), _edge(least, last, last + step)))
    return arcs


def _edge(least: Callable[[FloatArray], FloatArray], inside: float, outside: float) -> float:
    for _ in range(BISECTIONS):
        middle = 0.5 * (inside + outside)
        if least(np.array([middle]))[0] >= 0.0:
            inside = middle
        else:
            outside = middle
    return float(inside)
