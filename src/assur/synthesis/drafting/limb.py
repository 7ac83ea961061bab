"""One limb drawn: its elements become links and joints whose points are named dimensions at home.

At home all joint values are zero and all frames are parallel. A joint's point is given by its coordinates there, in
both links as a difference of the same dimensions, so that the loops close whatever these are.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from assur.joints.joint_type import JointType
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.joints.universal import UNIVERSAL
from assur.model.mechanism import GeneralisedJoint
from assur.numerics.vectors import add, dot, scaled
from assur.synthesis.drafting.layout import (
    WIDTH,
    DraftLayout,
    Stand,
    StationRow,
    across,
    neighbour,
    own_stations,
    short_side,
    slides,
    stations,
)
from assur.synthesis.drafting.linear import ORIGIN, Linear, Point, along, dimension, minus, plus
from assur.synthesis.drafting.tables import Dimension, DraftJoint, DraftLink
from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram, flattened
from assur.topology.directions import NAMED, Vector, unit

BASE_LINK, PLATFORM_LINK = "base", "platform"
HEIGHT_NAME = "height"
PITCH, REACH = 20.0, 120.0
ASKEW = 0.2
"""How far branches of a loop stand from being each other's mirror images, as a share of how far apart they are."""

WHOLE = 10
"""The largest of three whole numbers that say a direction which was left general."""

AXES = ("x", "y", "z")
_NEAR = {"4R": REVOLUTE, "4S": SPHERICAL, "4U": UNIVERSAL, "2US": UNIVERSAL}
_FAR = {"4R": REVOLUTE, "4S": SPHERICAL, "4U": UNIVERSAL, "2US": SPHERICAL}


@dataclass(frozen=True)
class ElementEnds:
    """Points of an element on the links before and behind it, and the same as numbers."""

    near: Point
    far: Point
    near_at: Vector
    far_at: Vector


@dataclass
class LimbDrawing:
    """A limb that grows. `centres`: label of a point that limbs share -> the name of its height, empty for none."""

    layout: DraftLayout
    stand: Stand
    template: bool
    centres: Mapping[str, str]
    names: Iterator[str]
    dimensions: dict[str, list[Dimension]] = field(default_factory=dict)
    links: list[DraftLink] = field(default_factory=list)
    joints: list[DraftJoint] = field(default_factory=list)
    groups: list[GeneralisedJoint] = field(default_factory=list)
    origins: dict[str, Point] = field(default_factory=dict)
    labels: dict[str, ElementEnds] = field(default_factory=dict)

    def draw(self, chain: Chain) -> None:
        """Every element of a chain, from the base to the platform."""
        height = Linear() if self.stand.flat else dimension(HEIGHT_NAME)
        self.origins = {BASE_LINK: ORIGIN, PLATFORM_LINK: (Linear(), Linear(), height)}
        elements = _named(chain.elements, self.names)
        self.dimensions = {joint.name: [] for joint in flattened(elements)}
        self._series(elements, BASE_LINK, PLATFORM_LINK, StationRow(0.0, 1.0, stations(elements)))

    def _series(self, elements: Sequence[Element], start: str, end: str, row: StationRow) -> list[ElementEnds | None]:
        owned = own_stations(elements)
        places = [sum(owned[:index]) for index in range(len(elements))]
        ends: list[ElementEnds | None] = [
            self._ends(element, row, place, count)
            for element, place, count in zip(elements, places, owned, strict=True)
        ]
        for index in range(len(elements)):
            beside = neighbour(elements, index)
            if beside is not None:
                ends[index] = _beside(ends[beside], before=beside < index)
        link = start
        for index, element in enumerate(elements):
            following = end if index == len(elements) - 1 else self._link(element)
            if isinstance(element, InnerLoop):
                self._loop(element, link, following, row, places[index], owned[index])
            elif isinstance(element, Parallelogram):
                self._parallelogram(element, link, following, _known(ends[index]), short_side(elements, index))
            else:
                self._joint(element, link, following, _known(ends[index]), _leg(elements, ends, index))
            link = following
        return ends

    def _link(self, element: Element) -> str:
        """The link behind an element."""
        if isinstance(element, InnerLoop):
            first = next(flattened(element.branches[0])).name
            name, meaning = f"output{first}", f"output link of the loop that begins at {first}"
        else:
            name, meaning = f"link{element.name}", f"link behind {element.name}"
        self.links.append(DraftLink(name, meaning))
        return name

    def _ends(self, element: Element, row: StationRow, place: int, count: int) -> ElementEnds | None:
        """Where an element of its own stations is; None for a loop, and for a P that stands elsewhere."""
        if isinstance(element, InnerLoop) or not count:
            return None
        letter = element.name
        position = row.at(place, self.stand, self.layout)
        if isinstance(element, Parallelogram):
            far_position = row.at(place + 1, self.stand, self.layout)
            near, near_at = self._point(letter, "1", position, f"middle of the near ends of {letter}")
            far, far_at = self._point(letter, "2", far_position, f"middle of the far ends of {letter}")
            return ElementEnds(near, far, near_at, far_at)
        if element.point in self.centres:
            return self._about_centre(element, letter, row.share(place))
        if element.point in self.labels:
            return self.labels[element.point]
        point, at = self._point(letter, "", position, f"joint {letter}")
        ends = ElementEnds(point, point, at, at)
        if element.point:
            self.labels[element.point] = ends
        return ends

    def _about_centre(self, element: ChainJoint, letter: str, share: float) -> ElementEnds:
        """On its own axis through a point that limbs share, away from it; a U or an S, or all that is flat, in it."""
        name = self.centres[element.point]
        centre: Point = (Linear(), Linear(), dimension(name) if name else Linear())
        if len(element.axes) == 1 and name:
            size = f"{letter}_d"
            alone = len(self.centres) == 1  # then the platform turns about it, within its limbs
            value = round(REACH * (1.5 - 0.5 * share if alone else 1.0 + 0.5 * share))
            self._dimension(letter, Dimension(size, value, f"from the point {element.point} to joint {letter}"))
            centre = plus(centre, along(size, element.axes[0]))
        return ElementEnds(centre, centre, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))

    def _dimension(self, letter: str, size: Dimension) -> None:
        self.dimensions[letter].append(size)

    def _point(self, letter: str, end: str, value: Vector, what: str) -> tuple[Point, Vector]:
        """A point by its coordinates at home, each a dimension; a flat limb has no height."""
        said = ("distance from the Z axis", "to the side", "height") if self.template else AXES
        at = (float(round(value[0])), float(round(value[1])), float(round(value[2])))
        parts = []
        for axis, number, meaning in zip(AXES, at, said, strict=True):
            if self.stand.flat and axis == "z":
                parts.append(Linear())
                continue
            full = f"{letter}{end}_{axis}"
            self._dimension(letter, Dimension(full, number, f"{what} at home: {meaning}"))
            parts.append(dimension(full))
        return (parts[0], parts[1], parts[2]), at

    def _add(
        self,
        name: str,
        kind: JointType,
        links: tuple[str, str],
        point: Point,
        axes: Sequence[Vector] = (),
        pitch: str = "",
        leg: Point | None = None,
    ) -> None:
        """A joint at a point; a link that is new has its origin there."""
        parent, child = links
        origin = self.origins.setdefault(child, point)
        at, child_at = minus(point, self.origins[parent]), minus(point, origin)
        self.joints.append(DraftJoint(name, kind, parent, child, at, child_at, tuple(axes), pitch, leg))

    def _joint(self, joint: ChainJoint, parent: str, child: str, ends: ElementEnds, leg: Point | None) -> None:
        name = joint.name
        pitch = ""
        if joint.type.screw:
            pitch = f"{name}_pitch"
            self._dimension(name, Dimension(pitch, PITCH, f"joint {name}: advance per turn"))
        nice = _nice_axes(joint) if joint.general and self.layout.nice else None
        along_leg = leg if joint.general and self.layout.nice else None
        self._add(name, joint.type, (parent, child), ends.near, nice or joint.axes, pitch, along_leg)

    def _parallelogram(
        self, element: Parallelogram, parent: str, child: str, ends: ElementEnds, hinge: Vector | None
    ) -> None:
        letter = element.name
        axis = NAMED["y"] if element.general and self.layout.nice else element.axis
        rod = tuple(far - near for near, far in zip(ends.near_at, ends.far_at, strict=True))
        aside = across(axis, (rod[0], rod[1], rod[2]))
        short = axis if element.kind != "4R" else hinge or aside
        width = f"{letter}_w"
        self._dimension(letter, Dimension(width, WIDTH, f"distance of the two rods of {letter}", "positive"))
        half = along(width, short, 0.5)
        rods = [f"rod{letter}1", f"rod{letter}2"]
        self.links += [DraftLink(rods[0], f"first rod of {letter}"), DraftLink(rods[1], f"second rod of {letter}")]
        near = [axis, aside]
        axes = {REVOLUTE: near[:1], UNIVERSAL: near, SPHERICAL: []}
        corners = [f"{letter}{end}" for end in "abcd"]
        at_near, at_far = _NEAR[element.kind], _FAR[element.kind]
        self.origins.setdefault(child, ends.far)
        for corner, rod_name, side in ((0, rods[0], -1.0), (3, rods[1], 1.0)):
            shift = _times(half, side)
            self._add(corners[corner], at_near, (parent, rod_name), plus(ends.near, shift), axes[at_near])
            other = {0: 1, 3: 2}[corner]
            self._add(corners[other], at_far, (rod_name, child), plus(ends.far, shift), axes[at_far][::-1])
        self.groups.append(GeneralisedJoint(letter, f"P({element.kind})", tuple(corners), parent, child))

    def _loop(self, loop: InnerLoop, parent: str, child: str, row: StationRow, place: int, count: int) -> None:
        """The branches side by side, apart in a direction that their first axis does not have."""
        number = len(loop.branches)
        aside = _apart(loop, self.layout.spread)
        for branch_number, branch in enumerate(loop.branches):
            share = (branch_number - (number - 1) / 2) * self.stand.sense
            moved = (aside[0] * share, aside[1] * share, aside[2] * share)
            inside = row.within(place, count, stations(branch), moved, branch_number)
            self._series(branch, parent, child, inside)


def _named(elements: Sequence[Element], names: Iterator[str]) -> tuple[Element, ...]:
    """The elements with other names, one for each joint in the order of the text."""
    return tuple(
        InnerLoop(tuple(_named(branch, names) for branch in element.branches))
        if isinstance(element, InnerLoop)
        else dataclasses.replace(element, name=next(names))
        for element in elements
    )


def _times(point: Point, factor: float) -> Point:
    return (point[0].times(factor), point[1].times(factor), point[2].times(factor))


def _known(ends: ElementEnds | None) -> ElementEnds:
    return ends or ElementEnds(ORIGIN, ORIGIN, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def _beside(ends: ElementEnds | None, *, before: bool) -> ElementEnds:
    """Where a P stands that shares the place of the element before or behind it."""
    known = _known(ends)
    point, at = (known.far, known.far_at) if before else (known.near, known.near_at)
    return ElementEnds(point, point, at, at)


def _nice_axes(joint: ChainJoint) -> tuple[Vector, ...]:
    """Axes for those that were left general: level and tangential of a U, else about as they are, in whole numbers.

    >>> from assur.topology.notation import parse_chain
    >>> _nice_axes(parse_chain("U S").joints[0])
    ((0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
    """
    if joint.type is UNIVERSAL:
        return NAMED["y"], NAMED["x"]
    return tuple(unit(round(WHOLE * part / max(map(abs, axis))) for part in axis) for axis in joint.axes)


def _leg(elements: Sequence[Element], ends: Sequence[ElementEnds | None], index: int) -> Point | None:
    """The vector from the joint before a P to the one behind it; None where there is no such pair."""
    element = elements[index]
    if not (isinstance(element, ChainJoint) and not element.type.turning):
        return None
    before = next((ends[i] for i in range(index - 1, -1, -1) if not slides(elements[i])), None)
    behind = next((ends[i] for i in range(index + 1, len(elements)) if not slides(elements[i])), None)
    if index == len(elements) - 1 and not isinstance(elements[index - 1], InnerLoop):
        behind = ends[index]
    if before is None or behind is None or before is behind:
        return None
    return minus(behind.near, before.far)


def _apart(loop: InnerLoop, spread: float) -> Vector:
    """How far the branches of a loop stand from each other: across its first axis, and a little in another direction.

    Branches that mirror each other would be special: where they cross, two equal cranks may stand on one centre.
    """
    axes = [
        axis
        for joint in flattened(loop.branches[0])
        if not slides(joint)
        for axis in (joint.axes if isinstance(joint, ChainJoint) else (joint.axis,))
    ]
    first = axes[0] if axes else NAMED["z"]
    side, other, _ = sorted((NAMED["y"], NAMED["x"], NAMED["z"]), key=lambda unit: abs(dot(unit, first)))
    return add(scaled(side, spread), scaled(other, ASKEW * spread))
