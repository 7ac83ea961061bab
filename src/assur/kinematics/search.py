"""Search: assemblies from many starts at once, sorted out by where every joint is; never claimed to be all."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import Interrupted
from assur.kinematics.border import held_inputs, inputs_of
from assur.kinematics.closure import Assembly, assemble
from assur.kinematics.configurations import numbered
from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem
from assur.kinematics.pose import pose_of
from assur.kinematics.starts import by_chance, mixed, redrawn
from assur.kinematics.turns import (
    counts_turns,
    near_turns_of_home,
    periodic_inputs,
    with_turns_of_home,
)
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.numerics import rotations
from assur.work import WorkStage, stage

FloatArray = NDArray[np.float64]
STARTS = 192
"""Starts that are closed together at most: of fewer the last that close keep arrays short, more are seldom needed."""
FEWEST = 12
"""As few starts may be closed together at the end of a search."""
MOST, UTMOST = 16 * STARTS, 32 * STARTS
"""Starts at most; and where an assembly was met once alone, so that there may be others as rare."""
STEPS = 240
"""Of a start: where two roots nearly meet many steps lead along a curved valley. Elsewhere few take more than 30."""
WAY = 16
"""Starts on the way from home, where turns count."""
AGAIN, LEAST = 24, 4
"""A search ends when so many assemblies in a row, for each that is known, were known already; for so many at least; and
each was met twice; or after MOST starts. One start by chance in 8000 leads to the rarest assembly of the Delta robot's
inverse problem: 16 times 40 that close missed it, 24 times do not."""


@dataclass(frozen=True, eq=False)
class Search:
    """Assemblies (K, coordinates) that were found from `starts` starts, in the order of their first finding.

    `converged` of them led to an assembly. `last_new` is the number of the start that found the last new one: far below
    `starts`, more are unlikely.
    `nearest` is the smallest gap that any start came to, in length units; `settled` says whether the search ended
    because it met nothing new any more.
    """

    joints: FloatArray
    starts: int
    converged: int
    last_new: int
    nearest: float
    settled: bool


def search(record: MechanismRecord, problem: Problem, given: FloatArray, seed: int = 0) -> Search:
    """Assemblies at printed inputs (n,) or at a pose (m,), from home and from starts by chance.

    Once some are known, a third of the starts are still by chance; in a third joints of a known assembly are drawn
    anew, in a third they stand as in another (`assur.kinematics.starts`). Where turns count, starts and assemblies have
    as many as motions from home (`assur.kinematics.turns`), and some starts lie on the way from home to what is asked
    for. The search ends when it has met what it knows `AGAIN` times as often as it has met anything new, and everything
    twice, or after `MOST` starts. Ctrl-C ends it with `Interrupted`, whose answer is the search so far.

    >>> from assur.model.registry import load_record
    >>> len(search(load_record("fivebar"), "direct", np.radians([127.0, 53.0])).joints)
    2
    """
    with stage("search of assemblies from many starts", MOST) as work:
        return _searched(record, problem, given, np.random.default_rng(seed), work)


def _searched(
    record: MechanismRecord, problem: Problem, given: FloatArray, rng: np.random.Generator, work: WorkStage
) -> Search:
    known = np.empty((0, len(record.coordinates)))
    starts, converged, last, nearest, again, met = 0, 0, 0, np.inf, 0, np.zeros(0, dtype=int)
    while (starts < MOST and again < _enough(known)) or (starts < UTMOST and np.any(met == 1)):
        begun = _starts(record, known, rng, min(STARTS, max(FEWEST, _needed(known, again, starts, converged))))
        try:
            if starts == 0:
                begun[0] = home_values(record)
                if counts_turns(record):
                    begun[1 : 1 + WAY] = _on_the_way(record, problem, given)
            assembled = _assembled(record, problem, given, begun)
        except KeyboardInterrupt:
            if not starts:
                raise
            raise Interrupted(Search(known, starts, converged, last, nearest, False)) from None
        counted, same = with_turns_of_home(record, assembled.values, _held(record, problem))
        closed = np.flatnonzero(assembled.closed & same)
        joints = np.concatenate([known, counted[closed]])
        number = numbered(record, joints)
        kept = np.unique(number, return_index=True)[1]
        met = np.bincount(number[len(known) :], minlength=len(kept)) + np.pad(met, (0, len(kept) - len(met)))
        again, converged = again + len(closed), converged + len(closed)
        if len(kept) > len(known):
            newest = int(kept[-1]) - len(known)
            last, again = starts + int(closed[newest]) + 1, len(closed) - newest - 1
        known, nearest, starts = joints[kept], min(nearest, float(np.min(assembled.residual))), starts + len(begun)
        work.at(starts, MOST, f"{len(known)} assemblies so far")
    return Search(known, starts, converged, last, nearest, again >= _enough(known) and not np.any(met == 1))


def _enough(known: FloatArray) -> int:
    return AGAIN * max(len(known), LEAST)


def _needed(known: FloatArray, again: int, starts: int, converged: int) -> int:
    """So many more end the search where as large a share of them leads to an assembly, and to none that is new."""
    return FEWEST + (_enough(known) - again) * starts // converged if converged else STARTS


def _starts(record: MechanismRecord, known: FloatArray, rng: np.random.Generator, count: int) -> FloatArray:
    """Joint values (count, n)."""
    if not len(known):
        return by_chance(record, count, rng)
    share = count // 3
    parts = (
        by_chance(record, count - 2 * share, rng),
        redrawn(record, known, share, rng),
        mixed(record, known, share, rng),
    )
    return np.concatenate(parts)


def _assembled(record: MechanismRecord, problem: Problem, given: FloatArray, start: FloatArray) -> Assembly:
    held = _held(record, problem)
    if problem == "direct":
        return assemble(
            record,
            near_turns_of_home(record, held_inputs(record, start, given), held),
            held=held,
            max_steps=STEPS,
            far=True,
        )
    return assemble(record, near_turns_of_home(record, start, held), poses=given, max_steps=STEPS, far=True)


def _held(record: MechanismRecord, problem: Problem) -> tuple[int, ...]:
    return record.input_indices if problem == "direct" else ()


def _on_the_way(record: MechanismRecord, problem: Problem, given: FloatArray) -> FloatArray:
    """Joint values (WAY, n) on the straight way from home to inputs (k,) or a pose (m,), each closed from the last."""
    # starts of a search need not close nor keep the mode, so no guard of the follower is asked
    values, on = home_values(record), []
    direct = problem == "direct"
    begun = inputs_of(record, values) if direct else pose_of(record, values)
    angular = periodic_inputs(record) if direct else np.array([is_angle(name) for name in record.platform.pose])
    change = given - begun
    change = np.where(angular, rotations.nearest_turn(change), change)
    for share in np.arange(1, WAY + 1) / WAY:
        values = _assembled(record, problem, begun + share * change, values[None]).values[0]
        on.append(values)
    return np.array(on)
