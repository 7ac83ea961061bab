"""Home in numbers: what every symbol of a derivation is at home, by which signs of roots are chosen."""

from __future__ import annotations

import numpy as np
import sympy
from numpy.typing import NDArray

from assur.derivation.loop_equations import LoopEquations
from assur.derivation.orientations import LinkOrientations
from assur.derivation.symbols import GivenSymbols, circle_of
from assur.joint_graph.frames import frames
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
    rotations = frames(record, values)
    for index, length in loops.lengths.items():
        numbers[length] = float(values[index])
    for direction in loops.directions:
        link = next(link for link in direction.links if link in record.links)
        own = placed.links[link]
        constant = _array(own.constant, numbers)
        turned = rotations[link][0] @ constant.T
        if direction.kind == "rod":
            parts = turned @ _array(own.line, numbers)
        else:
            axis = _array(own.axis, numbers)
            sine = (
                0.5
                * axis
                @ np.array([turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]])
            )
            parts = np.array([(np.trace(turned) - 1.0) / 2.0, sine])
        numbers |= dict(zip(direction.unknowns, map(float, parts), strict=True))
    return numbers


def _named(name: str, value: float, angle: bool) -> dict[sympy.Symbol, float]:
    if not angle:
        return {sympy.Symbol(name, real=True): value}
    return dict(zip(circle_of(name), (float(np.cos(value)), float(np.sin(value))), strict=True))


def _array(parts: object, numbers: dict[sympy.Symbol, float]) -> FloatArray:
    return np.array(sympy.Matrix(parts).evalf(30, subs=numbers), dtype=float).squeeze()
