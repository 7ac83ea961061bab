"""Where the platform stands with dimensions and inputs drawn at random within their tolerances, each assembled anew.

All samples are assembled at once: chords with the derivative of the loops at the nominal pose, over arrays.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.joint_graph.state import joint_state
from assur.joint_graph.tree import joint_graph
from assur.kinematics.certified.enclosed import loop_rows
from assur.kinematics.closure import closing_system
from assur.kinematics.pose import pose_of
from assur.machine.accuracy.toleranced_geometry import FLOATS, toleranced_geometry
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION
from assur.numerics import rotations
from assur.work import Progress, stage

FloatArray = NDArray[np.float64]
COUNT, SEED = 100_000, 1
"""Samples, and what the generator of random numbers starts from, where nothing else is said."""
AT_ONCE = 10_000
"""Samples that are assembled together: their arrays fit a cache."""
CHORDS = 12
"""Steps at most; with tolerances of a thousandth of the lengths each gains three digits."""
CLOSED = 1e-12
"""What stays open of a loop, as a share of the characteristic length, below which a sample is assembled."""
LEFT = 1000.0
"""Times what stays open by which the platform may be off: of a pose that the inputs hold loosely."""
SINGULAR = 1e-9
"""Share of the largest singular value below which one of the loops' derivative is zero: what is held twice."""


@dataclass(frozen=True, eq=False)
class SampledPoses:
    """What samples reach.

    Attributes:
        count: drawn uniformly within the tolerances; the ends that are worst to first order come on top.
        seed: of the generator.
        assembled: how many of all close their loops; in an overconstrained mechanism the others do not exist.
        bounds: (low, high) of each coordinate of the pose over these, in the mechanism's unit and rad; none without.
        rounding: of each coordinate what the loops, closed in floats, may leave of it.
    """

    count: int
    seed: int
    assembled: int
    bounds: Mapping[str, tuple[float, float]]
    rounding: Mapping[str, float]

    def ratio(self, proved: Mapping[str, tuple[float, float]]) -> dict[str, float | None]:
        """How many times as wide proved bounds are; None where samples do not differ."""
        widths = {name: high - low for name, (low, high) in self.bounds.items()}
        return {
            name: (proved[name][1] - proved[name][0]) / width if width > self.rounding[name] else None
            for name, width in widths.items()
            if name in proved
        }

    def inside(self, proved: Mapping[str, tuple[float, float]]) -> bool:
        """Whether all of them lie within proved bounds, but for what loops leave open."""
        return all(
            proved[name][0] - self.rounding[name] <= low and high <= proved[name][1] + self.rounding[name]
            for name, (low, high) in self.bounds.items()
            if name in proved
        )


@stage("sampled poses")
def sampled_poses(
    record: MechanismRecord,
    values: FloatArray,
    off: Mapping[str, float],
    rows: Mapping[str, FloatArray],
    count: int = COUNT,
    seed: int = SEED,
    progress: Progress | None = None,
) -> SampledPoses:
    """Poses near joint values (n,) of samples in which copies and inputs are off by at most `off`, in lengths and rad.

    Args:
        record: the mechanism.
        values: (n,) that close the loops.
        off: copy of a dimension, or input -> bound.
        rows: of each the change (6,) of the platform to first order, whose signs tell the worst ends.
        count: of samples.
        seed: of the generator.
        progress: told how many are done.

    >>> from assur.kinematics.home import home_values
    >>> from assur.machine.accuracy.pose_errors import pose_errors_at
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> errors = pose_errors_at(record, home_values(record))
    >>> own = sampled_poses(record, errors.values, {"l1": 0.05, "rod1.l2": 0.02}, errors.sensitivity, count=1000)
    >>> low, high = own.bounds["y"]
    >>> own.assembled, round(high - low, 3)
    (1012, 0.053)
    """
    loops = _Loops(record, values)
    ends = np.sign(np.nan_to_num([rows[name] for name in off])).T
    random = np.random.default_rng(seed)
    drawn = np.concatenate([ends, -ends, random.uniform(-1.0, 1.0, size=(count, len(off)))]) * list(off.values())
    reached: list[dict[str, FloatArray]] = []
    for first in range(0, len(drawn), AT_ONCE):
        part = drawn[first : first + AT_ONCE].T
        reached.append(loops.coordinates(dict(zip(off, part, strict=True))))
        if progress:
            progress(min(first + AT_ONCE, len(drawn)), len(drawn))
    whole = {name: np.concatenate([part[name] for part in reached]) for name in reached[0]}
    assembled = len(next(iter(whole.values()), []))
    bounds = {name: (float(own.min()), float(own.max())) for name, own in whole.items()} if assembled else {}
    rounding = {name: LEFT * CLOSED * (loops.length if name in LENGTHS else 1.0) for name in whole}
    return SampledPoses(count, seed, assembled, bounds, rounding)


class _Loops:
    """The loops of a record near joint values (n,), and what closes them again to first order."""

    def __init__(self, record: MechanismRecord, values: FloatArray) -> None:
        self.record, self.values = record, values
        self.length = characteristic_length(record)
        driven = {item.coordinate.index for item in record.drives}
        self.passive = [k for k in range(len(values)) if k not in driven]
        scales = joint_scales(record)[self.passive]
        slopes = closing_system(record, values[None], None)[1][0][:, self.passive] * scales
        self.inverse = scales[:, None] * np.linalg.pinv(slopes, rcond=SINGULAR)

    def coordinates(self, off: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
        """Coordinates of the pose of samples (N,) that assemble."""
        count = len(next(iter(off.values())))
        joints = np.tile(self.values[:, None], (1, count))
        for item in self.record.drives:
            if item.name in off:
                joints[item.coordinate.index] += item.sign * off[item.name]
        geometry = toleranced_geometry(self.record, off, FLOATS)
        for _ in range(CHORDS):
            own, gaps = self._at(joints, geometry)
            left = np.max(np.abs(gaps), axis=0, initial=0.0)
            if np.all(left <= CLOSED * self.length):
                break
            joints[self.passive] -= self.inverse @ gaps  # balls by their rotation vectors
        return self._pose(own, left <= CLOSED * self.length)

    def _at(self, joints: FloatArray, geometry: Any) -> tuple[Configuration, FloatArray]:
        graph = joint_graph(self.record)
        state: dict[str, Any] = {
            name: joint_state(own.type, joints[graph.slices[name]]) for name, own in self.record.joints.items()
        }
        own = Configuration(graph, geometry, state)
        rows = [np.broadcast_to(np.asarray(row, dtype=float), joints.shape[1]) for row in loop_rows(own)[0]]
        half = 0.5 * self.length  # the skew part of a small turn is twice its rotation vector
        return own, np.array(rows).reshape(-1, joints.shape[1]) * np.tile(
            np.repeat([1.0, half], 3), len(rows) // 6
        )[:, None]  # fmt: skip

    def _pose(self, own: Configuration, kept: NDArray[np.bool_]) -> dict[str, FloatArray]:
        rotation, point = own.platform
        full = [[np.broadcast_to(number, len(kept)) for number in row] for row in rotation]
        turn = np.moveaxis(np.array(full, dtype=float), -1, 0)[kept]
        known = {name: np.broadcast_to(part, len(kept))[kept] for name, part in zip(LENGTHS, point, strict=True)}
        names = self.record.platform.pose
        if set(names) & set(ANGLES):
            nominal = dict(zip(names, pose_of(self.record, self.values), strict=True))
            for name, angle in zip(ANGLES, rotations.to_angles(turn), strict=True):
                middle = nominal.get(name, 0.0)
                known[name] = middle + (angle - middle + np.pi) % (2.0 * np.pi) - np.pi
        return {name: known[name] for name in names if name not in QUATERNION}
