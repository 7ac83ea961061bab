"""Home of a drafted mechanism: as drawn, or a little away from there, and how far it is from singular."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import RANK_GAP, assemble
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.rates.motions import motions
from assur.kinematics.rates.restraint import WELL, restraint
from assur.kinematics.rates.velocity import velocity_map_at
from assur.kinematics.turns import joint_units
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS

FloatArray = NDArray[np.float64]

CLEAR = 0.02
"""Least measure of singularity (a sine) of a home that is far enough from singular."""

BENT = 0.1
"""Least measure with the platform locked (a sine) of a home in which legs are far from the end of their reach."""

TRAVEL = {"length": 30.0, "angle": math.radians(15.0)}
"""How far each input, and each coordinate of the pose, should move either way from home: mm and rad."""

STEPS = 6
"""In which it does so: a fold within one is seen, as no assembly is near behind it."""

LEAST = 0.4
"""The least share of this for which no other home is tried, and none is said to be near a fold."""

NEAR = 0.2
"""The most that a joint moves in a step (rad, or characteristic lengths), else it is another assembly."""

CONDITION = 50.0
"""A larger condition number of the Jacobian at home is said."""

AWAY = np.array([[60.0, 100.0, 30.0], [60.0, 100.0, -60.0], [18.0, 30.0, 10.0], [18.0, 30.0, -20.0]])
STEP = 0.2
"""How far a mechanism is moved from where it was drawn, where that is singular: x, y, z in mm, the first of them that
can be reached; else in rad."""


def away(record: MechanismRecord, *, still: bool) -> FloatArray | None:
    """Joint values (n,) of an assembly a little away from where it was drawn; None where there is none.

    The platform is moved without being turned where it keeps its orientation, else all motions are mixed.

    Args:
        record: with the pose x, y, z, phi, theta, psi, whatever of it can be chosen.
        still: whether the platform keeps its orientation.
    """
    home = home_values(record)
    if still:
        unturned = np.zeros_like(AWAY)  # as it was drawn; one that may turn closes there with it turned a little
        poses = np.hstack([pose_of(record, home)[:3] + AWAY, unturned])
        assembly = assemble(record, np.tile(home, (len(poses), 1)), poses=poses)
    else:
        motion = motions(record, home, RANK_GAP)
        shares = STEP * np.cos(1.0 + np.arange(len(home)))
        assembly = assemble(record, (home + motion.null @ shares * motion.scale)[None])
    return next(iter(assembly.values[assembly.closed]), None)


def home_table(record: MechanismRecord, values: FloatArray) -> dict[str, tuple[float, ...]]:
    """Joint values as a file writes them, in deg and mm."""
    slices = joint_graph(record).slices
    return {
        name: tuple(
            round(float(np.degrees(value) if kind == "angle" else value), 2) + 0.0
            for value, kind in zip(values[slices[name]], joint.type.kinds, strict=True)
        )
        for name, joint in record.joints.items()
    }


def clearance(record: MechanismRecord) -> float:
    """How far home is from singular: the least of its measures, 0 where it is singular."""
    motion = instantaneous(record, home_values(record))
    if any(bool(holds) for holds in motion.types.values()):
        return 0.0
    return min(float(measure) for measure in motion.measures.values())


def travel(record: MechanismRecord) -> float:
    """The share of `TRAVEL`, 0 to 1, that each input and each coordinate of the pose moves alone before a fold.

    >>> from assur.model.registry import load_record
    >>> travel(load_record("three_rps"))
    1.0
    """
    home = home_values(record)
    inputs = list(record.input_indices)
    held = np.array([TRAVEL[record.coordinates[index].kind] for index in inputs])
    changes = np.zeros((len(inputs), len(home)))
    changes[range(len(inputs)), inputs] = held
    names = record.platform.pose
    posed = np.diag([TRAVEL["length" if name in LENGTHS else "angle"] for name in names])
    return min(_moved(record, home, changes, inputs), _moved(record, home, posed, None))


def _moved(record: MechanismRecord, home: FloatArray, changes: FloatArray, held: Sequence[int] | None) -> float:
    """The share of changes (k, ·) of joint values that are held, or of poses, that all can be made, both ways."""
    ways = np.concatenate([changes, -changes])
    followed = [index for index, item in enumerate(record.coordinates) if not record.joints[item.joint].type.screw]
    units = joint_units(record)[followed]
    before = values = np.broadcast_to(home, (len(ways), len(home)))
    for step in range(1, STEPS + 1):
        start = 2.0 * values - before
        if held is None:
            closed = assemble(record, start, poses=pose_of(record, home) + ways * step / STEPS, near=True)
        else:
            start[:, held] = (home + ways * step / STEPS)[:, held]
            closed = assemble(record, start, held=held, near=True)
        jump = np.abs((closed.values - values)[:, followed] / units)
        if not np.all(closed.closed) or np.max(jump, initial=0.0) > NEAR:
            return (step - 1) / STEPS
        before, values = values, closed.values
    return 1.0


def holding(record: MechanismRecord) -> float:
    """The condition number of what holds the platform at home while inputs rest."""
    return restraint(record, home_values(record)).condition


def remarks(record: MechanismRecord, free: float = 1.0) -> tuple[str, ...]:
    """What a reader should know of home: singular, at a leg's end, badly conditioned, near a fold; else nothing.

    `free` is its `travel`, where that was asked.
    """
    if clearance(record) < CLEAR:
        return ("home is singular, or nearly so, in every layout that was tried: change the dimensions",)
    home = home_values(record)
    said = []
    if float(instantaneous(record, home).measures["input"]) < BENT:
        said.append("home is near the end of a leg's reach in every layout that was tried: change the dimensions")
    condition = float(velocity_map_at(record, home).condition)
    if condition > CONDITION:
        said.append(f"the condition number at home is {condition:.0f}, which is large: change the dimensions")
    elif (held := holding(record)) > WELL:
        said.append(
            f"home is near a constraint singularity in every layout that was tried, {held:.0f} the condition number "
            "of what holds the platform: turn axes of some limbs, or change the dimensions"
        )
    if free < LEAST:
        length, angle = (share * (free + 1.0 / STEPS) for share in TRAVEL.values())
        said.append(
            "home is near a fold in every layout that was tried: an input or the platform moves less than "
            f"{length:.0f} mm or {math.degrees(angle):.1f} deg to it: change the dimensions"
        )
    return tuple(said)
