"""What passes through every joint, from parent to child: Newton and Euler for every link, with unknown reactions.

Each joint passes what its type does not let move, and what its drive exerts. The equations of all links may leave some
of it open: where the joint graph has more constraints than it needs, stresses that balance one another can be added.
What such a stress changes is indeterminate for rigid links; the rest is unique. Shown is the least solution, moments
over the characteristic length. This is the second route to the forces of the actuators: they are unknowns here too,
but for redundant drives, whose forces are those of least norm.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames
from assur.kinematics.validation.check import METRES
from assur.machine.forces.actuator_forces import ActuatorForces
from assur.machine.motion.inertia import rotors
from assur.machine.motion.joint_motion import at_point
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
RANK = 1e-9
"""Singular values of the equations below this share of the largest are zero; lengths are characteristic lengths."""
OPEN = 1e-7
"""What a stress changes by less than this share of itself it leaves alone."""


@dataclass(frozen=True, eq=False)
class JointReaction:
    """The wrench that a joint's parent exerts on its child, at the child's joint point along the base's axes.

    Attributes:
        joint: its name.
        force, moment: (3,) in N and N m, what a drive exerts among it.
        unique: (6,) whether each number is determined for rigid links, force before moment.
        indeterminate: (r, 6) orthonormal wrenches that may be added together with others elsewhere.
    """

    joint: str
    force: FloatArray
    moment: FloatArray
    unique: NDArray[np.bool_]
    indeterminate: FloatArray


@dataclass(frozen=True, eq=False)
class Reactions:
    """All of them, with how many unknowns there are, equations, their rank, and what is left over of these in N.

    `actuators` (d,) are the forces of the drives by this route, `base` (6,) force and moment about the base's origin
    that the mechanism exerts on the base.
    """

    joints: tuple[JointReaction, ...]
    actuators: FloatArray
    base: FloatArray
    unknowns: int
    equations: int
    rank: int
    residual: float

    @property
    def redundancy(self) -> int:
        """Stresses that balance themselves."""
        return self.unknowns - self.rank


def reactions(answer: ActuatorForces) -> Reactions:
    """Reactions in all joints at the first configuration of an answer."""
    record, inertia, motion = answer.record, answer.motion.inertia, answer.motion
    length = motion.length
    points = child_points(record, answer.values[:1])
    screws = inertia.screws[0]
    wrenches, owners, drives = joint_wrenches(record, screws, points, length)  # (6, U) at the joints' points
    links = [link for link in record.links if link != record.base]
    equations = np.zeros((len(links), 6, len(owners)))
    for column, joint in enumerate(owners):
        own = about_origin(wrenches[:, column], points[joint] / length)
        for link, sense in ((record.joints[joint].child, 1.0), (record.joints[joint].parent, -1.0)):
            if link != record.base:
                equations[links.index(link), :, column] += sense * own
    right = _needed(answer, links, length).reshape(-1)
    matrix = equations.reshape(-1, len(owners))
    left, sizes, across = np.linalg.svd(matrix, full_matrices=True)
    rank = int(np.sum(sizes > RANK * sizes[0]))
    stresses = across[rank:].T  # (U, r)
    solution = _least(matrix, right, (left, sizes, across, rank), drives, answer)
    residual = float(np.linalg.norm(matrix @ solution - right))
    joints = tuple(_reaction(name, (wrenches, owners), solution, stresses, length) for name in record.joints)
    base = np.zeros(6)
    for column, joint in enumerate(owners):
        if record.base in (record.joints[joint].child, record.joints[joint].parent):
            sense = 1.0 if record.joints[joint].child == record.base else -1.0
            base += sense * about_origin(wrenches[:, column], points[joint] / length) * solution[column]
    base[3:] *= length
    efforts = np.array([solution[column] / scale for column, scale in drives])
    actuators = efforts + motion.drives @ (rotors(record) * answer.joint_accelerations[0])
    return Reactions(joints, actuators, base, len(owners), len(right), rank, residual)


def child_points(record: MechanismRecord, values: FloatArray) -> dict[str, FloatArray]:
    """The joints' points (3,) on their children, in m in the base frame."""
    placed, metre = frames(record, values), METRES[record.unit]
    points = {}
    for name, joint in record.joints.items():
        rotation, origin = placed[joint.child]
        points[name] = metre * (rotation[0] @ joint.child_at + origin[0])
    return points


def joint_wrenches(
    record: MechanismRecord, screws: FloatArray, points: dict[str, FloatArray], length: float
) -> tuple[FloatArray, list[str], list[tuple[int, float]]]:
    """Wrenches (6, U) of the unknowns, forces before moments over the length, their joints, and where drives are.

    Of a driven coordinate the wrench works 1 along it and nothing along the joint's others.
    """
    columns: list[FloatArray] = []
    owners: list[str] = []
    drives: dict[int, tuple[int, float]] = {}
    driven = {item.coordinate.index: place for place, item in enumerate(record.drives)}
    for name in record.joints:
        own = [item.index for item in record.joint_coordinates(name)]
        moves = at_point(screws[:, own], points[name], length)  # angular, then velocity over the length
        work = np.concatenate([moves[3:], moves[:3]])  # of forces, then moments over the length
        scale = np.linalg.norm(work, axis=0)
        across = np.linalg.svd((work / scale).T, full_matrices=True)[2]
        columns += list(across[len(own) :])
        owners += [name] * (6 - len(own))
        inverse = np.linalg.pinv((work / scale).T)  # (6, f)
        for place, index in enumerate(own):
            if index in driven:
                sign = record.drives[driven[index]].sign
                drives[driven[index]] = (len(owners), sign / scale[place] / length)
                columns.append(inverse[:, place])
                owners.append(name)
    return np.array(columns).T, owners, [drives[place] for place in range(len(driven))]


def about_origin(wrench: FloatArray, point: FloatArray) -> FloatArray:
    """A wrench (6,) at a point (3,), about the base's origin."""
    return np.concatenate([wrench[:3], wrench[3:] + np.cross(point, wrench[:3])])


def _needed(answer: ActuatorForces, links: list[str], length: float) -> FloatArray:
    """What joints must exert on each link (L, 6): force, and moment over the length about the base's origin."""
    inertia, motion = answer.motion.inertia, answer.motion
    force, moment = (part[0] for part in inertia.wrenches(answer.joint_rates, answer.joint_accelerations))
    if answer.load.gravity:
        force = force - inertia.masses[:, None] * inertia.gravity
    total = np.concatenate([force, (moment + np.cross(inertia.centres[0], force)) / length], axis=1)
    applied = answer.load.wrench_at(motion.point)[0]
    push = np.concatenate([applied[3:], (applied[:3] + np.cross(motion.point[0], applied[3:])) / length])
    total[links.index(answer.record.platform.link)] -= push
    return np.asarray(total)


def _least(
    matrix: FloatArray,
    right: FloatArray,
    parts: tuple[FloatArray, FloatArray, FloatArray, int],
    drives: list[tuple[int, float]],
    answer: ActuatorForces,
) -> FloatArray:
    """The least solution; redundant drives exert what virtual work says."""
    left, sizes, across, rank = parts
    if not answer.preload.shape[-1]:
        return np.asarray(across[:rank].T @ ((left[:, :rank].T @ right) / sizes[:rank]))
    solution = np.zeros(matrix.shape[1])
    turning = answer.motion.drives @ (rotors(answer.record) * answer.joint_accelerations[0])
    for (column, scale), force in zip(drives, answer.forces[0] - turning, strict=True):
        solution[column] = force * scale
    rest = np.setdiff1d(np.arange(matrix.shape[1]), [column for column, _ in drives])
    solution[rest] = np.linalg.lstsq(matrix[:, rest], right - matrix @ solution, rcond=RANK)[0]
    return solution


def _reaction(
    joint: str, unknowns: tuple[FloatArray, list[str]], solution: FloatArray, stresses: FloatArray, length: float
) -> JointReaction:
    wrenches, owners = unknowns
    own = [column for column, name in enumerate(owners) if name == joint]
    passed = wrenches[:, own] @ solution[own]
    changed = wrenches[:, own] @ stresses[own]  # (6, r)
    unique = np.max(np.abs(changed), axis=1, initial=0.0) <= OPEN
    units = np.repeat([1.0, length], 3)
    left, sizes, _ = np.linalg.svd(changed * units[:, None], full_matrices=False)
    kept = sizes > OPEN * max(1.0, length)
    return JointReaction(joint, passed[:3], passed[3:] * length, unique, left[:, kept].T)
