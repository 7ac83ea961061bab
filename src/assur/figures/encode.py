"""Files of a figure: PNG, PDF and SVG as bytes. The same figure gives the same bytes, for there is no date in them."""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import Any

from matplotlib.figure import Figure

from assur.errors import UnknownNameError
from assur.figures.style import DOTS_PER_INCH, styled

_METADATA: Mapping[str, dict[str, Any]] = {
    "png": {"Software": None},
    "pdf": {"Creator": "assur", "Producer": None, "CreationDate": None},
    "svg": {"Creator": "assur", "Date": None},
}
FORMATS = ("png", "pdf", "svg", "tex", "json")
USUAL = ("png", "pdf", "tex", "json")
"""Those of which files are written unless others are asked for."""


def encoded(figure: Figure, form: str, dots: int = DOTS_PER_INCH) -> bytes:
    """A figure as a PNG, PDF or SVG file; `dots` per inch for pixels.

    >>> from assur.figures.style import new_figure
    >>> encoded(new_figure(10, 10), "png")[1:4]
    b'PNG'
    """
    if form not in _METADATA:
        raise UnknownNameError("picture format", form, _METADATA)
    stream = io.BytesIO()
    with styled():
        packed: Any = {"pil_kwargs": {"compress_level": 4}} if form == "png" else {}
        figure.savefig(stream, format=form, dpi=dots, metadata=_METADATA[form], **packed)
    return stream.getvalue()
