"""Loops as linear equations in points on unit circles and spheres.

A link that turns about u by psi carries a vector w to  w_u + z (w' - i u x w')/2 + z~ (w' + i u x w')/2,  with
z = exp(i psi), z~ = 1/z, w_u the part of w along u and w' the rest: linear in z and z~ as if they were independent.
So is a sliding length s along a fixed direction; across the axis of a link that turns, s z and s z~ are the unknowns.
A rod on a hinge across u, turned by phi about it, is a point on a sphere: its unknowns are k z, k z~ and sin phi with
k = cos phi; those of a rod between ball joints are the components of its direction, and those of a platform on ball
joints the vectors between three of their centres. Every loop is three linear equations in these. What is left is
quadratic: z z~ = 1 for a circle, (s z) z~ = z (s z~) for a slider, (k z)(k z~) + sin² phi = 1 and (k z) z~ = z (k z~)
for a rod, length 1 for a direction, three sides for a triangle.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import WRITTEN, characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.loops.hinges import NotCirclesError, middle
from assur.kinematics.loops.orientations import Turning
from assur.kinematics.loops.unknowns import UnknownGroup
from assur.model.mechanism import Joint, MechanismRecord
from assur.model.pose import LENGTHS
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
Turnings = Mapping[str, Turning]
UNUSED = 1e-9
"""Coefficients below this do not occur in an equation whose lengths are over the characteristic length."""


@dataclass(frozen=True, eq=False)
class System:
    """Linear equations `matrix` (r, 1 + c) on (1, unknowns), lengths over `length`.

    Attributes:
        groups: unknowns of links that turn.
        slides: index of a length -> its column, where its direction is fixed.
        turnings: orientations of the links.
    """

    record: MechanismRecord
    matrix: ComplexArray
    groups: tuple[UnknownGroup, ...]
    slides: Mapping[int, int]
    turnings: Turnings
    length: float


def system(
    record: MechanismRecord, turnings: Turnings, locked: Mapping[int, float], place: Mapping[str, float]
) -> System:
    """The equations of all loops, and of the platform's point where `place` gives coordinates of it."""
    record = _with_origins_on_joints(record, frozenset(link for link in turnings if turnings[link].corners is None))
    turnings = _rods_along_circles(record, turnings)
    circles = 1 + max((turning.circle for turning in turnings.values() if turning.circle is not None), default=-1)
    groups = [UnknownGroup("circle", 1 + 2 * number, 1 + 2 * number) for number in range(circles)]
    column = 1 + 2 * circles
    rods = sorted(
        {turning.rod: 1 + 2 * (turning.circle or 0) for turning in turnings.values() if turning.rod is not None}.items()
    )
    for _, circle in rods:
        groups.append(UnknownGroup("rod", column, circle))
        column += 3
    for _ in range(1 + max((turning.ball for turning in turnings.values() if turning.ball is not None), default=-1)):
        groups.append(UnknownGroup("ball", column, column, alone=True))
        column += 3
    length = characteristic_length(record)
    for turning in turnings.values():
        if turning.corners is not None:
            first, second = (turning.corners[1:] - turning.corners[0]) / length
            sides = tuple(float(side @ side) for side in (first, second, first - second))
            groups.append(UnknownGroup("triangle", column, column, alone=True, sides=sides))
            column += 6
    slides: dict[int, int] = {}
    for name, joint in record.joints.items():
        for axis, index in _sliding(record, joint):
            if index in locked:
                continue
            across = _across(joint, axis, turnings[joint.parent])
            if across is None:
                slides[index] = column
            else:
                groups.append(UnknownGroup("slider", column, 1 + 2 * across, name, index=index))
            column += 1 if across is None else 2
    bare = System(record, np.zeros((0, column), dtype=complex), tuple(groups), slides, turnings, length)
    matrix = _equations(bare, locked, place)
    return replace(bare, matrix=matrix, groups=_alone(groups, matrix))


@lru_cache(maxsize=64)
def _with_origins_on_joints(record: MechanismRecord, links: frozenset[str]) -> MechanismRecord:
    """The mechanism with a joint's point as the origin of links that have none there: a rod is seen from its end."""
    points: dict[str, list[FloatArray]] = {}
    for joint in record.joints.values():
        points.setdefault(joint.parent, []).append(joint.at)
        points.setdefault(joint.child, []).append(joint.child_at)
    near = UNUSED * characteristic_length(record)
    beside = {
        link for link in links - {record.base} if link in points and min(map(np.linalg.norm, points[link])) > near
    }
    shift = {link: own[0] if link in beside else np.zeros(3) for link, own in points.items()}
    moved = {
        name: replace(joint, at=joint.at - shift[joint.parent], child_at=joint.child_at - shift[joint.child])
        for name, joint in record.joints.items()
    }
    point = record.platform.point - shift[record.platform.link]
    return replace(record, joints=moved, platform=replace(record.platform, point=point))


def joint_values(system: System, unknowns: ComplexArray, locked: Mapping[int, float]) -> FloatArray:
    """Joint values (N, n) of real unknowns (N, 1 + c), the first of which is 1."""
    record = system.record
    slices = joint_graph(record).slices
    values = np.zeros((len(unknowns), len(record.coordinates)))
    placed = {link: _orientation(system, turning, unknowns) for link, turning in system.turnings.items()}
    lengths = {index: unknowns[:, column].real for index, column in system.slides.items()}
    lengths |= {
        i.index: (unknowns[:, i.first] / unknowns[:, i.circle]).real for i in system.groups if i.kind == "slider"
    }
    for index, length in lengths.items():
        values[:, index] = length * system.length
    for name, joint in record.joints.items():
        own = values[:, slices[name]]
        turned = _back(placed[joint.parent]) @ placed[joint.child] @ joint.turn.T
        if joint.type.turns == 1 and not joint.type.screw:
            own[:, -1] = rotations.to_vector(turned) @ joint.axes[0]
        if joint.type.ball:
            own[:] = rotations.to_vector(turned)
        if joint.type.turns == 2:
            cross = _back(placed[joint.parent]) @ placed[middle(joint)]
            own[:, 0] = rotations.to_vector(cross) @ joint.axes[0]
            own[:, 1] = rotations.to_vector(_back(cross) @ turned) @ joint.axes[1]
    for index, value in locked.items():
        values[:, index] = value
    return values


def _back(rotation: FloatArray) -> FloatArray:
    return np.swapaxes(rotation, -1, -2)


def _rods_along_circles(record: MechanismRecord, turnings: Turnings) -> dict[str, Turning]:
    """Rods on hinges turned so that at phi = 0 they point along hinge x axis."""
    found = dict(turnings)
    ends = [(j.parent, j.at) for j in record.joints.values()] + [(j.child, j.child_at) for j in record.joints.values()]
    angles: dict[int, FloatArray] = {}
    for link, vector in ends:
        turning = turnings[link]
        if turning.rod is None or turning.hinge is None or turning.axis is None or turning.rod in angles:
            continue
        turned = turning.rotation @ vector
        across = turned - (turned @ turning.hinge) * turning.hinge
        if np.linalg.norm(across) > UNUSED * characteristic_length(record):
            wanted = rotations.cross(turning.hinge, turning.axis)
            angles[turning.rod] = np.arctan2(turning.hinge @ rotations.cross(across, wanted), across @ wanted)
    for link, turning in turnings.items():
        if turning.rod in angles and turning.hinge is not None:
            found[link] = replace(
                turning, rotation=rotations.about_axis(turning.hinge, angles[turning.rod]) @ turning.rotation
            )
    return found


def _alone(groups: list[UnknownGroup], matrix: ComplexArray) -> tuple[UnknownGroup, ...]:
    """Rods whose circle occurs nowhere else are points on spheres, and their circles no unknowns."""
    found = []
    for group in groups:
        others = [other for other in groups if other is not group and other.circle == group.circle]
        used = bool(np.any(np.abs(matrix[:, group.circle : group.circle + 2]) > UNUSED))
        if not used and group.kind == "rod" and len(others) == 1:
            found.append(replace(group, alone=True))
        elif used or group.kind != "circle" or [other.kind for other in others] != ["rod"]:
            found.append(group)
    return tuple(found)


def _sliding(record: MechanismRecord, joint: Joint) -> Iterator[tuple[FloatArray, int]]:
    """Directions (3,) that a joint slides along in its parent, and the indices of its lengths."""
    start = joint_graph(record).slices[joint.name].start
    for step, first in joint.type.places:
        if step.kind == "slide":
            yield joint.axes[step.direction], start + first


def _shift(record: MechanismRecord, joint: Joint, locked: Mapping[int, float]) -> FloatArray:
    """How far (3,) what is locked has moved the joint's point in its parent."""
    shift = np.zeros(3)
    for axis, index in _sliding(record, joint):
        shift = shift + locked.get(index, 0.0) * axis
    if joint.type.screw:
        index = joint_graph(record).slices[joint.name].start
        if index not in locked:
            raise NotCirclesError(f"{joint.name} is {joint.type.name}")
        shift = shift + locked[index] * joint.pitch / (2 * np.pi) * joint.axes[0]
    return shift


def _across(joint: Joint, axis: FloatArray, parent: Turning) -> int | None:
    """The circle about whose axis a direction that a joint slides along turns; None where the direction is fixed."""
    if parent.circle is None or parent.axis is None:
        return None
    along = abs(parent.axis @ parent.rotation @ axis)
    if parent.rod is not None or WRITTEN < along < 1.0 - 0.5 * WRITTEN**2:
        raise NotCirclesError(f"{joint.name} slides obliquely on a link that turns")
    return None if along > 0.5 else parent.circle


def _equations(bare: System, locked: Mapping[int, float], place: Mapping[str, float]) -> ComplexArray:
    record, graph = bare.record, joint_graph(bare.record)
    points: dict[str, ComplexArray] = {record.base: np.zeros((3, bare.matrix.shape[1]), dtype=complex)}
    steps = {name: _step(bare, joint, locked) for name, joint in record.joints.items()}
    for joint, forward in graph.tree:
        near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
        points[far] = points[near] + (steps[joint.name] if forward else -steps[joint.name])
    rows = [points[joint.parent] + steps[joint.name] - points[joint.child] for joint in graph.cut]
    link = record.platform.link
    for name, value in place.items():
        point = points[link] + _carried(bare, link, record.platform.point / bare.length)
        row = point[[LENGTHS.index(name)]].copy()
        row[:, 0] -= value / bare.length
        rows.append(row)
    return np.concatenate(rows) if rows else bare.matrix


def _step(bare: System, joint: Joint, locked: Mapping[int, float]) -> ComplexArray:
    """From the parent's origin to the child's (3, 1 + c)."""
    fixed = joint.at + _shift(bare.record, joint, locked)
    step = _carried(bare, joint.parent, fixed / bare.length) - _carried(bare, joint.child, joint.child_at / bare.length)
    for axis, index in _sliding(bare.record, joint):
        direction = _carried(bare, joint.parent, axis)
        if index in bare.slides:
            step[:, bare.slides[index]] += direction[:, 0]
        elif index not in locked:
            (own,) = (group for group in bare.groups if group.index == index)
            step[:, own.first : own.first + 2] += direction[:, own.circle : own.circle + 2]
    return step


def _carried(bare: System, link: str, vector: FloatArray) -> ComplexArray:
    """A vector (3,) fixed in a link, as (3, 1 + c) on (1, unknowns); of a triangle, the vector from corner 1 to it."""
    turning = bare.turnings[link]
    row = np.zeros((3, bare.matrix.shape[1]), dtype=complex)
    if turning.corners is not None:
        corners = turning.corners / bare.length
        sides = (corners[1:] - corners[0]).T
        shares = np.linalg.pinv(sides) @ (vector - corners[0])
        if np.linalg.norm(sides @ shares - (vector - corners[0])) > UNUSED:
            raise NotCirclesError(f"{link} carries a point outside the plane of three ball joints")
        row[:, list(_triangle(bare, turning).columns)] = np.kron(shares, np.eye(3))
        return row
    if turning.line is not None:
        share = vector @ turning.line
        if np.linalg.norm(vector - share * turning.line) > UNUSED:
            raise NotCirclesError(f"{link} is no straight rod")
        row[:, list(_ball(bare, turning).columns)] = share * np.eye(3)
        return row
    turned = turning.rotation @ vector
    if turning.circle is None or turning.axis is None:
        row[:, 0] = turned
        return row
    circle = 1 + 2 * turning.circle
    if turning.hinge is not None:
        rod = [group for group in bare.groups if group.kind == "rod"][turning.rod or 0]
        along = rotations.cross(turning.hinge, turning.axis)
        share = turned @ along
        turned = turned - share * along
        if abs(turned @ turning.axis) > UNUSED:
            raise NotCirclesError(f"{link} is no straight rod")
        row[:, rod.first : rod.first + 2] += share * _halves(turning.axis, along)
        row[:, rod.first + 2] -= share * turning.axis
    row[:, 0] = (turning.axis @ turned) * turning.axis
    row[:, circle : circle + 2] += _halves(turning.axis, turned - row[:, 0].real)
    return row


def _halves(axis: FloatArray, across: FloatArray) -> ComplexArray:
    """Coefficients (3, 2) of z and z~ for a vector across the axis."""
    quarter = rotations.cross(axis, across)
    return np.stack([(across - 1j * quarter) / 2, (across + 1j * quarter) / 2], axis=1)


def _triangle(system: System, turning: Turning) -> UnknownGroup:
    return [group for group in system.groups if group.kind == "triangle"][turning.triangle or 0]


def _ball(system: System, turning: Turning) -> UnknownGroup:
    return [group for group in system.groups if group.kind == "ball"][turning.ball or 0]


def _orientation(system: System, turning: Turning, unknowns: ComplexArray) -> FloatArray:
    """Orientations (N, 3, 3) of a link at real unknowns (N, 1 + c)."""
    count = len(unknowns)
    if turning.corners is not None:
        sides = unknowns[:, list(_triangle(system, turning).columns)].real.reshape(count, 2, 3)
        return np.asarray(_upright(sides) @ _upright((turning.corners[1:] - turning.corners[0])[None])[0].T)
    if turning.line is not None:
        return _along(turning.line, unknowns[:, list(_ball(system, turning).columns)].real)
    if turning.circle is None or turning.axis is None:
        return np.broadcast_to(turning.rotation, (count, 3, 3))
    z = unknowns[:, 1 + 2 * turning.circle]
    inner = turning.rotation
    if turning.hinge is not None:
        rod = [group for group in system.groups if group.kind == "rod"][turning.rod or 0]
        angle = np.arctan2(unknowns[:, rod.first + 2].real, (unknowns[:, rod.first] / z).real)
        inner = rotations.about_axis(turning.hinge, angle) @ inner
    return rotations.about_axis(turning.axis, np.angle(z)) @ inner


def _along(line: FloatArray, ends: FloatArray) -> FloatArray:
    """Rotations (N, 3, 3) that take a direction (3,) onto others (N, 3), by way of a half turn if on its other side."""
    across = rotations.cross(line, np.eye(3)[np.argmin(np.abs(line))])
    half_turn = rotations.about_axis(across / np.linalg.norm(across), np.asarray(np.pi))
    ahead = (ends @ line >= 0.0)[:, None]
    turned = rotations.taking(line, np.where(ahead, ends, -ends))
    return np.where(ahead[:, :, None], turned, turned @ half_turn)


def _upright(sides: FloatArray) -> FloatArray:
    """Frames (N, 3, 3) whose x axis is along the first of two vectors (N, 2, 3), and whose xy plane contains both."""
    x = sides[:, 0] / np.linalg.norm(sides[:, 0], axis=1, keepdims=True)
    z = rotations.cross(x, sides[:, 1])
    z = z / np.linalg.norm(z, axis=1, keepdims=True)
    return np.stack([x, rotations.cross(z, x), z], axis=2)
