"""Sizes of quantities: the scales against which a closed form judges zero."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy

from assur.derivation.not_derived import NotDerivedError
from assur.derivation.solution import AnalyticSolution
from assur.model.pose import LENGTHS

LEAST = 1e-3
"""Share of the sum of all magnitudes that a quantity counts as where it is less at home, which may be singular."""


@dataclass(frozen=True, eq=False)
class Sizes:
    """How large quantities of a mechanism are, and in which power of the length unit.

    Attributes:
        solution: of the inverse problem.
        inputs: those of the direct problem that are lengths.
    """

    solution: AnalyticSolution
    inputs: frozenset[sympy.Symbol]

    @cached_property
    def reference(self) -> tuple[str, float]:
        """The largest length among the dimensions, as a formula and in size; of those that are positive, if any are.

        Errors:
            NotDerivedError: no dimension is a length.
        """
        record = self.solution.symbols.record
        lengths = {
            name: parameter for name, parameter in record.parameters.items()
            if parameter.unit == record.unit and parameter.value and not parameter.drawn_only
        }  # fmt: skip
        if not lengths:
            raise NotDerivedError("no parameter is a length, and scales are multiples of one: give lengths names")
        positive = [name for name, parameter in lengths.items() if parameter.sign == "positive"]
        name = max(positive or lengths, key=lambda own: abs(lengths[own].value))
        return name if positive else f"sqrt({name}*{name})", abs(lengths[name].value)

    @cached_property
    def lengths(self) -> set[sympy.Symbol]:
        """GivenSymbols that are lengths."""
        record = self.solution.symbols.record
        parameters = self.solution.symbols.parameters
        own = {parameters[name] for name, parameter in record.parameters.items() if parameter.unit == record.unit}
        own |= {sympy.Symbol(name, real=True) for name in LENGTHS} | {*self.solution.loops.lengths.values()}
        return own | self.inputs

    def unit(self, value: sympy.Expr) -> int:
        """Power of the length unit: the greatest among the terms of a sum, where a plain number may be a length too."""
        if value.is_Add:
            return max(map(self.unit, value.args))
        if value.is_Mul:
            return sum(map(self.unit, value.args))
        if value.is_Pow:
            return int(self.unit(value.base) * value.exp)
        return int(value in self.lengths)

    def scale(self, value: sympy.Expr, at_home: float | None = None) -> str:
        """The sum of the magnitudes of its terms over a power of the largest length.

        Args:
            value: the quantity, in the unknowns of the inverse problem and what is given.
            at_home: what its terms add up to at home, if that is known. Of products of sums the magnitudes multiply to
                far more than any configuration has.
        """
        name, length = self.reference
        unit = self.unit(value)
        size = self._size(value)
        if at_home is not None:
            size = min(size, max(at_home, LEAST * size))
        size /= length**unit
        factors = [name] * max(unit, 0)
        number = f"{size:.2g}"
        plain = number if "e" not in number else f"{size:.6f}"
        return "*".join([plain, *factors]) + "".join(f"/{name}" for _ in range(-min(unit, 0)))

    def _size(self, value: sympy.Expr) -> float:
        if value.is_Add:
            return sum(map(self._size, value.args))
        if value.is_Mul:
            size = 1.0
            for part in value.args:
                size *= self._size(part)
            return size
        if value.is_Pow:
            return float(self._size(value.base) ** float(value.exp))
        if value.is_Symbol:
            return self._of_symbol(value)
        return abs(float(value)) if value.is_number else 1.0  # cosine or sine of an angle among the dimensions

    def _of_symbol(self, symbol: sympy.Symbol) -> float:
        record = self.solution.symbols.record
        if symbol.name in record.parameters:
            return abs(record.parameters[symbol.name].inside)
        return self.reference[1] if symbol in self.lengths else 1.0
