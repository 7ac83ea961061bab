"""The fifth law: every assembly of the joint graph, within the declared model, is among the solutions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.kinematics import border
from assur.kinematics.closure import assemble
from assur.kinematics.contract.borders import named_by_signs, refusing
from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions, solutions, solves
from assur.kinematics.home import home_values
from assur.kinematics.loops.parallelograms import some_crossed
from assur.kinematics.modes import Problem, mode_text
from assur.kinematics.naming import declared_signs
from assur.kinematics.pose import pose_error, pose_of
from assur.kinematics.rates.motions import InstantaneousMotion, general_share
from assur.kinematics.status import closed_form_of
from assur.kinematics.still import otherwise
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

CLEAR = 1e-3
"""An assembly nearer to a singularity than this (a sine, of the closure a share of what it is around home) is not asked
for: rounding decides whether it is there, and where the closure nearly loses rank, how far its links have turned."""
SAME = 1e-5
"""Solutions nearer to each other than this share of the characteristic length are one."""
CONSTANT, TURNED = 1e-9, 1e-4
"""A link whose orientation varies by no more is one that keeps it; an assembly in which it differs by more is left out
of a reduced model."""


def missing(solutions: Solutions, joints: FloatArray, motion: InstantaneousMotion) -> list[Mismatch]:
    """Assemblies (A, n) of the joint graph that the closed form lacks, for either problem.

    Args:
        solutions: solutions of the closed form, by which it is judged what a reduced model leaves out.
        joints: joint values that close every loop.
        motion: of the joint graph, there.
    """
    record = solutions.record
    mismatches = []
    for problem in ("inverse", "direct"):
        if not solves(record, problem) or not len(joints):
            continue
        here = joints[_clear(record, problem, motion)]
        given = pose_of(record, here) if problem == "inverse" else border.inputs_of(record, here)
        lacking = _unmatched(record, problem, given, here, solutions)
        within = lacking[~_left_out(solutions, here[lacking])][:1]
        mismatches += [_told(record, problem, given[k], here[k]) for k in within]
    return mismatches


def random_assemblies(record: MechanismRecord, count: int, random: np.random.Generator) -> FloatArray:
    """Assemblies (A, n) to which starts all around home lead, and home itself.

    >>> from assur.model.registry import load_record
    >>> random_assemblies(load_record("fivebar"), 4, np.random.default_rng(0)).shape[1]
    5
    """
    home = home_values(record)
    if not count:
        return home[None]
    scale = joint_scales(record)
    spread = np.where(np.arange(count) % 2, 0.5, 2.0)[:, None]
    starts = home + spread * scale * random.normal(size=(count, len(home)))
    reached = assemble(record, starts, max_steps=40)
    return np.concatenate([home[None], reached.values[reached.closed]])


def _clear(record: MechanismRecord, problem: Problem, motion: InstantaneousMotion) -> BoolArray:
    """Where what is given determines the assembly, well away from a singularity, of constraints too."""
    part = motion.pose if problem == "inverse" else motion.inputs
    sizes = np.linalg.svd(part, compute_uv=False)[..., part.shape[-2] - 1]
    least = motion.values[..., int(np.max(motion.ranks.closure)) - 1] / motion.values[..., 0]
    return np.asarray((sizes > CLEAR) & (least > CLEAR * general_share(record)))


def _unmatched(
    record: MechanismRecord, problem: Problem, given: FloatArray, joints: FloatArray, answer: Solutions
) -> NDArray[np.intp]:
    """Problems whose assembly is not among the solutions; those that the closed form leaves undecided are not asked."""
    listed = solutions(record, problem, given)
    near = _apart(listed, joints[listed.rows], answer) <= SAME * characteristic_length(record)
    matched = np.zeros(len(given), dtype=bool)
    matched[listed.rows[near]] = True
    matched[listed.undecided] = True
    return np.flatnonzero(~matched)


def _apart(listed: Solutions, joints: FloatArray, solutions: Solutions) -> FloatArray:
    """How far solutions (S,) are from assemblies (S, n) that have what is given, in length units."""
    record, length = listed.record, characteristic_length(listed.record)
    if not len(listed):
        return np.zeros(0)
    if listed.problem == "direct":
        return np.asarray(np.max(np.abs(pose_error(record, joints, listed.poses, length)), axis=-1))
    offsets, signs = (np.array([getattr(item, name) for item in record.inputs]) for name in ("offset", "sign"))
    claimed, there = (listed.inputs - offsets) * signs, joints[:, list(record.input_indices)]
    angular = np.array([item.coordinate.kind == "angle" for item in record.inputs])
    gap = claimed - there
    turned = length * np.abs((gap + np.pi) % (2 * np.pi) - np.pi)
    mirrored = np.where(_one_sided(solutions), np.abs(np.abs(claimed) - np.abs(there)), np.abs(gap))
    return np.asarray(np.max(np.where(angular, turned, mirrored), axis=-1))


def _one_sided(solutions: Solutions) -> BoolArray:
    """Inputs (n,) whose joint values, lengths, all have one sign: the other, a leg turned half round, adds no pose."""
    record = solutions.record
    lengths = np.array([item.coordinate.kind == "length" for item in record.inputs])
    values = solutions.joints[:, list(record.input_indices)]
    one = np.all(values > 0, axis=0) | np.all(values < 0, axis=0)
    return np.asarray(lengths & one & (closed_form_of(record).complete_for == "reduced"))


def _left_out(solutions: Solutions, joints: FloatArray) -> BoolArray:
    """Assemblies (A, n) that the declared model is without: crossed over, turned, or with a leg turned half round."""
    record = solutions.record
    if closed_form_of(record).complete_for == "joint_graph" or not len(joints):
        return np.zeros(len(joints), dtype=bool)
    if not len(solutions):  # nothing says what the model is without but home
        return np.array([bool(other) for other in otherwise(record, joints)])
    index = list(record.input_indices)
    sides = np.sign(solutions.joints[0, index])
    out = np.any((np.sign(joints[:, index]) != sides) & _one_sided(solutions), axis=-1)
    own, others = frames(record, solutions.joints), frames(record, joints)
    for link, (rotations, _) in own.items():
        first = np.broadcast_to(rotations, (len(solutions), 3, 3))
        if np.max(np.abs(first - first[0])) <= CONSTANT:
            out |= (
                np.max(np.abs(np.broadcast_to(others[link][0], (len(joints), 3, 3)) - first[0]), axis=(1, 2)) > TURNED
            )
    rest = np.flatnonzero(~out)
    out[rest] = some_crossed(record, joints[rest])
    return np.asarray(out)


def _told(record: MechanismRecord, problem: Problem, given: FloatArray, joints: FloatArray) -> Mismatch:
    signs = declared_signs(record, problem, joints)
    mode = mode_text(signs)
    other: Problem = "direct" if problem == "inverse" else "inverse"
    answer = border.inputs_of(record, joints) if problem == "inverse" else pose_of(record, joints)
    text = (
        f"the {problem} problem at {place_text(record, problem, given)} lacks a solution that the joint graph has: "
        f"{place_text(record, other, answer)}{f', of mode {mode}' if mode else ''}"
    )
    model = closed_form_of(record).complete_for
    what = "all of the joint graph" if model == "joint_graph" else "all but crossed or turned assemblies"
    allowed = f"its branches must be {what}"
    margin = refusing(record, problem, given, signs) if named_by_signs(record, problem) else ""
    if margin:
        return Mismatch("margin", margin, problem, text, allowed, "it is negative where the branch exists")
    return Mismatch("branch", mode, problem, text, allowed, "is a branch missing, or a margin wrong?")
