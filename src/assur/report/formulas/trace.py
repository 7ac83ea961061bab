"""Recorded numbers: what a kernel computes, kept as it is written, with values at random points beside it.

A kernel that is read over `Traced` numbers returns its own formulas. SymPy would put terms into its own
order and multiply brackets out; here (x + b - d)/l4 stays what the source prints. The values serve to
recognise a letter of the source wherever it turns up: two formulas that agree at random complex points
are the same quantity (a false agreement has probability zero).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from assur.numerics.powers import whole_power

Values = NDArray[np.complex128]
Operator = Literal["number", "letter", "+", "-", "*", "/", "neg", "sqrt"]
CLOSE = 1e-9
POINTS = 8
"""Random points at which every number is known."""


@dataclass(frozen=True)
class Letter:
    """A symbol: a name, or the cosine or sine of an angle's name; `mathml` is how it is written."""

    name: str
    mathml: str
    function: Literal["", "cos", "sin", "sgn"] = ""


@dataclass(eq=False)
class Book:
    """The letters that may be recognised, and the formula of each that has been met, in that order.

    Attributes:
        known: letters with their values, those that come first winning.
        met: letter -> the formula that it stood for where it was met first.
    """

    known: list[tuple[Letter, Values]] = field(default_factory=list)
    met: dict[Letter, Traced] = field(default_factory=dict)

    def letter_of(self, values: Values) -> Letter | None:
        """The letter with these values, if there is one."""
        if not self.known:
            return None
        with np.errstate(invalid="ignore"):
            same = np.all(np.abs(self._table - values) <= CLOSE * np.abs(self._table), axis=1)
        return self.known[int(np.argmax(same))][0] if np.any(same) else None

    @cached_property
    def _table(self) -> Values:
        """The values of all known letters (k, POINTS)."""
        return np.array([values for _, values in self.known])


@dataclass(frozen=True, eq=False)
class Traced:
    """A number with its formula: an operator, its parts, and the values (POINTS,) at the random points.

    >>> from assur.report.formulas.normal import text
    >>> x = leaf(Book(), Letter("x", "<mi>x</mi>"), np.arange(1.0, 9.0))
    >>> text((x + 1) / 2 - 3 * x * x)
    '(x + 1)/2 - 3 x^2'
    """

    book: Book
    operator: Operator
    parts: tuple[Traced, ...]
    values: Values
    letter: Letter | None = None

    def __add__(self, other: Any) -> Traced:
        return self._make("+", self, self._number(other))

    def __radd__(self, other: Any) -> Traced:
        return self._make("+", self._number(other), self)

    def __sub__(self, other: Any) -> Traced:
        return self._make("-", self, self._number(other))

    def __rsub__(self, other: Any) -> Traced:
        return self._make("-", self._number(other), self)

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)

    def __mul__(self, other: Any) -> Traced:
        return self._make("*", self, self._number(other))

    def __rmul__(self, other: Any) -> Traced:
        return self._make("*", self._number(other), self)

    def __truediv__(self, other: Any) -> Traced:
        return self._make("/", self, self._number(other))

    def __rtruediv__(self, other: Any) -> Traced:
        return self._make("/", self._number(other), self)

    def __neg__(self) -> Traced:
        return self._make("neg", self)

    def __pos__(self) -> Traced:
        return self

    def _number(self, value: Any) -> Traced:
        return value if isinstance(value, Traced) else number(self.book, value)

    def _make(self, operator: Operator, *parts: Traced) -> Traced:
        return made(self.book, operator, *parts)


@dataclass(frozen=True)
class Tracing:
    """The namespace of a kernel that is read over recorded numbers."""

    book: Book

    def sqrt(self, radicand: Traced | float, /) -> Traced | float:
        """Square root: any of the two complex ones, the sign of a branch standing before it; of 4 the number 2."""
        if isinstance(radicand, Traced):
            return made(self.book, "sqrt", radicand)
        root = math.sqrt(radicand)
        return root if root.is_integer() else made(self.book, "sqrt", number(self.book, radicand))


_RULES: dict[str, Callable[..., Values]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
    "neg": np.negative,
    "sqrt": np.sqrt,
}


def number(book: Book, value: float) -> Traced:
    """A plain number."""
    return Traced(book, "number", (), np.full(POINTS, value, dtype=complex))


def leaf(book: Book, letter: Letter, values: Any) -> Traced:
    """A letter that stands for itself."""
    return Traced(book, "letter", (), np.asarray(values, dtype=complex), letter)


def made(book: Book, operator: Operator, *parts: Traced) -> Traced:
    """The result of an operation; a letter where the book knows one with these values."""
    with np.errstate(divide="ignore", invalid="ignore"):
        values = _RULES[operator](*(part.values for part in parts))
    result = Traced(book, operator, parts, values)
    if not np.any(values):
        return number(book, 0.0)
    if len(parts) == 2 and (same := _unchanged(operator, *parts)):
        return same
    letter = None if _is_power(result) else book.letter_of(values)
    if letter is None:
        return result
    book.met.setdefault(letter, result)
    return leaf(book, letter, values)


def _unchanged(operator: Operator, first: Traced, second: Traced) -> Traced | None:
    """The part that is the whole: of x + 0, x - 0, 1 x, x 1, x/1."""
    neutral = {"+": 0.0, "-": 0.0, "*": 1.0, "/": 1.0}[operator]
    if second.operator == "number" and second.values[0] == neutral:
        return first
    return second if operator in "+*" and first.operator == "number" and first.values[0] == neutral else None


def _is_power(term: Traced) -> bool:
    """A power of one letter, perhaps with a number: better written so than by another letter."""
    letters = list(_factors(term))
    return len(letters) > 1 and len(set(letters)) == 1 and letters[0] is not None


def _factors(term: Traced) -> list[Letter | None]:
    """The letters of a product, None for whatever else is in it."""
    if term.operator in ("*", "/", "neg"):
        return [letter for part in term.parts for letter in _factors(part)]
    return [] if term.operator == "number" else [term.letter]
