"""The motion space of a serial chain: its pure translations T, and the directions Omega that it rotates about.

dim M = dim T + dim Omega. T is tracked from the end link towards the base: slides add their directions, two parallel
axes add a line perpendicular to them (criterion C1), and every turn turns what was found behind it. With more than
three blocks, the rotations depend on each other, and each relation between them is one more translation.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from assur.topology.symbolic.blocks import Block, Item, Structure
from assur.topology.symbolic.bundles import Bundles, bundles
from assur.topology.symbolic.elementary import Slide
from assur.topology.symbolic.spans import Span

Count = Mapping[int, int]
"""How many lines perpendicular to its axes each block adds, by the index of its first line; none if it is not in."""


def rotations(structure: Structure) -> Span:
    """Omega: the span of the directions of all axes.

    >>> from assur.topology.symbolic.blocks import structure
    >>> from assur.topology.symbolic.elementary import Turn
    >>> rotations(structure([Turn((0.0, 0.0, 1.0), "R1"), Turn((1.0, 0.0, 0.0), "R2")])).dim
    2
    """
    span = _rotations(structure.items).with_span(_carried(_rotations(structure.beyond), structure))
    for _ in structure.rods:
        span = span.with_line()
    return span


def _rotations(items: Sequence[Item]) -> Span:
    span = Span()
    for item in reversed(items):
        if isinstance(item, Slide):
            continue
        if item.net:
            span = span.turned(item.direction)
        span = span.with_span(_rotations(item.inner).turned(item.direction))
        span = span.with_line() if item.direction is None else span.with_direction(item.direction)
    return span


def translations(structure: Structure) -> Span:
    """T: the pure translations.

    >>> from assur.topology.symbolic.blocks import structure
    >>> from assur.topology.symbolic.elementary import Turn
    >>> z = (0.0, 0.0, 1.0)
    >>> translations(structure([Turn(z, "R1"), Turn(z, "R2"), Turn(z, "R3")])).fixed
    ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    """
    span = tracked(structure, _pairs(structure))
    turned = rotations(structure).dim
    if span.dim == 3 or len(structure.blocks) + len(structure.rods) <= turned:
        return span
    return _with_relations(structure, span, turned)


def _pairs(structure: Structure) -> Count:
    """Each parallel axis after the first of its block adds a line."""
    return {block.index: len(block.lines) - 1 for block in structure.blocks}


def tracked(structure: Structure, count: Count) -> Span:
    """Translations by slides and by parallel axes."""
    return _tracked(structure.items, count).with_span(_carried(_tracked(structure.beyond, count), structure))


def _carried(span: Span, structure: Structure) -> Span:
    """Directions of the end link, as it turns."""
    for axis in reversed(structure.axes):
        span = span.turned(axis)
    return span


def _tracked(items: Sequence[Item], count: Count) -> Span:
    """The same of some items, from the last towards the first."""
    span = Span()
    for item in reversed(items):
        if isinstance(item, Slide):
            span = span.with_span(item.span)
            continue
        inner = _tracked(item.inner, count)
        for _ in range(count.get(item.index, 0)):
            inner = inner.with_line(in_plane=item.direction)
        if item.net:
            span = span.turned(item.direction)
        span = span.with_span(inner.turned(item.direction))
    return span


def _with_relations(structure: Structure, span: Span, turned: int) -> Span:
    """T with the translations by relations between more rotations than are independent.

    They are general, unless all axes belong to one or two bundles: all through a point, none; through a point or
    parallel to u, all perpendicular to u; through two points, all perpendicular to the line that joins them.
    """
    of = bundles(structure)
    count = min(of.rank - turned, 3)
    if of.everything in of.points:
        return tracked(structure, {})
    beside = _block_beside_a_point(structure, of)
    if beside is not None:
        return tracked(structure, {beside.index: count})
    if any(first | second == of.everything for first in of.points for second in of.points):
        span = tracked(structure, {})
    else:
        lines = replace(structure, items=_without_slides(structure.items), beyond=_without_slides(structure.beyond))
        count -= tracked(lines, _pairs(structure)).dim
    for _ in range(count):
        span = span.with_line()
    return span


def _block_beside_a_point(structure: Structure, of: Bundles) -> Block | None:
    """The block that all axes belong to that do not run through one point."""
    for block, lines in zip(structure.blocks, of.blocks, strict=True):
        if block.direction is not None and any(point | lines == of.everything for point in of.points):
            return block
    return None


def _without_slides(items: Sequence[Item]) -> tuple[Item, ...]:
    return tuple(replace(item, inner=_without_slides(item.inner)) for item in items if isinstance(item, Block))
