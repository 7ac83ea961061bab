"""Home in numbers: what every symbol of a derivation is at home, by which signs of roots are chosen."""

from __future__ import annotations

import numpy as np
import sympy
from numpy.typing import NDArray

from assur.derivation.ball_triangles import SIDES
from assur.derivation.loop_equations import LoopEquations
from assur.derivation.orientations import LinkOrientations
from assur.derivation.rotations_at_home import rotations_at_home, turned_about
from assur.derivation.symbols import GivenSymbols, circle_of
from assur.kinematics import pose
from assur.kinematics.home import home_values
from assur.model.pose import ANGLES

FloatArray = NDArray[np.float64]


def home_numbers(symbols: GivenSymbols, placed: LinkOrientations, loops: LoopEquations) -> dict[sympy.Symbol, float]:
    """Symbol -> its value at home: dimensions, inputs, coordinates of the pose, unknowns of directions, lengths."""
    record, values = symbols.record, home_values(symbols.record)
    numbers: dict[sympy.Symbol, float] = {
        symbol: record.parameters[name].inside for name, symbol in symbols.parameters.items()
    }
    for driven in record.inputs:
        printed = float(driven.printed(values[driven.coordinate.index]))
        numbers |= _named(driven.name, printed, driven.coordinate.kind == "angle")
    for name, value in zip(record.platform.pose, pose.pose_of(record, values), strict=True):
        numbers |= _named(name, float(value), name in ANGLES)
    for own in placed.named.definitions:
        numbers[own.symbol] = float(own.formula.evalf(subs=numbers))
    for index, length in loops.lengths.items():
        numbers[length] = float(values[index])
    numbers |= {across: numbers[length] for length, across in loops.oblique.items()}
    rotations = rotations_at_home(record)
    for direction in sorted(loops.directions, key=lambda own: placed.links[own.links[0]].second is not None):
        placing = placed.links[direction.links[0]]
        turned = rotations[direction.links[0]] @ _array(placing.constant, numbers).T
        if direction.kind == "rod":
            parts = turned @ _array(placing.line, numbers)
        elif placing.triangle is not None:
            parts = turned @ _array(placing.triangle.sides[SIDES.index(direction.name[-2:])], numbers)
        elif placing.second is None:
            parts = _angle(turned, _array(placing.axis, numbers))
        else:
            first = next(part for part in loops.carriers if placed.links[part.links[0]].circle == placing.circle)
            carried = turned_about(_array(placing.axis, numbers), *(numbers[unknown] for unknown in first.unknowns))
            parts = _angle(carried.T @ turned, _array(placing.hinge, numbers))
        numbers |= dict(zip(direction.unknowns, map(float, parts), strict=True))
    return numbers


def _angle(turned: FloatArray, axis: FloatArray) -> FloatArray:
    """Cosine and sine of a rotation (3, 3) about an axis (3,)."""
    twist = np.array([turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]])
    return np.array([(np.trace(turned) - 1.0) / 2.0, 0.5 * axis @ twist])


def _named(name: str, value: float, angle: bool) -> dict[sympy.Symbol, float]:
    if not angle:
        return {sympy.Symbol(name, real=True): value}
    return dict(zip(circle_of(name), (float(np.cos(value)), float(np.sin(value))), strict=True))


def _array(parts: object, numbers: dict[sympy.Symbol, float]) -> FloatArray:
    return np.array(sympy.Matrix(parts).evalf(30, subs=numbers), dtype=float).squeeze()
