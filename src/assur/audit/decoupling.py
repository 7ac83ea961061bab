"""Printed statements of which inputs a coordinate of the pose depends on."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.audit.configurations import configurations
from assur.audit.rows import Row
from assur.errors import UnknownNameError
from assur.joint_graph.frames import frames
from assur.kinematics.border import input_names
from assur.kinematics.rates.velocity import velocity_map
from assur.model.file.schema import Entry
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
ZERO = 1e-9


class Dependence(Entry):
    """A coordinate of the pose and the inputs on which it depends."""

    source: str
    quantity: str
    printed: str
    on: tuple[str, ...]
    erratum: str = ""


def dependence_rows(record: MechanismRecord, entry: Dependence) -> list[Row]:
    """One row: the inputs whose partial derivative is not zero at some random regular configuration."""
    names = input_names(record)
    for name in entry.on:
        if name not in names:
            raise UnknownNameError(f"input of {record.name}", name, names)
    if entry.quantity not in record.platform.pose:
        raise UnknownNameError(f"pose coordinate of {record.name}", entry.quantity, record.platform.pose)
    slopes = np.abs(jacobians(record))[:, record.platform.pose.index(entry.quantity)]
    influential = tuple(
        name for name, slope in zip(names, slopes.max(axis=0), strict=True) if slope > ZERO * slopes.max()
    )
    holds = set(influential) == set(entry.on)
    return [
        Row(
            source=entry.source,
            quantity=entry.quantity,
            printed=entry.printed,
            computed=f"depends on {', '.join(influential)}",
            verdict="ok" if holds else "wrong",
            erratum=entry.erratum,
            note=f"partial derivatives at {len(slopes)} random configurations",
        )
    ]


def jacobians(record: MechanismRecord) -> FloatArray:
    """dx/dq (N, m, n) at the random configurations, of the pose coordinates by the printed inputs."""
    sampled = configurations(record)
    rotation, origin = frames(record, sampled.values)[record.platform.link]
    points = rotation @ record.platform.point + origin
    poses = points[:, ["xyz".index(name) for name in record.platform.pose]]
    return np.array([velocity_map(record, pose, mode).matrix for pose, mode in zip(poses, sampled.modes, strict=True)])
