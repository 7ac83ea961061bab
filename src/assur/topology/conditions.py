"""Geometric conditions of a mechanism that its motion needs: which axes are parallel, at right angles, and which meet.

Each is broken in turn, all else as it is: one axis is turned away, or the parallel axes of a limb together, or a common
point is given up. Where F and t, r, dim of the POC set stay what they were, the condition is an accident of how the
limbs are drawn.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import combinations

import numpy as np

from assur.errors import AssurError
from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.directions import EXACT, Vector, cross, dot, parallel, unit
from assur.topology.screws.assembly_equations import Hold
from assur.topology.screws.modes import operation_modes
from assur.topology.screws.placing import place

AWAY = 0.3
"""How far (rad, about) axes are turned away: far from where they were and from all others."""

SOMEWHERE: Vector = (0.843, 0.991, 0.986)
"""A way that no axis of a mechanism is likely to have anything to do with."""

CONFIGURATIONS = 2
"""Of each broken mechanism: two that agree."""

FREE = 6
"""A limb of so many freedoms or more resists nothing, and needs no condition."""

Numbers = tuple[int, tuple[int, int, int]]
"""F, and t, r, dim of the POC set."""


@dataclass(frozen=True)
class _Axis:
    """One written axis: of which limb, joint and place among the joint's axes."""

    name: str
    limb: int
    joint: str
    place: int
    direction: Vector


def needed_conditions(chains: Sequence[Chain], numbers: Numbers, hold: Hold | None = None) -> tuple[str, ...] | None:
    """The conditions in words, parallel axes first, then other directions, then common points.

    Args:
        chains: the limbs, with names of joints that are unique.
        numbers: F, and (t, r, dim) of the platform.
        hold: as in `assur.topology.screws.configurations.configurations`.

    Returns:
        None without limbs, and where limbs of lengths by chance have other numbers: then dimensions matter too.

    Example: P joints of a tripteron may point anywhere, three R of a limb may not.

    >>> from assur.topology.notation import parse_chains
    >>> tripteron = parse_chains(["P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]"])
    >>> needed_conditions(tripteron, (3, (3, 0, 3)))
    ('R1 ∥ R2 ∥ R3', 'R4 ∥ R5 ∥ R6', 'R7 ∥ R8 ∥ R9')
    """
    broken = _Broken(tuple(chains), numbers, hold)
    if not chains or broken.moves(broken.chains) != numbers:
        return None
    return (*broken.parallels(), *broken.directions(), *broken.points())


@dataclass(frozen=True)
class _Broken:
    """Limbs of which one condition at a time is broken, and what was `known` to move otherwise then."""

    chains: tuple[Chain, ...]
    numbers: Numbers
    hold: Hold | None
    known: dict[tuple[frozenset[tuple[str, int]], Vector], bool] = field(default_factory=dict)

    def moves(self, chains: Sequence[Chain]) -> Numbers | None:
        """What limbs with lengths by chance move like; None where nothing can be said, or they do not move."""
        try:
            mode = operation_modes(place(chains), CONFIGURATIONS, hold=self.hold)[0]
        except AssurError:
            return None
        return mode.freedoms, mode.poc

    @cached_property
    def families(self) -> list[list[_Axis]]:
        """Axes that are parallel, of all limbs that resist anything."""
        families: list[list[_Axis]] = []
        for axis in _axes(self.chains):
            own = next((family for family in families if parallel(axis.direction, family[0].direction)), None)
            if own is None:
                families.append([axis])
            else:
                own.append(axis)
        return families

    @cached_property
    def groups(self) -> list[list[_Axis]]:
        """Axes of one limb that are parallel."""
        return [
            [axis for axis in family if axis.limb == limb]
            for family in self.families
            for limb in dict.fromkeys(axis.limb for axis in family)
        ]

    @cached_property
    def needed(self) -> list[list[_Axis]]:
        """The groups that must not be turned away as a whole, from the other axes of the mechanism."""
        return [group for group in self.groups if self._matters(group)]

    @cached_property
    def units(self) -> list[list[_Axis]]:
        """Axes that must be parallel, of several limbs or of one; and single ones that must not be turned away."""
        units: list[list[_Axis]] = []
        for family in self.families:
            groups = [group for group in self.groups if group[0] in family]
            kept = [[axis for axis in group if len(group) == 1 or self._matters([axis])] for group in groups]
            across = [own for own, group in zip(kept, groups, strict=True) if own and self._is_held(group)]
            joined = [axis for own in across for axis in own] if len(across) > 1 else []
            units += [joined] if joined else []
            units += [own for own in kept if own and not (joined and own in across)]
        return [own for own in units if len(own) > 1 or self._matters(own)]

    def parallels(self) -> Iterator[str]:
        """Axes that must be parallel."""
        return (" ∥ ".join(axis.name for axis in own) for own in self.units if len(own) > 1)

    def _is_held(self, group: list[_Axis]) -> bool:
        """Whether a group must keep its direction, and not only its right angles to others of its limb."""
        beside = [other[0].direction for other in self.needed if other[0].limb == group[0].limb and other is not group]
        ways = [cross(axis, group[0].direction) for axis in beside if abs(dot(axis, group[0].direction)) < EXACT]
        return group in self.needed and all(self._matters(group, way) for way in ways)

    def directions(self) -> Iterator[str]:
        """Right angles in a limb, those between limbs that nothing in a limb explains, and planes."""
        square: dict[str, list[list[_Axis]]] = {}
        pairs = list(combinations(self.units, 2))
        for within in (True, False):
            for first, second in pairs:
                alone = not (square.get(first[0].name) or square.get(second[0].name))
                if _share_limb(first, second) == within and (within or alone) and self._must_be_square(first, second):
                    square.setdefault(first[0].name, []).append(second)
                    square.setdefault(second[0].name, []).append(first)
                    yield f"{first[0].name} ⊥ {_beside(second, first)}"
        for inside, normal in _in_planes(self.units):
            across = [own for own in square.get(inside[0][0].name, ()) if len(_limbs(own)) > 1]
            implied = any(all(own in square.get(other[0].name, ()) for other in inside) for own in across)
            if not implied and all(self._matters(own, normal) for own in inside):
                yield f"{', '.join(own[0].name for own in inside)} in a plane"

    def _must_be_square(self, first: list[_Axis], second: list[_Axis]) -> bool:
        """Whether axes are at right angles, and the mechanism moves otherwise with either turned towards the other."""
        u, v = first[0].direction, second[0].direction
        return abs(dot(u, v)) < EXACT and self._matters(first, v) and self._matters(second, u)

    def points(self) -> Iterator[str]:
        """Axes and centres that must meet."""
        at: dict[str, list[str]] = {}
        for joint in (joint for chain in self.chains for joint in chain.joints if isinstance(joint, ChainJoint)):
            for label in _labels(joint):
                at.setdefault(label, []).append(joint.name)
        for label, names in at.items():
            parted = [_changed(chain, partial(_without, label=label)) for chain in self.chains]
            if len(names) > 1 and self.moves(parted) != self.numbers:
                yield f"{', '.join(names)} meet"

    def _matters(self, axes: Sequence[_Axis], way: Vector = SOMEWHERE) -> bool:
        """Whether the mechanism moves otherwise with some parallel axes turned together a way (3,)."""
        direction = unit(np.add(axes[0].direction, np.multiply(AWAY, way)))
        named = frozenset((axis.joint, axis.place) for axis in axes)
        if (named, direction) not in self.known:
            turned = [_changed(chain, lambda joint: _turned(joint, named, direction)) for chain in self.chains]
            self.known[named, direction] = self.moves(turned) != self.numbers
        return self.known[named, direction]


def _limbs(unit: Iterable[_Axis]) -> set[int]:
    return {axis.limb for axis in unit}


def _share_limb(first: Iterable[_Axis], second: Iterable[_Axis]) -> bool:
    return bool(_limbs(first) & _limbs(second))


def _beside(unit: Sequence[_Axis], other: Sequence[_Axis]) -> str:
    """The axis of a unit that stands in a limb with the first of another one."""
    return next((axis.name for axis in unit if axis.limb == other[0].limb), unit[0].name)


def _axes(chains: Iterable[Chain]) -> Iterator[_Axis]:
    """The written axes of limbs that resist anything, called U1.1 and U1.2 of a joint with two."""
    for limb, chain in enumerate(chains):
        looped = any(isinstance(element, InnerLoop) for element in chain.elements)
        if sum(joint.freedoms for joint in chain.joints) >= FREE and not looped:
            continue
        for joint in (joint for joint in chain.joints if not joint.general):
            axes = joint.axes if isinstance(joint, ChainJoint) else (joint.axis,)
            for number, axis in enumerate(axes):
                name = f"{joint.name}.{number + 1}" if len(axes) > 1 else joint.name
                yield _Axis(name, limb, joint.name, number, axis)


def _in_planes(units: Sequence[list[_Axis]]) -> Iterator[tuple[list[list[_Axis]], Vector]]:
    """Axes of three directions or more in a plane, with its normal."""
    told: list[list[list[_Axis]]] = []
    for first, second in combinations(units, 2):
        u, v = first[0].direction, second[0].direction
        if parallel(u, v) or any(first in other and second in other for other in told):
            continue
        normal = unit(cross(u, v))
        inside = [own for own in units if abs(dot(normal, own[0].direction)) < EXACT]
        if any(not parallel(own[0].direction, u) and not parallel(own[0].direction, v) for own in inside):
            told.append(inside)
            yield inside, normal


def _labels(joint: ChainJoint) -> tuple[str, ...]:
    return tuple(dict.fromkeys(label for axis in range(max(1, len(joint.axes))) for label in joint.points_on(axis)))


Joint = ChainJoint | Parallelogram


def _changed(chain: Chain, change: Callable[[Joint], Joint]) -> Chain:
    """A chain with every joint as a function makes it."""
    return replace(chain, elements=tuple(_element(element, change) for element in chain.elements), text="")


def _element(element: Element, change: Callable[[Joint], Joint]) -> Element:
    if not isinstance(element, InnerLoop):
        return change(element)
    branches = tuple(tuple(_element(inner, change) for inner in branch) for branch in element.branches)
    return replace(element, branches=branches)


def _turned(joint: Joint, named: Collection[tuple[str, int]], direction: Vector) -> Joint:
    """A joint with the axes that are named along another direction."""
    if isinstance(joint, Parallelogram):
        return replace(joint, axis=direction) if (joint.name, 0) in named else joint
    axes = tuple(direction if (joint.name, place) in named else axis for place, axis in enumerate(joint.axes))
    return replace(joint, axes=axes)


def _without(joint: Joint, label: str) -> Joint:
    """A joint whose axes do not run through a point any more."""
    if isinstance(joint, Parallelogram):
        return joint
    through = tuple(tuple(other for other in labels if other != label) for labels in joint.through)
    return replace(joint, point="" if joint.point == label else joint.point, through=through)
