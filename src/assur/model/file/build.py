"""From a description to a record: every name resolved, every formula evaluated, every fault noted."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from assur.errors import KeyPath
from assur.model.file import schema
from assur.model.file.build_chains import build_chains, build_generalised
from assur.model.file.build_inputs import build_home, build_inputs
from assur.model.file.build_joints import JointVectors, build_joint
from assur.model.file.build_letters import build_angles, build_modes, build_points
from assur.model.file.build_machine import MACHINE_TABLES, build_machine
from assur.model.file.description import Description
from assur.model.file.faults import Faults
from assur.model.file.graph_checks import check_graph
from assur.model.file.limbs import expand, repeated
from assur.model.file.names import check_names
from assur.model.file.numbers import Numbers
from assur.model.file.parameters import evaluate_parameters
from assur.model.file.scope import Scope
from assur.model.mechanism import Link, MechanismRecord, Platform
from assur.model.pose import ANGLES, LENGTHS, QUATERNION, is_angle, rate_names

_REQUIRED = {
    "format": "1, the format that this version reads",
    "name": "a short name: letters, digits, _ and -",
    "unit": "the unit of length: mm, cm, m, in or ft",
    "angle": "the unit of angles: deg or rad",
    "base": "the link that stands still",
    "platform": "the link that is moved: its link, point and pose",
    "links": "a table of at least two links",
    "joints": "a table of joints",
    "inputs": "a table of the actuated joints",
    "home": "values of all joints near one assembled configuration",
}
MOST = {"joints": 200, "limbs": 60, "parameters": 4000}
"""Sizes far beyond any mechanism, so that no file takes long."""
_OTHERS = 400


def build(description: Description, overrides: Mapping[str, float], faults: Faults) -> MechanismRecord:
    """The record of a description, with some parameters at other values.

    Errors:
        MechanismFileError: every fault of the description, those already noted among them.
    """
    record = built(description, overrides, faults)
    faults.raise_any()
    return record


def built(description: Description, overrides: Mapping[str, float], faults: Faults) -> MechanismRecord:
    """The same, its faults noted and not raised: what they leave unknown is empty, NaN or missing in the record.

    Errors:
        MechanismFileError: the description is too large to be looked at.
    """
    file, cut = description.form.entry, description.form.cut
    _check_size(file, faults)
    _check_required(file, cut, faults)
    tables = expand(description, faults)
    check_names(file, tables, faults)
    scope = Scope(tables, faults)
    unit, angle = file.unit or "mm", file.angle or "rad"
    broken = tables.broken.get("parameters", frozenset())
    parameters, numbers = evaluate_parameters(file.parameters, overrides, (unit, angle), broken, faults)
    geometry = JointVectors(file, numbers)
    joints = {name: build_joint(placed, scope, geometry) for name, placed in tables.joints.items()}
    platform = _platform(file, scope, geometry)
    drives = build_inputs(file, tables, scope, numbers)
    determining = len(rate_names(platform.pose)) or len(drives)
    record = MechanismRecord(
        name=file.name or "",
        title=file.title or file.name or "",
        source=file.source,
        unit=unit,
        angle=angle,
        parameters=parameters,
        links={name: Link(name, placed.entry.meaning) for name, placed in tables.links.items()},
        joints={name: joint for name, joint in joints.items() if joint},
        base="" if file.base is None else scope.link(file.base, ("base",)) or "",
        platform=platform,
        inputs=drives[:determining],
        redundant_inputs=drives[determining:],
        coordinates=tuple(scope.coordinates),
        home=build_home(tables, scope, geometry),
        modes=build_modes(file, scope, numbers),
        file=description.path,
        folder=description.path.parent,
        generalised=build_generalised(tables, scope),
        chains=build_chains(tables, scope),
        angles=build_angles(file, scope),
        points=build_points(tables, scope, geometry),
        box=_box(file, numbers),
        sections=_sections(file, numbers),
        description=description,
        overrides=dict(overrides),
        machine=build_machine(file, tables, scope, geometry, (joints, drives)),
    )
    check_graph(record, tables, faults)
    return record


def _check_size(file: schema.FileEntry, faults: Faults) -> None:
    """Limbs count as often as they repeat."""
    others = ("links", "inputs", "generalised", "points", "home", *MACHINE_TABLES)
    most = {**dict.fromkeys(others, _OTHERS), **MOST}
    for table, limit in most.items():
        count = len(file.inputs.entries if table == "inputs" else getattr(file, table))
        count += sum(len(getattr(limb, table, ())) * repeated(limb) for limb in file.limbs.values())
        if count > limit:
            faults.add((table,), f"{count} entries", f"allowed: at most {limit}")
            faults.raise_any()


def _check_required(file: schema.FileEntry, cut: frozenset[KeyPath], faults: Faults) -> None:
    for key, what in _REQUIRED.items():
        given = file.inputs.entries if key == "inputs" else getattr(file, key)
        in_limb = any(getattr(limb, key, None) for limb in file.limbs.values())
        if not given and not in_limb and not any(path[0] in (key, "limbs") for path in cut):
            faults.add((key,), "missing", f"this must be there: {what}")


def _platform(file: schema.FileEntry, scope: Scope, geometry: JointVectors) -> Platform:
    entry = file.platform
    if entry is None:
        return Platform("", np.zeros(3), (), "any")
    link = scope.link(entry.link, ("platform", "link"))
    if link is not None and entry.link == file.base:
        scope.faults.add(("platform", "link"), f"'{link}' is the base", "allowed: another link")
    path, names = ("platform", "pose"), set(entry.pose)
    if len(names) < len(entry.pose):
        again = next(k for k, name in enumerate(entry.pose) if name in entry.pose[:k])
        first = scope.faults.first((*path, entry.pose.index(entry.pose[again])))
        found = f"the coordinate {entry.pose[again]} twice; {first}"
        scope.faults.add((*path, again), found, "allowed: each once")
    if names & set(QUATERNION) and (not names >= set(QUATERNION) or names & set(ANGLES)):
        scope.faults.add(path, "half a quaternion", "allowed: qw, qx, qy, qz together, without angles")
    if names - set(LENGTHS) and entry.orientation == "constant":
        scope.faults.add(path, "a coordinate that turns", "allowed with constant orientation: x, y, z")
    point = geometry.vector(entry.point, ("platform", "point"))
    return Platform(link or "", point, entry.pose, entry.orientation, geometry.written(entry.point))


def _box(file: schema.FileEntry, numbers: Numbers) -> dict[str, tuple[float, float]]:
    pose = file.platform.pose if file.platform else ()
    found = {}
    for name, ends in file.workspace.box.items():
        path = ("workspace", "box", name)
        if name not in pose and file.platform:
            numbers.faults.unknown(path, "coordinate of the pose", name, pose)
        found[name] = numbers.interval("angle" if is_angle(name) else "length", ends, path)
    return found


def _sections(file: schema.FileEntry, numbers: Numbers) -> tuple[float, ...]:
    last = file.platform.pose[-1] if file.platform else ""
    path = ("workspace", "sections")
    given = enumerate(file.workspace.sections)
    return tuple(numbers.of("angle" if is_angle(last) else "length", value, (*path, at)) for at, value in given)
