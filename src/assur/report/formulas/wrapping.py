"""Long formulas that wrap: their parts are rows that a browser sets on as many lines as the page has room for."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from xml.etree import ElementTree

from assur.report.formulas.mathml import tops

Element = ElementTree.Element
BREAKS = ("+", "−", "=", "≤", "≥", "∪", "∩")
"""Signs before which a line may end."""

SHORT = 24
"""Letters of a formula that no page is too narrow for."""


def wrapping(mathml: str) -> str:
    """A formula whose long rows are rows of parts, outside brackets first; a short one is as it was.

    >>> wrapping("<math><mrow><mi>a</mi></mrow></math>")
    '<math><mrow><mi>a</mi></mrow></math>'
    """
    opening = re.match(r"<math[^>]*>", mathml)
    if opening is None or _length(parts := tops(mathml)) <= SHORT:
        return mathml
    return f"{opening[0]}{_row(parts)}</math>"


def _row(parts: Sequence[Element]) -> str:
    """Parts side by side: as one row where nothing may break, else as rows that a line may end between."""
    groups = [list(group) for group in _groups(parts)] if _length(parts) > SHORT else []
    if len(groups) < 2:
        return f"<mrow>{''.join(map(_text, parts))}</mrow>"
    return f'<mrow class="wraps">{"".join(map(_row, groups))}</mrow>'


def _groups(parts: Sequence[Element]) -> Iterator[Sequence[Element]]:
    """The parts between signs that stand in the fewest brackets."""
    depths, depth = [], 0
    for part in parts:
        depth -= _is(part, ")]}")
        depths.append(depth)
        depth += _is(part, "([{")
    places = [k for k in range(1, len(parts)) if _is(parts[k], BREAKS) and parts[k].get("lspace") is None]
    least = min((depths[k] for k in places), default=0)
    ends = [k for k in places if depths[k] == least]
    for start, end in zip([0, *ends], [*ends, len(parts)], strict=True):
        if start:
            parts[start].set("form", "infix")
        yield parts[start:end]


def _is(part: Element, signs: Sequence[str]) -> bool:
    return part.tag == "mo" and bool(part.text) and part.text in signs


def _length(parts: Sequence[Element]) -> int:
    return sum(len("".join(part.itertext())) for part in parts)


def _text(part: Element) -> str:
    return ElementTree.tostring(part, encoding="unicode")
