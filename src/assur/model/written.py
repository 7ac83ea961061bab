"""Dimensions as they are written: points, axes and turns of limbs as formulas, over any number type."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from assur.joints.joint_type import Directions
from assur.joints.steps import UNTURNED, about
from assur.model.formula import Formula
from assur.model.syntax import Functions, Literal, Negative, Number, Operands, Pi
from assur.numerics.vectors import Matrix, Vector, apply, dot, taking

Triple = tuple[Formula, Formula, Formula]


@dataclass(frozen=True)
class NumberReading:
    """How formulas are read over a number type: what names stand for, its functions, and how a literal is read."""

    names: Mapping[str, Any]
    functions: Functions
    number: Literal

    def value(self, formula: Formula) -> Any:
        """The value of a formula."""
        return formula.evaluate(self.names, self.functions, self.number)


@dataclass(frozen=True)
class LimbTurn:
    """By what a limb is turned from its template: an angle about an axis."""

    about: Triple
    angle: Formula

    def matrix(self, reading: NumberReading) -> Matrix:
        """The turn (3, 3)."""
        angle = reading.value(self.angle)
        axis = WrittenVector(self.about).unit(reading)
        return about(axis, reading.functions.cos(angle), reading.functions.sin(angle))


@dataclass(frozen=True)
class WrittenVector:
    """Three formulas, in a template's frames if there is a limb."""

    parts: Triple
    limb: LimbTurn | None = None

    def vector(self, reading: NumberReading) -> Vector:
        """A point."""
        return self.turned(self._read(reading), reading)

    def unit(self, reading: NumberReading) -> Vector:
        """The unit vector in this direction; along an axis of the frame no root is drawn."""
        parts = self._read(reading)
        along = [k for k, part in enumerate(self.parts) if not is_zero(part)]
        if len(along) == 1 and _is_one(self.parts[along[0]]):
            return self.turned(parts, reading)
        size = reading.functions.sqrt(dot(parts, parts))
        return self.turned((parts[0] / size, parts[1] / size, parts[2] / size), reading)

    def _read(self, reading: NumberReading) -> Vector:
        x, y, z = (_whole(part) if _is_whole(part) else reading.value(part) for part in self.parts)
        return x, y, z

    def turned(self, vector: Vector, reading: NumberReading) -> Vector:
        """A vector of the template, as it is in the limb."""
        return apply(self.limb.matrix(reading), vector) if self.limb else vector


@dataclass(frozen=True)
class JointFormulas:
    """The formulas of a joint: its points, its axes, what its child's axis is in the child's frame, its pitch."""

    at: WrittenVector
    child_at: WrittenVector
    axes: tuple[WrittenVector, ...]
    child_axis: WrittenVector | None = None
    pitch: Formula | None = None

    def units(self, reading: NumberReading, directions: Directions) -> tuple[Vector, ...]:
        """Unit vectors of all steps, as a joint type makes them of those that are written, in the template."""
        made = directions([WrittenVector(axis.parts).unit(reading) for axis in self.axes])
        return tuple(self.at.turned(direction, reading) for direction in made)

    def turn(self, reading: NumberReading) -> Matrix:
        """Orientation (3, 3) of the child's frame in the parent's at value zero."""
        if self.child_axis is None:
            return UNTURNED
        return taking(self.child_axis.unit(reading), self.axes[0].unit(reading))


def share_of_turn(index: int, count: int) -> Formula:
    """The angle of one of so many limbs.

    >>> share_of_turn(1, 4).evaluate({})
    1.5707963267948966
    """
    parts = Number("2"), (("*", Pi()), ("*", Number(str(index))), ("/", Number(str(count))))
    return Formula(f"2*pi*{index}/{count}", Operands(*parts), frozenset())


def in_degrees(formula: Formula) -> Formula:
    """A plain number of degrees as the angle."""
    return Formula(formula.text, Operands(formula.root, (("*", Pi()), ("/", Number("180")))), formula.names)


def _is_whole(formula: Formula) -> bool:
    return is_zero(formula) or _is_one(formula)


def _whole(formula: Formula) -> int:
    root = formula.root
    return -int(float(root.of.text)) if _is_negative(root) else int(float(root.text))  # type: ignore[union-attr]


def _is_negative(root: Any) -> bool:
    return isinstance(root, Negative) and isinstance(root.of, Number)


def is_zero(formula: Formula) -> bool:
    """Whether a formula is a zero that is written out."""
    return _literal(formula) == 0.0


def _is_one(formula: Formula) -> bool:
    return _literal(formula) == 1.0


def _literal(formula: Formula) -> float | None:
    """The magnitude of a number that is written out; None of any other formula."""
    root = formula.root.of if isinstance(formula.root, Negative) else formula.root
    return float(root.text) if isinstance(root, Number) else None
