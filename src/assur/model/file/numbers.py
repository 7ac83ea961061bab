"""Formulas to numbers, with the one distinction that a mechanism needs: an angle is not a plain number.

Inside a formula every angle is in rad. `62 deg` and a parameter with an angle unit are angles; `pi` may be
either; everything else is plain. A plain number that stands for an angle is in the file's angle unit.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import KeyPath
from assur.model import syntax as s
from assur.model.file.faults import Faults
from assur.model.formula import Formula

FloatArray = NDArray[np.float64]
Kind = Literal["plain", "angle", "either"]
AngleUnit = Literal["deg", "rad"]
Triple = tuple[Formula, Formula, Formula]
MIXED = "allowed: angles with angles, plain numbers with plain numbers"
MIXED_HINT = "a unit makes an angle of a number: 90 deg"
SHORTEST = 1e-12
LARGEST = 1e100
"""Of any formula, so that products of a few numbers stay within the floats."""
FARTHEST = 1e12
"""Of a length or an angle that is used: beyond it nothing would be left of its digits."""
_REASONS = {
    ZeroDivisionError: "division by zero",
    ValueError: "square root of a negative number",
    OverflowError: "too large",
}


class KindError(Exception):
    """A formula that mixes angles with plain numbers."""


def kind_of(node: s.Node, kinds: Mapping[str, Kind]) -> Kind:
    """Whether a formula gives an angle, from the kinds of its names; `KindError` where it makes no sense.

    >>> from assur.model.formula import parse
    >>> kind_of(parse("2*pi/3 + 5 deg").root, {})
    'angle'
    >>> kind_of(parse("l*sin(a)").root, {"l": "plain", "a": "angle"})
    'plain'
    """
    match node:
        case s.Number():
            return "plain"
        case s.Angle():
            return "angle"
        case s.Pi():
            return "either"
        case s.Name(text):
            return kinds[text]
        case s.Negative(of):
            return kind_of(of, kinds)
        case s.Call(function, of):
            return _call(function, kind_of(of, kinds))
        case s.Operands(first, rest):
            kind = kind_of(first, kinds)
            for sign, term in rest:
                kind = _join(sign, kind, kind_of(term, kinds))
            return kind


def _call(function: str, argument: Kind) -> Kind:
    if function == "sqrt" and argument == "angle":
        raise KindError("the square root of an angle")
    if function != "sqrt" and argument == "plain":
        raise KindError(f"{function} of a plain number")
    return "plain"


def _join(sign: str, left: Kind, right: Kind) -> Kind:
    if sign in "+-":
        if {left, right} == {"angle", "plain"}:
            raise KindError("the sum of an angle and a plain number")
        return right if left == "either" else left
    if right == "angle":
        if sign == "/" and left != "plain":
            return "plain"
        if sign == "*" and left != "angle":
            return "angle"
        raise KindError("a product of angles" if sign == "*" else "a plain number divided by an angle")
    if left == "angle":
        return "angle"
    return "either" if "either" in (left, right) else "plain"


@dataclass(frozen=True)
class Numbers:
    """Evaluates formulas of parameters; what goes wrong is noted, and the result is then NaN.

    Attributes:
        values: parameters by name, angles in rad.
        kinds: which of all parameters are angles.
        broken: parameters that are in the file but have no value, because of a fault already noted.
        angle_unit: unit of plain numbers that stand for angles.
    """

    values: dict[str, float]
    kinds: Mapping[str, Kind]
    broken: set[str]
    angle_unit: AngleUnit
    faults: Faults

    def evaluate(self, formula: Formula, path: KeyPath) -> tuple[float, Kind]:
        """Value and kind; NaN of kind "either" where a fault stands in the way."""
        missing = {name for name in formula.names if name not in self.values}
        for name in sorted(missing.difference(self.broken)):
            self.faults.unknown(path, "parameter", name, self.kinds)
        if missing:
            return math.nan, "either"
        try:
            kind = kind_of(formula.root, self.kinds)
            value = float(formula.evaluate(self.values, math))
        except KindError as error:
            self.faults.add(path, f'"{formula.text}": {error}', MIXED, MIXED_HINT)
        except (ZeroDivisionError, ValueError, OverflowError) as error:
            reason = _REASONS[type(error)]
            self.faults.add(path, f'"{formula.text}" has no value: {reason}', "allowed: a finite number")
        else:
            if abs(value) <= LARGEST:
                return value, kind
            self.faults.add(path, f'"{formula.text}" is too large', f"allowed: numbers up to {LARGEST:g}")
        return math.nan, "either"

    def plain(self, formula: Formula, path: KeyPath) -> float:
        """A length, or a pure number."""
        value, kind = self.evaluate(formula, path)
        if kind == "angle":
            self.faults.add(path, f'"{formula.text}" is an angle', "allowed: a length")
        return self._near(value, formula, path)

    def _near(self, value: float, formula: Formula, path: KeyPath) -> float:
        if abs(value) > FARTHEST:
            self.faults.add(path, f'"{formula.text}" is {value:.3g}', f"allowed: numbers up to {FARTHEST:g}")
            return math.nan
        return value

    def angle(self, formula: Formula, path: KeyPath) -> float:
        """An angle in rad."""
        value, kind = self.evaluate(formula, path)
        value = self._near(value, formula, path)
        return math.radians(value) if kind == "plain" and self.angle_unit == "deg" else value

    def of(self, kind: Literal["angle", "length"], formula: Formula, path: KeyPath) -> float:
        """An angle in rad, or a length."""
        return self.angle(formula, path) if kind == "angle" else self.plain(formula, path)

    def interval(
        self, kind: Literal["angle", "length"], ends: tuple[Formula, Formula], path: KeyPath
    ) -> tuple[float, float]:
        """Two numbers, the first below the second."""
        low, high = (self.of(kind, end, (*path, index)) for index, end in enumerate(ends))
        if low >= high:
            found = f'from "{ends[0].text}" to "{ends[1].text}"'
            self.faults.add(path, found, "allowed: [low, high] with low below high")
        return low, high

    def vector(self, components: Triple, path: KeyPath) -> FloatArray:
        """A vector (3,) of lengths."""
        return np.array([self.plain(part, (*path, index)) for index, part in enumerate(components)])

    def axis(self, components: Triple, path: KeyPath) -> FloatArray:
        """A unit vector (3,)."""
        vector = self.vector(components, path)
        length = float(np.linalg.norm(vector))
        if length < SHORTEST:
            self.faults.add(path, "an axis of length zero", "allowed: a vector that has a direction")
            return np.full(3, np.nan)
        return vector / length
