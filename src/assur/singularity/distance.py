"""How far a pose is from the nearest parallel singularity, the orientation held: a clearance in length units.

The answer is the distance of a singular pose that rays found (`assur.singularity.rays`), so an upper bound: nothing
nearer was seen. What is proved to be free of singularities is for intervals to say (`assur.workspace.certified`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border
from assur.kinematics.closed_form.filling import Engine
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS
from assur.singularity.parallel_factors import ParallelFactors
from assur.singularity.rays import Rays

FloatArray = NDArray[np.float64]
BLOCK = 4096
"""Poses that are worked on at a time."""

MANY = 500
"""From so many poses on a compiled loop is repaid."""


@dataclass(frozen=True, eq=False)
class Distance:
    """Distances of poses (...) from the nearest parallel singularity of one working mode that was found.

    Attributes:
        value: (...) in length units, an upper bound; infinite where none was found within `reach`, NaN out of reach of
            the mode.
        factor: (...) name of the factor that vanishes there, "" where there is none.
        nearest: (..., m) the singular pose, NaN where there is none.
        reach: how far was looked.
    """

    value: FloatArray
    factor: NDArray[np.str_]
    nearest: FloatArray
    reach: float


def distance(
    record: MechanismRecord, poses: ArrayLike, mode: str | None = None, reach: float | None = None
) -> Distance:
    """Distance of poses (..., m) from the nearest parallel singularity of the working mode, the orientation held.

    Counted is every pose that the mode reaches and at which a parallel factor changes its sign, whether or not it lies
    within strokes and limits. A factor that vanishes only on the border of the workspace, where a serial one does,
    keeps its sign inside and has no surface, as in `assur.singularity.loci`. A surface that no ray meets is missed.

    Args:
        record: the mechanism, with a closed form and at least one length in its pose.
        poses: in lengths and rad.
        mode: the working mode; the file's default where none is given.
        reach: how far is looked; the characteristic length by default.

    Errors:
        UsageError: no closed form, a pose of angles alone, a reach that is not positive.

    Example: here the paper's mechanism has v = 3.877 mm, which falls to 0 straight below at nearly 1 mm per mm, and a
    little sooner on a slanted way.

    >>> from assur.model.registry import load_record
    >>> found = distance(load_record("zeng2019"), [0.0, 0.0, 241.0])
    >>> str(found.factor), float(found.value.round(3))
    ('v', 3.497)
    """
    closed_form_of(record)
    columns = [k for k, name in enumerate(record.platform.pose) if name in LENGTHS]
    if not columns:
        raise UsageError(f"the pose of {record.name} has no lengths: there is no distance in {record.unit}")
    reach = characteristic_length(record) if reach is None else reach
    if not (np.isfinite(reach) and reach > 0):
        raise UsageError(f"reach: {reach!r} is not a positive length")
    given = border.checked_poses(record, poses)
    flat = given.reshape(-1, given.shape[-1])
    engine: Engine = "compiled" if len(flat) >= MANY else "auto"
    rays = Rays(ParallelFactors(record, mode or record.modes.default_working, columns, engine))
    parts = [rays.nearest(flat[start : start + BLOCK], float(reach)) for start in range(0, max(1, len(flat)), BLOCK)]
    value, which, nearest = (np.concatenate(column) for column in zip(*parts, strict=True))
    batch = given.shape[:-1]
    names = np.array([*rays.factors.names, ""])
    return Distance(value.reshape(batch), names[which].reshape(batch), nearest.reshape(given.shape), float(reach))
