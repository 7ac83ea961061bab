"""Restraint: how well the joints at the platform hold it while all inputs rest, freedoms and constraints alike.

A platform that moves by a twist t while inputs rest opens the joints at it: all that they and the mechanism behind them
can follow is a space of motions, and what is left of t, a gap in each of these joints, is the least of squares. The
singular values of this map from twists to gaps, lengths over the characteristic length, are those of the wrenches by
which legs hold the platform, each of size one: of what drives bear, which a Jacobian of inputs and pose knows, and of
what constraints bear, which it does not. The smallest is zero at a parallel and at a constraint singularity. Which
joint closes a loop does not count.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames, screws
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import RANK_GAP
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
WELL = 50.0
"""A condition above this says that a singularity is near: at their homes mechanisms have 1 to 30."""


@dataclass(frozen=True, eq=False)
class Restraint:
    """How the platform is held.

    Attributes:
        sizes: (6,) gaps at the platform's joints by unit twists, largest first, lengths over the characteristic length.
        weakest: (6,) the unit twist that opens them least, angular first, about the middle of the platform's joints,
            wherever its own point is, along the axes of the base.
    """

    sizes: FloatArray
    weakest: FloatArray

    @property
    def condition(self) -> float:
        """The largest over the smallest; infinite where the platform is not held."""
        return float(self.sizes[0] / self.sizes[-1]) if self.sizes[-1] > RANK_GAP * self.sizes[0] else float("inf")


def restraint(record: MechanismRecord, values: FloatArray) -> Restraint:
    """How the platform is held at joint values (n,) that close the loops.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("orthoglide")
    >>> 1 < restraint(record, home_values(record)).condition < WELL
    True
    """
    platform = record.platform.link
    links = {link: 6 * k for k, link in enumerate(own for own in record.links if own not in (record.base, platform))}
    twists = _unit_twists(record, values)
    twists[:, [item.coordinate.index for item in record.drives]] = 0.0  # a rate that moves nothing changes no span
    behind, at_platform, moved = [np.zeros((0, 6 * len(links) + len(values)))], [], []
    for name, joint in record.joints.items():
        gaps = np.zeros((6, 6 * len(links) + len(values)))
        for link, sense in ((joint.parent, -1.0), (joint.child, 1.0)):
            if link in links:
                gaps[:, links[link] : links[link] + 6] = sense * np.eye(6)
        place = joint_graph(record).slices[name]
        gaps[:, 6 * len(links) + place.start : 6 * len(links) + place.stop] = -twists[:, place]
        if platform not in (joint.parent, joint.child):
            behind.append(gaps)
            continue
        at_platform.append(gaps)
        moved.append(np.eye(6) if joint.child == platform else -np.eye(6))
    followed = _span(np.concatenate(at_platform) @ _null(np.concatenate(behind)))
    by_platform = np.concatenate(moved)
    _, sizes, right = np.linalg.svd(by_platform - followed @ (followed.T @ by_platform))
    return Restraint(sizes, right[-1])


def _unit_twists(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Twists (6, n) of joint rates, of size one, lengths over the characteristic length."""
    own = screws(record, values[None])[0]
    point = middle(record, values)
    moved = np.concatenate([own[:3], (own[3:] + np.cross(own[:3].T, point).T) / characteristic_length(record)])
    return np.asarray(moved / np.linalg.norm(moved, axis=0))


def middle(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """The middle (3,) of the joints at the platform, in the base frame: how it is held does not depend on its tool.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("three_rps")
    >>> middle(record, home_values(record)).shape
    (3,)
    """
    turn, origin = frames(record, values[None])[record.platform.link]
    ends = [joint.child_at for joint in record.joints.values() if joint.child == record.platform.link]
    ends += [joint.at for joint in record.joints.values() if joint.parent == record.platform.link]
    return np.asarray(origin[0] + turn[0] @ np.mean(ends, axis=0))


def _null(matrix: FloatArray) -> FloatArray:
    """An orthonormal basis (n, k) of what a matrix (m, n) takes to zero."""
    _, sizes, right = np.linalg.svd(matrix)
    return np.asarray(right[_rank(sizes) :].T)


def _span(matrix: FloatArray) -> FloatArray:
    """An orthonormal basis (m, r) of the columns of a matrix."""
    left, sizes, _ = np.linalg.svd(matrix, full_matrices=False)
    return np.asarray(left[:, : _rank(sizes)])


def _rank(sizes: FloatArray) -> int:
    return int(np.sum(sizes > RANK_GAP * np.max(sizes, initial=0.0)))
