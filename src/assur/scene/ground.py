"""The ground: what the base is drawn as: a plate with stands under what stands on it, rails, and forks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from assur.scene.companion import Companion
from assur.scene.hull import hull
from assur.scene.joining import stand
from assur.scene.part import DARK, DRIVE, PLATE, STEEL, Part
from assur.scene.rails import Rail, rails
from assur.scene.shapes import Cuboid, Cylinder, Slab
from assur.scene.skeleton import JointMark, Skeleton
from assur.scene.yokes import Yoke

FloatArray = NDArray[np.float64]
SUNK, OVER = 4.2, 2.0
"""How far a rail lies below a slider that has a joint nearer than this to its own point, in thicknesses."""

WAYS = 12
"""Directions in which room for such a rail is looked for."""

THICKEST = 1.6
"""What is drawn about points that a plate must not hide reaches so far, in thicknesses."""

HIGH = 1.5
"""A rail whose middle line is higher above the plate than so many thicknesses does not lie on it: it has columns."""

UNDER, FREE, BESIDE = 6.0, 5.0, 3.0
"""How far a plate lies below what hangs between its columns; room between a rod and a column below an upright rail, and
below the end of another, in thicknesses."""

CORNERS, FILLS = 12, 0.8
"""Corners about a foot of a plate; a plate that fills more than this share of its rectangle is one."""

UPRIGHT = 0.9
"""An axis whose cosine to Z is above it is upright: its joint stands on a pillar."""


def ground(
    skeleton: Skeleton, companion: Companion, forks: Sequence[Yoke], size: float, reach: Callable[[JointMark], float]
) -> Iterator[Part]:
    """The parts of the base in its own frame; without a plate, where one would hide what is below it, forks alone.

    Args:
        skeleton: the mechanism as it is drawn.
        companion: says how long the rails are.
        forks: the yokes of all universal joints.
        size: the thickness.
        reach: half the length of a joint's pin, in thicknesses.
    """
    base = skeleton.record.base
    laid, lowest = rails(skeleton, companion), 1.6
    feet = [mark.at for stack in _stacks(skeleton, size) for mark in stack]
    deep = depth(skeleton, size)
    sunk = []
    for k, rail in enumerate(laid, 1):
        side, up = bed(skeleton, rail.sliders[0], deep)
        below = (0.65 * size + deep) * up
        sunk.append(replace(rail, start=rail.start - below, end=rail.end - below))
        sides = np.array([(rail.end - rail.start) / 2, 0.8 * size * side, 0.95 * size * up])
        yield Part(f"rail {k}", base, Cuboid(sunk[-1].ends.mean(axis=0), sides), STEEL, "rail")
        lowest = max(lowest, float(1.6 + deep / size * up[2]))
        feet += [rail.start, rail.end]
    drop = _drop(skeleton, np.array(feet), lowest if laid else None, size) if feet else None
    yield from _pillars(skeleton, size, hangs=drop is not None and drop < 0)
    if drop is None:
        for yoke in forks:
            if yoke.link == base:
                for role, shape in yoke.shapes(size):
                    yield Part(f"{yoke.joint} {role}", base, shape, DARK, role, yoke.joint)
        return
    top = float((np.min(feet, axis=0)[2] if drop > 0 else np.max(feet, axis=0)[2]) - drop * size)
    columns = [shape for rail in sunk for shape in _columns(skeleton, rail, top, size)]
    feet += [shape.start for shape in columns]
    outline = _outline(np.array(feet)[:, :2], 3.2 * size, bool(laid))
    yield from _under_pillars(skeleton, top, size)
    corners = np.column_stack([outline, np.full(len(outline), top - 1.3 * size)])
    yield Part("base plate", base, Slab(corners, np.array([0.0, 0.0, 1.3 * size])), PLATE, "plate")
    for k, shape in enumerate(columns, 1):
        yield Part(f"column {k}", base, shape, DARK, "column")
    for mark in skeleton.marks:
        if mark.grounded and not mark.slides and not upright(mark):
            height = (top - (0.15 if drop > 0 else 1.15) * size) - mark.at[2]
            for shape in stand(mark, np.array([0.0, 0.0, height]), (reach(mark) - 0.4) * size, size):
                yield Part(f"{mark.joint.name} stand", base, shape, DARK, "stand", mark.joint.name)


def _pillars(skeleton: Skeleton, size: float, hangs: bool) -> Iterator[Part]:
    """What upright joints of the base stand on, or hang from: a motor, or a pillar."""
    way = np.array([0.0, 0.0, size if hangs else -size])
    for mark in (stack[-1 if hangs else 0] for stack in _stacks(skeleton, size)):
        if upright(mark):
            role, colour = ("motor", DRIVE) if mark.driven else ("pillar", DARK)
            shape = Cylinder(mark.at + 4.6 * way, mark.at + 1.2 * way, 1.9 * size)
            yield Part(f"{mark.joint.name} {role}", skeleton.record.base, shape, colour, role, mark.joint.name)


def _under_pillars(skeleton: Skeleton, top: float, size: float) -> Iterator[Part]:
    """Columns on a plate that lies lower than the feet of upright joints, as it does where rails ask for more room."""
    for mark in (stack[0] for stack in _stacks(skeleton, size)):
        foot = mark.at - np.array([0.0, 0.0, 4.6 * size])
        if upright(mark) and foot[2] > top:
            column = Cylinder(np.array([*foot[:2], top]), foot, size)
            yield Part(f"{mark.joint.name} column", skeleton.record.base, column, DARK, "column", mark.joint.name)


def _stacks(skeleton: Skeleton, size: float) -> list[list[JointMark]]:
    """Joints of the base that do not slide; those that lie above one another together, from below."""
    stacks: list[list[JointMark]] = []
    for mark in sorted(skeleton.marks, key=lambda mark: float(mark.at[2])):
        if mark.grounded and not mark.slides:
            below = next((stack for stack in stacks if np.linalg.norm(stack[0].at[:2] - mark.at[:2]) < size), None)
            if below is None:
                stacks.append([mark])
            else:
                below.append(mark)
    return stacks


def _drop(skeleton: Skeleton, feet: FloatArray, lowest: float | None, size: float) -> float | None:
    """How far the plate lies below the feet (k, 3), in thicknesses, negative where they hang; None without a plate.

    `lowest` is how far rails reach below their sliders, in thicknesses; None where there are none. Rails stand on
    columns where something hangs below them.
    """
    drop = 4.0 if lowest is None else lowest
    others = [rod.points for rod in skeleton.rods if not _on_base(skeleton, rod.link)]
    others += [plate.points for plate in skeleton.plates if not _on_base(skeleton, plate.link)]
    low = min((float(np.min(points[:, 2])) for points in others), default=np.inf) - THICKEST * size
    low = min(low, float(np.min(skeleton.cloud[:, 2])))
    foot = float(np.min(feet[:, 2]))
    if low >= foot - drop * size:
        return drop
    if lowest is not None:
        return (foot - low) / size + UNDER
    hangs = np.max(skeleton.cloud[:, 2]) <= np.max(feet[:, 2]) + size
    heads = [stack[-1].at[2] for stack in _stacks(skeleton, size)]
    return None if not hangs or np.ptp(heads) > size else -drop - 1.3


def _outline(feet: FloatArray, margin: float, railed: bool) -> FloatArray:
    """Outline (k, 2) of a plate about feet (n, 2): a rectangle under rails, else what surrounds them."""
    low, high = feet.min(axis=0) - margin, feet.max(axis=0) + margin
    rectangle = np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]])
    if railed:
        return rectangle
    turns = 2 * np.pi * (np.arange(CORNERS) + 0.5) / CORNERS
    round_feet = feet[:, None] + margin * np.column_stack([np.cos(turns), np.sin(turns)]) / np.cos(np.pi / CORNERS)
    around = hull(round_feet.reshape(-1, 2))
    sides = np.roll(around, -1, axis=0)
    area = 0.5 * abs(float(np.sum(around[:, 0] * sides[:, 1] - around[:, 1] * sides[:, 0])))
    return around if area < FILLS * float(np.prod(high - low)) else rectangle


def _columns(skeleton: Skeleton, rail: Rail, top: float, size: float) -> Iterator[Cylinder]:
    """What holds a rail that is high above the plate: under its ends, from one of them aside where it is upright."""
    lower, upper = sorted(rail.ends, key=lambda end: float(end[2]))
    if lower[2] - top < HIGH * size:
        return
    room = skeleton.room
    below = [np.array([*end[:2], top]) for end in rail.ends]
    way = (upper - lower) / np.linalg.norm(upper - lower)
    if abs(float(way[2])) < UPRIGHT:
        rooms = [room(foot, end) for foot, end in zip(below, rail.ends, strict=True)]
        for foot, end, free in zip(below, rail.ends, rooms, strict=True):
            if free > BESIDE * size or free == max(rooms):
                yield Cylinder(foot, end, size)
        return
    foot = np.array([*lower[:2], top])
    if room(foot, lower) > FREE * size:
        yield Cylinder(foot, lower, size)
        return
    middle = skeleton.cloud[:, :2].mean(axis=0)
    far = np.linalg.norm(skeleton.cloud[:, :2] - middle, axis=1).max() + FREE * size
    turns = 2 * np.pi * np.arange(WAYS) / WAYS
    heads = [np.array([*(middle + far * np.array([np.cos(turn), np.sin(turn)])), upper[2]]) for turn in turns]
    head = max(heads, key=lambda at: room(np.array([*at[:2], top]), at) + room(at, upper))
    yield Cylinder(np.array([*head[:2], top]), head, size)
    yield Cylinder(head, upper, size)


def _on_base(skeleton: Skeleton, link: str) -> bool:
    """Whether a link shares a joint with the base."""
    return any({joint.parent, joint.child} == {link, skeleton.record.base} for joint in skeleton.record.joints.values())


def depth(skeleton: Skeleton, size: float) -> float:
    """How far all rails lie below their sliders: what is hinged to a slider on its rail's line needs room."""
    for slider in skeleton.marks:
        for mark in _hinged_to(skeleton, slider):
            if np.linalg.norm(np.cross(slider.axes[0], mark.at - slider.at)) < OVER * size:
                return SUNK * size
    return 0.0


def held(skeleton: Skeleton, slider: JointMark, size: float) -> list[JointMark]:
    """Joints of what slides on the base that lie right over its carriage, where a thickness is given."""
    return [mark for mark in _hinged_to(skeleton, slider) if np.linalg.norm(mark.at - slider.at) < OVER * size]


def _hinged_to(skeleton: Skeleton, slider: JointMark) -> list[JointMark]:
    """The other joints of what slides on a rail of the base; none where the joint is no such slider."""
    if not (slider.slides and slider.grounded):
        return []
    link = slider.joint.child if slider.joint.parent == skeleton.record.base else slider.joint.parent
    return [mark for mark in skeleton.marks if link in (mark.joint.parent, mark.joint.child) and mark is not slider]


def bed(skeleton: Skeleton, slider: JointMark, deep: float) -> tuple[FloatArray, FloatArray]:
    """Unit vectors across a rail, the second from it to its slider: upwards; of a deep one where most room is left."""
    axis = slider.axes[0]
    side, up = across(axis)
    if not deep:
        return side, up
    half = 0.5 * skeleton.size * axis
    turns = 2 * np.pi * np.arange(WAYS) / WAYS
    ways = np.cos(turns)[:, None] * up + np.sin(turns)[:, None] * side
    middles = slider.rail - deep * ways
    rooms = np.array([skeleton.room(middle - half, middle + half) for middle in middles])
    way = ways[np.argmax(rooms > (1.0 - 1e-6) * rooms.max())]
    return np.cross(way, axis), way


def upright(mark: JointMark) -> bool:
    """Whether the first axis of a joint is upright."""
    return bool(len(mark.axes)) and abs(float(mark.axes[0][2])) > UPRIGHT


def across(axis: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit vectors across an axis, the second as far upwards as can be."""
    up = np.array([0.0, 0.0, 1.0]) if abs(axis[2]) < UPRIGHT else np.array([1.0, 0.0, 0.0])
    up = up - (up @ axis) * axis
    up = up / np.linalg.norm(up)
    return np.cross(up, axis), up
