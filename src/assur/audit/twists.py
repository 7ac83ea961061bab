"""Numbers of topology by the rank of twists: of any part of the joint graph, at random assembled configurations.

An independent route to POC sets and the numbers of Eqs. (3)-(6). It knows dimensions, not directions.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.audit.configurations import configurations, joint_scales, null_space, scaled_closure
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.closure import characteristic_length
from assur.model.joint_graph import frames, joint_graph, screws
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
RANK_GAP = 1e-8


@dataclass(frozen=True)
class Part:
    """Some joints of the joint graph, and the links that they join.

    Attributes:
        loops: its independent loops, each joint -> +1 or -1 along it.
        paths: link -> the joints that lead to it from the root, each with its sense.
    """

    joints: tuple[str, ...]
    loops: tuple[dict[str, int], ...]
    paths: dict[str, dict[str, int]]


def expanded(record: MechanismRecord, names: Sequence[str]) -> tuple[str, ...]:
    """Joints by name, a generalised joint replaced by the joints that it is made of; every one by default."""
    found: list[str] = []
    for name in names or record.joints:
        if name in record.generalised:
            found += record.generalised[name].joints
        elif name in record.joints:
            found.append(name)
        else:
            raise UnknownNameError(f"joint of {record.name}", name, (*record.joints, *record.generalised))
    return tuple(found)


def part(record: MechanismRecord, names: Sequence[str] = ()) -> Part:
    """The part of the joint graph that some joints (or generalised joints) make up.

    Errors:
        UnknownNameError: no such joint. UsageError: the part does not hang together.
    """
    joints = expanded(record, names)
    links = {link for name in joints for link in (record.joints[name].parent, record.joints[name].child)}
    root = record.base if record.base in links else record.joints[joints[0]].parent
    paths: dict[str, dict[str, int]] = {root: {}}
    rest = list(joints)
    grown = True
    while grown:
        grown = False
        for name in list(rest):
            joint = record.joints[name]
            for near, far, sense in ((joint.parent, joint.child, 1), (joint.child, joint.parent, -1)):
                if near in paths and far not in paths:
                    paths[far] = {**paths[near], name: sense}
                    rest.remove(name)
                    grown = True
    if set(paths) != links:
        raise UsageError(f"{record.name}: the joints {', '.join(joints)} do not hang together")
    loops = []
    for name in rest:
        joint = record.joints[name]
        loop = {**paths[joint.parent], name: 1}
        for other, sense in paths[joint.child].items():
            loop[other] = loop.get(other, 0) - sense
        loops.append({other: sense for other, sense in loop.items() if sense})
    return Part(joints, tuple(loops), paths)


def constraint_rank(record: MechanismRecord, names: Sequence[str] = ()) -> int:
    """Rank of the loop closure of a part of the joint graph: the sum of its xi."""
    matrix = _closure(record, part(record, names))
    if not matrix.shape[-2]:
        return 0
    singular = np.linalg.svd(matrix, compute_uv=False)
    return int(np.max(np.sum(singular > RANK_GAP * singular[..., :1], axis=-1)))


def freedoms_with_inputs_locked(record: MechanismRecord, values: FloatArray, threshold: float = 1e-7) -> int:
    """Freedoms that the joint graph keeps at joint values (n,) when every input is locked: 0 where regular."""
    matrix = scaled_closure(record, values)
    free = [index for index in range(matrix.shape[-1]) if index not in record.input_indices]
    singular = np.linalg.svd(matrix[:, free], compute_uv=False)
    return len(free) - int(np.sum(singular > threshold * singular[0]))


def freedom_sum(record: MechanismRecord, names: Sequence[str] = ()) -> int:
    """Sum of the freedoms f_i of some joints."""
    return sum(record.joints[name].type.freedoms for name in expanded(record, names))


def poc_dimensions(record: MechanismRecord, link: str, names: Sequence[str] = ()) -> tuple[int, int, int]:
    """(t, r, dim) of the POC set of a link moved by a part of the joint graph.

    t and r are the ranks of the velocities of the link's origin (of O' for the platform) and of its angular
    velocities, dim that of both together.

    >>> from assur.model.registry import load_record
    >>> poc_dimensions(load_record("zeng2019"), "platform")
    (3, 0, 3)
    """
    some = part(record, names)
    if link not in some.paths:
        raise UnknownNameError(f"link of this part of {record.name}", link, some.paths)
    here = configurations(record).values
    twists = _columns(record, here)
    placed = frames(record, here)
    rotation, origin = placed[link]
    if link == record.platform.link:
        origin = rotation @ record.platform.point + origin
    ranks = []
    for index, matrix in enumerate(_closure(record, some)):
        columns = _indices(record, some.joints)
        basis = null_space(matrix) if len(matrix) else np.eye(len(columns))
        moved = np.zeros((6, len(basis)))
        for name, sense in some.paths[link].items():
            chosen = _indices(record, [name])
            places = [columns.index(column) for column in chosen]
            moved[:, places] = sense * twists[index][:, chosen]
        twist = moved @ basis
        point = origin[index] / characteristic_length(record)
        velocity = twist[3:] + np.cross(twist[:3], point[:, None], axis=0)
        ranks.append((_rank(velocity), _rank(twist[:3]), _rank(np.vstack([velocity, twist[:3]]))))
    return max(ranks, key=lambda item: item[2])


def _rank(matrix: FloatArray) -> int:
    singular = np.linalg.svd(matrix, compute_uv=False)
    return int(np.sum(singular > RANK_GAP))


def _closure(record: MechanismRecord, some: Part) -> FloatArray:
    """Closure Jacobian (N, 6 loops, columns of the part) at the random configurations, in numbers of one size."""
    here = configurations(record).values
    twists = _columns(record, here)
    columns = _indices(record, some.joints)
    matrix = np.zeros((len(here), len(some.loops), 6, len(columns)))
    for index, loop in enumerate(some.loops):
        for name, sense in loop.items():
            chosen = _indices(record, [name])
            places = [columns.index(column) for column in chosen]
            matrix[:, index, :, places] = np.moveaxis(sense * twists[:, :, chosen], -1, 0)
    return matrix.reshape(len(here), 6 * len(some.loops), len(columns))


def _columns(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Joint twists (N, 6, n), lengths in units of the characteristic length."""
    length = characteristic_length(record)
    twists = screws(record, frames(record, values), values) * joint_scales(record)
    twists[:, 3:] /= length
    return twists


def _indices(record: MechanismRecord, names: Sequence[str]) -> list[int]:
    slices = joint_graph(record).slices
    return [index for name in names for index in range(slices[name].start, slices[name].stop)]
