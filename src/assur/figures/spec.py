"""What a figure is: an entry of the catalogue, its number, title and caption, and the drawing with its data."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from matplotlib.figure import Figure

from assur.figures.context import Context


@dataclass(frozen=True)
class FigureSpec:
    """A figure that a mechanism has: its name, the number it has in the source ("" for none), title and caption."""

    name: str
    number: str
    title: str
    caption: str


def always(_context: Context) -> str:
    """Every mechanism has this figure."""
    return ""


@dataclass(frozen=True, eq=False)
class Drawing:
    """A drawn figure and the numbers that it shows."""

    figure: Figure
    data: dict[str, Any]


@dataclass(frozen=True)
class FigureKind:
    """A kind of figure.

    Attributes:
        missing: why a mechanism has no such figure; empty where it has one. Must be quick.
        caption: what the figure shows, with units.
        draw: makes the drawing, inside `assur.figures.style.styled`.
    """

    name: str
    title: str
    missing: Callable[[Context], str]
    caption: Callable[[Context], str]
    draw: Callable[[Context], Drawing]
