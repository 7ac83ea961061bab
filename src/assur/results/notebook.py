"""Tables as notebooks and terminals show them: HTML with a picture beside it, and text in columns."""

from __future__ import annotations

import base64
import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from html import escape
from importlib import import_module
from typing import Any

from assur.errors import UsageError

DOTS = 110
"""Of a picture per inch."""

Rows = Sequence[Sequence[object]]
"""Of a table; each cell is shown as `str` gives it."""


def html_table(title: str, columns: Sequence[str], rows: Rows, png: bytes = b"") -> str:
    """A table with its title, and a picture below it where there is one.

    >>> html_table("a < b", ("x",), ((1,),))
    '<table><caption>a &lt; b</caption><tr><th>x</th></tr><tr><td>1</td></tr></table>'
    """
    head = "".join(f"<th>{escape(column)}</th>" for column in columns)
    body = "".join(f"<tr>{''.join(f'<td>{escape(str(cell))}</td>' for cell in row)}</tr>" for row in rows)
    table = f"<table><caption>{escape(title)}</caption><tr>{head}</tr>{body}</table>"
    if not png:
        return table
    return f'{table}<img alt="{escape(title)}" src="data:image/png;base64,{base64.b64encode(png).decode("ascii")}">'


def text_table(title: str, columns: Sequence[str], rows: Rows) -> str:
    """The same as text, columns two spaces apart.

    >>> print(text_table("t", ("name", "value"), (("l1", 2.5),)))
    t
    name  value
    l1    2.5
    """
    cells = [[str(cell) for cell in row] for row in (columns, *rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in cells]
    return "\n".join([title, *(line.rstrip() for line in lines)] if columns else [title])


def pictured(figure: Any) -> bytes:
    """A figure as a PNG file of a size for notebooks; nothing where there is none."""
    if figure is None:
        return b""
    png: bytes = import_module("assur.figures.encode").encoded(figure, "png", DOTS)
    return png


Entries = Sequence[Mapping[str, object]]
"""Of a table, row by row: each cell by the name of its column, the same names in every row."""
SHOWN = 24
"""So many rows are shown; a data frame has all of them."""

ROUNDING = 1e-15
"""What is less than this share of the largest number of its column, or of what is its size, is rounding."""


def cells(entries: Entries, sizes: Mapping[str, float] | None = None) -> tuple[tuple[str, ...], list[list[object]]]:
    """Columns and rows as they are shown: numbers to six digits, rounding as 0, and how many rows are not shown.

    `sizes` are of columns of which all numbers may be rounding.

    >>> cells([{"x": 1 / 3, "mode": "+"}, {"x": 1e-17, "mode": "-"}])
    (('x', 'mode'), [['0.333333', '+'], ['0', '-']])
    """
    columns = tuple(entries[0]) if entries else ()
    numbers = [[cell for row in entries if isinstance(cell := row[name], float)] for name in columns]
    largest = [
        max([(sizes or {}).get(name, 0.0), *(abs(number) for number in column if math.isfinite(number))])
        for name, column in zip(columns, numbers, strict=True)
    ]
    rows: list[list[object]] = [
        [_shown(cell, ROUNDING * most) for cell, most in zip(row.values(), largest, strict=True)] for row in entries
    ]
    if len(rows) > SHOWN:
        rows[SHOWN:] = [[f"and {len(rows) - SHOWN} more", *[""] * (len(columns) - 1)]]
    return columns, rows


def _shown(cell: object, least: float) -> object:
    if not isinstance(cell, float):
        return cell
    return f"{0.0 if abs(cell) < least else cell + 0.0:.6g}"


def data_frame(entries: Entries) -> Any:
    """All rows as a `pandas.DataFrame`.

    Errors:
        UsageError: pandas is not installed.
    """
    try:
        pandas = import_module("pandas")
    except ImportError:
        raise UsageError("a data frame needs pandas, which is not installed", hint="pip install pandas") from None
    return pandas.DataFrame(list(entries))


class Tabulated(ABC):
    """An answer that is read as a table: printed, in a notebook, as a data frame."""

    @abstractmethod
    def _title(self) -> str:
        """What the table is of."""

    @abstractmethod
    def _entries(self) -> Entries:
        """Its rows."""

    def _sizes(self) -> Mapping[str, float]:
        """How large numbers of a column are, where all of them may be rounding."""
        return {}

    def _picture(self) -> Any:
        """A figure of it, or None."""
        return None

    def __str__(self) -> str:
        return text_table(self._title(), *cells(self._entries(), self._sizes()))

    def _repr_html_(self) -> str:
        return html_table(self._title(), *cells(self._entries(), self._sizes()), pictured(self._picture()))

    def to_dataframe(self) -> Any:
        """The table as a `pandas.DataFrame`, one row for each pose, moment or name.

        Errors:
            UsageError: pandas is not installed.
        """
        return data_frame(self._entries())
