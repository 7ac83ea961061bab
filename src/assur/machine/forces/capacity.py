"""How large a force on the platform the actuators hold at rest, in every direction, within what each can exert.

A force f asks the actuators for tau = tau_0 + A f, with tau_0 what gravity asks for. The forces for which |tau| stays
within the limits are a polytope: how far it reaches along an axis, its largest sphere about no force, its corners.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import HalfspaceIntersection

from assur.errors import UsageError
from assur.kinematics import border
from assur.kinematics.rates.acceleration import reached_in_mode
from assur.machine.forces.actuator_forces import ActuatorForces, forces_at
from assur.machine.forces.loads import load_of
from assur.model.file.place import entry_hint
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
        limiting: the input whose limit that is; "" where redundant ones share it.
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


@dataclass(frozen=True, eq=False)
class HeldForces:
    """The same at N configurations; what is not held, or not reached, is NaN.

    Attributes:
        axes, limits: as above.
        faces: (N, m, k) and room (N, m): the forces f on the platform with faces f <= room are held.
        per_load: (N, d, k) forces of the actuators per newton on the platform along each axis.
        utilisation: (N, d) share of each actuator's limit that gravity asks for, of redundant ones the least norm's.
        answer: forces under gravity alone.
    """

    axes: tuple[str, ...]
    limits: FloatArray
    faces: FloatArray
    room: FloatArray
    per_load: FloatArray
    utilisation: FloatArray
    answer: ActuatorForces

    @property
    def per_axis(self) -> FloatArray:
        """The largest force (N, k, 2) against each axis and along it; infinite where no actuator feels it."""
        pairs = []
        for sense in (-1.0, 1.0):
            slope = sense * self.faces
            reach = np.where(slope > 0, self.room[..., None] / np.where(slope > 0, slope, 1.0), np.inf)
            pairs.append(np.maximum(np.min(np.where(np.isnan(slope), np.nan, reach), axis=1), 0.0))
        enough = np.all(self.room >= 0, axis=1) | np.isnan(self.room[:, 0])
        return np.where(enough[:, None, None], np.stack(pairs, axis=-1), 0.0)

    @property
    def reach(self) -> FloatArray:
        """How large a force (N, m) is held in the direction of each face, at right angles to it."""
        sizes = np.linalg.norm(self.faces, axis=-1)
        return np.where(sizes == 0.0, np.inf, np.maximum(self.room, 0.0) / np.where(sizes == 0.0, 1.0, sizes))

    @property
    def sphere(self) -> FloatArray:
        """The largest force (N,) that is held in every direction; 0 where gravity alone is too much."""
        return np.asarray(np.min(self.reach, axis=1))


def held_forces(record: MechanismRecord, values: FloatArray, lost: NDArray[np.int8] | None = None) -> HeldForces:
    """Forces that are held at joint values (N, n), gravity included; where `lost` (N,) is not `regular` there are none.

    With more drives than freedoms the forces by which they balance one another help: what any of them holds counts.

    Errors:
        UsageError: actuators without a largest force, links without a mass.
    """
    limits = force_limits(record)
    axes = tuple(name for name in LENGTHS if name in record.platform.pose)
    answer = forces_at(record, values, load_of(None), lost=lost)
    pushes = [np.eye(3)[LENGTHS.index(name)] for name in axes]
    asked = np.stack(
        [forces_at(record, values, load_of(push, gravity=False), lost=lost).forces for push in pushes], axis=-1
    )  # (N, d, k): forces are gravity's and these times f
    normals = _normals(answer, limits)  # (N, m, d)
    bound = np.abs(normals) @ limits
    faces, own = normals @ asked, (normals @ answer.forces[..., None])[..., 0]
    faces[np.abs(faces) <= ZERO * np.abs(faces).max(axis=(1, 2), initial=0.0)[:, None, None]] = 0.0
    return HeldForces(
        axes=axes,
        limits=limits,
        faces=np.concatenate([faces, -faces], axis=1),
        room=np.concatenate([bound - own, bound + own], axis=1),
        per_load=asked,
        utilisation=np.abs(answer.forces) / limits,
        answer=answer,
    )


def _normals(answer: ActuatorForces, limits: FloatArray) -> FloatArray:
    """Sums of actuator forces (N, m, d) whose largest values bound what is held: each alone, without redundant ones.

    Else preload changes the forces: what counts are sums that it leaves alone, those that leave out most actuators.
    """
    count, shape = answer.preload.shape[-1], (len(answer.values), len(limits), len(limits))
    if not count:
        return np.broadcast_to(np.eye(len(limits)), shape)
    left = np.linalg.svd(answer.preload)[0][..., count:]  # (N, d, k) sums that preload leaves alone
    normals = []
    for kept in itertools.combinations(range(len(limits)), left.shape[-1] - 1):
        across = np.linalg.svd(left[:, kept])[2][:, -1]  # of these the sum without the actuators kept
        normals.append((left @ across[..., None])[..., 0])
    return np.stack(normals, axis=1)


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
    held = held_forces(record, *reached_in_mode(record, border.checked_poses(record, pose)[None], mode))
    shown = not bool(np.isnan(held.room[0]).any())
    place = int(np.argmin(held.reach[0])) % (held.room.shape[1] // 2)
    own = not held.answer.preload.shape[-1]
    return ForceCapacity(
        axes=held.axes,
        per_axis=held.per_axis[0],
        sphere=float(held.sphere[0]),
        limiting=record.drives[place].name if shown and own else "",
        vertices=_corners(held.faces[0], held.room[0]) if shown else np.empty((0, len(held.axes))),
        utilisation=held.utilisation[0],
        limits=held.limits,
        answer=held.answer,
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
        hint = f"{entry_hint(record, 'actuators', lacking[0], 'force = 60')}, in N or N m"
        raise UsageError(f"{record.name}: no largest force of {', '.join(lacking)}", hint=hint)
    return np.array([own.force for own in known if own is not None], dtype=float)


def _corners(faces: FloatArray, room: FloatArray) -> FloatArray:
    """Corners (V, k) of the polytope of forces around no force."""
    count, sizes = faces.shape[1], np.linalg.norm(faces, axis=1)
    none = np.empty((0, count))
    if np.any(room <= 0.0) or np.linalg.matrix_rank(faces, tol=ZERO * float(np.max(sizes))) < count or count < 2:
        return none
    felt = sizes > 0
    corners = HalfspaceIntersection(np.column_stack([faces, -room])[felt], np.zeros(count)).intersections
    rounded = np.round(corners / np.abs(corners).max(), 9)
    _, first = np.unique(rounded, axis=0, return_index=True)
    return np.asarray(corners[np.sort(first)])
