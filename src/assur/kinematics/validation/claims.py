"""The motions near home against which a file's claims are held: their ranks, and by name what moves."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closure import RANK_GAP, assemble
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_rates
from assur.kinematics.rates.motions import SINGULAR, InstantaneousMotion, Ranks, general, motions, pose_units
from assur.model.mechanism import MechanismRecord
from assur.model.pose import rate_names

FloatArray = NDArray[np.float64]

AWAY = 0.05
SAMPLES = 8
WHOLE = 1e-6
"""A direction this near to a coordinate axis is called by its name."""


@dataclass(frozen=True, eq=False)
class Claims:
    """Motions at home and at assemblies near it (S, ...); `general` are the ranks, `at` the sample that has them."""

    record: MechanismRecord
    values: FloatArray
    motion: InstantaneousMotion
    general: Ranks
    at: int

    @property
    def moving(self) -> int:
        """Freedoms without internal ones."""
        return int(self.general.freedoms - self.general.internal)

    @property
    def independent_inputs(self) -> int:
        """How many of the inputs that are to determine the mechanism are independent."""
        return _rank(self.motion.inputs[self.at])

    @property
    def spare_inputs(self) -> list[str]:
        """Inputs that can be left out without loss."""
        return _spare([item.name for item in self.record.inputs], self.motion.inputs[self.at])

    @property
    def spare_pose(self) -> list[str]:
        """Coordinates of the pose that can be left out without loss."""
        return _spare(list(rate_names(self.record.platform.pose)), self.motion.pose[self.at])

    @property
    def still(self) -> list[str]:
        """Coordinates of the pose that never change near home."""
        sizes = np.max(np.abs(self.motion.pose), axis=(0, 2))
        return [
            name for name, size in zip(rate_names(self.record.platform.pose), sizes, strict=True) if size < SINGULAR
        ]

    @property
    def free_joints(self) -> list[str]:
        """Joint values that still change, and the platform or another input with them, when all inputs stand."""
        held = _null(self.motion.inputs[self.at])
        _, sizes, right = np.linalg.svd(self.motion.twists[self.at] @ held)
        moves = held @ right[: int(np.sum(sizes > SINGULAR))].T
        rates = np.max(np.abs(self.motion.null[self.at] @ moves), axis=-1, initial=0.0)
        found = [item for item in self.record.coordinates if rates[item.index] > np.max(rates) * 1e-3]
        single = [item for item in found if self.record.joints[item.joint].type.freedoms == 1]
        return [self.record.coordinate_label(item) for item in single or found]

    def lacking(self, names: tuple[str, ...]) -> list[str]:
        """Coordinates among `names` that would add to what the pose says."""
        record, values = self.record, self.values[self.at]
        found = []
        for name in names:
            pose = (*record.platform.pose, name)
            wider = replace(record, platform=replace(record.platform, pose=pose))
            rates = pose_rates(wider, values) * self.motion.scale / pose_units(wider)[:, None]
            if _rank(rates @ self.motion.null[self.at]) > int(self.general.pose):
                found.append(name)
        return found

    @property
    def unsaid(self) -> str:
        """How the platform moves while its pose stands: "turns about z", "moves along x"."""
        twists = self.motion.twists[self.at] @ _null(self.motion.pose[self.at])
        turning = twists[:3]
        if np.max(np.abs(turning), initial=0.0) > SINGULAR:
            return f"turns about {axis_name(turning)}"
        return f"moves along {axis_name(twists[3:])}"


def claims(record: MechanismRecord) -> Claims:
    """Motions near home, of a mechanism whose loops close.

    >>> from assur.model.registry import load_record
    >>> here = claims(load_record("zeng2019"))
    >>> here.moving, here.still, here.spare_inputs, here.free_joints
    (3, [], [], [])
    """
    home = home_values(record)
    there = motions(record, home, RANK_GAP)
    random = np.random.default_rng(0).normal(size=(SAMPLES, len(home)))
    found = assemble(record, home + AWAY * random @ there.null.T * there.scale)
    values = np.concatenate([home[None], found.values[found.closed]])
    motion = motions(record, values, RANK_GAP)
    ranks = motion.ranks
    usual = ranks.closure == np.max(ranks.closure)
    sizes = np.where(usual, ranks.moving + ranks.related + ranks.inputs + ranks.pose, -1)
    at = int(np.flatnonzero(sizes == np.max(sizes))[-1])  # not home, where something may stand still for once
    return Claims(record, values, motion, general(record), at)


def axis_name(vectors: FloatArray) -> str:
    """The direction of the longest of vectors (..., 3, n): "z", or its components.

    >>> axis_name(np.array([[0.0], [0.0], [-2.0]])), axis_name(np.array([[3.0], [0.0], [4.0]]))
    ('z', '[0.6, 0, 0.8]')
    """
    columns = np.moveaxis(vectors, -2, -1).reshape(-1, 3)
    longest = columns[np.argmax(np.linalg.norm(columns, axis=-1))]
    unit = longest / np.linalg.norm(longest)
    unit = unit * np.sign(unit[np.argmax(np.abs(unit))])
    if np.max(unit) > 1 - WHOLE:
        return "xyz"[int(np.argmax(unit))]
    return f"[{', '.join(f'{part:.3g}' for part in unit + 0.0)}]"


def _rank(matrix: FloatArray) -> int:
    return int(np.sum(np.linalg.svd(matrix, compute_uv=False) > SINGULAR))


def _null(matrix: FloatArray) -> FloatArray:
    """Orthonormal columns (n, k) that a matrix (r, n) annuls."""
    _, sizes, right = np.linalg.svd(matrix)
    return np.asarray(right[int(np.sum(sizes > SINGULAR)) :].T)


def _spare(names: list[str], rows: FloatArray) -> list[str]:
    """Names of rows (r, n) that depend on the others."""
    whole = _rank(rows)
    return [name for place, name in enumerate(names) if _rank(np.delete(rows, place, axis=0)) == whole]
