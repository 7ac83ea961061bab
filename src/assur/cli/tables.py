"""Tables in which no number is ever cut: one that is too wide for a terminal is printed in parts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rich.console import Console, ConsoleOptions, RenderResult
from rich.table import Table
from rich.text import Text

BETWEEN = 2
"""Spaces between columns."""

LONGEST = 30
"""A longer word may be broken, where its column may be broken into lines; no number is as long."""


class WholeTable(Table):
    """A table whose cells are `Text`; a column that may not wrap is as wide as its widest cell.

    Where these columns do not fit beside each other, a terminal gets blocks of columns below one another, the first
    column in front of each. Elsewhere the lines are as long as they must be, so that a program reads one table.
    """

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        width, cells = options.max_width, [_texts(column.header, column.cells) for column in self.columns]
        least = [_least(texts, column.no_wrap) for texts, column in zip(cells, self.columns, strict=True)]
        most = [max(_widest(text) for text in texts) for texts in cells]
        blocks = _blocks(least, width) if console.is_terminal else [list(range(len(least)))]
        for place, block in enumerate(blocks):
            if place:
                yield ""
            widths = _widths([least[k] for k in block], [most[k] for k in block], width)
            part = Table(
                title=None if place else self.title,
                title_justify=self.title_justify,
                box=self.box,
                pad_edge=False,
                collapse_padding=True,
                show_edge=False,
                header_style=self.header_style,
            )
            wrapped = [
                [_wrapped(text, size, console) for text in cells[k]] for k, size in zip(block, widths, strict=True)
            ]
            for k, texts in zip(block, wrapped, strict=True):
                part.add_column(texts[0], justify=self.columns[k].justify, no_wrap=True)
            for row, *texts in zip(self.rows, *(texts[1:] for texts in wrapped), strict=True):
                part.add_row(*texts, style=row.style)
            wide = max(width, sum(widths) + BETWEEN * len(widths))
            yield from console.render(part, options.update(width=wide, max_width=wide) if wide > width else options)


def _texts(header: object, cells: Iterable[object]) -> list[Text]:
    """The header and the cells of a column."""
    return [item if isinstance(item, Text) else Text(str(item)) for item in (header, *cells)]


def _widest(text: Text) -> int:
    return max((line.cell_len for line in text.split("\n", allow_blank=True)), default=0)


def _least(texts: Sequence[Text], whole: bool) -> int:
    """The least width of a column: of its widest cell, or of its longest word where it may be broken into lines."""
    if whole:
        return max(_widest(text) for text in texts)
    words = [Text(word).cell_len for text in texts for word in text.plain.split()]
    return min(max(words, default=0), LONGEST)


def _blocks(least: Sequence[int], width: int) -> list[list[int]]:
    """Columns that fit beside each other in `width`, the first of all in front of each block.

    >>> _blocks([4, 10, 10, 10, 10], 30)
    [[0, 1, 2], [0, 3, 4]]
    >>> _blocks([4, 50, 10], 30)
    [[0, 1], [0, 2]]
    """
    blocks, used = [[0]], least[0]
    for k in range(1, len(least)):
        if len(blocks[-1]) > 1 and used + BETWEEN + least[k] > width:
            blocks.append([0])
            used = least[0]
        blocks[-1].append(k)
        used += BETWEEN + least[k]
    return blocks


def _widths(least: Sequence[int], most: Sequence[int], width: int) -> list[int]:
    """Widths between the least and the most that fill `width` where they can: the broadest columns give way first.

    >>> _widths([4, 5, 5], [4, 30, 8], 30)
    [4, 14, 8]
    """
    room = width - BETWEEN * (len(least) - 1)
    level = max(most)
    while level > 0 and sum(_level(least, most, level)) > room:
        level -= 1
    return _level(least, most, level)


def _level(least: Sequence[int], most: Sequence[int], level: int) -> list[int]:
    return [min(high, max(low, level)) for low, high in zip(least, most, strict=True)]


def _wrapped(text: Text, width: int, console: Console) -> Text:
    """The same with line breaks, so that no line is wider."""
    if _widest(text) <= width:
        return text
    lines = Text("\n").join(text.wrap(console, width, justify="default", overflow="fold"))
    lines.justify = text.justify
    return lines
