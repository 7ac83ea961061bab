"""What only the closed joint graph tells of a file: whether it moves, as its inputs, pose and limits claim."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from assur.errors import MechanismFileError, Problem
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.instantaneous import instantaneous
from assur.kinematics.motions import Ranks, general
from assur.model.file.faults import path_text
from assur.model.file.toml_source import KeyPath
from assur.model.joint_graph import joint_graph
from assur.model.mechanism import MechanismRecord
from assur.model.pose import rate_names

SMALLEST, LARGEST = 1e-3, 50.0
"""A mechanism smaller or larger than this, in metres, has probably its lengths in another unit."""

METRES = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
TURNS = 1e-6
"""A platform whose angular velocity, of a motion of size one, stays below this keeps its orientation."""


@lru_cache(maxsize=64)
def faults(record: MechanismRecord) -> tuple[Problem, ...]:
    """Faults of a mechanism whose file reads well: loops that do not close, no freedom, too few or too many inputs,
    inputs or a pose that say the same twice, a constant orientation that turns, a home beyond its limits.

    >>> from assur.model.registry import load_record
    >>> faults(load_record("zeng2019"))
    ()
    """
    try:
        home_values(record)
    except MechanismFileError as error:
        return error.problems
    usual = general(record)
    return tuple(_freedoms(record, usual) or (*_pose(record, usual), *_orientation(record), *_limits(record)))


def check(record: MechanismRecord) -> None:
    """Raise `MechanismFileError` with every fault, if there is one."""
    found = faults(record)
    if found:
        raise MechanismFileError(found)


def doubts(record: MechanismRecord) -> tuple[Problem, ...]:
    """What is no fault but probably not meant: a mechanism of the size of a pin or of a house, spinning links.

    >>> from assur.model.registry import load_record
    >>> doubts(load_record("zeng2019"))
    ()
    """
    size = characteristic_length(record) * METRES[record.unit]
    if SMALLEST <= size <= LARGEST:
        return ()
    hint = f"is it {'m' if size < SMALLEST else 'mm'} that is meant?"
    found = f"the longest link measures {characteristic_length(record):.3g} {record.unit}, that is {size:.3g} m"
    return (_problem(record, ("unit",), found, "that may be, but it is unusual", hint),)


def _freedoms(record: MechanismRecord, usual: Ranks) -> list[Problem]:
    """Freedoms against inputs, by the rank of the whole joint graph."""
    count, internal = int(usual.freedoms), int(usual.internal)
    moving, driven = count - internal, len(record.inputs)
    names = ", ".join(item.name for item in record.inputs)
    path: KeyPath = ("inputs",)
    if moving == 0:
        found = f"a structure that cannot move: {len(record.coordinates)} joint freedoms, rank {int(usual.closure)}"
        return [_problem(record, ("joints",), found, "at least one freedom", "are axes parallel that should be?")]
    freedoms = f"the mechanism has {moving} freedom{'s' if moving > 1 else ''}"
    if driven < moving:
        found = f"{driven} input{'s' if driven > 1 else ''} ({names}); {freedoms}"
        return [_problem(record, path, found, "one input for each freedom", "name further inputs, or fix joints")]
    if driven > moving:
        found = f"{driven} inputs ({names}); {freedoms}"
        return [_problem(record, path, found, "one input for each freedom", "it is over-actuated: leave inputs out")]
    if int(usual.inputs) < driven:
        found = f"inputs ({names}) that depend on one another: rank {int(usual.inputs)} of {driven}"
        return [_problem(record, path, found, "inputs that determine the mechanism", "drive other joints")]
    return []


def _pose(record: MechanismRecord, usual: Ranks) -> list[Problem]:
    """Whether the coordinates of the pose can be chosen freely, and say all that moves."""
    names = rate_names(record.platform.pose)
    path: KeyPath = ("platform", "pose")
    listed = ", ".join(record.platform.pose)
    if int(usual.pose) < len(names):
        found = f"{listed}: {len(names)} coordinates of which only {int(usual.pose)} are independent"
        return [_problem(record, path, found, "coordinates that the platform can choose", "leave one out")]
    if int(usual.pose) < len(record.inputs):
        found = f"{listed}: {len(names)} coordinates for {len(record.inputs)} freedoms"
        return [_problem(record, path, found, "as many as there are freedoms", "which way does the platform turn?")]
    return []


def _orientation(record: MechanismRecord) -> list[Problem]:
    if record.platform.orientation != "constant":
        return []
    home = home_values(record)
    motion = instantaneous(record, home).motion
    turning = float(np.max(np.abs(motion.twists[..., :3, :]), initial=0.0))
    if turning <= TURNS:
        return []
    found = '"constant", but the platform turns when it moves'
    return [_problem(record, ("platform", "orientation"), found, '"constant" only where it keeps its orientation')]


def _limits(record: MechanismRecord) -> list[Problem]:
    """Home against the limits of joints and the strokes of inputs."""
    home = home_values(record)
    problems = []
    slices = joint_graph(record).slices
    for name, joint in record.joints.items():
        for value, limit, component in zip(
            home[slices[name]], joint.limits or (None,) * joint.type.freedoms, joint.type.components, strict=True
        ):
            if limit is not None and not limit[0] <= value <= limit[1]:
                found = f"home has {component} = {value:.6g}, outside [{limit[0]:.6g}, {limit[1]:.6g}]"
                problems.append(_problem(record, ("joints", name, "limits"), found, "limits that home keeps"))
    for item, printed in zip(record.inputs, inputs_of(record, home), strict=True):
        if item.stroke is not None and not item.stroke[0] <= printed <= item.stroke[1]:
            found = f"home has {item.name} = {printed:.6g}, outside [{item.stroke[0]:.6g}, {item.stroke[1]:.6g}]"
            problems.append(_problem(record, ("inputs", item.coordinate.joint, "stroke"), found, "a stroke with home"))
    return problems


def _problem(record: MechanismRecord, path: KeyPath, found: str, allowed: str, hint: str = "") -> Problem:
    """A problem with the line at which its path, or the nearest part of it, stands in the file."""
    line = None
    if record.description is not None:
        line = record.description.source.line(path)
    return Problem(str(record.file), line, path_text(path), found, f"allowed: {allowed}", hint)
