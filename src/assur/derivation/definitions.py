"""Definitions: symbols and the formulas that they stand for."""

from __future__ import annotations

from dataclasses import dataclass

import sympy


@dataclass(frozen=True)
class Definition:
    """A symbol, the formula that it stands for, and why, in a few words."""

    symbol: sympy.Symbol
    formula: sympy.Expr
    meaning: str = ""


class FreeNames:
    """Names that nothing has yet.

    >>> names = FreeNames({"a1"})
    >>> names.numbered("a"), names.numbered("a"), names.named("det"), names.named("det")
    (a1_, a2, det, det_)
    """

    def __init__(self, taken: set[str]) -> None:
        self._taken = taken
        self._counts: dict[str, int] = {}

    def numbered(self, letter: str) -> sympy.Symbol:
        """A symbol of a letter and the next number."""
        self._counts[letter] = self._counts.get(letter, 0) + 1
        return self.named(f"{letter}{self._counts[letter]}")

    def named(self, name: str) -> sympy.Symbol:
        """A symbol of that name, or one with a low line after it."""
        while name in self._taken:
            name += "_"
        self._taken.add(name)
        return sympy.Symbol(name, real=True)
