"""Turns of home: what assemblies with screws have in common with home, and angles counted accordingly.

A nut that was threaded on one turn further stands elsewhere at the same angles. No motion leads there from home, so
such an assembly answers no question about the mechanism as it is assembled.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closure import characteristic_length
from assur.kinematics.home import home_values
from assur.model.mechanism import MechanismRecord
from assur.model.turns import counted, periodic, screws_among, turn_relations

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


def in_one_turn(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """Joint values (..., n) with every angle that is the same after a whole turn between -pi and pi."""
    return np.where(periodic(record), (joints + np.pi) % (2 * np.pi) - np.pi, joints)


def with_turns_of_home(
    record: MechanismRecord, joints: FloatArray, held: Sequence[int] = ()
) -> tuple[FloatArray, BoolArray]:
    """Joint values (N, n) with as many turns as motions from home have.

    Args:
        record: the mechanism.
        joints: assemblies (N, n).
        held: indices of joint values that are as they were asked for.

    Returns:
        the same assemblies: periodic angles in one turn, and whole turns added to driven joints without pitch, which
        turn back into themselves, where screws tell how many they have made; and whether (N,) this can be so. Where it
        cannot, a nut has been threaded anew.
    """
    answer, screws = in_one_turn(record, joints), screws_among(record)
    home, relations = home_values(record), turn_relations(record)
    for row in relations:
        free = np.setdiff1d(np.flatnonzero((row != 0) & ~screws), np.asarray(held, dtype=int))
        if len(free):
            turns = np.round((answer - home) @ row / (2 * np.pi))
            answer[..., free[0]] -= 2 * np.pi * turns * row[free[0]]
    off = np.round((answer - home) @ relations.T / (2 * np.pi))
    return answer, np.all(off == 0, axis=-1)


def near_turns_of_home(record: MechanismRecord, start: FloatArray, held: Sequence[int]) -> FloatArray:
    """Starts (..., n) moved as little as gives them as many turns as motions from home have, `held` values kept."""
    relations = turn_relations(record).copy()
    off = (start - home_values(record)) @ relations.T
    relations[:, list(held)] = 0.0
    return start - off @ np.linalg.pinv(relations).T


def told_by_turns(record: MechanismRecord, locked: dict[int, float]) -> dict[int, float]:
    """Joint values (index -> value) that follow from locked ones by the turns of home: screws on driven shafts.

    >>> from assur.model.registry import load_record
    >>> told_by_turns(load_record("fivebar"), {0: 1.0})
    {}
    """
    known, home = dict(locked), home_values(record)
    relations = turn_relations(record)
    for _ in relations:
        for row in relations:
            unknown = [int(index) for index in np.flatnonzero(row) if index not in known]
            if len(unknown) == 1:
                (index,) = unknown
                rest = sum(row[k] * (known[int(k)] - home[k]) for k in np.flatnonzero(row) if k != index)
                known[index] = float(home[index] - rest * row[index])
    return {index: value for index, value in known.items() if index not in locked}


@lru_cache(maxsize=64)
def joint_units(record: MechanismRecord) -> FloatArray:
    """What a change of one is of each joint value (n,): the characteristic length, a rad, or a screw's turns for it.

    A screw, and a shaft that drives one, turns many times while its nut goes as far as other joints go in one step.

    >>> from assur.model.registry import load_record
    >>> joint_units(load_record("fivebar")).tolist()
    [1.0, 1.0, 1.0, 1.0, 1.0]
    """
    length = characteristic_length(record)
    units = np.array([length if item.kind == "length" else 1.0 for item in record.coordinates])
    pitches = np.array([abs(record.joints[item.joint].pitch) for item in record.coordinates])
    for row in turn_relations(record) != 0:
        pitches[row] = np.maximum(pitches[row], np.max(pitches[row]))
    screws = pitches > 0
    units[screws] = np.maximum(1.0, 2 * np.pi * length / pitches[screws])
    units.flags.writeable = False
    return units


def counts_turns(record: MechanismRecord) -> bool:
    """Whether whole turns of any joint value count.

    >>> from assur.model.registry import load_record
    >>> counts_turns(load_record("zeng2019"))
    False
    """
    return bool(np.any(counted(record)))
