"""How large a force on the platform the actuators hold at rest, in every direction, within what each can exert.

A force f asks the actuators for tau = tau_0 - A f, with tau_0 what gravity asks for. The forces for which |tau| stays
within the limits are a polytope: how far it reaches along an axis, its largest sphere about no force, its corners.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import HalfspaceIntersection

from assur.errors import UsageError
from assur.kinematics.status import Status
from assur.machine.forces import ActuatorForces, forces
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS

FloatArray = NDArray[np.float64]
ZERO = 1e-9
"""Newtons (newton metres) of an actuator per newton, as a share of the largest: what is less holds nothing."""


@dataclass(frozen=True, eq=False)
class ForceCapacity:
    """Forces on the platform that are held at one pose, in N, along the lengths of the pose.

    Attributes:
        axes: of these x, y and z that the pose has.
        per_axis: (k, 2) the largest force against each axis and along it; infinite where no actuator feels it.
        sphere: the largest force that is held in every direction; 0 where gravity alone is too much.
        limiting: the input whose limit that is.
        vertices: (V, k) corners of the polytope; none where it is not bounded, or gravity alone is too much.
        utilisation: (d,) share of each actuator's limit that gravity asks for.
        limits: (d,) N or N m.
        answer: forces under gravity alone.
    """

    axes: tuple[str, ...]
    per_axis: FloatArray
    sphere: float
    limiting: str
    vertices: FloatArray
    utilisation: FloatArray
    limits: FloatArray
    answer: ActuatorForces


def capacity(record: MechanismRecord, pose: ArrayLike, mode: str | None = None) -> ForceCapacity:
    """Forces that are held at a pose (m,), in the mechanism's unit and rad, gravity included.

    Where the actuators hold nothing, or the pose is not reached, numbers are NaN; the status of `answer` says why.

    Errors:
        UsageError: actuators without a largest force, links without a mass.

    >>> from assur.model.registry import load_record
    >>> held = capacity(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315])
    >>> held.axes, len(held.vertices)
    (('x', 'y', 'z'), 8)
    """
    limits = force_limits(record)
    axes = tuple(name for name in LENGTHS if name in record.platform.pose)
    answer = forces(record, pose, mode=mode)
    pushes = [np.eye(3)[LENGTHS.index(name)] for name in axes]
    asked = np.array(
        [forces(record, pose, load=push, gravity=False, mode=mode).forces[0] for push in pushes]
    ).T  # (d, k)
    own = answer.forces[0]
    utilisation = np.abs(own) / limits
    if Status(int(answer.status[0])) not in (Status.regular, Status.near_singular, Status.serial):
        none = np.full((len(axes), 2), np.nan)
        return ForceCapacity(axes, none, np.nan, "", np.empty((0, len(axes))), utilisation, limits, answer)
    faces = np.concatenate([asked, -asked])  # with asked = -A: faces f <= room
    room = np.concatenate([limits - own, limits + own])
    faces[np.abs(faces) <= ZERO * np.abs(faces).max(initial=0.0)] = 0.0
    sizes = np.linalg.norm(faces, axis=1)
    reach = np.where(sizes > 0, np.maximum(room, 0.0) / np.where(sizes > 0, sizes, 1.0), np.inf)
    place = int(np.argmin(reach))
    return ForceCapacity(
        axes=axes,
        per_axis=_along(faces, room),
        sphere=float(reach[place]),
        limiting=record.drives[place % len(limits)].name,
        vertices=_corners(faces, room, sizes),
        utilisation=utilisation,
        limits=limits,
        answer=answer,
    )


def force_limits(record: MechanismRecord) -> FloatArray:
    """The largest force (d,) of each actuator.

    Errors:
        UsageError: one for which the file says none.
    """
    labels = [record.coordinate_label(item.coordinate) for item in record.drives]
    known = [record.machine.actuators.get(label) for label in labels]
    lacking = [label for label, own in zip(labels, known, strict=True) if own is None or own.force is None]
    if lacking:
        hint = f"say it in [actuators]: {lacking[0].rpartition('.')[2]} = {{ force = 60 }}, in N or N m"
        raise UsageError(f"{record.name}: no largest force of {', '.join(lacking)}", hint=hint)
    return np.array([own.force for own in known if own is not None], dtype=float)


def _along(faces: FloatArray, room: FloatArray) -> FloatArray:
    """The largest force (k, 2) against and along each axis."""
    held = []
    for axis in range(faces.shape[1]):
        for sense in (-1.0, 1.0):
            slope = sense * faces[:, axis]
            reach = np.where(slope > 0, room / np.where(slope > 0, slope, 1.0), np.inf)
            held.append(max(float(np.min(reach)), 0.0) if np.all(room >= 0) else 0.0)
    return np.array(held).reshape(-1, 2)


def _corners(faces: FloatArray, room: FloatArray, sizes: FloatArray) -> FloatArray:
    """Corners (V, k) of the polytope of forces around no force."""
    count = faces.shape[1]
    none = np.empty((0, count))
    if np.any(room <= 0.0) or np.linalg.matrix_rank(faces, tol=ZERO * float(np.max(sizes))) < count or count < 2:
        return none
    felt = sizes > 0
    corners = HalfspaceIntersection(np.column_stack([faces, -room])[felt], np.zeros(count)).intersections
    rounded = np.round(corners / np.abs(corners).max(), 9)
    _, first = np.unique(rounded, axis=0, return_index=True)
    return np.asarray(corners[np.sort(first)])
