"""Directions that what is given turns: their components have names, so that equations in them are short."""

from __future__ import annotations

from collections.abc import Sequence

import sympy

from assur.derivation.definitions import Definition, FreeNames
from assur.derivation.symbols import GivenSymbols
from assur.derivation.trigonometric import shorter
from assur.numerics.vectors import Vector


class NamedDirections:
    """Names for sums of what is given.

    Args:
        symbols: what is given.
        posed: entries of the platform's rotation, which have names already.
    """

    def __init__(self, symbols: GivenSymbols, posed: Sequence[Definition] = ()) -> None:
        record = symbols.record
        taken = {*record.parameters, *(driven.name for driven in record.inputs), *record.platform.pose}
        self._symbols, self._posed = symbols, tuple(posed)
        self._names = FreeNames(taken | {own.symbol.name for own in posed})
        self._known: dict[sympy.Expr, Definition] = {}
        self._given = {symbol for pair in symbols.circles for symbol in pair} | {own.symbol for own in posed}

    @property
    def definitions(self) -> tuple[Definition, ...]:
        """What has a name, in the order of computation."""
        return (*self._posed, *self._known.values())

    def turned(self, part: sympy.Expr) -> bool:
        """Whether what is given is in a component."""
        return bool(sympy.sympify(part).free_symbols & self._given)

    def vector(self, vector: Vector) -> Vector:
        """A vector, its components that are sums by names; those in which anything is unknown stay as they are."""
        parts = {sympy.Symbol(axis): sympy.expand(part) for axis, part in zip("xyz", vector, strict=True)}
        x, y, z = map(self._name, shorter(parts, self._symbols.circles, self._symbols.witness).values())
        return x, y, z

    def _name(self, part: sympy.Expr) -> sympy.Expr:
        known = self._given | {*self._symbols.parameters.values()}
        if not part.has(sympy.Add) or not self.turned(part) or not part.free_symbols <= known:
            return part
        if -part in self._known:
            return -self._known[-part].symbol
        if part not in self._known:
            own = self._known[part] = Definition(self._names.numbered("u"), sympy.factor_terms(part))
            self._given.add(own.symbol)
            self._symbols.witness.define(own.symbol, own.formula)
        return self._known[part].symbol
