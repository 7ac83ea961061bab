"""The position problem on the joint graph: loop by loop where that is complete, else by a search."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import Interrupted
from assur.kinematics.home import home_values
from assur.kinematics.joint_graph_solutions import JointGraphSolutions
from assur.kinematics.limbs.inverse import inverse_by_limbs
from assur.kinematics.loops.loops import crossed_parallelograms, solve_by_loops
from assur.kinematics.modes import Method, Problem
from assur.kinematics.near_home import nearest_first
from assur.kinematics.platforms.direct import direct_by_conditions
from assur.kinematics.search import search
from assur.kinematics.validation.check import check
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


def assemblies(
    record: MechanismRecord, problem: Problem, given: FloatArray, only: str, method: Method, *, crossed: bool
) -> JointGraphSolutions:
    """What is found on the joint graph, problem by problem: loop by loop where that is complete, else by a search."""
    check(record)
    found = []
    for one in given.reshape(-1, given.shape[-1]):
        found.append(_assemblies(record, problem, one, method, crossed))
        if found[-1].interrupted and len(found) < given[..., 0].size:
            raise KeyboardInterrupt
    most = max((len(item.joints) for item in found), default=0)
    joints = np.full((len(found), most, len(record.coordinates)), np.nan)
    for row, item in zip(joints, found, strict=True):
        row[: len(item.joints)] = item.joints[nearest_first(record, item.joints)]
    batch = given.shape[:-1]
    answer = JointGraphSolutions(
        record,
        problem,
        given,
        joints.reshape(*batch, *joints.shape[1:]),
        all_known=all(item.complete for item in found),
        model="reduced" if record.generalised and all(item.uncrossed for item in found) else "joint_graph",
        reason="; ".join(dict.fromkeys(item.right for item in found)),
        nearest=np.array([item.nearest for item in found]).reshape(batch),
        only=only,
    )
    if any(item.interrupted for item in found):
        raise Interrupted(answer)
    return answer


@dataclass(frozen=True, eq=False)
class _Assemblies:
    """Joint values (K, coordinates) of one problem; `uncrossed`: crossed parallelograms are left out."""

    joints: FloatArray
    complete: bool
    right: str
    nearest: float
    uncrossed: bool
    interrupted: bool = False


def _assemblies(
    record: MechanismRecord, problem: Problem, given: FloatArray, method: Method, crossed: bool
) -> _Assemblies:
    if method != "search":
        asked = {"inputs": given} if problem == "direct" else {"pose": given}
        known = (inverse_by_limbs if problem == "inverse" else direct_by_conditions)(record, given)
        turn = known if known and known.complete else solve_by_loops(record, **asked, crossed=crossed)
        if turn.complete or method == "loops" or (crossed and len(turn.joints)):
            return _Assemblies(turn.joints, turn.complete, turn.right, np.nan, not crossed)
    interrupted = False
    try:
        found = search(record, problem, given)
    except Interrupted as stop:
        found, interrupted = stop.answer, True
    last = (
        f"of which number {found.last_new} found the last new one" if len(found.joints) else "none of which found one"
    )
    reason = f"not proved: a search from {found.starts} starts, {last}"
    if crossed or not record.generalised or crossed_parallelograms(record, home_values(record)):
        return _Assemblies(found.joints, False, reason, found.nearest, False, interrupted)
    kept = found.joints[[not crossed_parallelograms(record, row) for row in found.joints]]
    left_out = len(found.joints) - len(kept)
    if left_out:
        reason += f"; {left_out} with crossed parallelograms {'was' if left_out == 1 else 'were'} left out"
    nearest = np.nan if left_out and not len(kept) else found.nearest  # a crossed one closes: no gap is to be told
    return _Assemblies(kept, False, reason, nearest, True, interrupted)
