"""Two proofs of one answer: bounds of every branch from the closed form, and bounds of every pose from the legs alone.

The closed form says how many poses there are at most; the legs prove so many at least. Where the numbers agree the
answer is complete, even if the bounds of a branch are too wide to tell that it exists.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.certified.branches import JudgedBranches, grouped
from assur.kinematics.certified.given import inputs_meant
from assur.kinematics.certified.proofs import Proofs, turned
from assur.kinematics.certified.result import CertifiedSolutions, Doubt, ProvedSolution
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.numerics.intervals.interval import Interval, common
from assur.numerics.intervals.shapes import empty

FloatArray = NDArray[np.float64]
BOTH = "closed form over intervals, and Krawczyk on the legs"
FORM = "closed form over intervals"
LEGS = "Krawczyk on the legs"


@dataclass(frozen=True, eq=False)
class Candidates:
    """Branches of a closed form over intervals, their modes and the working modes of the float answer, if known."""

    branches: JudgedBranches
    modes: tuple[str, ...]
    working: tuple[str, ...]


def matched(
    record: MechanismRecord,
    inputs: FloatArray,
    candidates: Candidates,
    known: Proofs,
    floats: SolutionSet,
    right: str,
    extra: Sequence[Doubt] = (),
) -> CertifiedSolutions:
    """The certificate of a direct problem (n,) from both proofs; `extra` are doubts that no branch answers for."""
    found = candidates.branches
    names = record.platform.pose
    near = {int(k): turned(names, found.pose[k], known.pose) for k in np.flatnonzero(~found.absent)}
    rivals = {k: _meeting(found.pose[k], bounds) for k, bounds in near.items()}
    possible = int(np.sum(~found.absent))
    settled = len(known.rows) == possible and not extra and not np.any(~found.exists & ~found.absent & ~found.merging)
    solutions: list[ProvedSolution] = []
    taken: set[int] = set()
    for k in np.flatnonzero(found.exists).tolist():
        bounds, how = found.pose[k], FORM
        one = rivals[k][0] if len(rivals[k]) == 1 else -1
        if one >= 0 and (settled or bool(np.all(bounds.within(turned(names, bounds, known.alone)[one])))):
            bounds, how = common(bounds, near[k][one])[0], BOTH
            taken.add(one)
        solutions.append(_solution(record, inputs, bounds, candidates.modes[k], candidates.working[k], how))
    held = {j for k in np.flatnonzero(found.exists).tolist() for j in rivals[k]}
    left = [j for j in range(len(known.rows)) if j not in taken | held]
    doubts = list(found.doubts)
    solutions.extend(_of_legs(inputs, known, j, floats) for j in left)
    if settled:  # as many are proved from the legs as there are branches at all
        doubts = []
        if len(solutions) != possible:  # bounds of a branch that hold several poses count one alone
            solutions = [_of_legs(inputs, known, j, floats) for j in range(possible)]
    solutions, twice = _told_apart(names, solutions)
    doubts += [(-1, Doubt("pose", item.pose.low, item.pose.high, "one pose or two")) for item in twice]
    if len(solutions) > possible or len(known.rows) > possible:
        doubts.append((-1, Doubt("pose", *_ends(known.pose), "the closed form and the legs disagree here")))
    form = closed_form_of(record)
    undecided = (*grouped(doubts), *extra)
    return CertifiedSolutions(
        record, "direct", inputs, tuple(solutions), undecided, True, form.complete_for, right, found.by
    )  # fmt: skip


def _told_apart(
    names: tuple[str, ...], solutions: Sequence[ProvedSolution]
) -> tuple[list[ProvedSolution], list[ProvedSolution]]:
    """Solutions of which no two may be one, and the others: several of the same modes whose poses may be the same."""
    kept: list[ProvedSolution] = []
    twice: list[ProvedSolution] = []
    for item in solutions:
        alike = [one.pose for one in kept if (one.mode, one.working_mode) == (item.mode, item.working_mode)]
        known = Interval.of([one.low for one in alike], [one.high for one in alike]) if alike else empty(len(names))
        (twice if _meeting(item.pose, turned(names, item.pose, known)) else kept).append(item)
    return kept, twice


def _meeting(bounds: Interval, known: Interval) -> list[int]:
    """Which of the proved poses (K, m) may be the one in these bounds (m,)."""
    return [j for j in range(len(known.low)) if not np.any(common(known[j], bounds)[1])]


def _of_legs(inputs: FloatArray, known: Proofs, j: int, floats: SolutionSet) -> ProvedSolution:
    """The solution that is proved from the legs alone, with the modes of the float answer."""
    row = int(known.rows[j])
    return _solution(floats.record, inputs, known.pose[j], str(floats.labels[row]), str(floats.other_labels[row]), LEGS)


def _solution(
    record: MechanismRecord, inputs: FloatArray, pose: Interval, mode: str, working: str, how: str
) -> ProvedSolution:
    return ProvedSolution(pose, inputs_meant(record, inputs), mode, working, mode, how)


def _ends(bounds: Interval) -> tuple[FloatArray, FloatArray]:
    """The hull of poses (K, m)."""
    return np.min(bounds.low, axis=0), np.max(bounds.high, axis=0)
