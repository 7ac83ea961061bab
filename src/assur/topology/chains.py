"""Chains from base to platform, as topology sees them: joints with directions, parallelograms, inner loops.

Nothing here has dimensions. Axes are unit vectors in the base frame at the configuration as written; equal
axes are distinct parallel lines unless a label says that they share a point.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from assur.errors import UnknownNameError, UsageError
from assur.joints.joint_type import JointType
from assur.topology.directions import EXACT, Vector, parallel

ParallelogramKind = Literal["4R", "4S", "4U", "2US"]

FREEDOMS_OF_PARALLELOGRAM: dict[str, int] = {"4R": 1, "4S": 4, "4U": 3, "2US": 4}
"""Freedoms of a parallelogram as one generalised joint; the spins of the rods of a P(4S) are not counted."""


@dataclass(frozen=True)
class ChainJoint:
    """A joint of a chain.

    Attributes:
        axes: unit vectors, as many as its type has written: two for U, the first fixed in the link before it.
        point: label of a point that the axis runs through, or that is the centre; equal labels are one point.
        through: labels of further points that each axis runs through; none where nothing more is said.
        name: how it is printed, "R3": unique in its mechanism.
        general: the axes were left open, and `axes` holds arbitrary ones.

    Errors:
        UsageError: another number of axes; axes that are not unit vectors; parallel axes of a U; a P with a point.
    """

    type: JointType
    axes: tuple[Vector, ...]
    point: str = ""
    name: str = ""
    general: bool = False
    through: tuple[tuple[str, ...], ...] = ()

    def __post_init__(self) -> None:
        letter, count = self.type.letter, len(self.axes)
        if count != self.type.axes:
            raise UsageError(f"{count} axes for {letter}; expected {self.type.axes}")
        for axis in self.axes:
            _refuse_unless_unit(axis)
        if self.type.turns == 2 and parallel(self.axes[0], self.axes[1]):
            raise UsageError(f"parallel axes {self.axes} of a {letter}; expected different ones", hint="they are one R")
        if (self.point or self.through) and not self.type.turning:
            raise UsageError(f"a point '{self.point}' for {letter}; expected none: a translation has no place")
        if len(self.through) not in (0, count):
            raise UsageError(f"points on {len(self.through)} axes of {letter}; expected them for each of {count}")

    @property
    def directions(self) -> tuple[Vector, ...]:
        """Those of its steps: its axes, and what its type makes of them."""
        return self.type.directions(self.axes)

    @property
    def freedoms(self) -> int:
        """f_i of Eq. (3)."""
        return self.type.freedoms

    def points_on(self, axis: int) -> tuple[str, ...]:
        """Labels of the points that one of its axes runs through, a centre first."""
        further = self.through[axis] if self.through else ()
        return (self.point, *further) if self.point else further


@dataclass(frozen=True)
class Parallelogram:
    """Four hinges and two equal rods between two links, counted as one generalised joint.

    `axis` is the direction of the hinges of a P(4R). Of a P(4S), P(4U) or P(2US) it is the direction of the
    short links, about which the rods swing sideways; it stays fixed in both links that the rods join. `bar` is the
    name of the first rod of a P(4R), where other chains lead to it.
    """

    kind: ParallelogramKind
    axis: Vector
    name: str = ""
    general: bool = False
    bar: str = ""

    def __post_init__(self) -> None:
        if self.kind not in FREEDOMS_OF_PARALLELOGRAM:
            raise UnknownNameError("parallelogram", self.kind, FREEDOMS_OF_PARALLELOGRAM)
        _refuse_unless_unit(self.axis)

    @property
    def freedoms(self) -> int:
        """Freedoms as a generalised joint."""
        return FREEDOMS_OF_PARALLELOGRAM[self.kind]


@dataclass(frozen=True)
class InnerLoop:
    """Branches side by side between one link and the loop's output link, such as the 2P4R of an HSOC.

    `name` is what a planar loop's rotation is called: R12, after the joints R1 and R2 of its first branch.
    """

    branches: tuple[tuple[Element, ...], ...]
    name: str = ""

    def __post_init__(self) -> None:
        if len(self.branches) < 2 or not all(self.branches):
            lengths = [len(branch) for branch in self.branches]
            raise UsageError(f"a loop of branches with {lengths} elements; expected two branches or more, none empty")


Element = ChainJoint | Parallelogram | InnerLoop

BASE, PLATFORM = "base", "platform"
"""Names of the links that limbs lead from and to."""


@dataclass(frozen=True)
class Chain:
    """Elements from one link to another, of a limb from base to platform, and the text that they were read from."""

    elements: tuple[Element, ...]
    text: str = ""
    start: str = BASE
    end: str = PLATFORM

    @property
    def is_limb(self) -> bool:
        """Whether it leads from the base to the platform."""
        return (self.start, self.end) == (BASE, PLATFORM)

    @property
    def joints(self) -> tuple[ChainJoint | Parallelogram, ...]:
        """Every joint in the order of the text, branches flattened: what `limb.joint` counts from 1."""
        return tuple(flattened(self.elements))


def flattened(elements: tuple[Element, ...]) -> Iterator[ChainJoint | Parallelogram]:
    """The joints of some elements, those of inner loops branch by branch."""
    for element in elements:
        if isinstance(element, InnerLoop):
            for branch in element.branches:
                yield from flattened(branch)
        else:
            yield element


def _refuse_unless_unit(axis: Vector) -> None:
    if not abs(math.hypot(*axis) - 1) < EXACT:
        raise UsageError(f"the axis {axis}; expected a unit vector", hint="directions.unit gives one")
