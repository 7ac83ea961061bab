"""Turns: which angles are the same after a whole turn, and which are not because a screw advances by its pitch.

The value of a helical joint is a real number of turns. So is that of a driven joint whose angle and those of screws
add up to what no motion changes: a motor on the shaft of a screw whose nut does not turn, be it guided or held by
axes across.

A nut that was threaded on one turn further stands elsewhere at the same angles. No motion leads there from home, so
such an assembly answers no question about the mechanism as it is assembled.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import MechanismFileError, UsageError
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.joint_graph.tree import joint_graph
from assur.joint_graph.turns import screws_among, turn_relations
from assur.kinematics.closure import assemble
from assur.kinematics.home import home_values
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

SUMMED = 4
"""So many angles at most are looked at together: screws, and motors that turn their shafts in series."""

AROUND, SAMPLES = 0.1, 24
"""How far assemblies around home are looked for (rad), and how many."""

LONGEST = 1.25 * np.pi
"""Rotation vectors up to this length, in rad, are left as they are by motions."""

KEPT = 1e-6
"""A sum of angles that changes by less than this (rad) does not change: assemblies close to some 1e-9, and the angles
move by `AROUND`. In turns: within it half a turn counts as just that."""


@lru_cache(maxsize=64)
def counted(record: MechanismRecord) -> BoolArray:
    """Whether whole turns of a joint value (n,) count.

    >>> from assur.model.registry import load_record
    >>> bool(np.any(counted(load_record("fivebar"))))
    False
    """
    driven = np.isin(np.arange(len(record.coordinates)), record.input_indices)
    return _frozen(screws_among(record) | (driven & np.any(lasting_relations(record) != 0, axis=0)))


@lru_cache(maxsize=64)
def periodic(record: MechanismRecord) -> BoolArray:
    """Whether a whole turn leaves a joint value (n,) as it was: an angle about an axis whose turns do not count.

    >>> from assur.model.registry import load_record
    >>> bool(np.all(periodic(load_record("fivebar"))))
    True
    """
    return _frozen(_about_axis(record) & ~counted(record))


def periodic_inputs(record: MechanismRecord) -> BoolArray:
    """The same (n,) for the inputs.

    >>> from assur.model.registry import load_record
    >>> periodic_inputs(load_record("fivebar")).tolist()
    [True, True]
    """
    return np.asarray(periodic(record)[list(record.input_indices)])


def periodic_drives(record: MechanismRecord) -> BoolArray:
    """The same (d,) for every input, redundant ones last."""
    return np.asarray(periodic(record)[[item.coordinate.index for item in record.drives]])


def unwrapped(record: MechanismRecord, change: FloatArray) -> FloatArray:
    """Changes (..., n) of joint values, angles that are the same after a whole turn the short way.

    >>> from assur.model.registry import load_record
    >>> unwrapped(load_record("fivebar"), np.full(5, 6.0)).round(4).tolist()
    [-0.2832, -0.2832, -0.2832, -0.2832, -0.2832]
    """
    return np.where(periodic(record), rotations.nearest_turn(change), change)


@lru_cache(maxsize=64)
def lasting_relations(record: MechanismRecord) -> FloatArray:
    """Sums (r, n) of angles of screws and inputs that no motion from home changes, as rows of -1, 0 and 1.

    Those around loops of parallel axes hold in every assembly. The others, of at most `SUMMED` angles, are told by
    assemblies around home: a nut may also be kept from turning by hinges across its screw.

    >>> from assur.model.registry import load_record
    >>> lasting_relations(load_record("fivebar")).shape
    (0, 5)
    """
    rows = list(turn_relations(record))
    screws = screws_among(record)
    if np.any(screws):
        driven = np.isin(np.arange(len(screws)), record.input_indices) & _about_axis(record)
        changes = _changes_around_home(record)
        for row in _sums(screws, driven):
            off = np.abs(rotations.nearest_turn(changes @ row))
            kept = np.max(off, initial=0.0) <= KEPT
            if kept and np.linalg.matrix_rank(np.array([*rows, row])) > len(rows):
                rows.append(row)
    return _frozen(np.array(rows).reshape(len(rows), len(screws)))


def _sums(screws: BoolArray, driven: BoolArray) -> Iterator[FloatArray]:
    """Rows (n,) of -1, 0 and 1, shorter ones first, the first of them 1, with a screw and an angle in each."""
    angles = np.flatnonzero(screws | driven)
    for size in range(2, SUMMED + 1):
        for chosen in itertools.combinations(angles, size):
            if not np.any(screws[list(chosen)]):
                continue
            for signs in itertools.product((1.0, -1.0), repeat=size - 1):
                row = np.zeros(len(screws))
                row[list(chosen)] = (1.0, *signs)
                yield row


def _changes_around_home(record: MechanismRecord) -> FloatArray:
    """How joint values (N, n) differ from those of home at assemblies around it; none where home does not close.

    A joint that stands still tells nothing: rows in which some angle of a screw or an input does not move at all would
    make every sum with it look kept, so that it is given a motion of its own.
    """
    try:
        home = home_values(record)
    except (MechanismFileError, UsageError):
        return np.eye(len(record.home))
    away = AROUND * np.random.default_rng(0).normal(size=(SAMPLES, len(home)))
    found = assemble(record, home + away * _about_axis(record))
    changes = (found.values - home)[found.closed]
    still = np.max(np.abs(changes), axis=0, initial=0.0) <= KEPT
    return np.concatenate([changes, np.diag(still.astype(float))])


def _about_axis(record: MechanismRecord) -> BoolArray:
    """Which joint values (n,) are angles about an axis."""
    return np.array([item.kind == "angle" and not record.joints[item.joint].type.ball for item in record.coordinates])


def in_one_turn(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """Joint values (..., n) with every angle that is the same after a whole turn between -pi and pi.

    Rotation vectors of spherical joints too: as a vector of length 2 pi the identity has no rates, and looks singular.
    """
    answer = np.where(periodic(record), rotations.nearest_turn(joints), joints)
    for place in joint_graph(record).turns:
        answer[..., place] = rotations.shortest(answer[..., place])
    return answer


def whole_turns_less(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """The same assemblies (N, n) with every rotation vector that is longer than `LONGEST` a turn the other way round.

    One that is a little longer than half a turn stays, so that a motion along there is not turned to and fro.
    """
    answer = joints
    for place in joint_graph(record).turns:
        longer = np.flatnonzero(np.linalg.norm(joints[:, place], axis=1) > LONGEST)
        if len(longer):
            answer = joints.copy() if answer is joints else answer
            answer[longer, place] = rotations.shortest(joints[longer, place])
    return answer


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
    home, relations = home_values(record), lasting_relations(record)
    for row in relations:
        free = np.setdiff1d(np.flatnonzero((row != 0) & ~screws), np.asarray(held, dtype=int))
        if len(free):
            answer[..., free[0]] -= 2 * np.pi * _turns((answer - home) @ row) * row[free[0]]
    return answer, np.all(_turns((answer - home) @ relations.T) == 0, axis=-1)


def _turns(angle: FloatArray) -> FloatArray:
    """Whole turns (...) of an angle; half a turn counts as none, forwards, so that rounding does not decide."""
    return np.asarray(np.ceil(angle / (2 * np.pi) - 0.5 - KEPT))


def near_turns_of_home(record: MechanismRecord, start: FloatArray, held: Sequence[int]) -> FloatArray:
    """Starts (..., n) moved as little as gives them as many turns as motions from home have, `held` values kept."""
    relations = lasting_relations(record).copy()
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
    units = joint_scales(record).copy()
    pitches = np.array([abs(record.joints[item.joint].pitch) for item in record.coordinates])
    for row in lasting_relations(record) != 0:
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


def _frozen(array: NDArray[Any]) -> NDArray[Any]:
    array.flags.writeable = False
    return array
