"""Resizing: a dimension is changed in steps, the inputs or the pose held, so that neither mode is left on the way.

The dimension is followed as inputs and poses are, under the same guard (`assur.kinematics.following.ranks`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import inputs_of
from assur.kinematics.following.course import Prescribed
from assur.kinematics.following.locked import own
from assur.kinematics.following.ranks import Blocked, RankGuard
from assur.kinematics.following.stepping import Pace, Places, followed
from assur.kinematics.following.stopping import LESS
from assur.kinematics.following.ways import DimensionWay, system_of
from assur.kinematics.limits import limits
from assur.kinematics.pose import pose_of
from assur.model.dimensions import with_parameters
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
TOLERANCE = 1e-5
"""Share of the change within which it stops before what stops it."""

KINDS = {"inputs": "parallel singularity", "poses": "serial singularity"}
"""What a rank that goes to zero means, by what is locked in its matrix."""

ENDS = {
    "open": "the loops do not close",
    "far": "the loops do not close in this mode",
    "lost": "the mode ends",
}
"""What is said where no singular value goes to zero."""


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
        ranks: of `assur.kinematics.following.locked.general_ranks` there.

    Errors: AssurError where the dimension is none, or one that the file does not allow.

    Example: with the cranks of the five-bar at rest its rods can be made shorter until they lie in line, from knee to
    knee.

    >>> from assur.kinematics.following.locked import general_ranks
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
    target = inputs_of(record, values) if held == "inputs" else pose_of(record, values)
    way, guard = DimensionWay(record, name, (before, value), held, target), RankGuard(held, limits, ranks)
    here = Places(np.zeros(1), values[None].copy(), system_of(record, held, values[None], target[None])[1])
    begun = guard.begun(way, here)
    if begun and guard.leaving:  # at a singularity of what is not held there is no mode that could be kept
        guard.refused.append(Blocked("lost"))
    arrived = not guard.refused and followed(way, here, guard, Pace(TOLERANCE), np.ones(1))[0]
    share = float(here.shares[0])
    return Resized(way.mechanism(share), here.joints[0], way.value(share), "" if arrived else _why(guard))


def _why(guard: RankGuard) -> str:
    """The singularity before which it ended, by the singular value that went down most; else what forbade a step."""
    first, last, blocked = guard.points[0], guard.points[-1], guard.refused[-1]
    if blocked.limit is not None:
        return blocked.limit.name
    sizes = [np.array([point.own.sizes[-1], point.other.sizes[-1]]) for point in (first, last)]
    shares = sizes[1] / sizes[0]
    kinds = [KINDS[name] for name in own(guard.held)]
    if first is last:
        return kinds[int(np.argmin(sizes[1]))]
    if np.min(shares) < LESS:
        return kinds[int(np.argmin(shares))]
    return blocked.text or ENDS[blocked.why]
