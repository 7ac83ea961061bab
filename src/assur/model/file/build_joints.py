"""Joints from their entries: points, axes, limits, with every formula evaluated and kept."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from assur.errors import KeyPath
from assur.joints.catalogue import JOINT_TYPES
from assur.model.file import schema
from assur.model.file.limbs import Instance, Placed
from assur.model.file.numbers import KindError, Numbers, Triple, kind_of
from assur.model.file.scope import Scope
from assur.model.formula import Formula, parse
from assur.model.mechanism import Joint
from assur.model.written import (
    JointFormulas,
    LimbTurn,
    NumberReading,
    WrittenVector,
    in_degrees,
    is_zero,
    share_of_turn,
)
from assur.numerics.vectors import Vector

FloatArray = NDArray[np.float64]
SMALL = 1e-9


class JointVectors:
    """Vectors of the file, turned where they belong to a repeated limb: their formulas, and the floats of these."""

    def __init__(self, file: schema.FileEntry, numbers: Numbers) -> None:
        self.numbers = numbers
        self._turns: dict[str, FloatArray] = {}
        self._limbs: dict[str, LimbTurn] = {}
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
            formulas = [self._angle(angle) for angle in repeat.angles]
        else:
            count = repeat.count or 1
            formulas = [share_of_turn(index, count) for index in range(count)]
            angles = [float(formula.evaluate({}, math)) for formula in formulas]
        self._check_apart(angles, (*path, "angles"))
        for index, formula in enumerate(formulas):
            turn, prefix = LimbTurn(repeat.about, formula), Instance(limb, index + 1).prefix
            sound = np.all(np.isfinite([*axis, angles[index]]))
            self._limbs[prefix] = turn
            self._turns[prefix] = np.array(turn.matrix(self.reading), dtype=float) if sound else np.full((3, 3), np.nan)

    @property
    def reading(self) -> NumberReading:
        """Formulas as floats."""
        return NumberReading(self.numbers.values, math, float)

    def _angle(self, formula: Formula) -> Formula:
        """An angle of the file as one in rad."""
        try:
            plain = kind_of(formula.root, self.numbers.kinds) == "plain"
        except (KindError, KeyError):  # a fault already noted
            plain = False
        return in_degrees(formula) if plain and self.numbers.angle_unit == "deg" else formula

    def written(self, components: Triple, instance: Instance | None = None) -> WrittenVector:
        """The formulas of a vector."""
        return WrittenVector(components, self._limbs.get(instance.prefix) if instance else None)

    def written_axis(self, components: Triple, instance: Instance | None = None) -> WrittenVector:
        """The formulas of an axis; of one along an axis of the frame its sense alone."""
        along = [k for k, part in enumerate(components) if not is_zero(part)]
        if len(along) == 1 and components[along[0]].names <= self.numbers.values.keys():
            parts = [parse("0")] * 3
            parts[along[0]] = parse("1" if self.reading.value(components[along[0]]) > 0 else "-1")
            components = parts[0], parts[1], parts[2]
        return self.written(components, instance)

    def _check_apart(self, angles: list[float], path: KeyPath) -> None:
        """No two limbs at one place."""
        for index, angle in enumerate(angles):
            for other in range(index):
                if abs(math.remainder(angle - angles[other], 2 * math.pi)) < SMALL:
                    found = f"limbs {other + 1} and {index + 1} at one place"
                    self.numbers.faults.add((*path, index), found, "allowed: each limb at its own angle")

    def vector(self, components: Triple, path: KeyPath, instance: Instance | None = None) -> FloatArray:
        """A point (3,)."""
        return self._read(self.numbers.vector(components, path), self.written(components, instance).vector, instance)

    def axis(self, components: Triple, path: KeyPath, instance: Instance | None = None) -> FloatArray:
        """A unit vector (3,)."""
        return self._read(self.numbers.axis(components, path), self.written_axis(components, instance).unit, instance)

    def turned(self, vector: FloatArray, instance: Instance | None) -> FloatArray:
        """A vector (3,) of a template, as it is in one of its limbs."""
        return _frozen(self._turns[instance.prefix] @ vector if instance else vector)

    def _read(
        self, checked: FloatArray, written: Callable[[NumberReading], Vector], instance: Instance | None
    ) -> FloatArray:
        """The floats of a vector; NaN where a fault stands in the way."""
        if instance:
            checked = self._turns[instance.prefix] @ checked
        sound = bool(np.all(np.isfinite(checked)))
        return _frozen(np.array(written(self.reading) if sound else checked, dtype=float))


def build_joint(placed: Placed[schema.AnyJoint], scope: Scope, geometry: JointVectors) -> Joint | None:
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
        written=_written(placed, geometry),
    )


def _written(placed: Placed[schema.AnyJoint], geometry: JointVectors) -> JointFormulas:
    """The formulas of a joint's dimensions."""
    entry, instance = placed.entry, placed.instance
    axes: tuple[Triple, ...] = ()
    child_axis: Triple | None = None
    if isinstance(entry, schema.AxialEntry):
        axes, child_axis = (entry.axis,), entry.child_axis
    elif isinstance(entry, schema.UniversalEntry):
        axes = tuple(entry.axes)
    return JointFormulas(
        geometry.written(entry.at, instance),
        geometry.written(entry.child_at, instance),
        tuple(geometry.written_axis(axis, instance) for axis in axes),
        geometry.written_axis(child_axis, instance) if child_axis else None,
        entry.pitch if isinstance(entry, schema.HelicalEntry) else None,
    )


def _axes(placed: Placed[schema.AnyJoint], geometry: JointVectors) -> tuple[FloatArray, FloatArray]:
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
    written = geometry.axis(entry.axis, (*path, "axis"))
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
    return axes, np.array(_written(placed, geometry).turn(geometry.reading), dtype=float)


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


def _cone(placed: Placed[schema.AnyJoint], geometry: JointVectors) -> tuple[FloatArray | None, float | None]:
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


def _frozen(array: FloatArray) -> FloatArray:
    array.flags.writeable = False
    return array
