"""A draft by lengths: its parameters become link lengths, offsets and angles, and what is zero is left out.

A drawn draft says where joints are at home, in coordinates. Here each link has its own frame (`turned`), in which the
places of its joints are as few numbers as can be: a radius and an angle on base and platform, else a length l along one
axis and offsets e along others. Points that must stay on a common line or in a common centre keep their dimensions.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from itertools import chain, count

import numpy as np
from numpy.typing import NDArray

from assur.synthesis.drafting.limb import AXES, BASE_LINK, HEIGHT_NAME, PLATFORM_LINK
from assur.synthesis.drafting.linear import Linear, Point, dimension
from assur.synthesis.drafting.tables import Dimension, DraftJoint, Template
from assur.synthesis.drafting.templates import Draft
from assur.synthesis.drafting.turned import TurnedLinks, is_shared, number, turned_links

FloatArray = NDArray[np.float64]
NOTHING = 1e-6
"""mm, and deg: what is smaller is zero."""

COARSE = 10.0
"""What is longer is rounded to whole mm, what is shorter to tenths."""


def by_lengths(
    drawn: Draft, *, rounded: bool = True, polar: bool = True, straight: Collection[str] = frozenset()
) -> Draft:
    """The same mechanism by lengths, offsets and angles.

    Args:
        drawn: by coordinates at home.
        rounded: whether to whole numbers, so that home closes near to where it was drawn; else it is the same to the
            last digits.
        polar: whether places on base and platform are told by radius and angle; else by x and y.
        straight: joints whose places there are told by x and y in any case.
    """
    sizes = {size.name: size.value for size in _all_dimensions(drawn)}
    platform = np.array([0.0, 0.0, sizes.get(HEIGHT_NAME, 0.0)])
    numbers = {letter: count(1) for letter in "le"}
    made = []
    for template in drawn.templates:
        home = turned_links(template, sizes, platform)
        sizing = _Sizing(template, home, sizes, numbers, len(drawn.templates) > 1, rounded, polar, straight)
        made.append(sizing.template_by_lengths())
    used = {
        name
        for template in made
        for joint in template.joints
        for point in (joint.at, joint.child_at)
        for part in point
        for name, _ in part.terms
    }
    kept = tuple(size for size in drawn.dimensions if size.name in used)
    return dataclasses.replace(drawn, dimensions=kept, templates=tuple(made))


def _all_dimensions(drawn: Draft) -> list[Dimension]:
    return [*drawn.dimensions, *(size for template in drawn.templates for size in template.dimensions)]


def _is_kept(name: str) -> bool:
    """Whether a dimension of a drawn limb is a length already: a width, a pitch, a distance from a shared centre."""
    return name.endswith(("_w", "_d", "_pitch"))


@dataclass
class _Sizing:
    """One limb whose places become lengths, one after the other."""

    template: Template
    home: TurnedLinks
    sizes: Mapping[str, float]
    numbers: Mapping[str, count[int]]
    several: bool
    rounded: bool
    polar: bool
    straight: Collection[str]
    dimensions: list[Dimension] = field(default_factory=list)
    known: dict[tuple[str, tuple[float, ...]], Point] = field(default_factory=dict)

    def template_by_lengths(self) -> Template:
        """The limb with its joints in the frames of its links."""
        joints = tuple(map(self._joint, self.template.joints))
        kept = [size for size in self.template.dimensions if _is_kept(size.name)]
        return dataclasses.replace(
            self.template,
            dimensions=(*self.dimensions, *kept),
            joints=joints,
            home=self._home(),
        )

    def _home(self) -> dict[str, tuple[float, ...]]:
        """Values of the joints; none where all are zero."""
        digits = 1 if self.rounded else 9
        rounded = {name: tuple(round(value, digits) + 0.0 for value in own) for name, own in self.home.values.items()}
        return rounded if any(map(any, rounded.values())) else {}

    def _joint(self, joint: DraftJoint) -> DraftJoint:
        at = self._place(joint, joint.parent, joint.at, self.home.points[joint.name])
        stroke = self.home.values[joint.name][0] if joint.name in self.home.slides else 0.0
        slide = self.home.slides.get(joint.name)
        moved = self.home.points[joint.name]
        if slide is not None:
            moved = moved + stroke * (self.home.turns[joint.parent] @ slide)
        child_at = self._place(joint, joint.child, joint.child_at, moved)
        axes = joint.axes if slide is None else (_direction(slide),)
        return dataclasses.replace(joint, at=at, child_at=child_at, axes=axes, leg=None)

    def _place(self, joint: DraftJoint, link: str, drawn: Point, point: FloatArray) -> Point:
        """A joint's place in a link's frame: of dimensions that are kept, or of new ones."""
        turn = self.home.turns[link]
        names = [name for part in drawn for name, _ in part.terms]
        if names and all(name == HEIGHT_NAME or is_shared(name) for name in names):
            return drawn
        widths = tuple(Linear(tuple(term for term in part.terms if term[0].endswith("_w"))) for part in drawn)
        shift = number((widths[0], widths[1], widths[2]), self.sizes)
        local = turn.T @ (point - shift - self.home.origins[link])
        place = self._named(joint, link, local)
        own = _turned((widths[0], widths[1], widths[2]), turn.T)
        return (place[0] + own[0], place[1] + own[1], place[2] + own[2])

    def _named(self, joint: DraftJoint, link: str, local: FloatArray) -> Point:
        """A place (3,) in a link by new dimensions; equal rods and corners of one link share theirs."""
        key = (link.rstrip("12") if link.startswith("rod") else link, tuple(np.round(local, 6).tolist()))
        if key not in self.known:
            made = (
                self._radial(joint, link, local)
                if link in (BASE_LINK, PLATFORM_LINK)
                else self._linked(joint, link, local)
            )
            self.known[key] = made
        return self.known[key]

    def _radial(self, joint: DraftJoint, link: str, local: FloatArray) -> Point:
        """On base or platform: a radius, an angle about Z and a height."""
        x, y, z = (float(value) for value in local)
        base, part = link == BASE_LINK, self._letter(joint)
        radius, angle = math.hypot(x, y), math.degrees(math.atan2(y, x))
        across: tuple[Linear, Linear] = (Linear(), Linear())
        if (not self.polar or joint.name in self.straight) and abs(y) > NOTHING:
            x_of, y_of = (
                dimension(self._new(f"{axis}{part}", value, f"{link}: {part} along {axis.upper()}"))
                if abs(value) > NOTHING
                else Linear()
                for axis, value in (("x", x), ("y", y))
            )
            across = (x_of, y_of)
        elif radius > NOTHING:
            short = "a" if base else "b"
            name = self._new(
                f"r{part}" if self.several else short, radius, f"{link}: from the Z axis to {part}", "positive"
            )
            across = (dimension(name), Linear())
            if abs(angle) > NOTHING:
                short = "alpha" if base else "beta"
                turn = self._new(
                    f"{short}{part}" if self.several else short, angle, f"{link}: about Z, from X to {part}", unit="deg"
                )
                across = (dimension(f"{name}*cos({turn})"), dimension(f"{name}*sin({turn})"))
        up = dimension(self._new(f"h{part}", z, f"{link}: height of {part}")) if abs(z) > NOTHING else Linear()
        return (*across, up)

    def _linked(self, joint: DraftJoint, link: str, local: FloatArray) -> Point:
        """In a link: its length along the axis that has most of it, and offsets; beside a slide these alone."""
        parts = [Linear(), Linear(), Linear()]
        along = None if self._slides(link) else int(np.argmax(np.abs(local) * self._across(link)))
        for place in sorted(range(3), key=lambda axis: axis != along):
            value = float(local[place])
            if abs(value) > NOTHING:
                name = self._length(joint, link, abs(value), "" if place == along else AXES[place])
                parts[place] = dimension(name).times(math.copysign(1.0, value))
        return (parts[0], parts[1], parts[2])

    def _length(self, joint: DraftJoint, link: str, value: float, aside: str) -> str:
        start = next(self._letter(other) for other in self.template.joints if other.child == link)
        which = f"rods of {start}" if start == self._letter(joint) else f"from {start} to {self._letter(joint)}"
        letter = "e" if aside else "l"
        meaning = f"{which}: offset along {aside}" if aside else f"{which}: length"
        return self._new(f"{letter}{next(self.numbers[letter])}", value, meaning, "any" if aside else "positive")

    def _across(self, link: str) -> FloatArray:
        """Axes (3,) of a link across that of the joint before it as 1, others as little: no length is along that."""
        first = next(joint for joint in self.template.joints if joint.child == link)
        if first.type.turns != 1 or first.type.ball:
            return np.ones(3)
        return np.where(np.abs(first.axes[0]) > NOTHING, NOTHING, 1.0)

    def _slides(self, link: str) -> bool:
        """Whether a P moves along a link with a stroke, which is its length."""
        return any(
            link in (joint.parent, joint.child) and abs(self.home.values[joint.name][0]) > NOTHING
            for joint in self.template.joints
            if joint.name in self.home.slides
        )

    def _letter(self, joint: DraftJoint) -> str:
        """What a joint is called; of the corners of a parallelogram what this is called."""
        return next((group.name for group in self.template.groups if joint.name in group.joints), joint.name)

    def _new(self, name: str, value: float, meaning: str, sign: str = "any", unit: str = "") -> str:
        taken = {size.name for size in self.dimensions}
        unique = next(full for full in chain([name], (f"{name}_{k}" for k in count(2))) if full not in taken)
        if self.rounded:
            value = round(value, 0 if abs(value) >= COARSE or unit else 1)
        self.dimensions.append(Dimension(unique, value, meaning, sign, unit))
        return unique


def _turned(point: Point, rotation: FloatArray) -> Point:
    """A sum of dimensions along directions, turned (3, 3)."""
    rows: list[Linear] = []
    for row in rotation:
        total = Linear()
        for share, part in zip(row, point, strict=True):
            total = total + part.times(_plain(float(share)))
        rows.append(total)
    return (rows[0], rows[1], rows[2])


def _plain(share: float) -> float:
    """A share without the dust of rounding."""
    return round(share) + 0.0 if abs(share - round(share)) < NOTHING else share


def _direction(axis: FloatArray) -> tuple[float, float, float]:
    x, y, z = (_plain(float(part)) for part in axis)
    return (x, y, z)
