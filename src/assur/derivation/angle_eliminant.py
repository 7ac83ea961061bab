"""The eliminant of a coupled set: a polynomial in the tangent of half an angle, as a program of polynomials."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

import sympy

from assur.derivation.definitions import Definition
from assur.derivation.linear import Form, value_of
from assur.derivation.trigonometric import homogeneous
from assur.derivation.unknown_directions import UnknownDirection


@dataclass(frozen=True)
class AngleEliminant:
    """One polynomial in the tangent of half an angle.

    Attributes:
        direction: the circle whose angle it is.
        known: formulas before it, in which the angle does not occur.
        entries: polynomials in its cosine and its sine.
        steps: polynomials in the entries; the last is the eliminant, which vanishes.
        unknowns: which the lines say by Cramer's rule; of two and more steps the first is the determinant.
        quadric: that vanishes beside the lines, with a symbol for each product of unknowns; {} where none is left.
        spare: how often 1 + t^2 divides it, where cosine, sine and 1 are 1 - t^2, 2 t and 1 + t^2.
        degree: in t, without these.
        divisors: of steps and of what follows those by which it is divided at a root.
        backward: polynomials in entries and steps of which unknowns are quotients at a root.
    """

    direction: UnknownDirection
    known: tuple[Definition, ...]
    entries: tuple[Definition, ...]
    steps: tuple[Definition, ...]
    unknowns: tuple[sympy.Symbol, ...] = ()
    quadric: Form = field(default_factory=dict)
    spare: int = 0
    degree: int = 0
    divisors: tuple[sympy.Symbol, ...] = ()
    backward: tuple[Definition, ...] = ()

    @property
    def left_quadric(self) -> sympy.Expr:
        """What vanishes beside the lines, 0 where nothing is left."""
        return value_of(self.quadric)

    @property
    def named_lines(self) -> tuple[Form, ...]:
        """Lines with names for their coefficients, where they are written so."""
        return ()

    def program(self, one: sympy.Expr) -> tuple[Definition, ...]:
        """Entries and steps, as homogeneous polynomials in the cosine, the sine and what stands for 1."""
        if one not in self._programs:
            self._programs[one] = tuple(self._program(one))
        return self._programs[one]

    def backward_program(self, one: sympy.Expr) -> tuple[Definition, ...]:
        """The same of what follows at a root."""
        degrees = dict.fromkeys(self.direction.unknowns, 1)
        whole = [*self._homogeneous((*self.entries, *self.steps, *self.backward), degrees, one)]
        return tuple(whole[len(self.entries) + len(self.steps) :])

    @cached_property
    def _programs(self) -> dict[sympy.Expr, tuple[Definition, ...]]:
        return {}

    def _program(self, one: sympy.Expr) -> Iterator[Definition]:
        yield from self._homogeneous((*self.entries, *self.steps), dict.fromkeys(self.direction.unknowns, 1), one)

    def _homogeneous(
        self, definitions: tuple[Definition, ...], degrees: dict[sympy.Symbol, int], one: sympy.Expr
    ) -> Iterator[Definition]:
        for own in definitions:
            formula, degrees[own.symbol] = homogeneous(own.formula, degrees, one)
            yield Definition(own.symbol, formula, own.meaning)
