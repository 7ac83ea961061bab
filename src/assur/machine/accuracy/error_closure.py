"""How the joints of a mechanism answer to errors in them while its inputs are held, to first order.

The child of each joint is off by a twist; the passive joints move so that all loops close. Where they cannot, a stress
that balances itself bears the error.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import screws
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.pose import platform_frame
from assur.kinematics.rates.motions import SINGULAR, general_share
from assur.kinematics.turns import joint_units
from assur.machine.motion.joint_motion import at_point
from assur.machine.motion.screws import paths
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
FITS = 1e-7
"""What stays open of a loop, as a share of the error itself, below which the error assembles."""


@dataclass(frozen=True, eq=False)
class ErrorClosure:
    """How joints answer to twists in them, lengths over the characteristic length, about the platform's point.

    Attributes:
        record: the mechanism.
        values: (n,) joint values.
        point: (3,) the platform's, in the mechanism's unit.
        loops: (6 v, n) of all coordinates.
        of_twists: (6 v, 6 J) of twists in the joints.
        platform, platform_of_twists: (6, n) and (6, 6 J), displacement before rotation.
        driven: (n,) whether an input holds it.
        unit: (6, 6) a twist about the platform's point of one at the base's origin.
    """

    record: MechanismRecord
    values: FloatArray
    point: FloatArray
    loops: FloatArray
    of_twists: FloatArray
    platform: FloatArray
    platform_of_twists: FloatArray
    driven: NDArray[np.bool_]
    unit: FloatArray

    @cached_property
    def _parts(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Pseudo-inverse (n, 6 v) of the passive joints, what they cannot close (6 v, r), idle motions (n, k)."""
        scale = np.where(self.driven, 0.0, joint_units(self.record))
        left, sizes, right = np.linalg.svd(self.loops * scale, full_matrices=True)
        whole = np.linalg.svd(self.loops * joint_units(self.record), compute_uv=False)[0]
        rank = int(np.sum(sizes > SINGULAR * general_share(self.record) * whole))
        inverse = scale[:, None] * (right[:rank].T / sizes[:rank]) @ left[:, :rank].T
        return inverse, left[:, rank:], scale[:, None] * right[rank:].T

    @property
    def held(self) -> bool:
        """Whether no idle motion moves the platform."""
        moved = self.platform @ self._parts[2] / np.repeat([characteristic_length(self.record), 1.0], 3)[:, None]
        return bool(np.max(np.abs(moved), initial=0.0) <= FITS)

    def answer(self, twists: FloatArray, drives: FloatArray | None = None) -> tuple[FloatArray, FloatArray]:
        """Displacement and rotation (6, k) of the platform for twists (6 J, k), and what stays open (r, k).

        `drives` (n, k) are errors of joint coordinates that inputs hold.
        """
        inverse, cannot, _ = self._parts
        given = np.zeros((self.loops.shape[1], twists.shape[1])) if drives is None else drives
        gaps = self.of_twists @ twists + self.loops @ given
        joints = given - inverse @ gaps
        return self.platform_of_twists @ twists + self.platform @ joints, cannot.T @ gaps

    def sizes(self, twists: FloatArray) -> FloatArray:
        """How large (k,) errors are, of twists (6 J, k) in the joints."""
        parts = self.unit @ twists.reshape(len(twists) // 6, 6, twists.shape[1])
        return np.asarray(np.linalg.norm(parts, axis=(0, 1)))

    def stress(self, left_open: FloatArray) -> FloatArray:
        """Wrenches (J, 6), force and moment about the platform's point, that balance themselves over what stays open.

        What each joint's parent passes to its child; the largest number is 1, moments over the characteristic length.
        """
        loops = (self._parts[1] @ left_open).reshape(-1, 6)  # moments work on turns
        names, slices = list(self.record.joints), joint_graph(self.record).slices
        of_loops = paths(self.record).of_loops
        borne = np.array([of_loops[:, slices[name].start] @ loops for name in names])
        whole = np.concatenate([borne[:, 3:], borne[:, :3]], axis=1)
        return np.asarray(whole / np.max(np.abs(whole)))


def error_closure(record: MechanismRecord, values: FloatArray) -> ErrorClosure:
    """The closure at joint values (n,)."""
    own, slices = paths(record), joint_graph(record).slices
    length = characteristic_length(record)
    point = platform_frame(record, values[None])[1][0]
    moves = at_point(screws(record, values[None])[0], point, length)
    unit = at_point(np.eye(6), point, length)
    starts = [slices[name].start for name in record.joints]
    to_platform = own.of_links[own.links.index(record.platform.link)]
    order = [3, 4, 5, 0, 1, 2]
    lengths = np.repeat([length, 1.0], 3)[:, None]
    driven = np.zeros(len(values), dtype=bool)
    driven[[item.coordinate.index for item in record.drives]] = True
    return ErrorClosure(
        record=record,
        values=values,
        point=point,
        loops=(moves * own.of_loops[:, None]).reshape(-1, len(values)),
        of_twists=np.concatenate([np.kron(row[starts], unit) for row in own.of_loops]),
        platform=lengths * (moves * to_platform)[order],
        platform_of_twists=lengths * np.kron(to_platform[starts], unit)[order],
        driven=driven,
        unit=unit,
    )
