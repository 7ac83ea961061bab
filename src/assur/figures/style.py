"""Style: one page width, one family of letters, one palette for every figure, safe for colour-blind readers."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

MILLIMETRE = 1 / 25.4
"""In inches."""

PAGE = 175.0
"""Width of two columns, in mm."""

INK = "#1a1a1a"
GREY = "#7f7f7f"
PALE = "#d9d9d9"
PAPER = "#ffffff"
ORANGE = "#e69f00"
SKY = "#6cbcec"
GREEN = "#009466"
BLUE = "#004c8c"
RED = "#b83c00"
PINK = "#c46a9c"
SERIES = (BLUE, RED, GREEN, ORANGE, PINK, SKY)
"""Colours that stay apart for every reader, the first four in grey too, in the order in which they are used."""

SMALL = 7.0
TEXT = 8.0
LETTER = 9.0
"""Font sizes in points: notes, text, letters of points."""

DOTS_PER_INCH = 250
"""Pixels per inch of files, and of shaded pictures inside them."""

_SETTINGS: Any = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": TEXT,
    "axes.titlesize": TEXT,
    "axes.labelsize": TEXT,
    "xtick.labelsize": SMALL,
    "ytick.labelsize": SMALL,
    "legend.fontsize": SMALL,
    "axes.linewidth": 0.6,
    "lines.linewidth": 1.0,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "text.color": INK,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "legend.frameon": False,
    "legend.handlelength": 1.6,
    "figure.dpi": 72.0,
    "savefig.dpi": DOTS_PER_INCH,
    "pdf.fonttype": 42,
    "pdf.compression": 4,
    "svg.fonttype": "path",
    "svg.hashsalt": "assur",
    "axes.unicode_minus": True,
    "hatch.linewidth": 0.5,
}


@contextlib.contextmanager
def styled() -> Iterator[None]:
    """The settings of every figure, for as long as it is made; the user's own are as before afterwards."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_SETTINGS)
        yield


def new_figure(width: float, height: float) -> Figure:
    """An empty figure of width x height mm that no global list of figures knows, so that nothing need close it."""
    figure = Figure(figsize=(width * MILLIMETRE, height * MILLIMETRE), dpi=72)
    FigureCanvasAgg(figure)
    return figure
