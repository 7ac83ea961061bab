"""Direction marks: how the directions of a POC set are named by joints, as the papers print them."""

from __future__ import annotations

from collections.abc import Iterable

from assur.topology.directions import NAMED, Vector, parallel
from assur.topology.poc import Mark
from assur.topology.symbolic.blocks import Block, Structure
from assur.topology.symbolic.spans import Span

MOVING = Mark("moving")


def translation_mark(span: Span, *chains: Structure) -> Mark:
    """The mark of translations: along slides, perpendicular to axes, or moving.

    Args:
        span: their directions.
        chains: whose joints may be named, the first one first.

    >>> from assur.topology.symbolic.blocks import structure
    >>> from assur.topology.symbolic.elementary import Turn
    >>> z = (0.0, 0.0, 1.0)
    >>> translation_mark(Span((), 1, z), structure([Turn(z, "R1")])).relation
    'arm'
    """
    if span.dim in (0, 3):
        return Mark()
    if span.is_fixed and span.dim == 1:
        return Mark("parallel", (_slide_along(span.fixed[0], chains) or name_of(span.fixed[0], chains),), span.fixed)
    if span.is_fixed:
        slides = () if _block_along(span.normal, chains) else _slides_in(span, chains)
        if slides:
            return Mark("plane", slides, span.fixed)
        return Mark("perpendicular", (name_of(span.normal, chains),), span.fixed)
    if span.dim == 1 and span.plane is not None:
        slides = () if _block_along(span.plane, chains) else _slides_in(span, chains)
        return Mark("plane", slides[:1]) if slides else Mark("arm", (name_of(span.plane, chains),))
    return MOVING


def rotation_mark(span: Span, *chains: Structure) -> Mark:
    """The mark of rotations: along one axis, or in the plane of two."""
    if span.dim in (0, 3):
        return Mark()
    if span.dim == 1:
        return Mark("parallel", (name_of(span.fixed[0], chains),), span.fixed) if span.is_fixed else MOVING
    for chain in chains:
        lines = [*(block.lines[0] for block in chain.blocks), *chain.rods]
        if len(lines) == 2:
            return Mark("plane", tuple(dict.fromkeys(line.name for line in lines)), span.fixed if span.is_fixed else ())
    return MOVING


def name_of(direction: Vector, chains: Iterable[Structure]) -> str:
    """A joint along a direction of the base, or else the direction itself."""
    block = _block_along(direction, chains)
    if block is not None:
        return block.name
    named = [name for name, axis in NAMED.items() if parallel(axis, direction)]
    return named[0] if named else "({:.3g}, {:.3g}, {:.3g})".format(*direction)


def _block_along(direction: Vector, chains: Iterable[Structure]) -> Block | None:
    return next((block for chain in chains for block in chain.along(direction)), None)


def _slide_along(direction: Vector, chains: Iterable[Structure]) -> str:
    """The first joint that slides along a direction."""
    return next((slide.name for chain in chains for slide in chain.slides if slide.span.contains(direction)), "")


def _slides_in(span: Span, chains: Iterable[Structure]) -> tuple[str, ...]:
    """The first joints of one chain that slide in a plane and make it, or of a line that turns in a plane."""
    for chain in chains:
        total, names = Span(), []
        for slide in chain.slides:
            larger = total.with_span(slide.span)
            if larger.dim > total.dim:
                total = larger
                names.append(slide.name)
            if total == span or (total.is_fixed and total.dim == span.dim == 2 and parallel(total.normal, span.normal)):
                return tuple(dict.fromkeys(names))
    return ()
