"""Solutions of the direct problem proved from the legs alone: a Krawczyk image about each answer in floats."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.certified.legs import Legs
from assur.kinematics.modes import mode_signs, sign_names
from assur.model.mechanism import MechanismRecord
from assur.model.pose import has_quaternion, is_angle
from assur.numerics.branch_and_prune import certain
from assur.numerics.intervals.functions import TURN
from assur.numerics.intervals.interval import Interval
from assur.numerics.intervals.shapes import empty
from assur.numerics.krawczyk import image, proves

FloatArray = NDArray[np.float64]
RADII = (1e-10, 1e-7)
"""Half widths of the boxes that are tried, against the size of each coordinate."""


@dataclass(frozen=True, eq=False)
class Proofs:
    """Poses (K, m) that certainly are solutions, each the only one in its box `alone` and its working mode.

    `rows` (K,) are those of the float answer.
    """

    pose: Interval
    alone: Interval
    rows: NDArray[np.intp]


def sizes(record: MechanismRecord) -> FloatArray:
    """Size (m,) of each coordinate of a pose: the characteristic length, and 1 of an angle."""
    length = characteristic_length(record)
    return np.array([1.0 if is_angle(name) else length for name in record.platform.pose])


def proofs(legs: Legs, solutions: SolutionSet) -> Proofs:
    """Which solutions of a float answer to a direct problem are proved, with their bounds.

    None where the pose is a quaternion, or where a leg has no sign (the pose is serially singular).
    """
    record = legs.record
    rows = np.flatnonzero(solutions.exists)
    labels = [_label(record, str(solutions.other_labels[row])) for row in rows]
    rows = np.array([row for row, label in zip(rows, labels, strict=True) if label >= 0], dtype=np.intp)
    known = np.array([label for label in labels if label >= 0], dtype=np.intp)
    none = np.zeros(0, dtype=np.intp)
    nothing = empty(len(record.platform.pose))
    if has_quaternion(record.platform.pose) or not len(rows):
        return Proofs(nothing, nothing, none)
    centre = solutions.poses[rows]
    low, high = np.empty_like(centre), np.empty_like(centre)
    half = np.zeros_like(centre)
    for radius in RADII:
        open_ = np.flatnonzero(half[:, 0] == 0)
        if not len(open_):
            break
        size = np.broadcast_to(radius * sizes(record), centre[open_].shape)
        box = Interval.of(centre[open_] - size, centre[open_] + size)
        picture = image(legs.equations(known[open_]), box)
        one = proves(picture, box)
        if np.any(one):
            one[one] &= certain(legs, picture[one], known[open_][one])
        low[open_[one]], high[open_[one]], half[open_[one]] = picture.low[one], picture.high[one], size[one]
    kept: list[int] = []
    for k in np.flatnonzero(half[:, 0] > 0).tolist():
        own = Interval.of(low[k], high[k])
        others = turned(record.platform.pose, own, Interval.of(low[kept], high[kept]))
        if np.all(np.any((own.high < others.low) | (others.high < own.low), axis=-1)):
            kept.append(k)
    alone = Interval.of(centre[kept] - half[kept], centre[kept] + half[kept])
    return Proofs(Interval.of(low[kept], high[kept]), alone, rows[kept])


def turned(names: tuple[str, ...], bounds: Interval, known: Interval) -> Interval:
    """Poses (K, m) with their angles moved by whole turns to where the bounds (m,) of another pose are."""
    for k, name in enumerate(names):
        turns = np.round((bounds.middle[k] - known.middle[:, k]) / TURN.middle) if is_angle(name) else 0.0
        if np.any(turns):
            column = known[:, k] + TURN * turns
            low, high = known.low.copy(), known.high.copy()
            low[:, k] = np.where(turns == 0, low[:, k], column.low)
            high[:, k] = np.where(turns == 0, high[:, k], column.high)
            known = Interval.of(low, high)
    return known


def _label(record: MechanismRecord, mode: str) -> int:
    """The row of a working mode in `Legs.modes`, or -1 where a sign is zero."""
    count = len(sign_names(record, "inverse"))
    text = mode.partition("/")[0][:count]
    if count == 0:
        return 0
    if len(text) != count or "0" in text:
        return -1
    return int("".join("0" if sign > 0 else "1" for sign in mode_signs(record, "inverse", text)), 2)
