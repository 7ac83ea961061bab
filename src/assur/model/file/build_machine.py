"""Masses, cross-sections, actuators and tolerances from their entries, every name resolved and every fault noted."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import KeyPath
from assur.joints.catalogue import JOINT_TYPES
from assur.model.file import schema
from assur.model.file.build_compliances import joint_compliances, link_compliance
from assur.model.file.build_joints import JointVectors
from assur.model.file.build_profiles import build_materials, build_profiles, check_positive
from assur.model.file.faults import Faults
from assur.model.file.limbs import Instance, Placed, Tables
from assur.model.file.scope import Scope
from assur.model.machine_data import Actuator, Gear, Gravity, LinkData, MachineData, Profile, Tolerance
from assur.model.mechanism import Input, Joint

FloatArray = NDArray[np.float64]
MACHINE_TABLES = ("materials", "profiles", "actuators", "tolerances", "clearances", "compliances")
ROUNDED = 1e-9
"""Share of the largest principal moment by which the triangle inequality may fail: moments are written with digits."""
OF_A_BOUND = 3.0
"""A bound is so many standard deviations where the file does not say."""


def build_machine(
    file: schema.FileEntry,
    tables: Tables,
    scope: Scope,
    geometry: JointVectors,
    made: tuple[Mapping[str, Joint | None], Sequence[Input]],
) -> MachineData:
    """All that the file says of the machine; `made` are its joints and its inputs, redundant ones too."""
    faults = scope.faults
    materials = build_materials(file.materials, faults)
    profiles = build_profiles(file.profiles, geometry, faults)
    names = _Names(tables, scope, made[1])
    data = {}
    for name, placed in tables.links.items():
        own = _link(placed, placed.entry, placed.instance, (geometry, scope))
        alone = tables.single_links.get(name)
        if alone is not None:
            own = _merged(own, _link(alone, alone.entry, None, (geometry, scope), placed.instance))
        if own is not None:
            _check_link(own, (alone or placed).path, file, profiles, faults)
            data[name] = own
    for name, alone in tables.single_links.items():
        if name not in tables.links:
            scope.link(name, alone.path)
    payload = None
    if file.payload is not None:
        payload = _weight(file.payload, ("payload",), geometry, None)
        if payload.mass is None:
            faults.add(("payload", "mass"), "missing", "this key must be there: a mass in kg")
    return MachineData(
        materials=materials,
        profiles=profiles,
        gravity=_gravity(file.gravity, geometry),
        payload=payload,
        links=data,
        actuators=_actuators(file, names, faults),
        tolerances=_tolerances(file, names, geometry),
        clearances=_clearances(file, names, geometry),
        compliances=joint_compliances(file.compliances, tables, geometry, names.of_joint),
    )


class _Names:
    """What names of joints, of inputs and of sizes stand for: `A` of a template for all of its limbs."""

    def __init__(self, tables: Tables, scope: Scope, drives: Sequence[Input]) -> None:
        self.tables, self.drives, self.faults = tables, drives, scope.faults
        self.joints: dict[str, list[str]] = {}
        for name, placed in tables.joints.items():
            for text in {name, placed.local}:
                self.joints.setdefault(text, []).append(name)
        for alias, name in scope.aliases.items():
            self.joints.setdefault(alias, []).append(name)

    def of_joint(self, text: str, path: KeyPath) -> list[str]:
        """Joints of a name; none, and a fault, where there is none."""
        if text not in self.joints and text not in self.tables.broken.get("joints", ()):
            self.faults.unknown(path, "joint", text, self.joints)
        return self.joints.get(text, [])

    def of_input(self, text: str, path: KeyPath) -> list[str]:
        """Labels of the driven coordinates that a joint's name stands for, with its component where it has several."""
        driven: dict[str, list[str]] = {}
        for item in self.drives:
            joint, part = item.coordinate.joint, item.coordinate.component
            label = self.label(item)
            for name, joints in self.joints.items():
                if joint in joints:
                    for known in (name, f"{name}.{part}"):
                        driven.setdefault(known, []).append(label)
        complete = len(self.drives) == len(self.tables.inputs) and not self.tables.broken.get("inputs")
        if text not in driven and complete:
            self.faults.unknown(path, "driven joint", text, driven)
        return driven.get(text, [])

    def label(self, drive: Input) -> str:
        """A driven coordinate: its joint, with the component where it has several."""
        joint = drive.coordinate.joint
        single = JOINT_TYPES[self.tables.joints[joint].entry.type].freedoms == 1
        return joint if single else f"{joint}.{drive.coordinate.component}"


def _gravity(entry: schema.GravityEntry | None, geometry: JointVectors) -> Gravity:
    if entry is None:
        return Gravity()
    check_positive(entry.value, ("gravity", "value"), geometry.numbers.faults, zero=True)
    return Gravity(geometry.axis(entry.direction, ("gravity", "direction")), entry.value)


def _link(
    placed: Placed[schema.LinkEntry],
    entry: schema.LinkEntry,
    instance: Instance | None,
    readers: tuple[JointVectors, Scope],
    limb: Instance | None = None,
) -> LinkData | None:
    """What an entry says of a link; vectors of a template turn with `instance`, names of joints may be the limb's."""
    if not entry.model_fields_set - {"meaning"}:
        return None
    geometry, scope = readers
    path = placed.path
    weight = _weight(entry, path, geometry, instance)
    check_positive(entry.kg_per_m, (*path, "kg_per_m"), scope.faults)
    bars = []
    for place, pair in enumerate(entry.bars or ()):
        ends = [scope.joint(text, (*path, "bars", place), instance or limb) for text in pair]
        if ends[0] == ends[1] and None not in ends:
            scope.faults.add((*path, "bars", place), f"{ends[0]} twice", "allowed: two joints")
        if ends[0] and ends[1]:
            bars.append((ends[0], ends[1]))
            _check_ends((ends[0], ends[1]), placed.name, (*path, "bars", place), scope)
    return replace(
        weight,
        kg_per_m=entry.kg_per_m,
        profile=entry.profile,
        material=entry.material,
        rigid=entry.rigid,
        up=None if entry.up is None else geometry.axis(entry.up, (*path, "up"), instance),
        bars=tuple(bars),
        compliance=link_compliance(entry.compliance, (*path, "compliance"), geometry, instance),
    )


def _check_ends(ends: Iterable[str], link: str, path: KeyPath, scope: Scope) -> None:
    """Joints of a bar are joints of its link."""
    for name in ends:
        joint = scope.tables.joints[name]
        beside = [scope.link(text, joint.path, joint.instance) for text in (joint.entry.parent, joint.entry.child)]
        if link not in beside and None not in beside:
            scope.faults.add(path, f"'{name}' is no joint of {link}", f"allowed: a joint of {link}")


def _weight(entry: schema.WeightEntry, path: KeyPath, geometry: JointVectors, instance: Instance | None) -> LinkData:
    """Mass, centre and inertia of an entry."""
    faults = geometry.numbers.faults
    check_positive(entry.mass, (*path, "mass"), faults, zero=True)
    for key in ("centre", "inertia"):
        if getattr(entry, key) is not None and entry.mass is None:
            faults.add((*path, key), f"{key} without mass", "allowed beside a mass", "add mass, in kg")
    centre = None if entry.centre is None else geometry.vector(entry.centre, (*path, "centre"), instance)
    return LinkData(entry.mass, centre, _tensor(entry, path, geometry, instance))


def _tensor(
    entry: schema.WeightEntry, path: KeyPath, geometry: JointVectors, instance: Instance | None
) -> FloatArray | None:
    """The inertia (3, 3) of an entry, as it is in its limb."""
    if entry.inertia is None:
        return None
    xx, yy, zz, xy, xz, yz = entry.inertia
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    low, middle, high = np.linalg.eigvalsh(tensor)
    if low < -ROUNDED * abs(high) or high > (low + middle) * (1.0 + ROUNDED) or high < 0.0:
        moments = f"principal moments {low:.4g}, {middle:.4g}, {high:.4g}"
        allowed = "allowed: none negative, and none larger than the sum of the two others"
        geometry.numbers.faults.add((*path, "inertia"), moments, allowed, "the order is xx, yy, zz, xy, xz, yz")
    if instance is None:
        return tensor
    turn = np.stack([geometry.turned(axis, instance) for axis in np.eye(3)], axis=-1)
    return np.asarray(turn @ tensor @ turn.T)


def _merged(template: LinkData | None, alone: LinkData | None) -> LinkData | None:
    """What a template says of a link, and what is said of it in one limb, which counts more."""
    if template is None or alone is None:
        return alone if template is None else template
    said: dict[str, Any] = {item.name: getattr(alone, item.name) for item in fields(LinkData)}
    said = {name: part for name, part in said.items() if isinstance(part, np.ndarray) or part}
    return replace(template, **said)


def _check_link(
    data: LinkData, path: KeyPath, file: schema.FileEntry, profiles: Mapping[str, Profile], faults: Faults
) -> None:
    for key, entries in (("material", file.materials), ("profile", file.profiles)):
        name = getattr(data, key)
        if name is not None and name not in entries and name not in _written(faults, f"{key}s"):
            faults.unknown((*path, key), key, name, entries)
    if data.profile is not None and data.material is None and data.mass is None and data.kg_per_m is None:
        faults.add((*path, "profile"), "a profile without material", "allowed: material = beside it, or kg_per_m")
    if data.compliance is not None and len(data.bars) > 1:
        allowed = "allowed: one pair, the joint that is held and the joint that gives way"
        faults.add((*path, "bars"), f"{len(data.bars)} pairs beside a compliance", allowed)
    profile = profiles.get(data.profile or "")
    if profile and profile.iy != profile.iz and profile.up is None and data.up is None:
        faults.add((*path, "profile"), f"'{profile.name}' without up", 'allowed: up = "z", or another direction')


def _written(faults: Faults, table: str) -> frozenset[str]:
    """Names in a table whose entries are not in form."""
    data = faults.source.data.get(table)
    return frozenset(data) if isinstance(data, dict) else frozenset()


def _actuators(file: schema.FileEntry, names: _Names, faults: Faults) -> dict[str, Actuator]:
    general: dict[str, Actuator] = {}
    own: dict[str, Actuator] = {}
    for text, entry in file.actuators.items():
        path = ("actuators", text)
        for key in ("stiffness", "force", "speed"):
            check_positive(getattr(entry, key), (*path, key), faults)
        check_positive(entry.rotor, (*path, "rotor"), faults, zero=True)
        for key in ("coulomb", "viscous"):
            check_positive(getattr(entry.friction, key), (*path, "friction", key), faults, zero=True)
        friction = entry.friction.coulomb, entry.friction.viscous
        gear = None if entry.gear is None else _gear(entry.gear, (*path, "gear"), faults)
        actuator = Actuator(entry.stiffness, entry.force, entry.speed, entry.rotor, *friction, gear)
        labels = names.of_input(text, path)
        (general if len(labels) > 1 else own).update(dict.fromkeys(labels, actuator))
    return {**general, **own}


def _gear(entry: schema.GearEntry, path: KeyPath, faults: Faults) -> Gear:
    if entry.ratio == 0.0:
        faults.add((*path, "ratio"), "0", "allowed: a number that is not zero")
    check_positive(entry.stiffness, (*path, "stiffness"), faults)
    check_positive(entry.rotor, (*path, "rotor"), faults, zero=True)
    return Gear(entry.ratio, entry.stiffness, entry.rotor)


def _tolerances(file: schema.FileEntry, names: _Names, geometry: JointVectors) -> dict[str, Tolerance]:
    numbers, tables = geometry.numbers, names.tables
    owners = {"", *(instance.prefix for instance in tables.instances), *tables.links}
    inputs = {item.name: item.coordinate.kind for item in names.drives}
    tolerances = {}
    for text, entry in file.tolerances.items():
        path: KeyPath = ("tolerances", text)
        owner, _, local = text.rpartition(".")
        kind = inputs.get(text) or ("angle" if numbers.kinds.get(local) == "angle" else "length")
        if text not in inputs and (local not in file.parameters or owner not in owners):
            known = [*inputs, *file.parameters] if not owner else [*owners - {""}, *file.parameters]
            numbers.faults.unknown(path, "size", text, known)
            continue
        if entry.bound is None and entry.sigma is None:
            numbers.faults.add(path, "nothing", "allowed: a bound, or { sigma = 0.02 }")
            continue
        sizes = {
            key: numbers.of(kind, value, (*path, key))
            for key, value in (("bound", entry.bound), ("sigma", entry.sigma))
            if value is not None
        }
        sound = [check_positive(size, (*path, key), numbers.faults, zero=True) for key, size in sizes.items()]
        if all(sound):
            bound = sizes.get("bound", OF_A_BOUND * sizes.get("sigma", 0.0))
            tolerances[text] = Tolerance(bound, sizes.get("sigma", bound / OF_A_BOUND))
    return tolerances


def _clearances(file: schema.FileEntry, names: _Names, geometry: JointVectors) -> dict[str, float]:
    general: dict[str, float] = {}
    own: dict[str, float] = {}
    for text, value in file.clearances.items():
        path: KeyPath = ("clearances", text)
        radius = geometry.numbers.plain(value, path)
        check_positive(radius, path, geometry.numbers.faults, zero=True)
        joints = names.of_joint(text, path)
        (general if len(joints) > 1 else own).update(dict.fromkeys(joints, radius))
    return {**general, **own}
