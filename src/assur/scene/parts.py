"""Parts: every link of a mechanism as bars, pins, sliders, rails and plates, in the link's own frame.

Links that meet in a hinge lie in different layers along its axis (tongue, fork, wider fork), so that none
runs through another. Sizes other than those of the joint graph are drawn only, as multiples of one thickness.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.home import home_values
from assur.model.mechanism import MechanismRecord
from assur.scene.companion import Companion
from assur.scene.companion import companion as companion_of
from assur.scene.ground import bed, depth, ground, held, upright
from assur.scene.hull import hull
from assur.scene.joining import posts, stand
from assur.scene.mesh import Mesh, joined
from assur.scene.part import DARK, DRIVE, LINKS, PLAIN, STAGE, STEEL, Part
from assur.scene.rods import BALL, LAYERS, broad, broad_rods, rod_parts
from assur.scene.shapes import Ball, Cuboid, Cylinder, Slab
from assur.scene.sizes import thickness
from assur.scene.skeleton import JointMark, Skeleton
from assur.scene.skeleton import skeleton as skeleton_at
from assur.scene.stacking import stacked
from assur.scene.telescopes import telescope
from assur.scene.yokes import ASIDE, Yoke, cross, trimmed, yokes

FloatArray = NDArray[np.float64]
FLAT = 0.1
"""A platform whose outline has less than this share of the square of its length is drawn as a bar."""

DEEP = 0.2
"""A platform that is thicker than this share of its length is drawn by its bars alone."""

MOTOR, LEAST, ROOMY = 4.5, 2.4, 6.0
"""How far a motor reaches beyond the stand of its hinge, room for one, and for a thicker one, in thicknesses."""


def unit(skeleton: Skeleton) -> float:
    """The thickness of a flat bar, of which all drawn sizes are multiples: one for every configuration."""
    return thickness(skeleton.record)


@lru_cache(maxsize=64)
def machine(record: MechanismRecord) -> tuple[Part, ...]:
    """Every solid of a mechanism, made once, at home: whatever is drawn or exported moves these with their links.

    >>> from assur.model.registry import load_record
    >>> sorted({item.role for item in machine(load_record("fivebar")) if item.link == "base"})
    ['motor', 'pin', 'plate']
    """
    names = companion_of(record)
    return parts(skeleton_at(record, names, home_values(record)), names)


def parts(skeleton: Skeleton, companion: Companion) -> tuple[Part, ...]:
    """Every solid, as it is made for one configuration, each in the frame of its link.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> from assur.scene.skeleton import skeleton
    >>> record = load_record("fivebar")
    >>> found = parts(skeleton(record, Companion(), home_values(record)), Companion())
    >>> [item.name for item in found if item.link == "crank1"]
    ['bar A1 B1', 'B1 pin']
    """
    cut = []
    for part in _placed(skeleton, companion, _chain_colours(skeleton)):
        rotation, origin = skeleton.frames[part.link]
        cut.append(replace(part, shape=part.shape.moved(rotation.T, -rotation.T @ origin)))
    return tuple(cut)


def model(skeleton: Skeleton, accents: Mapping[str, str] | None = None) -> Mesh:
    """The machine where a configuration has its links; `accents` gives links another colour than their chain's."""
    made = machine(skeleton.record)
    if accents:
        own = _chain_colours(skeleton)
        made = tuple(
            replace(part, colour=accents.get(part.link, part.colour))
            if part.colour == own.get(part.link, PLAIN)
            else part
            for part in made
        )
    return placed(made, skeleton)


def placed(solids: tuple[Part, ...], skeleton: Skeleton) -> Mesh:
    """Parts as one mesh in the base frame, where this configuration has their links."""
    return joined([part.shape.mesh(part.colour).moved(*skeleton.frames[part.link]) for part in solids])


def _placed(skeleton: Skeleton, companion: Companion, colours: Mapping[str, str]) -> Iterator[Part]:
    """Every part with its shape still in the base frame."""
    layers, forks = link_layers(skeleton), yokes(skeleton)
    skeleton = stacked(trimmed(skeleton, forks, unit(skeleton)), unit(skeleton))
    for yoke in forks:
        if yoke.link != skeleton.record.base:
            yield from _yoke(skeleton, yoke, colours.get(yoke.link, PLAIN))
    breadth = broad_rods(skeleton)
    for rod in skeleton.rods:
        if rod.size > 0:
            yield from rod_parts(skeleton, rod, layers[rod.link], colours.get(rod.link, PLAIN), breadth)
    for plate in skeleton.plates:
        colour = colours.get(plate.link, PLAIN)
        for k, a in enumerate(plate.points):
            for j, b in enumerate(plate.points[:k]):
                shape = Cylinder(a, b, 0.7 * unit(skeleton))
                yield Part(f"bar {j + 1} {k + 1} of {plate.link}", plate.link, shape, colour)
    for mark in skeleton.marks:
        yield from _joint(skeleton, mark, layers)
    yield from _stage(skeleton, colours.get(skeleton.record.platform.link, STAGE))
    yield from ground(skeleton, companion, forks, unit(skeleton), lambda mark: _reach(mark, layers, True))


def _yoke(skeleton: Skeleton, yoke: Yoke, colour: str) -> Iterator[Part]:
    for role, shape in yoke.shapes(unit(skeleton)):
        yield Part(f"{yoke.joint} {role}", yoke.link, shape, colour, role, yoke.joint)


def link_layers(skeleton: Skeleton) -> dict[str, int]:
    """Link -> its layer, another one than those of the links that it is hinged to, but for universal joints."""
    hinges = [mark.joint for mark in skeleton.marks if not (mark.slides or mark.flat) and mark.joint.type.turns != 2]
    depths: dict[str, int] = {}
    for link in skeleton.record.links:
        others = {
            joint.child if joint.parent == link else joint.parent
            for joint in hinges
            if link in (joint.parent, joint.child)
        }
        used = {depths[other] for other in others if other in depths and other != skeleton.record.base}
        depths[link] = next((k for k in range(len(LAYERS)) if k not in used), 0)
    return depths


def _chain_colours(skeleton: Skeleton) -> dict[str, str]:
    order = {name: LINKS[k % len(LINKS)] for k, name in enumerate(skeleton.chains)}
    colours = {link: order[chain] for link, chain in skeleton.chain_of().items()}
    return {**colours, skeleton.record.platform.link: STAGE}


def _joint(skeleton: Skeleton, mark: JointMark, layers: Mapping[str, int]) -> Iterator[Part]:
    size, joint = unit(skeleton), mark.joint
    if joint.type.ball:
        yield Part(f"{joint.name} ball", joint.child, Ball(mark.at, BALL * size), DARK, "ball", joint.name)
        return
    colour = DRIVE if mark.driven else DARK
    if mark.slides:
        yield from _slider(skeleton, mark, layers)
    elif joint.type.turns == 2:
        for link, role, piece in cross(mark, size):
            yield Part(f"{joint.name} {role}", link, piece, colour, "pin", joint.name)
    elif mark.flat:
        yield from _table(skeleton, mark, colour)
    else:
        over = any(mark in held(skeleton, slider, size) for slider in skeleton.marks)
        reach = _reach(mark, layers, mark.grounded or over) * size * mark.axes[0]
        shape = Cylinder(mark.at - reach, mark.at + reach, 0.7 * size)
        yield Part(f"{joint.name} pin", joint.parent, shape, colour, "pin", joint.name)
    if mark.grounded and mark.driven and joint.type.turns == 1 and not mark.slides and not upright(mark):
        motor = _motor(skeleton, mark, layers)
        if motor is not None:
            yield Part(f"{joint.name} motor", skeleton.record.base, motor, DRIVE, "motor", joint.name)


def _motor(skeleton: Skeleton, mark: JointMark, layers: Mapping[str, int]) -> Cylinder | None:
    """On the pin of a driven hinge of the base, on that side of its stand where what moves leaves more room.

    None where rods lie along the pin on both sides: the colour of the pin alone says that it is driven.
    """
    size, axis = unit(skeleton), mark.axes[0]
    near = (_reach(mark, layers, True) + 0.1) * size

    def room(sense: float) -> float:
        first, last = (mark.at + sense * (near + far * size) * axis for far in (1.0, MOTOR))
        return skeleton.room(first, last)

    sense = max((1.0, -1.0), key=room)
    if room(sense) < LEAST * size:
        return None
    first, last = (mark.at + sense * (near + far * size) * axis for far in (1.0, MOTOR))
    thick = float(np.clip(skeleton.room(first, last, {mark.joint.child}) / ROOMY, size, broad(skeleton) * size))
    start = mark.at + sense * near * axis
    return Cylinder(start, start + sense * (MOTOR - 1.0) * thick * axis, 1.6 * thick)


def _reach(mark: JointMark, layers: Mapping[str, int], stands: bool) -> float:
    """Half the length of a pin, in units of `unit`: through all layers, and through a stand."""
    if mark.joint.type.turns == 2:
        return ASIDE + 0.4
    widest = max(max(LAYERS[layers[link]]) for link in (mark.joint.parent, mark.joint.child))
    return widest + 0.75 + 0.6 * stands


def _table(skeleton: Skeleton, mark: JointMark, colour: str) -> Iterator[Part]:
    """A round plate of the parent on which a puck of the child slides and turns."""
    size, normal, joint = unit(skeleton), mark.axes[0], mark.joint
    radius = float(np.linalg.norm(mark.at - mark.rail)) + 3.2 * size
    foot = mark.rail - ((mark.rail - mark.at) @ normal) * normal
    plate = Cylinder(foot - 1.6 * size * normal, foot - 0.8 * size * normal, radius)
    yield Part(f"{joint.name} table", joint.parent, plate, PLAIN, "table", joint.name)
    puck = Cylinder(mark.at - 0.75 * size * normal, mark.at + 0.75 * size * normal, 1.9 * size)
    yield Part(f"{joint.name} puck", joint.child, puck, colour, "puck", joint.name)


def _slider(skeleton: Skeleton, mark: JointMark, layers: Mapping[str, int]) -> Iterator[Part]:
    """A carriage on its rail; of a leg that grows longer a tube, a rod in it and a collar at the tube's end."""
    joint, axis, size = mark.joint, mark.axes[0], unit(skeleton)
    deep = 0.0 if mark.telescopes else depth(skeleton, size)
    side, up = bed(skeleton, mark, deep)
    colour = DRIVE if mark.driven else PLAIN
    where, link, name = mark.at, joint.child, "carriage"
    if mark.telescopes:
        tube, rod = telescope(skeleton, mark, size)
        where, link, name = tube.end, joint.parent, "collar"
        yield Part(f"{joint.name} tube", joint.parent, tube, STEEL, "tube", joint.name)
        yield Part(f"{joint.name} rod", joint.child, rod, STEEL, "rod", joint.name)
    over = held(skeleton, mark, size) if deep else []
    pins = np.array([_reach(mark, layers, True) * mark.axes[0] for mark in over if len(mark.axes)]).reshape(-1, 3)
    along, wide = (np.max(np.abs(pins @ way), initial=least) for way, least in ((axis, 2.6), (side, 1.9)))
    sides = size * np.array([along * axis, wide * side, 1.15 * up])
    middle = where + (0.1 * size - deep) * up
    yield Part(f"{joint.name} {name}", link, Cuboid(middle, sides), colour, name, joint.name)
    for mark_over in over:
        for shape in stand(mark_over, middle - mark_over.at, (_reach(mark_over, layers, True) - 0.4) * size, size):
            yield Part(f"{mark_over.joint.name} stand", link, shape, colour, "stand", mark_over.joint.name)
    if deep and not over:
        yield Part(f"{joint.name} post", link, Cylinder(middle, mark.at, 0.75 * size), colour, "post", joint.name)


def _stage(skeleton: Skeleton, colour: str) -> Iterator[Part]:
    """A plate on a platform of three or more joints that lie almost in a plane across its Z axis."""
    link = skeleton.record.platform.link
    rotation, origin = skeleton.frames[link]
    points = [rod.points for rod in skeleton.rods if rod.link == link] + [
        p.points for p in skeleton.plates if p.link == link
    ]
    joints = [mark for mark in skeleton.marks if link in (mark.joint.parent, mark.joint.child)]
    if len(joints) < 3 or not points:
        return
    size = unit(skeleton)
    local = (np.concatenate(points) - origin) @ rotation
    if np.ptp(local[:, 2]) > DEEP * np.max(np.ptp(local, axis=0)):
        return
    level = float(local[:, 2].max()) + 1.3 * size
    for k, post in enumerate(posts(skeleton, level + 0.4 * size, 0.5 * size), 1):
        yield Part(f"post {k}", link, post, colour, "post")
    corners = _outline(local[:, :2], 2.4 * size)
    if len(corners):
        raised = np.column_stack([corners, np.full(len(corners), level)])
        yield Part("plate", link, Slab(origin + raised @ rotation.T, 0.8 * size * rotation[:, 2]), colour, "plate")
        return
    margin = np.array([1.2 * size, 3.4 * size, 0.0])
    low, high = local.min(axis=0) - margin, local.max(axis=0) + margin
    low[2], high[2] = level, level + 0.8 * size
    shape = Cuboid(origin + rotation @ ((low + high) / 2), np.diag((high - low) / 2) @ rotation.T)
    yield Part("plate", link, shape, colour, "plate")


def _outline(points: FloatArray, margin: float) -> FloatArray:
    """Convex hull (k, 2) of points, moved out by a margin; empty (0, 2) where they lie almost on a line."""
    corners = hull(points)
    along, across = np.roll(corners, -1, axis=0), np.ptp(points, axis=0)
    area = 0.5 * abs(float(np.sum(corners[:, 0] * along[:, 1] - corners[:, 1] * along[:, 0])))
    if len(corners) < 3 or area < FLAT * float(np.max(across)) ** 2:
        return np.zeros((0, 2))
    outwards = corners - corners.mean(axis=0)
    return np.asarray(corners + margin * outwards / np.linalg.norm(outwards, axis=1, keepdims=True))
