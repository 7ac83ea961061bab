"""Figures: drawn from the joint graph and from the analyses, each also as data.

`catalogue(record)` lists them, `draw(record, name)` makes one, `write(record, folder)` makes files.
"""

from assur.figures.catalogue import catalogue, draw, drawing, left_out, names, spec, write
from assur.figures.context import Context
from assur.figures.encode import encoded
from assur.figures.spec import Drawing, FigureSpec

__all__ = [
    "Context",
    "Drawing",
    "FigureSpec",
    "catalogue",
    "draw",
    "drawing",
    "encoded",
    "left_out",
    "names",
    "spec",
    "write",
]
