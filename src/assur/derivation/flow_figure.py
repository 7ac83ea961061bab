r"""The flow of information as a figure of LaTeX's own `picture`: a box for each step, arrows from what it takes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from assur.derivation.formula_latex import width
from assur.derivation.written_parts import FlowNode

LEFT, BOX, STEP, HIGH = 24, 44, 13, 7
"""Millimetres: where boxes begin, how wide they are, from one to the next, and how high."""
LANE = 3
"""Millimetres between the lines that pass by boxes."""
LETTERS = 24
"""So many letters a box takes on its line; more are set smaller."""
LANES = 3


def flow_figure(nodes: Sequence[FlowNode]) -> str:
    r"""The figure, about a column wide.

    >>> text = flow_figure([FlowNode("Set 1", "x", ("a",), ()), FlowNode("", "y", ("b",), (0,))])
    >>> text.count(r"\framebox"), text.count(r"\vector")
    (2, 3)
    """
    height = STEP * len(nodes)
    lines = [
        r"\setlength{\unitlength}{1mm}",
        rf"\begin{{picture}}({LEFT + BOX + (LANES + 1) * LANE},{height})(0,0)",
        *_lines(nodes),
        r"\end{picture}",
    ]
    return "\n".join(lines)


def _lines(nodes: Sequence[FlowNode]) -> Iterator[str]:
    count = len(nodes)
    lane = 0
    for k, own in enumerate(nodes):
        low = STEP * (count - 1 - k) + (STEP - HIGH) / 2
        head = f"{own.name}: " if own.name else ""
        small = r"\scriptsize" if width(own.gives) + len(head) > LETTERS else r"\small"
        yield rf"\put({LEFT},{low}){{\framebox({BOX},{HIGH}){{{small} {head}${own.gives}$}}}}"
        if own.given:
            middle = low + HIGH / 2
            given = ", ".join(own.given)
            small = r"\scriptsize" if width(given) > LETTERS // 3 else r"\small"
            yield rf"\put({LEFT - 5},{middle}){{\makebox(0,0)[r]{{{small} ${given}$}}}}"
            yield rf"\put({LEFT - 4},{middle}){{\vector(1,0){{4}}}}"
        for source in own.before:
            if source == k - 1:
                yield rf"\put({LEFT + BOX / 2},{low + STEP}){{\vector(0,-1){{{STEP - HIGH}}}}}"
            else:
                lane += 1
                yield from _past(low, count, source, (lane - 1) % LANES + 1)


def _past(low: float, count: int, source: int, lane: int) -> Iterator[str]:
    """A line from a box past others to one further down, each a little apart from the one before."""
    shift = 1.0 - lane / 2
    start, end = STEP * (count - 1 - source) + STEP / 2 - 1.0 + shift, low + HIGH / 2 + 1.0 + shift
    right, out = LEFT + BOX, lane * LANE
    yield rf"\put({right},{start}){{\line(1,0){{{out}}}}}"
    yield rf"\put({right + out},{start}){{\line(0,-1){{{start - end}}}}}"
    yield rf"\put({right + out},{end}){{\vector(-1,0){{{out}}}}}"
