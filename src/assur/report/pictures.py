"""The figures of a mechanism as pictures for a page."""

from __future__ import annotations

import io

from PIL import Image

from assur.figures import catalogue as figures
from assur.figures.context import Context
from assur.figures.encode import encoded
from assur.results.kinds import Picture

DOTS_PER_INCH = 240
ENLARGED = 1.25
"""Figures are drawn for a journal's column; a screen is read from farther away."""

CSS_INCH = 96


def pictures(context: Context, name: str) -> tuple[Picture, ...]:
    """The figure of that name, or none where the mechanism has none; the report numbers it."""
    if name not in figures.names(context.record, context):
        return ()
    spec = figures.spec(context.record, name, context)
    figure = figures.draw(context.record, name, context)
    width, height = (round(float(size) * CSS_INCH * ENLARGED) for size in figure.get_size_inches())
    png = _with_palette(encoded(figure, "png", DOTS_PER_INCH))
    return (Picture(spec.name, "", spec.title, spec.caption, png, width, height),)


def _with_palette(png: bytes) -> bytes:
    """The same picture in 256 colours of its own: a third of the size, and no difference to see."""
    picture = Image.open(io.BytesIO(png)).convert("RGB")
    reduced = picture.quantize(256, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    stream = io.BytesIO()
    reduced.save(stream, "png", optimize=True)
    return stream.getvalue()
