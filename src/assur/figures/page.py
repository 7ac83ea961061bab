"""The page: widths that journals print, how many panels stand side by side on one, and the legend above them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from assur.errors import UsageError
from assur.figures.style import MILLIMETRE, PAGE, SMALL

WIDTHS = {"ieee": 88.9, "ieee2": 182.0, "elsevier": 90.0, "elsevier1.5": 140.0, "elsevier2": 190.0}
"""Of the columns and pages of journals, in mm."""

NARROWEST, WIDEST = 80.0, 1000.0
"""Of a page in mm: on a narrower one numbers of axes and words of figures do not stand beside one another at 7 pt."""

HIGHEST = 235.0
"""Of a figure with many panels in mm: the height of a journal's page."""

COLUMNS = 4
"""Of a legend at most."""

EDGE = 1.0
"""White between a legend and what is about it, in mm."""


def page_width(text: str) -> float:
    """The width in mm that a word or a number stands for; "" is the usual one.

    Errors:
        UsageError: neither the name of a width nor a number of mm from 80 to 1000.

    >>> page_width("ieee"), page_width("120"), page_width("")
    (88.9, 120.0, 175.0)
    """
    if not text:
        return PAGE
    try:
        width = WIDTHS[text] if text in WIDTHS else float(text)
    except ValueError:
        width = math.nan
    if not NARROWEST <= width <= WIDEST:
        raise UsageError(
            f"'{text}' is no width of a page", hint=f"one of {', '.join(WIDTHS)}, or {NARROWEST:g} to {WIDEST:g} in mm"
        )
    return width


def side_by_side(page: float, usual: int, least: float) -> int:
    """How many panels, each with a share of at least so many mm, stand in a row of a page in mm: as usual, or fewer.

    >>> side_by_side(175.0, 3, 55.0), side_by_side(140.0, 3, 55.0), side_by_side(88.9, 3, 55.0)
    (3, 2, 1)
    """
    return max(1, min(usual, int(page / least)))


def legend_above(figure: Figure, handles: Sequence[Any], **more: Any) -> None:
    """A legend over all that is drawn: the figure grows by its height; as many columns as its width has room for."""
    if not handles:
        return
    width, height = figure.get_size_inches()
    renderer = FigureCanvasAgg(figure).get_renderer()  # type: ignore[no-untyped-call]  # matplotlib does not say
    for columns in range(min(COLUMNS, len(handles)), 0, -1):
        legend = figure.legend(
            handles=handles, loc="upper center", ncols=columns, fontsize=SMALL, borderaxespad=0.4, **more
        )
        extent = legend.get_window_extent(renderer)
        if extent.width <= figure.dpi * (width - 2 * EDGE * MILLIMETRE) or columns == 1:
            break
        legend.remove()
    grown = height + extent.height / figure.dpi + EDGE * MILLIMETRE
    for axes in figure.axes:
        place = axes.get_position(original=True)
        axes.set_position((place.x0, place.y0 * height / grown, place.width, place.height * height / grown))
    for text in figure.texts:
        text.set_y(text.get_position()[1] * height / grown)
    figure.set_size_inches(width, grown)
