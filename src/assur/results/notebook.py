"""Tables as notebooks and terminals show them: HTML with a picture beside it, and text in columns."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from html import escape

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
    return "\n".join([title, *(line.rstrip() for line in lines)])
