"""The symbols of a derivation: dimensions and what is given, and the joints' geometry as formulas of them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy

from assur.derivation.witness import ModularWitness
from assur.joint_graph.geometry import Geometry, written_geometry
from assur.kinematics.modes import Problem
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS
from assur.model.written import NumberReading
from assur.numerics.vectors import Matrix, about_x, about_y, about_z, product

Circle = tuple[sympy.Symbol, sympy.Symbol]
"""Cosine and sine of an angle."""


def circle_of(name: str) -> Circle:
    """GivenSymbols of the cosine and the sine of an angle."""
    return sympy.Symbol(f"cos_{name}", real=True), sympy.Symbol(f"sin_{name}", real=True)


def abs_of(symbol: sympy.Expr) -> sympy.Symbol:
    """The symbol of a symbol or of its negative."""
    return next(iter(symbol.free_symbols))


@dataclass(frozen=True, eq=False)
class GivenSymbols:
    """What is known at first.

    Attributes:
        record: the mechanism.
        problem: what is asked.
        witness: values of all symbols.
    """

    record: MechanismRecord
    problem: Problem
    witness: ModularWitness

    @cached_property
    def parameters(self) -> dict[str, sympy.Symbol]:
        """Name of a dimension -> its symbol."""
        positive = {"positive": True, "nonnegative": None, "any": None}
        return {
            name: sympy.Symbol(name, real=True, positive=positive[parameter.sign])
            for name, parameter in self.record.parameters.items()
        }

    @cached_property
    def geometry(self) -> Geometry:
        """Points, axes and turns of all joints."""
        reading = NumberReading(self.parameters, sympy, sympy.Rational)
        return written_geometry(self.record, reading).mapped(sympy.nsimplify)

    @cached_property
    def locked(self) -> dict[int, Any]:
        """Index in the joint values -> the length, or the circle, of an input that is given."""
        if self.problem == "inverse":
            return {}
        own: dict[int, Any] = {}
        for driven in self.record.inputs:
            if driven.coordinate.kind == "length":
                offset = sympy.nsimplify(driven.offset, rational=True)
                own[driven.coordinate.index] = (sympy.Symbol(driven.name, real=True) - offset) * int(driven.sign)
            else:
                cosine, sine = circle_of(driven.name)
                self.witness.on_circle(cosine, sine)
                own[driven.coordinate.index] = cosine, int(driven.sign) * sine
        return own

    @property
    def circles(self) -> list[Circle]:
        """Cosine and sine of each angle that is given."""
        angles = [value for value in self.locked.values() if isinstance(value, tuple)]
        posed = self.record.platform.pose if self.problem == "inverse" else ()
        return [(cosine, abs_of(sine)) for cosine, sine in angles] + [
            circle_of(name) for name in posed if name in ANGLES
        ]

    @property
    def given(self) -> list[sympy.Symbol]:
        """Symbols of the inputs, or of the pose where that is given, in the file's order; of angles cosine and sine."""
        driven = [own.name for own in self.record.inputs]
        names = driven if self.problem == "direct" else [*self.record.platform.pose]
        circles = {own for circle in self.circles for own in circle}
        return [
            symbol
            for name in names
            for symbol in (circle_of(name) if circle_of(name)[0] in circles else (sympy.Symbol(name, real=True),))
        ]

    @cached_property
    def place(self) -> dict[str, sympy.Symbol]:
        """Coordinate of the platform's point -> its symbol, where the pose is given."""
        if self.problem == "direct":
            return {}
        return {name: sympy.Symbol(name, real=True) for name in self.record.platform.pose if name in LENGTHS}

    @cached_property
    def orientation(self) -> Matrix | None:
        """The platform's, where the pose gives one."""
        if self.problem == "direct" or not {*ANGLES} & {*self.record.platform.pose}:
            return None
        turns: dict[str, Any] = dict.fromkeys(ANGLES, (1, 0))
        for name in self.record.platform.pose:
            if name in ANGLES:
                turns[name] = circle_of(name)
                self.witness.on_circle(*turns[name])
        return product(product(about_z(turns["phi"]), about_y(turns["theta"])), about_x(turns["psi"]))
