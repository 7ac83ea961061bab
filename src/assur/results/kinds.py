"""The kinds of result: scalar, facts, table, matrix, formula, picture. Outer layers render them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

PROVED = "proved by interval arithmetic"
EXACT = "exact: counted"
RANK = "rank by singular values"
TWO_RESOLUTIONS = "estimate: difference of two resolutions"
FLOATING = "floating point"
RIGHTS = ("proved", "exact", "rank", "estimate", "floating point", "not proved")
"""With one of these begins how a number is known."""


@dataclass(frozen=True)
class Scalar:
    """One number with its unit and by what right it is known.

    Attributes:
        name, value, unit: what it is; the value is None where it does not exist, or where only bounds are known.
        known_by: by what right, beginning with one of `RIGHTS`.
        error: estimate of its error, in its unit.
        low, high: proved bounds, None where there are none; both the value itself of a count that is proved.
        note: what else there is to say: of what it is the number, what agrees with it.
    """

    name: str
    value: float | None
    unit: str = ""
    known_by: str = ""
    error: float | None = None
    low: float | None = None
    high: float | None = None
    note: str = ""


@dataclass(frozen=True)
class Facts:
    """Things said in words: (label, text) pairs."""

    title: str
    items: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class PrintedFormula:
    """A line of mathematics as MathML, with what it says and its number in the source and in the report."""

    mathml: str
    equation: str = ""
    meaning: str = ""
    number: str = ""

    @property
    def words(self) -> str:
        """What it says, the number that it has in the source before it.

        >>> PrintedFormula("", "(7)", "a length").words
        'Eq. (7) of the source: a length'
        """
        source = f"Eq. ({self.equation.strip('()')}) of the source" if self.equation else ""
        return ": ".join(part for part in (source, self.meaning) if part)


@dataclass(frozen=True)
class Formulas:
    """Formulas that belong together, one under the other."""

    title: str
    lines: tuple[PrintedFormula, ...]
    caption: str = ""


Cell = str | float | None | PrintedFormula
"""Of a table: text, a number, None (does not exist) or mathematics."""


@dataclass(frozen=True)
class Table:
    """Rows under column titles."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    caption: str = ""
    marks: tuple[str, ...] = ()
    """Per row: "", "ok", "wrong" or "missing", for colour; never the only carrier of meaning."""

    folded: bool = False
    """Whether only the title need be seen at first."""

    known_by: str = ""
    """By what right its numbers are known, beginning with one of `RIGHTS`; of volumes, areas and counts always."""


@dataclass(frozen=True, eq=False)
class Matrix:
    """A small matrix (r, k) with the names of its rows and columns."""

    name: str
    values: FloatArray
    rows: tuple[str, ...] = ()
    columns: tuple[str, ...] = ()


@dataclass(frozen=True)
class Picture:
    """A drawn figure as PNG, with its number, and in words for who cannot see it."""

    name: str
    number: str
    title: str
    caption: str
    png: bytes
    width: int
    height: int


@dataclass(frozen=True)
class Section:
    """A titled group of results, plain text before them, and sections inside it."""

    title: str
    text: str = ""
    results: Sequence[Result | Section] = field(default_factory=tuple)


Result = Scalar | Facts | Table | Matrix | Formulas | Picture
