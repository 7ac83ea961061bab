"""The position problem on the joint graph: loop by loop where that is complete, else by a search."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.errors import Interrupted
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.joint_graph.turns import screws_among
from assur.kinematics.border import held_inputs
from assur.kinematics.closure import RANK_GAP, assemble, closing_system
from assur.kinematics.coaxial_screws import MergedPair, merged_pair
from assur.kinematics.configurations import SAME, places
from assur.kinematics.home import home_values
from assur.kinematics.joint_graph_solutions import JointGraphSolutions
from assur.kinematics.limbs.solving import LimbSolutions
from assur.kinematics.loops.loops import LoopSolutions, PositionQuestion, solve_by_loops, staying_parallel
from assur.kinematics.loops.parallelograms import crossed_parallelograms, parallelograms, some_crossed
from assur.kinematics.modes import Method, Problem
from assur.kinematics.near_home import nearest_first
from assur.kinematics.platforms.direct import direct_by_conditions
from assur.kinematics.platforms.inverse import inverse_by_limbs
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.architecture import self_motion_dimension
from assur.kinematics.search import STARTS, search
from assur.kinematics.starts import by_chance
from assur.kinematics.validation.check import check
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
CHECKED, CHECKED_STEPS = 4, 40
"""Starts from which assemblies are met that must be among those that are called all, and steps of each."""

ANOTHER = 1e-2
"""Distance of places, in characteristic lengths, from which they are another assembly for certain: where two merge they
are known to half of the digits."""

POINTS = 8
"""Assemblies that are listed of self-motions, which have infinitely many."""


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
        model="reduced" if all(item.uncrossed for item in found) else "joint_graph",
        reason="; ".join(dict.fromkeys(item.right for item in found)),
        nearest=np.array([item.nearest for item in found]).reshape(batch),
        only=only,
        limbs=found[0].limbs if given.ndim == 1 else (),
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
    limbs: tuple[LimbSolutions, ...] = ()


def _known(record: MechanismRecord, problem: Problem, given: FloatArray, crossed: bool) -> LoopSolutions:
    """Without a search, by what is complete; else what the loops give.

    Limb by limb a pose is solved soonest, but where parallelograms are to be told from crossed ones.
    """
    asked = {"pose": given} if problem == "inverse" else {"inputs": given}
    turn = None
    if problem == "direct" or parallelograms(record):
        turn = solve_by_loops(record, **asked, crossed=crossed)
        if turn.complete:
            return turn
    by_limbs = inverse_by_limbs if problem == "inverse" else direct_by_conditions
    own = by_limbs(record, given, crossed=crossed)
    if own.limbs and not own.complete:
        return own
    if own.complete:
        return own if crossed else _uncrossed(record, own)
    pair = merged_pair(record, problem)
    if pair and (merged := _with_pair(pair, problem, given, crossed)):
        return merged
    turn = turn or solve_by_loops(record, **asked, crossed=crossed)
    if turn.complete:
        return turn
    return replace(turn, right=f"{turn.right}; {_why(own)}")


def _missed(record: MechanismRecord, problem: Problem, given: FloatArray, known: LoopSolutions) -> bool:
    """Whether an assembly is none of what is called all: a few are met from home and by chance, to make sure.

    What screws have turned further than is told is left aside, and what is crossed where that is left out.
    """
    if np.any(screws_among(record)):
        return False
    starts = np.concatenate([home_values(record)[None], by_chance(record, CHECKED - 1, np.random.default_rng(7))])
    if problem == "direct":
        starts = held_inputs(record, starts, given)
        closed = assemble(record, starts, held=record.input_indices, far=True, max_steps=CHECKED_STEPS)
    else:
        closed = assemble(record, starts, poses=given, far=True, max_steps=CHECKED_STEPS)
    met = closed.values[closed.closed]
    if known.kept:
        met = met[~some_crossed(record, met)]
    where = places(record, known.joints)
    return any(np.min(np.max(np.abs(where - row), axis=1), initial=np.inf) > ANOTHER for row in places(record, met))


def _why(solutions: LoopSolutions) -> str:
    """Why solutions are not known to be all."""
    return solutions.right.removeprefix("not proved, since ").removeprefix("not proved: ")


def _with_pair(pair: MergedPair, problem: Problem, given: FloatArray, crossed: bool) -> LoopSolutions | None:
    """By the mechanism in which a screw and what is coaxial to it are one joint; None where that is not complete."""
    merged = _known(pair.record, problem, pair.given(given) if problem == "direct" else given, crossed)
    joints = PositionQuestion(pair.whole, problem, given).closed(pair.expanded(merged.joints))
    if not merged.complete or len(joints) != len(merged.joints):
        return None
    *_, joint = pair.record.joints
    right = f"{joint} as one cylindrical joint: {merged.right}"
    return replace(merged, joints=joints, right=right, limbs=())


def _uncrossed(record: MechanismRecord, solutions: LoopSolutions) -> LoopSolutions:
    """Those in which every parallelogram stands as such; all of them where one is crossed at home."""
    names = tuple(parallelograms(record))
    if not names or crossed_parallelograms(record, home_values(record)):
        return solutions
    kept = ~some_crossed(record, solutions.joints)
    right = solutions.right + staying_parallel(names)
    return replace(solutions, joints=solutions.joints[kept], right=right, kept=names, limbs=())


def _of_self_motions(record: MechanismRecord, inputs: FloatArray) -> _Assemblies:
    """Of an architecturally singular mechanism: no assembly where that is proved, else points far from each other."""
    known = direct_by_conditions(record, inputs)
    if known.complete:
        return _Assemblies(known.joints, True, known.right, np.nan, False)
    begun = np.concatenate([home_values(record)[None], by_chance(record, STARTS - 1, np.random.default_rng(0))])
    closed = assemble(record, held_inputs(record, begun, inputs), held=record.input_indices, far=True)
    joints = closed.values[closed.closed]
    right = f"not proved: a search from {STARTS} starts, of whose assemblies up to {POINTS} are kept"
    joints = joints[nearest_first(record, joints)]
    return _Assemblies(joints[_apart(places(record, joints))], False, right, float(np.min(closed.residual)), False)


def _without_motions(record: MechanismRecord, problem: Problem, joints: FloatArray) -> list[int]:
    """Rows of joint values (K, n) that do not move with inputs or pose held, and `POINTS` of those that do.

    What spins at home as well, as a rod, is no motion.
    """
    rows = np.concatenate([home_values(record)[None], joints])
    free = np.delete(np.arange(rows.shape[1]), list(record.input_indices) if problem == "direct" else [])
    slopes = closing_system(record, rows, pose_of(record, rows) if problem == "inverse" else None)[1]
    units = characteristic_length(record) / joint_scales(record)[free]
    sizes = np.linalg.svd(slopes[..., free] / units, compute_uv=False)
    ranks = np.sum(sizes > RANK_GAP * sizes[:, :1], axis=1)
    moving = ranks[1:] < ranks[0]
    listed = np.flatnonzero(moving)
    return sorted([*np.flatnonzero(~moving).tolist(), *listed[_apart(places(record, joints[moving]))].tolist()])


def _apart(where: FloatArray) -> list[int]:
    """Rows of places (N, k), the first one and others that are farthest from those before; `POINTS` at most."""
    kept: list[int] = []
    away = np.full(len(where), np.inf)
    while len(kept) < POINTS and np.max(away, initial=0.0) > SAME:
        kept.append(int(np.argmax(away)))
        away = np.minimum(away, np.max(np.abs(where - where[kept[-1]]), axis=1))
    return kept


def _assemblies(
    record: MechanismRecord, problem: Problem, given: FloatArray, method: Method, crossed: bool
) -> _Assemblies:
    if problem == "direct" and self_motion_dimension(record):
        return _of_self_motions(record, given)
    why = ""
    if method != "search":
        turn = _known(record, problem, given, crossed)
        if turn.complete and _missed(record, problem, given, turn):
            turn = replace(
                turn, complete=False, right=f"an assembly that was met by chance is none of these: {turn.right}"
            )
        if turn.complete or turn.limbs or method == "loops" or (crossed and len(turn.joints)):
            return _Assemblies(turn.joints, turn.complete, turn.right, np.nan, bool(turn.kept), limbs=turn.limbs)
        why = f"; no other way is complete, since {_why(turn)}"
    interrupted = False
    try:
        found = search(record, problem, given)
    except Interrupted as stop:
        found, interrupted = stop.answer, True
    last = f"{found.converged} of which converged, number {found.last_new} to the last new one"
    met = last if len(found.joints) else "none of which found one"
    reason = f"not proved: a search from {found.starts} starts, {met}{why}"
    if method == "auto" and not interrupted:
        from assur.kinematics.monodromy.assemblies_by_monodromy import solved_by_monodromy  # the last resort

        try:
            whole = solved_by_monodromy(record, problem, given, found.joints)
        except KeyboardInterrupt:
            whole, interrupted = None, True
        if whole:
            whole = whole if crossed else _uncrossed(record, whole)
            return _Assemblies(whole.joints, True, whole.right, np.nan, bool(whole.kept))
    if not found.settled:
        rows = _without_motions(record, problem, found.joints)
        if len(rows) < len(found.joints):
            reason += f"; of {len(found.joints)} assemblies, most of which move with what is held, {len(rows)} are kept"
            found = replace(found, joints=found.joints[rows])
    if crossed or not parallelograms(record) or crossed_parallelograms(record, home_values(record)):
        return _Assemblies(found.joints, False, reason, found.nearest, False, interrupted)
    kept = found.joints[~some_crossed(record, found.joints)]
    left_out = len(found.joints) - len(kept)
    if left_out:
        reason += f"; {left_out} with crossed parallelograms {'was' if left_out == 1 else 'were'} left out"
    nearest = np.nan if left_out and not len(kept) else found.nearest  # a crossed one closes: no gap is to be told
    return _Assemblies(kept, False, reason, nearest, True, interrupted)
