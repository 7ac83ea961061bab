"""The symbols of a derivation: dimensions and what is given, and the joints' geometry as formulas of them."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

import sympy

from assur.derivation.witness import ModularWitness
from assur.joint_graph.geometry import Geometry, written_geometry
from assur.kinematics.modes import Problem
from assur.model.formula import parse
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION
from assur.model.written import NumberReading
from assur.numerics.prime_field import SIMPLE

SHORT = 999
"""Numerator and denominator of a rational whose root a decimal of fifteen digits is told by."""
Circle = tuple[sympy.Symbol, sympy.Symbol]
"""Cosine and sine of an angle."""


def circle_of(name: str) -> Circle:
    """GivenSymbols of the cosine and the sine of an angle."""
    return sympy.Symbol(f"cos_{name}", real=True), sympy.Symbol(f"sin_{name}", real=True)


def abs_of(symbol: sympy.Expr) -> sympy.Symbol:
    """The symbol of a symbol or of its negative."""
    return next(iter(symbol.free_symbols))


@lru_cache(maxsize=1024)
def _literal(text: Any) -> sympy.Expr:
    """A number of a file; of the digits of a root of a short rational this root: so turned axes stay units.

    >>> _literal("-0.8660254037844386"), _literal("0.8660"), _literal("0.3333333333333333")
    (-sqrt(3)/2, 433/500, 1/3)
    """
    own = sympy.Rational(text)
    exact = Fraction(int(own.p), int(own.q)) ** 2
    square = exact.limit_denominator(SHORT)
    if square.numerator > SHORT or abs(exact - square) > 4 * Fraction(SIMPLE) * square:
        return own
    return sympy.sign(own) * sympy.sqrt(sympy.Rational(square.numerator, square.denominator))


def _exact(part: Any) -> sympy.Expr:
    """A component without floats; cos^2 + sin^2 is 1 under its roots, as in the length of an axis."""
    return sympy.nsimplify(part).replace(
        lambda own: own.is_Pow and not own.exp.is_Integer and own.has(sympy.sin),
        lambda own: sympy.trigsimp(own.base) ** own.exp,
    )


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

    def __post_init__(self) -> None:
        self.witness.sizes, self.witness.dimensions = self.sizes, frozenset(self.parameters.values())
        self.draw(self.witness)

    @cached_property
    def parameters(self) -> dict[str, sympy.Symbol]:
        """Name of a dimension -> its symbol."""
        positive = {"positive": True, "nonnegative": None, "any": None}
        return {
            name: sympy.Symbol(name, real=True, positive=positive[parameter.sign])
            for name, parameter in self.record.parameters.items()
        }

    @cached_property
    def stated(self) -> dict[sympy.Symbol, sympy.Expr]:
        """Symbols of dimensions that are formulas of others in the file, and these."""
        record, reading = self.record, NumberReading(self.parameters, sympy, _literal)
        entries = tomllib.loads(record.description.text)["parameters"] if record.description else {}
        return {
            self.parameters[name]: reading.value(parse(entry["value"]))
            for name, entry in entries.items()
            if isinstance(entry["value"], str) and name not in record.overrides
        }

    @cached_property
    def geometry(self) -> Geometry:
        """Points, axes and turns of all joints."""
        reading = NumberReading(self.parameters, sympy, _literal)
        return written_geometry(self.record, reading).mapped(_exact)

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

    @property
    def quaternion(self) -> tuple[sympy.Symbol, ...]:
        """Components of a unit quaternion that is given."""
        posed = self.record.platform.pose if self.problem == "inverse" else ()
        return tuple(sympy.Symbol(name, real=True) for name in QUATERNION if name in posed)

    @cached_property
    def radicands(self) -> list[Fraction]:
        """Numbers whose roots are in axes and turns of the joints."""
        joints = self.geometry.joints.values()
        vectors = [vector for own in joints for vector in (own.at, own.child_at, *own.axes, *own.turn)]
        powers = {part for vector in vectors for own in vector for part in sympy.sympify(own).atoms(sympy.Pow)}
        bases = {part.base for part in powers if part.base.is_Rational and part.base > 0 and not part.exp.is_Integer}
        return sorted(Fraction(int(base.p), int(base.q)) for base in bases)

    @cached_property
    def sizes(self) -> tuple[sympy.Expr, ...]:
        """Squares of the lengths of axes that are formulas of dimensions."""
        axes = [part for own in self.geometry.joints.values() for axis in own.axes for part in axis]
        powers = {part for own in axes for part in sympy.sympify(own).atoms(sympy.Pow) if part.exp.q == 2}
        return tuple(sorted({part.base for part in powers if part.base.free_symbols}, key=str))

    def draw(self, witness: ModularWitness) -> None:
        """Values of what is given and is not free: cosine and sine of an angle, a unit quaternion."""
        witness.with_roots(self.radicands)
        for cosine, sine in self.circles:
            witness.on_circle(cosine, sine)
        if self.quaternion:
            witness.on_sphere(self.quaternion)

    @cached_property
    def place(self) -> dict[str, sympy.Symbol]:
        """Coordinate of the platform's point -> its symbol, where the pose is given."""
        if self.problem == "direct":
            return {}
        return {name: sympy.Symbol(name, real=True) for name in self.record.platform.pose if name in LENGTHS}
