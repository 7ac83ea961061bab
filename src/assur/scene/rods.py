"""Rods: flat bars normal to the hinges at their ends, round ones elsewhere, each as broad as there is room for."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from assur.scene.joining import webs
from assur.scene.part import Part
from assur.scene.shapes import Bar, Cylinder
from assur.scene.sizes import USUAL, thickness
from assur.scene.skeleton import Rod, Skeleton

FloatArray = NDArray[np.float64]
BROAD = 2.8
"""So many times as broad are arms and motors at most, where neighbouring joints elsewhere ask for thin links: they keep
off the plate of the base."""

ROD, BALL = 0.75, 1.4
"""Radii of a round rod and of a ball, in thicknesses."""

NECK, FREE = 0.12, 4.0
"""A rod between two balls is thin along this share of its length at each end, where others are near. Between them it is
so many times thinner at least than its distance at home from others, which come nearer as they fold."""

LAYERS = ((0.0,), (-0.95, 0.95), (-1.8, 1.8))
THICK = (1.0, 0.7, 0.7)
"""Middles of the plates of a tongue, a fork and a wider fork, and their thickness, in units of `unit`."""


def broad(skeleton: Skeleton) -> float:
    """How many times as broad as a bar an arm or a motor is, which no other joint is near: as usual, if it may be."""
    return float(np.clip(USUAL * skeleton.size / thickness(skeleton.record), 1.0, BROAD))


def broad_rods(skeleton: Skeleton) -> float:
    """How many times as broad as a round rod those between two balls are: all as that which has the least room.

    They are no broader than the balls: where these have room beside one another, rods that are parallel have it too.
    """
    inner = [(rod, *_inner(rod)) for rod in skeleton.rods if _is_pushed(skeleton, rod)]
    room = min((skeleton.room(start, end, {rod.link}) for rod, start, end in inner), default=0.0)
    return float(np.clip(room / (FREE * thickness(skeleton.record)), 1.0, min(BALL / ROD, broad(skeleton))))


def _inner(rod: Rod) -> tuple[FloatArray, FloatArray]:
    """The ends (3,) of a rod without its necks."""
    start, end = rod.points
    return start + NECK * (end - start), end - NECK * (end - start)


def _is_pushed(skeleton: Skeleton, rod: Rod) -> bool:
    """Whether a rod is all of a link that hangs between two balls, as those of a Delta robot."""
    own = [mark for mark in skeleton.marks if rod.link in (mark.joint.parent, mark.joint.child)]
    near = [min(np.linalg.norm(rod.points - mark.at, axis=1)) < 1e-9 * skeleton.size for mark in own]
    return len(own) == 2 and all(near) and all(mark.joint.type.ball for mark in own)


def rod_parts(skeleton: Skeleton, rod: Rod, layer: int, colour: str, breadth: float) -> Iterator[Part]:
    """Flat bars normal to the hinges at its ends, or a round rod where it has none across it."""
    size, name = thickness(skeleton.record), f"bar {' '.join(rod.ends)}"
    start, end = rod.points
    normal = _hinge_normal(skeleton, rod)
    if normal is None and breadth > 1.0 and _is_pushed(skeleton, rod):
        first, last = _inner(rod)
        for a, b, times in ((start, first, 1.0), (first, last, breadth), (last, end, 1.0)):
            yield Part(name, rod.link, Cylinder(a, b, ROD * times * size), colour)
        return
    if normal is None:
        yield Part(name, rod.link, Cylinder(start, end, ROD * size), colour)
        return
    width = 1.15 * size * (broad(skeleton) if _is_arm(skeleton, rod) else 1.0)
    for shift in LAYERS[layer]:
        aside = shift * size * normal
        shape = Bar(start + aside, end + aside, normal, width, THICK[layer] * size)
        yield Part(name, rod.link, shape, colour)
    if layer:
        for spacer in webs(skeleton, rod, max(LAYERS[layer]) * size * normal, 0.7 * size):
            yield Part(f"web {' '.join(rod.ends)}", rod.link, spacer, colour, "web")


def _is_arm(skeleton: Skeleton, rod: Rod) -> bool:
    """Whether a rod begins at a hinge of the base, and what shares no joint with it leaves room for a broad one."""
    pairs = [{joint.parent, joint.child} for joint in skeleton.record.joints.values()]
    own = set().union(*(pair for pair in pairs if rod.link in pair))
    feet = [mark.at for mark in skeleton.marks if mark.grounded and mark.joint.type.turns == 1 and not mark.slides]
    begins = any(np.min(np.linalg.norm(rod.points - foot, axis=1)) < 1e-9 * skeleton.size for foot in feet)
    needed = (1.15 * BROAD + 1.5) * thickness(skeleton.record)
    return begins and skeleton.room(rod.points[0], rod.points[1], own) > needed


def _hinge_normal(skeleton: Skeleton, rod: Rod) -> FloatArray | None:
    along = (rod.points[1] - rod.points[0]) / rod.size
    for mark in skeleton.marks:
        meets = np.min(np.linalg.norm(rod.points - mark.at, axis=1)) < 1e-9 * skeleton.size
        of_rod = rod.link in (mark.joint.parent, mark.joint.child)
        if of_rod and meets and not mark.slides and len(mark.axes) and abs(float(mark.axes[0] @ along)) < 1e-9:
            return np.asarray(mark.axes[0])
    return None
