"""Freedoms against inputs and pose: what is driven too little or too much, what stands still, what moves unsaid."""

from __future__ import annotations

from assur.errors import KeyPath, Problem
from assur.kinematics.home import home_values
from assur.kinematics.rates.architecture import self_motion_dimension
from assur.kinematics.validation.claims import Claims
from assur.kinematics.validation.gaps import axes_hint
from assur.model.file.place import problem, table_place
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION, rate_names
from assur.results.plain_text import count

SHOWN = 6


def freedom_problems(record: MechanismRecord, claims: Claims) -> list[Problem]:
    """Freedoms against inputs, by the rank of the whole joint graph near home."""
    driven, moving = len(record.drives), claims.moving
    if len(record.inputs) == moving == claims.independent_inputs > 0:
        return []  # those that follow are redundant
    if record.redundant_inputs and len(record.inputs) < moving:
        return []  # the pose says too little, which is told of it: the first inputs are as many as its rates
    names = ", ".join(item.name for item in record.inputs)
    path: KeyPath = table_place(record, "inputs")
    if moving == 0:
        freedoms = f"{len(record.coordinates)} joint freedoms, {int(claims.general.closure)} of them held by the loops"
        found = f"a structure that cannot move: {freedoms}"
        hint = axes_hint(record, home_values(record), tuple(record.joints)) or "are axes parallel that should be?"
        return [problem(record, table_place(record, "joints"), found, "at least one freedom", hint)]
    inputs, freedoms = count(driven, "input"), f"the mechanism has {count(moving, 'freedom')}"
    if len(record.inputs) > moving:
        hint = f"leave out {_one_of(claims.spare_inputs)}, or a coordinate of the pose: with as many as there are"
        hint += " freedoms the first inputs determine the mechanism, and further ones follow"
        return [problem(record, path, f"{inputs} ({names}); {freedoms}", "one input for each freedom", hint)]
    free = claims.free_joints[:SHOWN]
    drive = f"with the inputs locked these still move: {', '.join(free)}" if free else "fix a joint"
    if driven < moving:
        hint = f"{drive}; drive {'one' if moving - driven == 1 else moving - driven} of them"
        return [problem(record, path, f"{inputs} ({names}); {freedoms}", "one input for each freedom", hint)]
    if self_motion_dimension(record):
        return []
    independent = f"{claims.independent_inputs} of {len(record.inputs)} are independent"
    found = f"inputs ({names}) that depend on one another: {independent}"
    hint = f"{drive}; drive one of them instead of {_one_of(claims.spare_inputs)}"
    if record.redundant_inputs:
        others = ", ".join(item.name for item in record.redundant_inputs)
        hint = f"the first {len(record.inputs)} must determine the mechanism, others follow: write {others} before"
        hint += f" {_one_of(claims.spare_inputs)}"
    return [problem(record, path, found, "inputs that determine the mechanism", hint)]


def pose_problems(record: MechanismRecord, claims: Claims) -> list[Problem]:
    """Whether the coordinates of the pose can be chosen freely, and say all that moves."""
    names = rate_names(record.platform.pose)
    path: KeyPath = ("platform", "pose")
    listed = ", ".join(record.platform.pose)
    posed = int(claims.general.pose)
    if posed < len(names):
        found = f"{listed}: only {posed} of {len(names)} can be chosen"
        still = claims.still
        if still:
            hint = f"{', '.join(still)} never change{'s' if len(still) == 1 else ''}: leave {_it(still)} out"
        else:
            hint = f"leave out {_one_of(claims.spare_pose)}"
        return [problem(record, path, found, "coordinates that the platform can choose", hint)]
    if posed < claims.moving:
        found = f"{listed}: {count(len(names), 'coordinate')} for {count(claims.moving, 'freedom')}"
        hint = _unsaid(record, claims)
        return [problem(record, path, found, "as many as there are freedoms", hint)]
    return []


def _unsaid(record: MechanismRecord, claims: Claims) -> str:
    """What the platform does while its pose stands still."""
    pose = record.platform.pose
    if int(claims.general.twists) == int(claims.general.pose):
        return "the platform stands still while other links move"
    others = [name for name in (*LENGTHS, *(() if set(QUATERNION) & set(pose) else ANGLES)) if name not in pose]
    missing = claims.lacking(tuple(others))
    motion = f"with {', '.join(pose)} held it still {claims.unsaid}"
    return f"{motion}; add {_one_of(missing)}" if missing else motion


def _one_of(names: list[str]) -> str:
    return names[0] if len(names) == 1 else f"one of {', '.join(names)}"


def _it(names: list[str]) -> str:
    return "it" if len(names) == 1 else "them"
