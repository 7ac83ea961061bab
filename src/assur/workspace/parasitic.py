"""The largest parasitic motion over a workspace: of the coordinates that the pose leaves out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.parasitic import parasitic, parasitic_at
from assur.model.mechanism import MechanismRecord
from assur.workspace.region import Workspace

FloatArray = NDArray[np.float64]
POINTS = 4096


def largest_parasitic(
    record: MechanismRecord, found: Workspace, count: int = POINTS, rng: np.random.Generator | None = None
) -> dict[str, float]:
    """The largest size of each coordinate that the pose leaves out, in lengths and rad, over a workspace.

    Asked are the vertices of its surface and what it holds of `count` points spread over its box, so the true largest
    value may be larger, by less the more points there are. Empty where the pose leaves nothing out; NaN where the
    region is empty.

    Example: with both tilts within 20 deg and the height free, the 3-RPS turns about the vertical by at most
    arctan(sin^2(20 deg) / (2 cos(20 deg))).

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.region import workspace
    >>> record, tilt = load_record("three_rps"), np.radians(20.0)
    >>> found = workspace(record, box={"theta": (-tilt, tilt), "psi": (-tilt, tilt)}, resolution=8)
    >>> largest = largest_parasitic(record, found)["phi"]
    >>> bool(abs(largest - np.arctan(np.sin(tilt) ** 2 / (2 * np.cos(tilt)))) < 1e-9)
    True
    """
    inside = found.interior(count, rng or np.random.default_rng(20190719))
    if record.closed_form is None:
        names = [record.platform.pose.index(name) for name in found.box.names if name in record.platform.pose]
        free = inside[:, names] if len(names) == len(found.box.names) else np.empty((0, len(found.box.names)))
        joints = found.joints(np.concatenate([found.vertices, free]))
        values = parasitic_at(record, joints[np.all(np.isfinite(joints), axis=1)])
    else:
        values = parasitic(record, np.concatenate([found.slice.poses(found.vertices), inside]), found.mode)
    return {name: _largest(column) for name, column in values.items()}


def _largest(values: FloatArray) -> float:
    sizes = np.abs(values[np.isfinite(values)])
    return float(np.max(sizes)) if len(sizes) else float("nan")
