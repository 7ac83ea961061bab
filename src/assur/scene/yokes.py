"""Yokes: the forks of universal joints, and the skeleton whose rods end where the forks begin.

A universal joint is a cross of two pins between two forks. The pin along the first axis turns in the parent's fork,
that along the second in the child's, so that each is drawn as a part of the link whose fork it turns in. A link that
lies along its own pin has no fork: it holds the pin at one end.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.scene.shapes import Ball, Bar, Cylinder
from assur.scene.skeleton import JointMark, Plate, Rod, Skeleton

FloatArray = NDArray[np.float64]
ARM, ASIDE = 3.0, 1.7
"""From the middle of the cross to the bridge of a fork, and to the middle of each of its arms, in thicknesses."""

THIN, EYE, BRIDGE, PIN, HUB = 0.6, 1.0, 0.7, 0.7, 1.0
"""Thickness of an arm, half its width, and the radii of bridge, pin and hub, in thicknesses."""

REACH = ASIDE + 0.5 * THIN + 0.15
"""Half the length of a pin, in thicknesses."""

ALONG = 0.7
"""A link that lies along its pin by more than this cosine has no fork."""

COINCIDENT = 1e-9
"""Points nearer to each other than this share of the mechanism's size are one."""


@dataclass(frozen=True, eq=False)
class Yoke:
    """What one link has at a universal joint.

    Attributes:
        joint, link: their names.
        at: (3,) middle of the cross.
        axis: (3,) of the pin that turns in it.
        way: (3,) unit vector from there to the link.
    """

    joint: str
    link: str
    at: FloatArray
    axis: FloatArray
    way: FloatArray

    @property
    def forked(self) -> bool:
        """Whether it is a fork: the link does not lie along its pin."""
        return abs(float(self.axis @ self.way)) <= ALONG

    def root(self, size: float) -> FloatArray:
        """Where the link begins (3,), for a thickness."""
        if self.forked:
            return np.asarray(self.at + ARM * size * self.way)
        return np.asarray(self.at + ASIDE * size * np.sign(self.axis @ self.way) * self.axis)

    def shapes(self, size: float) -> Iterator[tuple[str, Bar | Cylinder]]:
        """Roles and shapes of a fork: two arms and the bridge between them; nothing of one that is none."""
        if not self.forked:
            return
        normal = self.axis - (self.axis @ self.way) * self.way
        normal = normal / np.linalg.norm(normal)
        aside, foot = ASIDE * size * self.axis, ARM * size * self.way
        for sense in (1.0, -1.0):
            start = self.at + sense * aside
            yield "arm", Bar(start, start + foot, normal, EYE * size, THIN * size)
        yield "bridge", Cylinder(self.at + foot - aside, self.at + foot + aside, BRIDGE * size)


def cross(mark: JointMark, size: float) -> Iterator[tuple[str, str, Cylinder | Ball]]:
    """Link, role and shape of the two pins of a universal joint and of the hub in which they meet."""
    for axis, link in zip(mark.axes, (mark.joint.parent, mark.joint.child), strict=True):
        reach = REACH * size * axis
        yield link, "pin", Cylinder(mark.at - reach, mark.at + reach, PIN * size)
    yield mark.joint.child, "hub", Ball(mark.at, HUB * size)


def yokes(skeleton: Skeleton) -> tuple[Yoke, ...]:
    """Both links of every universal joint, the parent's first."""
    forks, tiny = [], COINCIDENT * skeleton.size
    for mark in skeleton.marks:
        if mark.joint.type.turns != 2:
            continue
        links, places = (mark.joint.parent, mark.joint.child), (mark.rail, mark.at)
        ways = [_way(skeleton, link, at, tiny) for link, at in zip(links, places, strict=True)]
        for k in range(2):
            way, other = ways[k], ways[1 - k]
            chosen = _opposite(mark.axes[k], other) if way is None else way
            forks.append(Yoke(mark.joint.name, links[k], places[k], mark.axes[k], chosen))
    return tuple(forks)


def _way(skeleton: Skeleton, link: str, at: FloatArray, tiny: float) -> FloatArray | None:
    """Unit vector (3,) from a joint to the rest of a link: the mean of its rods; None where it has none there."""
    ways = []
    for rod in skeleton.rods:
        if rod.link == link:
            near, far = sorted(rod.points, key=lambda place: float(np.linalg.norm(place - at)))
            if _coincide(near, at, tiny):
                ways.append(far - at)
    for plate in skeleton.plates:
        if plate.link == link:
            ways += [place - at for place in plate.points if not _coincide(place, at, tiny)]
    for mark in skeleton.marks:
        if mark.telescopes:
            ways += [mark.at - at] if mark.joint.parent == link and _coincide(mark.rail, at, tiny) else []
            ways += [mark.rail - at] if mark.joint.child == link and _coincide(mark.at, at, tiny) else []
    total = np.sum([way / max(float(np.linalg.norm(way)), 1e-300) for way in ways], axis=0) if ways else np.zeros(3)
    size = float(np.linalg.norm(total))
    return None if size < COINCIDENT else np.asarray(total / size)


def _opposite(axis: FloatArray, other: FloatArray | None) -> FloatArray:
    """Unit vector (3,) across an axis, away from where the other link is as far as can be."""
    away = np.array([0.0, 0.0, -1.0]) if other is None else -other
    for way in (away, *np.eye(3)):
        across = way - (way @ axis) * axis
        size = float(np.linalg.norm(across))
        if size > 0.1:
            return np.asarray(across / size)
    return np.asarray(axis)  # no axis is along all of them


def trimmed(skeleton: Skeleton, forks: Sequence[Yoke], size: float) -> Skeleton:
    """The skeleton whose rods, plates and telescopes end at the roots of yokes, for a thickness."""
    tiny = COINCIDENT * skeleton.size

    def ended(link: str, place: FloatArray) -> FloatArray:
        return next((fork.root(size) for fork in forks if fork.link == link and _coincide(fork.at, place, tiny)), place)

    def rod(whole: Rod) -> Rod:
        ends = np.array([ended(whole.link, place) for place in whole.points])
        before = whole.points[1] - whole.points[0]
        return replace(whole, points=ends) if float((ends[1] - ends[0]) @ before) > 0 else whole

    def plate(whole: Plate) -> Plate:
        return replace(whole, points=np.array([ended(whole.link, place) for place in whole.points]))

    def mark(whole: JointMark) -> JointMark:
        if not whole.telescopes:
            return whole
        rail, at = ended(whole.joint.parent, whole.rail), ended(whole.joint.child, whole.at)
        return replace(whole, rail=rail, at=at) if float((at - rail) @ (whole.at - whole.rail)) > 0 else whole

    if not forks:
        return skeleton
    return replace(
        skeleton,
        rods=tuple(rod(item) for item in skeleton.rods),
        plates=tuple(plate(item) for item in skeleton.plates),
        marks=tuple(mark(item) for item in skeleton.marks),
    )


def _coincide(first: FloatArray, second: FloatArray, tiny: float) -> bool:
    return float(np.linalg.norm(first - second)) < tiny
