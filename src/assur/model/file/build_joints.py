"""Joints from their entries: points, axes, limits, with every formula evaluated."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from assur.joints.catalogue import JOINT_TYPES
from assur.model.file import schema
from assur.model.file.key_path import KeyPath
from assur.model.file.limbs import Instance, Placed
from assur.model.file.numbers import Numbers, Triple
from assur.model.file.scope import Scope
from assur.model.mechanism import Joint
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
SMALL = 1e-9


class Geometry:
    """Vectors of the file: numbers from formulas, turned where they belong to a repeated limb."""

    def __init__(self, file: schema.FileEntry, numbers: Numbers) -> None:
        self.numbers = numbers
        self._turns: dict[str, FloatArray] = {}
        for name, limb in file.limbs.items():
            if limb.repeat:
                self._place(name, limb.repeat)
            else:  # a fault already noted
                self._turns[Instance(name, 1).prefix] = np.eye(3)

    def _place(self, limb: str, repeat: schema.Repeat) -> None:
        path = ("limbs", limb, "repeat")
        axis = self.numbers.axis(repeat.about, (*path, "about"))
        if repeat.angles:
            given = enumerate(repeat.angles)
            angles = [self.numbers.angle(angle, (*path, "angles", index)) for index, angle in given]
        else:
            count = repeat.count or 1
            angles = [2 * math.pi * index / count for index in range(count)]
        self._check_apart(angles, (*path, "angles"))
        for index, angle in enumerate(angles):
            turn = rotations.about_axis(axis, np.array(angle))
            self._turns[Instance(limb, index + 1).prefix] = turn

    def _check_apart(self, angles: list[float], path: KeyPath) -> None:
        """No two limbs at one place."""
        for index, angle in enumerate(angles):
            for other in range(index):
                if abs(math.remainder(angle - angles[other], 2 * math.pi)) < SMALL:
                    found = f"limbs {other + 1} and {index + 1} at one place"
                    self.numbers.faults.add((*path, index), found, "allowed: each limb at its own angle")

    def vector(self, components: Triple, path: KeyPath, instance: Instance | None = None) -> FloatArray:
        """A point (3,)."""
        return self.turned(self.numbers.vector(components, path), instance)

    def axis(self, components: Triple, path: KeyPath, instance: Instance | None = None) -> FloatArray:
        """A unit vector (3,)."""
        return self.turned(self.numbers.axis(components, path), instance)

    def turned(self, vector: FloatArray, instance: Instance | None) -> FloatArray:
        """A vector (3,) of a template, as it is in one of its limbs."""
        result = self._turns[instance.prefix] @ vector if instance else vector
        result.flags.writeable = False
        return result


def build_joint(placed: Placed[schema.AnyJoint], scope: Scope, geometry: Geometry) -> Joint | None:
    """A joint, or None where one of its links is unknown."""
    entry, path, instance = placed.entry, placed.path, placed.instance
    parent = scope.link(entry.parent, (*path, "parent"), instance)
    child = scope.link(entry.child, (*path, "child"), instance)
    if parent is not None and parent == child:
        scope.faults.add((*path, "child"), f"joins '{entry.child}' to itself", "allowed: two different links")
    at = geometry.vector(entry.at, (*path, "at"), instance)
    child_at = geometry.vector(entry.child_at, (*path, "child_at"), instance)
    axes, turn = _axes(placed, geometry)
    axes.flags.writeable = turn.flags.writeable = False
    limits = _limits(placed, geometry.numbers)
    pitch = _pitch(placed, geometry.numbers)
    cone_axis, cone = _cone(placed, geometry)
    alias = next((alias for alias, joint in scope.aliases.items() if joint == placed.name), "")
    if parent is None or child is None:
        return None
    return Joint(
        name=placed.name,
        type=JOINT_TYPES[entry.type],
        parent=parent,
        child=child,
        at=at,
        child_at=child_at,
        axes=axes,
        turn=turn,
        pitch=pitch,
        alias=alias,
        limits=limits,
        cone=cone,
        cone_axis=cone_axis,
        meaning=entry.meaning,
    )


def _axes(placed: Placed[schema.AnyJoint], geometry: Geometry) -> tuple[FloatArray, FloatArray]:
    """Unit vectors (k, 3) of all its steps, and the orientation (3, 3) of the child's frame at value zero."""
    entry, path, instance = placed.entry, placed.path, placed.instance
    if isinstance(entry, schema.SphericalEntry):
        return np.zeros((0, 3)), np.eye(3)
    if isinstance(entry, schema.UniversalEntry):
        pair = [geometry.axis(axis, (*path, "axes", place), instance) for place, axis in enumerate(entry.axes)]
        if float(np.linalg.norm(np.cross(pair[0], pair[1]))) < SMALL:
            hint = "two parallel axes are one freedom: use a revolute"
            geometry.numbers.faults.add((*path, "axes"), "two parallel axes", "allowed: two that are not", hint)
        return np.array(pair), np.eye(3)
    written = geometry.numbers.axis(entry.axis, (*path, "axis"))
    # What is made of it is made in the template, so that joint values mean the same in every limb.
    made = JOINT_TYPES[entry.type].directions([tuple(written.tolist())])
    axes = np.array([geometry.turned(np.array(direction), instance) for direction in made])
    if entry.child_axis is None:
        return axes, np.eye(3)
    axis = axes[0]
    child_axis = geometry.axis(entry.child_axis, (*path, "child_axis"), instance)
    if float(axis @ child_axis) < -1 + SMALL:
        allowed = "allowed: any direction but the opposite, from which a smallest turn to `axis` exists"
        hint = "turn the child's frame so that child_axis is the axis itself, and leave child_axis out"
        geometry.numbers.faults.add((*path, "child_axis"), "the opposite of `axis`", allowed, hint)
        return axes, np.eye(3)
    return axes, rotations.taking(child_axis, axis)


def _limits(placed: Placed[schema.AnyJoint], numbers: Numbers) -> tuple[tuple[float, float] | None, ...]:
    entry, path = placed.entry, (*placed.path, "limits")
    kind = JOINT_TYPES[entry.type]
    if isinstance(entry, schema.SphericalEntry):
        return (None,) * kind.freedoms
    if kind.freedoms > 1:
        given = [(getattr(entry.limits, part), (*path, part)) for part in kind.components]
    else:
        given = [(entry.limits, path)]
    return tuple(
        numbers.interval(what, ends, place) if ends else None
        for (ends, place), what in zip(given, kind.kinds, strict=True)
    )


def _pitch(placed: Placed[schema.AnyJoint], numbers: Numbers) -> float:
    if not isinstance(placed.entry, schema.HelicalEntry):
        return 0.0
    path = (*placed.path, "pitch")
    pitch = numbers.plain(placed.entry.pitch, path)
    if pitch == 0:
        numbers.faults.add(path, "pitch 0", "allowed: the advance per turn", "without one it is a revolute")
    return pitch


def _cone(placed: Placed[schema.AnyJoint], geometry: Geometry) -> tuple[FloatArray | None, float | None]:
    """Axis (3,) and half angle in rad."""
    if not isinstance(placed.entry, schema.SphericalEntry) or placed.entry.cone is None:
        return None, None
    path = (*placed.path, "cone")
    cone = placed.entry.cone
    angle = geometry.numbers.angle(cone.angle, (*path, "angle"))
    if angle <= 0 or angle > math.pi:
        found = f'"{cone.angle.text}"'
        geometry.numbers.faults.add((*path, "angle"), found, "allowed: above 0, up to half a turn")
    return geometry.axis(cone.axis, (*path, "axis"), placed.instance), angle
