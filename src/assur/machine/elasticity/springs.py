"""Springs at coordinates of joints: actuators, gears before them, and joints that give way where they should hold.

What a joint gives way by beside its own freedoms are virtual joints, as many as its compliance has ranks: none along
what stays rigid. A rotor behind a gear that yields has a coordinate of its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.validation.check import METRES
from assur.model.file.place import entry_hint
from assur.model.machine_data import RIGID, Actuator
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
ACTUATORS = "actuators"
"""Stands for all of them, gears too, among links that strain energy is in."""
GEARS = "gears"
JOINTS = "joints"
"""Stands for all joints that give way, among links and kinds of strain."""


@dataclass(frozen=True, eq=False)
class VirtualJoint:
    """How the child of a joint gives way against its parent, at the joint's point on the child.

    Attributes:
        link: the child; places and directions are in its frame.
        point: (3,) in m.
        twists: (6, r) rotation, and displacement over the characteristic length, of each coordinate.
        stiffness: (r,) in J.
    """

    link: str
    point: FloatArray
    twists: FloatArray
    stiffness: FloatArray


@dataclass(frozen=True, eq=False)
class Springs:
    """Springs between coordinates of a structure.

    Attributes:
        ends: (S, w) what each is stretched by, per coordinate: 1, -1 or 0.
        stiffness: (S,) in N/m, N m/rad, or J for a virtual joint.
        kinds: `ACTUATORS`, `GEARS` or `JOINTS`.
        names: of inputs, or of joints.
        rotors: (w,) inertia at each coordinate, in kg, kg m2.
        before: the joint coordinates of the rotors behind gears, which are the last coordinates.
    """

    ends: FloatArray
    stiffness: FloatArray
    kinds: tuple[str, ...]
    names: tuple[str, ...]
    rotors: FloatArray
    before: tuple[int, ...]

    def energies(self, coordinates: FloatArray) -> FloatArray:
        """Of each (S,), in J, at coordinates (w, k), summed over k."""
        return np.asarray(0.5 * self.stiffness * np.sum((self.ends @ coordinates) ** 2, axis=1))

    def efforts(self, coordinates: FloatArray) -> FloatArray:
        """What springs exert along each coordinate (w,), at coordinates (w,)."""
        return np.asarray(-self.ends.T @ (self.stiffness * (self.ends @ coordinates)))


def virtual_joints(record: MechanismRecord) -> dict[str, VirtualJoint]:
    """Those of the file's compliances, by joints.

    >>> from assur.model.registry import load_record
    >>> virtual_joints(load_record("zeng2019"))
    {}
    """
    metre, length = METRES[record.unit], METRES[record.unit] * characteristic_length(record)
    made = {}
    for name, compliance in record.machine.compliances.items():
        sizes = np.sqrt(np.diag(compliance))
        scale = 1.0 / np.where(sizes > 0.0, sizes, 1.0)
        shares, ways = np.linalg.eigh(compliance * scale * scale[:, None])
        kept = shares > RIGID
        roots = sizes[:, None] * ways[:, kept] * np.sqrt(shares[kept])  # the compliance is roots @ roots.T
        plain = np.concatenate([roots[3:], roots[:3] / length])
        yields = np.linalg.norm(plain, axis=0)
        joint = record.joints[name]
        made[name] = VirtualJoint(joint.child, metre * joint.child_at, plain / yields, 1.0 / yields**2)
    return made


def springs(record: MechanismRecord, virtual: Mapping[str, VirtualJoint]) -> Springs:
    """Springs at the joints' coordinates, at those of virtual joints after them, and at rotors behind gears last.

    Errors:
        UsageError: an actuator of which the file says no stiffness.
    """
    drives = _actuators(record)
    count = len(record.coordinates) + sum(len(own.stiffness) for own in virtual.values())
    geared = [index for index, _, own in drives if own.gear and own.gear.stiffness]
    rows = np.eye(count + len(geared))
    ends, stiffness, kinds, names = [], [], [], []
    rotors = np.zeros(len(rows))
    for index, name, own in drives:
        held = index
        rotors[index] += own.inertia
        if own.gear and own.gear.stiffness:
            held = count + geared.index(index)
            rotors[index], rotors[held] = own.rotor, own.inertia - own.rotor
            ends.append(rows[index] - rows[held])
            stiffness.append(own.gear.stiffness)
            kinds.append(GEARS)
            names.append(name)
        ends.append(rows[held])
        stiffness.append(float(own.stiffness or 0.0))
        kinds.append(ACTUATORS)
        names.append(name)
    first = len(record.coordinates)
    for name, joint in virtual.items():
        ends += list(rows[first : first + len(joint.stiffness)])
        stiffness += joint.stiffness.tolist()
        kinds += [JOINTS] * len(joint.stiffness)
        names += [name] * len(joint.stiffness)
        first += len(joint.stiffness)
    return Springs(np.array(ends), np.array(stiffness), tuple(kinds), tuple(names), rotors, tuple(geared))


def _actuators(record: MechanismRecord) -> list[tuple[int, str, Actuator]]:
    """Joint coordinate, input and actuator of each drive."""
    known, lacking = [], []
    for drive in record.drives:
        label = record.coordinate_label(drive.coordinate)
        actuator = record.machine.actuators.get(label)
        if actuator is None or actuator.stiffness is None:
            lacking.append((label, drive.coordinate.kind))
        else:
            known.append((drive.coordinate.index, drive.name, actuator))
    if lacking:
        label, kind = lacking[0]
        size, unit = ("1e7", "N/m") if kind == "length" else ("1e5", "N m/rad")
        raise UsageError(
            f"{record.name}: no stiffness of {', '.join(name for name, _ in lacking)}",
            hint=f"{entry_hint(record, 'actuators', label, f'stiffness = {size}')}, in {unit}",
        )
    return known
