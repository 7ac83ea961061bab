"""Blocks: neighbouring parallel axes, which stay parallel as the chain moves, and the lines that they are.

Only axes with nothing but slides and parallel axes between them keep their angle to each other: consecutive
blocks are never parallel, however they were written. Lines keep a common point only while nothing between them
moves it off.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from assur.topology.directions import Vector, parallel
from assur.topology.symbolic.elementary import Elementary, Slide
from assur.topology.symbolic.meeting import GENERAL, Line, meeting


@dataclass(frozen=True)
class Block:
    """Parallel axes.

    Attributes:
        direction: of the axes; None for a single axis with any direction.
        lines: the distinct axes; coaxial ones are one line.
        inner: what stands between the first and the last.
        net: whether it turns what follows; False where the axes together leave it unturned.
    """

    direction: Vector | None
    lines: tuple[Line, ...]
    inner: tuple[Item, ...] = ()
    net: bool = True

    @property
    def name(self) -> str:
        """The joint that marks name."""
        return self.lines[0].name

    @property
    def index(self) -> int:
        """The number of its first line, which no other block of its chain has."""
        return self.lines[0].index


Item = Slide | Block


@dataclass(frozen=True)
class Structure:
    """A chain from base to end link as slides and blocks.

    Attributes:
        items: in the order of the chain.
        beyond: what stands behind a spherical joint, in order from the end link, where the end link's orientations
            are known; else it is among the items.
        axes: the rotations of those orientations, in order from the base.
        rods: lines along the rods of parallelograms, which turn nothing.
        end: the point O' on the last axis (or its centre); GENERAL where the last axis does not keep it.
        ends: labels of points of the last axis, and the points.
    """

    items: tuple[Item, ...]
    rods: tuple[Line, ...] = ()
    end: int = GENERAL
    beyond: tuple[Item, ...] = ()
    axes: tuple[Vector, ...] = ()
    ends: tuple[tuple[str, int], ...] = ()

    @property
    def blocks(self) -> tuple[Block, ...]:
        """The blocks from base to end link, those inside another one after it."""
        return tuple(_blocks((*self.items, *self.beyond)))

    @property
    def slides(self) -> tuple[Slide, ...]:
        """The slides from base to end link."""
        return tuple(_slides((*self.items, *self.beyond[::-1])))

    def along(self, direction: Vector) -> tuple[Block, ...]:
        """The blocks that are parallel to a direction of the base, and stay so."""
        behind = self.beyond if all(parallel(axis, direction) for axis in self.axes) else ()
        first = (_first_along(direction, items) for items in (self.items, behind))
        return tuple(block for block in first if block is not None)

    def with_sphere(self, point: int) -> Structure:
        """The chain with a spherical joint at a point of its end link behind it."""
        lines = [*(line for block in self.blocks for line in block.lines), *self.rods]
        start = 1 + max((line.index for line in lines), default=0)
        sphere = [Block(None, (Line(start + extra, "O'", frozenset({point})),)) for extra in range(3)]
        return replace(self, items=(*self.items, *sphere))


def structure(chain: Sequence[Elementary]) -> Structure:
    """Slides and turns gathered into blocks.

    >>> from assur.topology.symbolic.elementary import Turn
    >>> z = (0.0, 0.0, 1.0)
    >>> [len(block.lines) for block in structure([Turn(z, "R1"), Turn(z, "R2")]).blocks]
    [2]
    """
    meets = meeting(chain)
    items: list[Item] = []
    rods: list[Line] = []
    opened: Block | None = None
    after: list[Item] = []
    left = iter(meets.lines)
    for item in chain:
        if isinstance(item, Slide):
            after.append(item)
            continue
        line = next(left)
        if not item.finite:
            rods.append(line)
        elif opened is not None and parallel(opened.direction, item.direction):
            lines = opened.lines if line in opened.lines else (*opened.lines, line)
            opened, after = Block(opened.direction, lines, (*opened.inner, *after)), []
        else:
            items += [*([opened] if opened else []), *after]
            opened, after = Block(item.direction, (line,)), []
    items += [*([opened] if opened else []), *after]
    return Structure(tuple(items), tuple(rods), meets.end, ends=meets.ends)


def mirrored(chain: Structure) -> Structure:
    """The chain as it is seen from its end link."""
    return Structure(backwards(chain.items), chain.rods)


def backwards(items: Sequence[Item]) -> tuple[Item, ...]:
    """Items in order from their other end."""
    return tuple(_mirrored(item) for item in reversed(items))


def _mirrored(element: Item) -> Item:
    if isinstance(element, Slide):
        return element
    return replace(element, lines=element.lines[::-1], inner=backwards(element.inner))


def _first_along(direction: Vector, items: Iterable[Item]) -> Block | None:
    """The block along a direction that nothing before it turns."""
    for item in items:
        if isinstance(item, Block):
            if parallel(item.direction, direction):
                return item
            if item.net:
                return None
    return None


def _blocks(items: Iterable[Item]) -> Iterator[Block]:
    for item in items:
        if isinstance(item, Block):
            yield item
            yield from _blocks(item.inner)


def _slides(items: Iterable[Item]) -> Iterator[Slide]:
    for item in items:
        if isinstance(item, Block):
            yield from _slides(item.inner)
        else:
            yield item
