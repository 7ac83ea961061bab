"""Default dimensions: where the joints of a limb stand between base and platform, in several layouts to try.

A limb is a row of stations from its place on the base to that on the platform, in its own vertical plane: x outwards,
y to the side, z up. Its knees stand outwards. What a layout leaves at zero may be special, so others follow it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from assur.joints.revolute import REVOLUTE
from assur.numerics.vectors import cross, dot
from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.directions import Vector

BASE, PLATFORM, HEIGHT = 200.0, 100.0, 300.0
"""Radii of base and platform and the height between them."""

WIDTH = 60.0
"""Between the two rods of a parallelogram."""

FOUR = 4
"""Joints, or parallelograms, of the least loop of a linkage."""

ACROSS = 1e-9
"""Cosine below which two axes are perpendicular: both are written."""

ROUGH = (0.0, 1.0, -0.6, 0.3, -1.0, 0.7, -0.2, 0.9, -0.4)


@dataclass(frozen=True)
class DraftLayout:
    """One way to choose default dimensions.

    Attributes:
        knee: how far the middle of a limb stands outwards of the line between its ends.
        side: how far it stands to the side.
        twist: how far its end on the platform stands to the side.
        rough: how far stations stand away from all this, each in its own way.
        wide: by how much farther the base's joints stand from the middle.
        nice: whether axes that were left general are chosen to look well, else they stay arbitrary.
        parts: into how many templates a family of limbs is divided.
        spread: between the branches of an inner loop at its first link.
        lean: by what share of it they come nearer to each other up to its last link.
        elbow: by what share of it they stand farther apart in the middle.
    """

    knee: float = 100.0
    side: float = 0.0
    twist: float = 0.0
    rough: float = 0.0
    wide: float = 1.0
    nice: bool = True
    parts: int = 1
    spread: float = 150.0
    lean: float = 0.5
    elbow: float = 0.4


PLAIN = (
    DraftLayout(),
    DraftLayout(twist=60.0),
    DraftLayout(side=60.0),
    DraftLayout(side=-70.0, twist=50.0),
    DraftLayout(side=120.0, twist=100.0),
    DraftLayout(knee=150.0, side=100.0, twist=-60.0),
    DraftLayout(knee=130.0, side=60.0, twist=-40.0, rough=20.0),
    # bent farther, and with feet farther apart, where legs would end near their reach
    DraftLayout(wide=2.0),
    DraftLayout(wide=2.0, side=60.0, twist=-40.0),
    DraftLayout(knee=250.0, side=150.0, twist=100.0),
    DraftLayout(wide=1.7, knee=200.0, side=150.0, twist=-80.0),
    DraftLayout(knee=200.0, side=150.0, twist=-80.0),
    DraftLayout(wide=2.0, knee=200.0, side=150.0, twist=100.0),
)
DIVIDED = (
    DraftLayout(twist=50.0, parts=2),  # neighbouring legs do not cross
    DraftLayout(twist=80.0, parts=2),
    DraftLayout(knee=90.0, side=50.0, twist=70.0, rough=25.0, parts=2),
    DraftLayout(knee=120.0, side=50.0, twist=40.0, rough=35.0, nice=False),
    DraftLayout(knee=110.0, side=60.0, twist=60.0, rough=40.0, nice=False, parts=99),
)
LOOPED = (
    # branches of inner loops that lean against each other, or away, so that a loop is far from where it folds
    DraftLayout(knee=200.0, twist=100.0, spread=450.0, lean=0.7, elbow=0.8),
    DraftLayout(knee=160.0, twist=100.0, spread=450.0, lean=0.7, elbow=0.8),
    DraftLayout(knee=0.0, side=-120.0, twist=50.0, rough=20.0, elbow=0.8),
    DraftLayout(wide=1.5, knee=60.0, side=120.0, twist=50.0, spread=250.0, lean=0.3, elbow=0.0),
    DraftLayout(wide=1.5, knee=0.0, side=120.0, twist=-100.0, spread=350.0, elbow=0.0),
    DraftLayout(wide=1.5, side=-120.0, twist=-50.0),
    DraftLayout(wide=1.5, side=60.0, twist=50.0, lean=0.3),
    DraftLayout(wide=1.5, knee=0.0, side=-120.0, twist=50.0, lean=0.0, elbow=0.0),
    DraftLayout(wide=1.5, knee=0.0, side=120.0, twist=-100.0, spread=450.0, lean=0.7, elbow=0.8),
)
LAYOUTS = (PLAIN, DIVIDED)
"""Layouts in the order in which they are tried; of the first group the best, and only if none will do the others."""


def layouts_for(chains: Sequence[Chain]) -> tuple[tuple[DraftLayout, ...], ...]:
    """Groups of layouts in the order in which they are tried: those for inner loops first, where there are some.

    >>> from assur.topology.notation import parse_chains
    >>> layouts_for(parse_chains(["R[z] R[z] R[z]"] * 2)) == LAYOUTS
    True
    """
    return (LOOPED + PLAIN, DIVIDED) if looped(chains) else LAYOUTS


def looped(chains: Sequence[Chain]) -> bool:
    """Whether a limb has an inner loop that may fold: a nut beside its guide, three joints of one axis, does not."""
    loops = (element for chain in chains for element in chain.elements if isinstance(element, InnerLoop))
    return any(sum(map(len, loop.branches)) >= FOUR for loop in loops)


@dataclass(frozen=True)
class Stand:
    """Where a limb stands: turned by `angle` (rad) about z, its ends at `base` and `platform` from z.

    `number` tells limbs of different families apart, `flat` limbs have no height.
    """

    angle: float = 0.0
    base: float = BASE
    platform: float = PLATFORM
    number: int = 0
    flat: bool = False
    sense: float = 1.0

    def place(self, layout: DraftLayout, share: float, station: int) -> Vector:
        """Where a station stands that has passed a share, 0 to 1, of the way from base to platform.

        >>> Stand().place(DraftLayout(), 0.5, 1)
        (250.0, 0.0, 150.0)
        """
        arch = math.sin(math.pi * share)
        rough = layout.rough
        out = (
            self.base * layout.wide
            + (self.platform - self.base * layout.wide) * share
            + layout.knee * arch
            + rough * self._own(station)
        )
        aside = self.sense * (layout.side * arch + layout.twist * share) + rough * self._own(station + 3)
        up = 0.0 if self.flat else HEIGHT * share + rough * self._own(station + 5)
        cosine, sine = math.cos(self.angle), math.sin(self.angle)
        return (cosine * out - sine * aside, sine * out + cosine * aside, up)

    def _own(self, station: int) -> float:
        return ROUGH[(2 * station + 3 * self.number) % len(ROUGH)]


@dataclass(frozen=True)
class StationRow:
    """Stations of elements in series between two shares of the way, and how far aside their branch stands."""

    start: float
    end: float
    count: int
    first: int = 0
    aside: Vector = (0.0, 0.0, 0.0)

    def share(self, place: float) -> float:
        """How far along the way a station of the row is."""
        if self.count < 2:
            return (self.start + self.end) / 2
        return self.start + (self.end - self.start) * place / (self.count - 1)

    def at(self, place: float, stand: Stand, layout: DraftLayout) -> Vector:
        """Where a station of the row stands; branches of a loop come nearer to each other on the way."""
        inside = place / (self.count - 1) if self.count > 1 else 0.5
        x, y, z = stand.place(layout, self.share(place), self.first + round(place))
        near = 1.0 - layout.lean * inside + layout.elbow * math.sin(math.pi * inside)
        return (x + near * self.aside[0], y + near * self.aside[1], z + near * self.aside[2])

    def within(self, place: int, stations: int, count: int, aside: Vector, branch: int) -> StationRow:
        """The row of a branch of an inner loop that spans some stations of this row."""
        moved = (self.aside[0] + aside[0], self.aside[1] + aside[1], self.aside[2] + aside[2])
        first = self.first + place + 4 * branch
        return StationRow(self.share(place), self.share(place + stations - 1), count, first, moved)


def own_stations(elements: Sequence[Element]) -> list[int]:
    """How many stations each element has of its own: a P stands where its neighbour does, unless it is the last.

    So does an R beside a P(4R) across whose axis its own lies: in the middle of that one's short link, as in the
    Orthoglide. Each limb then keeps a point on a sphere; an R beside it would leave it on a torus.

    >>> from assur.topology.notation import parse_chain
    >>> own_stations(parse_chain("P[x] R[y] P[z] P(4R)[y] P[x]").elements)
    [0, 1, 0, 2, 1]
    >>> own_stations(parse_chain("P[x] R[y] P(4R)[z] R[y]").elements)
    [0, 0, 2, 0]
    """
    counts = []
    for place, element in enumerate(elements):
        if isinstance(element, InnerLoop):
            counts.append(max(2, *(stations(branch) for branch in element.branches)))
        elif isinstance(element, Parallelogram):
            counts.append(2)
        else:
            counts.append(0 if neighbour(elements, place) is not None else 1)
    return counts


def stations(elements: Sequence[Element]) -> int:
    """How many stations elements in series have."""
    return sum(own_stations(elements))


def neighbour(elements: Sequence[Element], place: int) -> int | None:
    """The element where another one stands, None where it stands alone.

    That of a P is the one before it, of the first the one behind it; that of an R a P(4R) whose short link it is on.
    """
    if not slides(elements[place]):
        return _on_short_link_of(elements, place)
    if place == len(elements) - 1:
        return None
    before = next((other for other in range(place - 1, -1, -1) if not slides(elements[other])), None)
    behind = next((other for other in range(place + 1, len(elements)) if not slides(elements[other])), None)
    chosen = behind if before is None else before
    if chosen is None or isinstance(elements[chosen], InnerLoop):
        return None
    beside = _on_short_link_of(elements, chosen)
    return chosen if beside is None else beside


def _on_short_link_of(elements: Sequence[Element], place: int) -> int | None:
    """The P(4R) before or behind an R whose axis lies across that one's."""
    joint = elements[place]
    if not isinstance(joint, ChainJoint) or joint.type is not REVOLUTE or joint.point or joint.general:
        return None
    for beside in (place - 1, place + 1):
        element = elements[beside] if 0 <= beside < len(elements) else None
        if isinstance(element, Parallelogram) and _hinged_across(element, joint.axes[0]):
            return beside
    return None


def short_side(elements: Sequence[Element], place: int) -> Vector | None:
    """The axis of an R on a short link of a P(4R): along that link, so that it carries rods and not their offset.

    >>> from assur.topology.notation import parse_chain
    >>> short_side(parse_chain("P[x] R[y] P(4R)[z] R[y]").elements, 2)
    (0.0, 1.0, 0.0)
    """
    hinges = (elements[beside] for beside in (place - 1, place + 1) if 0 <= beside < len(elements))
    own = elements[place]
    for hinge in hinges:
        if (
            isinstance(own, Parallelogram)
            and isinstance(hinge, ChainJoint)
            and hinge.type is REVOLUTE
            and not hinge.general
            and _hinged_across(own, hinge.axes[0])
        ):
            return hinge.axes[0]
    return None


def _hinged_across(element: Parallelogram, axis: Vector) -> bool:
    return element.kind == "4R" and not element.general and abs(dot(element.axis, axis)) < ACROSS


def slides(element: Element) -> bool:
    """Whether an element is a P."""
    return isinstance(element, ChainJoint) and not element.type.turning


def across(axis: Vector, rod: Vector) -> Vector:
    """A direction perpendicular to an axis and far from that of a rod: x, y or z where one is perpendicular.

    >>> across((0.0, 1.0, 0.0), (10.0, 0.0, 300.0))
    (1.0, 0.0, 0.0)
    """
    level = [unit for unit in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)) if abs(dot(unit, axis)) < 1e-9]
    if level:
        return min(level, key=lambda unit: abs(dot(unit, rod)))
    x, y, z = cross(axis, rod)
    length = math.hypot(x, y, z)
    if length < 1e-6 * math.hypot(*rod):
        x, y, z = cross(axis, (1.0, 0.0, 0.0))
        length = math.hypot(x, y, z)
    return (x / length, y / length, z / length)
