"""Solids: a skeleton as a model of bars, pins, sliders, rails, platform and base plate.

Links that meet in a hinge lie in different layers along its axis (tongue, fork, wider fork), so that none
runs through another. Sizes other than those of the joint graph are drawn only.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from assur.figures.companion import Companion
from assur.figures.mesh import Mesh, ball, bar, box, cylinder, joined, slab
from assur.figures.skeleton import Mark, Rod, Skeleton
from assur.figures.sketch import hull, rails
from assur.topology.joints import SPHERICAL

FloatArray = NDArray[np.float64]
STEEL = "#9aa3ab"
DARK = "#5d656c"
PLATE = "#d5d8da"
DRIVE = "#e0a020"
STAGE = "#e6cf6a"
LINKS = ("#5b9bc8", "#4fb591", "#d98a5f", "#c98bb0", "#8cc3e6", "#b59a7d")
PLAIN = "#b4bac0"
FLAT = 0.1
"""A platform whose outline has less than this share of the square of its length is drawn as a bar."""

DEEP = 0.2
"""A platform that is thicker than this share of its length is drawn by its bars alone."""

LAYERS = ((0.0,), (-0.95, 0.95), (-1.8, 1.8))
THICK = (1.0, 0.7, 0.7)
"""Middles of the plates of a tongue, a fork and a wider fork, and their thickness, in units of `unit`."""


def unit(skeleton: Skeleton) -> float:
    """The length that drawn thicknesses are multiples of."""
    return 0.018 * skeleton.size


def model(skeleton: Skeleton, companion: Companion, accents: Mapping[str, str] | None = None) -> Mesh:
    """The whole model; `accents` gives links another colour than that of their chain."""
    layers = link_layers(skeleton)
    colours = {**_chain_colours(skeleton), **(accents or {})}
    parts = [
        _rod(skeleton, rod, layers[rod.link], colours.get(rod.link, PLAIN)) for rod in skeleton.rods if rod.size > 0
    ]
    parts += [
        cylinder(a, b, 0.7 * unit(skeleton), colours.get(plate.link, PLAIN))
        for plate in skeleton.plates
        for k, a in enumerate(plate.points)
        for b in plate.points[:k]
    ]
    for mark in skeleton.marks:
        parts += _joint(skeleton, mark, layers)
    parts += _stage(skeleton, colours.get(skeleton.record.platform.link, STAGE))
    return joined([*parts, *_base(skeleton, companion)])


def link_layers(skeleton: Skeleton) -> dict[str, int]:
    """Link -> its layer, another one than those of the links that it is hinged to."""
    hinges = [mark.joint for mark in skeleton.marks if not mark.slides]
    found: dict[str, int] = {}
    for link in skeleton.record.links:
        others = {
            joint.child if joint.parent == link else joint.parent
            for joint in hinges
            if link in (joint.parent, joint.child)
        }
        used = {found[other] for other in others if other in found and other != skeleton.record.base}
        found[link] = next((k for k in range(len(LAYERS)) if k not in used), 0)
    return found


def _chain_colours(skeleton: Skeleton) -> dict[str, str]:
    order = {name: LINKS[k % len(LINKS)] for k, name in enumerate(skeleton.chains)}
    colours = {link: order[chain] for link, chain in skeleton.chain_of().items()}
    return {**colours, skeleton.record.platform.link: STAGE}


def _rod(skeleton: Skeleton, rod: Rod, layer: int, colour: str) -> Mesh:
    """Flat bars normal to the hinges at its ends, or a round rod where it has none across it."""
    size = unit(skeleton)
    start, end = rod.points
    normal = _hinge_normal(skeleton, rod)
    if normal is None:
        return cylinder(start, end, 0.75 * size, colour)
    plates = [
        bar(
            start + shift * size * normal,
            end + shift * size * normal,
            normal,
            1.15 * size,
            THICK[layer] * size,
            colour,
        )
        for shift in LAYERS[layer]
    ]
    return joined(plates)


def _hinge_normal(skeleton: Skeleton, rod: Rod) -> FloatArray | None:
    along = (rod.points[1] - rod.points[0]) / rod.size
    for mark in skeleton.marks:
        meets = np.min(np.linalg.norm(rod.points - mark.at, axis=1)) < 1e-9 * skeleton.size
        own = rod.link in (mark.joint.parent, mark.joint.child)
        if own and meets and not mark.slides and len(mark.axes) and abs(float(mark.axes[0] @ along)) < 1e-9:
            return np.asarray(mark.axes[0])
    return None


def _joint(skeleton: Skeleton, mark: Mark, layers: Mapping[str, int]) -> list[Mesh]:
    size = unit(skeleton)
    if mark.joint.type is SPHERICAL:
        return [ball(mark.at, 1.4 * size, DARK)]
    parts = []
    if mark.telescopes:
        parts.append(cylinder(mark.rail, mark.at, 0.5 * size, STEEL))
    if mark.slides:
        axis = mark.axes[0]
        across, up = _across(axis)
        sides = size * np.array([2.6 * axis, 1.9 * across, 1.15 * up])
        parts.append(box(mark.shown + 0.1 * size * up, sides, DRIVE if mark.driven else PLAIN))
    else:
        reach = max(max(LAYERS[layers[link]]) for link in (mark.joint.parent, mark.joint.child)) + 0.75
        colour = DRIVE if mark.driven else DARK
        parts += [
            cylinder(mark.at - reach * size * axis, mark.at + reach * size * axis, 0.7 * size, colour)
            for axis in mark.axes
        ]
    if mark.grounded and not mark.slides and abs(float(mark.axes[0][2])) > 0.9:
        parts.append(
            cylinder(
                mark.at - [0, 0, 4.0 * size],
                mark.at - [0, 0, 1.2 * size],
                1.9 * size,
                DRIVE if mark.driven else DARK,
            )
        )
    return parts


def _across(axis: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit vectors across an axis, the second as far upwards as can be."""
    up = np.array([0.0, 0.0, 1.0]) if abs(axis[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
    up = up - (up @ axis) * axis
    up = up / np.linalg.norm(up)
    return np.cross(up, axis), up


def _stage(skeleton: Skeleton, colour: str) -> list[Mesh]:
    """A plate on a platform of three or more joints that lie almost in a plane across its Z axis."""
    link = skeleton.record.platform.link
    rotation, origin = skeleton.frames[link]
    points = [rod.points for rod in skeleton.rods if rod.link == link] + [
        p.points for p in skeleton.plates if p.link == link
    ]
    joints = [mark for mark in skeleton.marks if link in (mark.joint.parent, mark.joint.child)]
    if len(joints) < 3 or not points:
        return []
    size = unit(skeleton)
    local = (np.concatenate(points) - origin) @ rotation
    if np.ptp(local[:, 2]) > DEEP * np.max(np.ptp(local, axis=0)):
        return []
    level = float(local[:, 2].max()) + 1.3 * size
    corners = _outline(local[:, :2], 2.4 * size)
    if len(corners):
        raised = np.column_stack([corners, np.full(len(corners), level)])
        return [slab(origin + raised @ rotation.T, 0.8 * size * rotation[:, 2], colour)]
    low, high = (
        local.min(axis=0) - np.array([1.2 * size, 3.4 * size, 0.0]),
        local.max(axis=0) + np.array([1.2 * size, 3.4 * size, 0.0]),
    )
    low[2], high[2] = level, level + 0.8 * size
    return [box(origin + rotation @ ((low + high) / 2), np.diag((high - low) / 2) @ rotation.T, colour)]


def _outline(points: FloatArray, margin: float) -> FloatArray:
    """Convex hull (k, 2) of points, moved out by a margin; empty (0, 2) where they lie almost on a line."""
    corners = hull(points)
    along, across = np.roll(corners, -1, axis=0), np.ptp(points, axis=0)
    area = 0.5 * abs(float(np.sum(corners[:, 0] * along[:, 1] - corners[:, 1] * along[:, 0])))
    if len(corners) < 3 or area < FLAT * float(np.max(across)) ** 2:
        return np.zeros((0, 2))
    outwards = corners - corners.mean(axis=0)
    return np.asarray(corners + margin * outwards / np.linalg.norm(outwards, axis=1, keepdims=True))


def _base(skeleton: Skeleton, companion: Companion) -> list[Mesh]:
    """A plate under everything that stands on the base, and the rails."""
    size = unit(skeleton)
    found = rails(skeleton, companion)
    parts, feet = [], [mark.at for mark in skeleton.marks if mark.grounded and not mark.slides]
    for start, end in found:
        axis = (end - start) / np.linalg.norm(end - start)
        across, up = _across(axis)
        sides = np.array([(end - start) / 2, 0.8 * size * across, 0.95 * size * up])
        parts.append(box((start + end) / 2 - 0.65 * size * up, sides, STEEL))
        feet += [start, end]
    if not feet:
        return parts
    drop = 1.6 if found else 4.0
    if np.min(skeleton.cloud[:, 2]) < np.min(feet, axis=0)[2] - drop * size:
        return parts  # a plate would hide what is below it
    low, high = np.min(feet, axis=0) - 3.2 * size, np.max(feet, axis=0) + 3.2 * size
    high[2] = np.min(feet, axis=0)[2] - drop * size
    low[2] = high[2] - 1.3 * size
    return [*parts, box((low + high) / 2, np.diag((high - low) / 2), PLATE)]
