"""The largest parasitic motion over a workspace: of the coordinates that the pose leaves out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.parasitic import moving, parasitic, parasitic_at
from assur.model.mechanism import MechanismRecord
from assur.workspace.region import Workspace

FloatArray = NDArray[np.float64]
POINTS = 4096


@dataclass(frozen=True)
class Largest:
    """The largest size of a coordinate.

    Attributes:
        value: with its sign, in a length or rad.
        at: coordinate of the workspace that varies -> its value there, in lengths and rad.
    """

    value: float
    at: Mapping[str, float]


def largest_parasitic(
    record: MechanismRecord, region: Workspace, count: int = POINTS, rng: np.random.Generator | None = None
) -> dict[str, Largest]:
    """Where each coordinate that the pose leaves out is largest in size, over a workspace.

    Asked are the vertices of its surface and what it holds of `count` points spread over its box, so the true largest
    value may be larger, by less the more points there are. Empty where nothing that the pose leaves out moves, and
    where the region is empty.

    Example: with both tilts within 20 deg and the height free, the 3-RPS turns about the vertical by at most
    arctan(sin^2(20 deg) / (2 cos(20 deg))).

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.region import workspace
    >>> record, tilt = load_record("three_rps"), np.radians(20.0)
    >>> found = workspace(record, box={"theta": (-tilt, tilt), "psi": (-tilt, tilt)}, resolution=8)
    >>> largest = largest_parasitic(record, found)["phi"]
    >>> bool(abs(abs(largest.value) - np.arctan(np.sin(tilt) ** 2 / (2 * np.cos(tilt)))) < 1e-9)
    True
    >>> sorted(largest.at)
    ['psi', 'theta', 'z']
    """
    names = moving(record)
    if not names:
        return {}
    free = [region.slice.pose.index(name) for name in region.box.names if name in region.slice.pose]
    inside = region.interior(count, rng or np.random.default_rng(20190719))[:, free]
    points = np.concatenate([region.vertices, inside]) if len(free) == len(region.box.names) else region.vertices
    values = parasitic_over(record, region, points)
    largest = {}
    for name in names:
        sizes = np.nan_to_num(np.abs(values[name]), nan=-1.0)
        if np.any(sizes >= 0):
            k = int(np.argmax(sizes))
            largest[name] = Largest(
                float(values[name][k]), dict(zip(region.box.names, points[k].tolist(), strict=True))
            )
    return largest


def parasitic_over(record: MechanismRecord, region: Workspace, points: FloatArray) -> dict[str, FloatArray]:
    """The coordinates that the pose leaves out, each (N,), at points (N, free coordinates) of a workspace.

    NaN where its mode does not reach a point.
    """
    if record.closed_form is not None:
        return parasitic(record, region.slice.poses(points), region.mode)
    joints = region.joints(points)
    reached = np.all(np.isfinite(joints), axis=1)
    answer = {}
    for name, values in parasitic_at(record, joints[reached]).items():
        answer[name] = np.full(len(points), np.nan)
        answer[name][reached] = values
    return answer
