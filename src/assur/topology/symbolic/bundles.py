"""Bundles: axes through one point, or parallel to one another; how many of a chain's axes are independent.

The rotations about all axes of a bundle make a group of three freedoms (a sphere, or a plane), and two bundles
always share one: the line that joins two points, the line through a point parallel to others, the translation along
which two planes meet. Axes that are general otherwise depend on each other in no other way.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations

from assur.topology.symbolic.blocks import Block, Structure


@dataclass(frozen=True)
class Bundles:
    """The lines of a chain as bits, and the bundles as sets of bits.

    Attributes:
        count: number of lines.
        points: lines through each common point.
        blocks: lines parallel to each block, in the order of `Structure.blocks`.
    """

    count: int
    points: tuple[int, ...]
    blocks: tuple[int, ...]

    @property
    def everything(self) -> int:
        """All lines."""
        return (1 << self.count) - 1

    @property
    def rank(self) -> int:
        """Number of independent lines: min(n, 3 + those outside one bundle, 5 + those outside two, 6).

        >>> Bundles(6, points=(0b111, 0b111000), blocks=()).rank
        5
        """
        large = [bundle for bundle in (*self.points, *self.blocks) if bundle.bit_count() >= 3]
        outside_one = [3 + self.count - bundle.bit_count() for bundle in large]
        outside_two = [5 + self.count - (first | second).bit_count() for first, second in combinations(large, 2)]
        return min(self.count, 6, *outside_one, *outside_two)


def bundles(structure: Structure) -> Bundles:
    """The bundles of a chain's lines."""
    blocks = structure.blocks
    lines = [*(line for block in blocks for line in block.lines), *structure.rods]
    bits = {line.index: 1 << place for place, line in enumerate(lines)}
    points: dict[int, int] = {}
    for line in lines:
        for point in line.points:
            points[point] = points.get(point, 0) | bits[line.index]
    families = [_family(block, structure) for block in blocks]
    return Bundles(len(lines), tuple(points.values()), tuple(_union(bits, family) for family in families))


def _family(block: Block, structure: Structure) -> tuple[Block, ...]:
    """The blocks parallel to a block: itself, and one on the other side of a spherical joint."""
    if block.direction is None or not structure.beyond:
        return (block,)
    fixed = structure.along(block.direction)
    return fixed if any(block is other for other in fixed) else (block,)


def _union(bits: dict[int, int], blocks: Iterable[Block]) -> int:
    return sum(bits[line.index] for block in blocks for line in block.lines)
