"""How far a pose is from the nearest parallel singularity, the orientation held: a clearance in length units.

Where a parallel factor f vanishes is a surface. Rays from the pose x0 meet it, and from the nearest of these points x
slides along the surface: towards the foot of x0 on the tangent plane, then back along the gradient of f. A step that
does not come nearer, or leaves the workspace, is halved.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.kinematics import border
from assur.kinematics.closed_form.existence import exists
from assur.kinematics.closure import characteristic_length
from assur.kinematics.modes import mode_kernel_signs
from assur.kinematics.rates.velocity import branch_at
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS
from assur.numerics.dual import Dual, Duals
from assur.numerics.number_types import Floats
from assur.results.json_text import plain

FloatArray = NDArray[np.float64]
STEPS = 40
"""Points on a ray."""

STARTS = 4
"""Rays, those with the shortest ways to a surface, from which the nearest point is looked for."""

SLIDES, PULLS = 40, 2
"""Steps along a surface, and those of Newton's method back to it after each."""

TINY = 1e-300


@dataclass(frozen=True, eq=False)
class Distance:
    """Distances of poses (...) from the nearest parallel singularity of one working mode.

    Attributes:
        value: (...) in length units; infinite where no ray meets one within `reach`, NaN out of reach of the mode.
        factor: (...) name of the factor that vanishes there, "" where there is none.
        nearest: (..., m) the singular pose, NaN where there is none.
        reach: how far was looked.
    """

    value: FloatArray
    factor: NDArray[np.str_]
    nearest: FloatArray
    reach: float

    def to_json(self) -> dict[str, Any]:
        """Plain numbers, with None for what does not exist."""
        return {
            "distance": plain(np.where(np.isfinite(self.value), self.value, np.nan)),
            "factor": self.factor.tolist(),
            "nearest": plain(self.nearest),
            "reach": self.reach,
        }


def distance(
    record: MechanismRecord, poses: ArrayLike, mode: str | None = None, reach: float | None = None
) -> Distance:
    """Distance of poses (..., m) from the nearest parallel singularity that the working mode can reach.

    Args:
        record: the mechanism, with a closed form and at least one length in its pose.
        poses: in lengths and rad.
        mode: the working mode; the file's default where none is given.
        reach: how far is looked; the characteristic length by default.

    Errors:
        UsageError: no closed form, a pose of angles alone, a reach that is not positive.

    Example: 1 mm above a pose at which the paper's mechanism has w = 0 it is a little less away from it.

    >>> from assur.model.registry import load_record
    >>> found = distance(load_record("zeng2019"), [0.0, 0.0, 241.0])
    >>> str(found.factor), float(found.value.round(3))
    ('w', 0.981)
    """
    form = closed_form_of(record)
    columns = [k for k, name in enumerate(record.platform.pose) if name in LENGTHS]
    if not columns:
        raise UsageError(f"the pose of {record.name} has no lengths: there is no distance in {record.unit}")
    reach = characteristic_length(record) if reach is None else reach
    if not (np.isfinite(reach) and reach > 0):
        raise UsageError(f"reach: {reach!r} is not a positive length")
    given = border.checked_poses(record, poses)
    flat = given.reshape(-1, given.shape[-1])
    names = [item.name for item in form.factor_list if item.kind == "parallel"]
    there = _sample(record, flat, mode, names)[1]
    best, which = np.full(len(flat), np.inf), np.full(len(flat), "", dtype=f"<U{max(map(len, names), default=1)}")
    nearest = np.full(flat.shape, np.nan)
    hits = _first_hits(record, flat, mode, names, columns, reach)
    for name, starts in zip(names, hits, strict=True):
        for start in starts:
            point = _foot(record, flat, start, mode, name, columns)
            away = np.linalg.norm((point - flat)[:, columns], axis=-1)
            closer = there & (away < best)  # a NaN is not
            best[closer], which[closer], nearest[closer] = away[closer], name, point[closer]
    best[~there] = np.nan
    batch = given.shape[:-1]
    return Distance(best.reshape(batch), which.reshape(batch), nearest.reshape(given.shape), float(reach))


def _first_hits(
    record: MechanismRecord, poses: FloatArray, mode: str | None, names: Sequence[str], columns: list[int], reach: float
) -> FloatArray:
    """Per factor the nearest points (F, S, N, m) in which rays inside the workspace meet its surface, or NaN."""
    steps = np.linspace(0.0, reach, STEPS + 1)
    points, lengths = [], []
    for direction in _directions(len(columns)):
        along = np.zeros(poses.shape[1])
        along[columns] = direction
        ray = poses + steps[:, None, None] * along  # (S + 1, N, m)
        values, there = _sample(record, ray.reshape(-1, poses.shape[1]), mode, names)
        values = values.reshape(len(names), *ray.shape[:2])
        inside = np.logical_and.accumulate(there.reshape(ray.shape[:2]), axis=0)
        crossed = (np.signbit(values[:, 1:]) != np.signbit(values[:, :-1])) & inside[1:]
        first, any_one = np.argmax(crossed, axis=1), np.any(crossed, axis=1)  # (F, N)
        before = np.take_along_axis(values, first[:, None], axis=1)[:, 0]
        after = np.take_along_axis(values, first[:, None] + 1, axis=1)[:, 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            at = np.where(any_one, steps[first] + steps[1] * before / (before - after), np.nan)
        points.append(poses + at[..., None] * along)
        lengths.append(np.where(any_one, at, np.inf))
    nearest = np.argsort(np.stack(lengths), axis=0)[:STARTS]  # (S, F, N)
    return np.take_along_axis(np.stack(points), nearest[..., None], axis=0).swapaxes(0, 1)


def _foot(
    record: MechanismRecord, poses: FloatArray, start: FloatArray, mode: str | None, name: str, columns: list[int]
) -> FloatArray:
    """The nearest point (N, m) on the surface of a factor that is reached from a start on it, or NaN."""
    known = np.flatnonzero(~np.isnan(start[:, 0]))
    point = np.full(poses.shape, np.nan)
    if not len(known):
        return point
    origin, here = poses[known], _back(record, start[known], mode, name, columns)
    away = np.linalg.norm((here - origin)[:, columns], axis=-1)
    share = np.ones(len(known))
    for _ in range(SLIDES):
        _, gradient = _gradient(record, here, mode, name, columns)
        normal = gradient / np.maximum(np.linalg.norm(gradient, axis=-1, keepdims=True), TINY)
        offset = (here - origin)[:, columns]
        along = offset - normal * np.sum(offset * normal, axis=-1, keepdims=True)
        trial = here.copy()
        trial[:, columns] -= share[:, None] * along
        trial = _back(record, trial, mode, name, columns)
        nearer = np.linalg.norm((trial - origin)[:, columns], axis=-1)
        better = (nearer < away) & _sample(record, trial, mode, [name])[1]
        here[better], away[better] = trial[better], nearer[better]
        share = np.where(better, np.minimum(1.5 * share, 1.0), 0.5 * share)
    _, there = _sample(record, here, mode, [name])
    point[known[there]] = here[there]
    return point


def _back(record: MechanismRecord, points: FloatArray, mode: str | None, name: str, columns: list[int]) -> FloatArray:
    """Points (N, m) moved along the gradient of a factor to where it vanishes."""
    moved = points.copy()
    for _ in range(PULLS):
        value, gradient = _gradient(record, moved, mode, name, columns)
        square = np.sum(gradient**2, axis=-1)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = np.nan_to_num(value[:, None] * gradient / square[:, None], posinf=0.0, neginf=0.0)
        moved[:, columns] -= step
    return moved


def _sample(
    record: MechanismRecord, poses: FloatArray, mode: str | None, names: Sequence[str]
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Factors (F, N) and whether the mode reaches the pose (N,)."""
    form = closed_form_of(record)
    with np.errstate(divide="ignore", invalid="ignore"):
        _, branch = branch_at(record, poses, mode, Floats())
        values = form.factors(Floats(), record.values, branch.core)
    found = np.stack([np.broadcast_to(values[name], (len(poses),)) for name in names])
    there = np.broadcast_to(exists(record, form.inverse_margins, branch.margins), (len(poses),))
    return found, there


def _gradient(
    record: MechanismRecord, poses: FloatArray, mode: str | None, name: str, columns: list[int]
) -> tuple[FloatArray, FloatArray]:
    """A factor (N,) and its derivatives (N, k) along the lengths of the pose."""
    form = closed_form_of(record)
    units = dict(zip(columns, np.eye(len(columns))[:, :, None], strict=True))  # each (k, 1)
    values = border.pose_components(record, poses)
    components = tuple(Dual(value, units[k]) if k in units else value for k, value in enumerate(values))
    with np.errstate(divide="ignore", invalid="ignore"):
        branch = form.inverse(Duals(), record.values, components, mode_kernel_signs(record, "inverse", mode))
        found = form.factors(Duals(), record.values, branch.core)[name]
    if not isinstance(found, Dual):  # the same everywhere
        return np.broadcast_to(np.asarray(found, dtype=float), (len(poses),)), np.zeros((len(poses), len(columns)))
    value = np.broadcast_to(found.value, (len(poses),))
    return value, np.broadcast_to(found.derivative, (len(columns), len(poses))).T


def _directions(size: int) -> FloatArray:
    """Unit vectors (3^k - 1, k) to the faces, edges and corners of a cube."""
    corners = np.array([item for item in itertools.product((-1.0, 0.0, 1.0), repeat=size) if any(item)])
    return corners / np.linalg.norm(corners, axis=-1, keepdims=True)
