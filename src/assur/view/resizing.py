"""Resizing: a dimension is changed in steps, the inputs or the pose held, so that neither mode is left on the way.

A step is taken where the first Newton step is nearly the whole correction and neither the matrix with the inputs
locked nor the one with the platform locked loses its rank (`assur.kinematics.paths.locked`), as along a path. Else it
is halved, down to the tolerance; then the mode ends there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import assemble, closing_system
from assur.kinematics.limits import limits
from assur.kinematics.paths.course import Prescribed
from assur.kinematics.paths.following import FURTHEST
from assur.kinematics.paths.locked import RANK, Locked, locked, matrices, units
from assur.kinematics.paths.stepping import AIM, CLOSE, FLOOR, KEPT
from assur.kinematics.paths.stopping import LESS
from assur.kinematics.pose import pose_of
from assur.model.dimensions import with_parameters
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
TOLERANCE = 1e-5
"""Share of the change within which it stops before what stops it."""

ROUNDING = 1e-9
"""Corrections up to this, in rad or characteristic lengths, are rounding."""

KINDS = {"inputs": "parallel singularity", "poses": "serial singularity"}
"""What a rank that goes to zero means, by what is locked in its matrix."""


@dataclass(frozen=True, eq=False)
class Resized:
    """How far a dimension could be changed.

    Attributes:
        record, values: the mechanism with the dimension that was reached, and its joint values (n,).
        reached: that dimension, in the unit of the file.
        why: what ended the change before the dimension that was wanted; "" where nothing did.
    """

    record: MechanismRecord
    values: FloatArray
    reached: float
    why: str = ""


@dataclass(frozen=True, eq=False)
class _Place:
    record: MechanismRecord
    values: FloatArray
    locks: Mapping[str, Locked]
    longer: float = 1.0  # the next step, in steps before


def resized(
    record: MechanismRecord, values: FloatArray, name: str, value: float, held: Prescribed, ranks: Mapping[str, int]
) -> Resized:
    """A dimension changed to a value, in the unit of the file, from an assembly (n,), as far as both modes are kept.

    Args:
        record: the mechanism before.
        values: (n,) joint values before.
        name: the dimension.
        value: what it shall be.
        held: what stays: the "inputs", or the pose of the platform ("poses").
        ranks: of `assur.kinematics.paths.locked.general_ranks` there.

    Errors: AssurError where the dimension is none, or one that the file does not allow.

    Example: with the cranks of the five-bar at rest its rods can be made shorter until they lie in line, from knee to
    knee.

    >>> from assur.kinematics.paths.locked import general_ranks
    >>> from assur.mechanism import load
    >>> bar = load("fivebar")
    >>> home = bar.home_values
    >>> found = resized(bar, home, "l2", 20.0, "inputs", general_ranks(bar, home))
    >>> half = np.linalg.norm(bar.point("B1", home) - bar.point("B2", home)) / 2
    >>> bool(half < found.reached < half + 0.1), found.why
    (True, 'parallel singularity')
    """
    before = record.parameters[name].value if name in record.parameters else value
    with_parameters(record, **{name: value})  # raises where there is no such dimension
    place = first = _place(record, values, ranks)
    if _least(first) < FLOOR:
        return Resized(record, values, before, _why(first, first, ""))
    done, step, why = 0.0, 1.0, ""
    while done < 1.0:
        share = min(1.0, done + step)
        target = value if share == 1.0 else before + share * (value - before)
        tried = _step(place, name, target, held, ranks)
        if isinstance(tried, str):
            why = tried
            if step <= TOLERANCE:
                return Resized(place.record, place.values, before + done * (value - before), _why(first, place, why))
            step = max(step / 2, TOLERANCE)
            continue
        place, done, step = tried, share, max((share - done) * tried.longer, TOLERANCE)
    return Resized(place.record, place.values, value)


def _place(record: MechanismRecord, values: FloatArray, ranks: Mapping[str, int], longer: float = 1.0) -> _Place:
    screws = matrices(record, values)
    return _Place(record, values, {held: locked(screws[held], ranks[held]) for held in KINDS}, longer)


def _least(place: _Place) -> float:
    return min(float(lock.sizes[-1]) for lock in place.locks.values())


def _step(place: _Place, name: str, target: float, held: Prescribed, ranks: Mapping[str, int]) -> _Place | str:
    """The assembly with another dimension near this one, or what forbids it."""
    try:
        record = with_parameters(place.record, **{name: target})
    except UsageError as error:  # between two dimensions that are allowed there may be one that is not
        return error.message
    poses = pose_of(place.record, place.values) if held == "poses" else None
    locks = record.input_indices if held == "inputs" else ()
    first = _newton(record, place.values, locks, poses)
    assembly = assemble(record, first, held=locks, poses=poses, near=True)
    if not bool(assembly.closed):
        return "the loops do not close"
    size = units(record)
    moved, away = (float(np.linalg.norm(change / size)) for change in (first - place.values, assembly.values - first))
    if moved > FURTHEST or away > CLOSE * moved + ROUNDING:
        return "the loops do not close in this mode"
    rows = matrices(record, assembly.values)
    if min(place.locks[kind].kept(rows[kind]) for kind in KINDS) < KEPT:
        return "the mode ends"
    broken = [bound.name for bound in limits(record, assembly.values) if float(bound.margin(assembly.values)) < 0.0]
    if broken:
        return broken[0]
    next_place = _place(record, assembly.values, ranks, min(2.0, AIM * CLOSE * moved / away if away > 0.0 else 2.0))
    return "the mode ends" if _least(next_place) < FLOOR else next_place


def _newton(record: MechanismRecord, values: FloatArray, locks: Sequence[int], poses: FloatArray | None) -> FloatArray:
    """Joint values (n,) after one Newton step that is not damped, the least one."""
    free = np.setdiff1d(np.arange(len(values)), locks)
    size, length = units(record)[free], characteristic_length(record)
    gaps, derivative = closing_system(record, values[None], None if poses is None else poses[None])
    after = values.copy()
    after[free] -= size * np.linalg.lstsq(derivative[0][:, free] * size / length, gaps[0] / length, rcond=RANK)[0]
    return after


def _why(first: _Place, last: _Place, otherwise: str) -> str:
    """The singularity before which it ended, by the singular value that went down most; else what forbade a step."""
    shares = {held: float(last.locks[held].sizes[-1] / first.locks[held].sizes[-1]) for held in KINDS}
    going = min(shares, key=lambda held: shares[held])
    small = {held: float(last.locks[held].sizes[-1]) for held in KINDS}
    if not otherwise:
        return KINDS[min(small, key=lambda held: small[held])]
    return KINDS[going] if shares[going] < LESS else otherwise
