"""Which orientations an end link takes, and what is left of a chain that is held to fewer.

A chain of one block turns about a fixed axis, a chain of two about one fixed in the base and one fixed in the end
link, and a chain of three takes every orientation. In a mechanism the platform takes what all limbs allow, and a
block whose turning is no part of that leaves the links behind it unturned.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from assur.topology.directions import Vector, coplanar, parallel
from assur.topology.symbolic.blocks import Block, Item, Structure, backwards
from assur.topology.symbolic.refusals import Refusal


@dataclass(frozen=True)
class Orientations:
    """A set of orientations, all of which contain the one as written.

    Attributes:
        dim: its dimension.
        axes: the rotations that make it, in order from the base: about one axis, or about one fixed in the base and
            then one fixed in the end link. Empty for the one orientation, for all of them, and for a set that
            has no such axes.
    """

    dim: int
    axes: tuple[Vector, ...] = ()

    def meet(self, other: Orientations) -> Orientations | Refusal:
        """The orientations in both sets.

        >>> x, y, z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
        >>> Orientations(2, (x, y)).meet(Orientations(2, (x, z)))
        Orientations(dim=1, axes=((1.0, 0.0, 0.0),))
        """
        small, large = sorted((self, other), key=lambda orientations: orientations.dim)
        if small.dim == 0 or large.dim == 3:
            return small
        if not small.axes or not large.axes:
            return Orientations(max(0, small.dim + large.dim - 3))
        shared = [axis for axis in small.axes if any(parallel(axis, direction) for direction in large.axes)]
        if small.dim == 1:
            return small if shared else UNTURNED
        if len(shared) == 2:
            return small if parallel(small.axes[0], large.axes[0]) else Refusal(SEVERAL)
        return Orientations(1, tuple(shared))


UNTURNED = Orientations(0)
"""The platform keeps its orientation."""

EVERY = Orientations(3)
"""The platform takes every orientation."""

SEVERAL = "the limbs turn about the same two axes in opposite orders, so there are several operation modes"


def orientations(structure: Structure) -> Orientations:
    """The orientations that the end link of a chain takes."""
    axes = [block.direction for block in structure.items if isinstance(block, Block)]
    if len(axes) > 2:
        return EVERY
    return Orientations(len(axes), tuple(axis for axis in axes if axis is not None))


def returns(structure: Structure) -> bool:
    """Whether an axis is parallel to an earlier one, as written, with others between."""
    axes = [block.direction for block in structure.blocks if block.direction is not None]
    return any(parallel(first, second) for first, second in combinations(axes, 2))


def turn_alike(first: Structure, second: Structure) -> bool:
    """Whether links inside two chains with one end link are parallel, because both turn about the same axes."""
    axes, others = _turning_axes(first), _turning_axes(second)
    return 1 < len(axes) == len(others) < 4 and all(map(parallel, axes, others))


def _turning_axes(structure: Structure) -> list[Vector | None]:
    return [block.direction for block in structure.items if isinstance(block, Block) and block.net]


def held(structure: Structure, to: Orientations) -> Structure | Refusal:
    """A chain whose end link takes only some of the orientations that it could take.

    Blocks that leave what follows unturned are marked so. First and last axes of three blocks that were written
    parallel stay parallel where the end link turns about nothing else, and are one block from then on.
    """
    blocks = [block for block in structure.items if isinstance(block, Block)]
    if to.dim in (3, len(blocks)) or (to.dim and not to.axes):
        return structure
    last = _last_of_sphere(blocks)
    if last is not None and (len(blocks) > 3 or last.direction is None):
        place = next(index for index, item in enumerate(structure.items) if item is last) + 1
        behind = backwards(structure.items[place:])
        return replace(structure, items=structure.items[:place], beyond=behind, axes=to.axes)
    if len(blocks) > 3:
        return Refusal("more than three blocks of axes are held to the orientations of the platform")
    if len(blocks) < 3:
        return _with_blocks(structure, [replace(block, net=_is_among(block, to)) for block in blocks])
    return _held_three(structure, blocks, to)


def _held_three(structure: Structure, blocks: Sequence[Block], to: Orientations) -> Structure | Refusal:
    """Three blocks have one way to each orientation, near the one as written."""
    axes = [block.direction for block in blocks if block.direction is not None]
    first, middle, last = axes
    if parallel(first, last):
        if to.dim == 0 or (to.dim == 1 and parallel(first, to.axes[0])):
            return _wrapped(structure, blocks, to.dim == 1)
    elif coplanar(first, middle, last):
        return Refusal("three axes in one plane as written are held to the orientations of the platform")
    for still in ((0, 1, 2), (1, 2), (0, 2), (0, 1), (2,), (1,), (0,)):
        moving = [axis for index, axis in enumerate(axes) if index not in still]
        if len(moving) == to.dim and all(map(parallel, moving, to.axes)):
            return _with_blocks(structure, [replace(block, net=i not in still) for i, block in enumerate(blocks)])
    return structure


def _wrapped(structure: Structure, blocks: Sequence[Block], net: bool) -> Structure:
    """First and last block as one, around everything between them."""
    first, last = (structure.items.index(block) for block in (blocks[0], blocks[2]))
    between = [replace(item, net=False) if item is blocks[1] else item for item in structure.items[first + 1 : last]]
    around = Block(
        blocks[0].direction,
        (*blocks[0].lines, *(line for line in blocks[2].lines if not line.points & blocks[0].lines[-1].points)),
        (*blocks[0].inner, *between, *blocks[2].inner),
        net,
    )
    items = (*structure.items[:first], around, *structure.items[last + 1 :])
    return replace(structure, items=items)


def axes_that_may_rest(structure: Structure) -> tuple[Block, ...]:
    """Axes of a chain with a held end link that turn only against others.

    They are the first and last axes that were made one block around the rest, and axes on either side of a spherical
    joint, which turns back what they turn.
    """
    blocks = [item for item in structure.items if isinstance(item, Block)]
    around = (block for block in blocks if any(isinstance(other, Block) for other in block.inner))
    sphere = sphere_of(structure)
    before = blocks[: -len(sphere)] if sphere else ()
    behind = (item for item in structure.beyond if isinstance(item, Block))
    return (*around, *before, *behind)


def sphere_of(structure: Structure) -> tuple[Block, ...]:
    """The three blocks, last among the items, that turn a held end link back; empty without them."""
    blocks = tuple(item for item in structure.items if isinstance(item, Block))
    last = _last_of_sphere(blocks)
    return blocks[-3:] if last is not None and last is blocks[-1] else ()


def at_rest(structure: Structure, axes: Block) -> Structure:
    """The chain where axes that may rest do not turn it, although they could."""
    return _with_items_in_place_of(axes, (replace(axes, inner=(), net=False), *axes.inner), structure)


def without_axes(structure: Structure, axes: Block) -> Structure:
    """The chain without axes that may rest."""
    return _with_items_in_place_of(axes, axes.inner, structure)


def without_still_axes(structure: Structure) -> Structure:
    """The chain without axes that keep what follows unturned, each of which turns against no parallel one."""
    items: list[Item] = []
    for item in structure.items:
        still = isinstance(item, Block) and not item.net and len(item.lines) == 1
        items += item.inner if still and isinstance(item, Block) else (item,)
    return replace(structure, items=tuple(items))


def _with_items_in_place_of(block: Block, items: tuple[Item, ...], structure: Structure) -> Structure:
    """The chain with other items where a block stands, before its spherical joint or behind it."""

    def replaced(among: tuple[Item, ...]) -> tuple[Item, ...]:
        return tuple(own for item in among for own in (items if item is block else (item,)))

    return replace(structure, items=replaced(structure.items), beyond=replaced(structure.beyond))


def _last_of_sphere(blocks: Sequence[Block]) -> Block | None:
    """The last of three axes through one point that can take every orientation already as written."""
    for three in reversed(list(zip(blocks, blocks[1:], blocks[2:], strict=False))):
        if len(three[2].lines) == 1 and set.intersection(*map(_points, three)) and _independent(three):
            return three[2]
    return None


def _points(block: Block) -> set[int]:
    return {point for line in block.lines for point in line.points}


def _independent(blocks: Sequence[Block]) -> bool:
    axes = [block.direction for block in blocks]
    return any(axis is None for axis in axes) or not coplanar(*(axis for axis in axes if axis is not None))


def _is_among(block: Block, to: Orientations) -> bool:
    return any(parallel(block.direction, axis) for axis in to.axes)


def _with_blocks(structure: Structure, blocks: Sequence[Block]) -> Structure:
    left = iter(blocks)
    return replace(structure, items=tuple(next(left) if isinstance(i, Block) else i for i in structure.items))
