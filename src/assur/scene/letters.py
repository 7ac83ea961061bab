"""Letters: which points of a mechanism are named in its drawings, and where they stand on their links."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.model.mechanism import MechanismRecord
from assur.scene.skeleton import Skeleton

FloatArray = NDArray[np.float64]
CLOSE = 0.03
"""In three dimensions, points that are nearer than this share of the mechanism get one letter."""


@dataclass(frozen=True, eq=False)
class PlacedLetter:
    """A letter at a point (3,) of a link's frame, in the mechanism's unit."""

    name: str
    link: str
    at: FloatArray


def letters(skeleton: Skeleton) -> tuple[PlacedLetter, ...]:
    """The letters of a mechanism, one where several stand in one place, each on its link.

    >>> from assur.model.registry import load_record
    >>> from assur.scene.companion import companion
    >>> from assur.scene.skeleton import skeleton
    >>> from assur.kinematics.home import home_values
    >>> record = load_record("fivebar")
    >>> [item.name for item in letters(skeleton(record, companion(record), home_values(record)))]
    ['A1', 'A2', 'B1', 'B2', 'P']
    """
    places: dict[str, FloatArray] = {}
    for name, point in lettered(skeleton).items():
        if all(np.linalg.norm(point - other) > CLOSE * skeleton.size for other in places.values()):
            places[name] = point
    return tuple(PlacedLetter(name, *_of_link(skeleton.record, name)) for name in places)


def _of_link(record: MechanismRecord, name: str) -> tuple[str, FloatArray]:
    if name in record.points:
        return record.points[name].link, record.points[name].at
    return record.joints[name].parent, record.joints[name].at


def lettered(skeleton: Skeleton) -> dict[str, FloatArray]:
    """Letters of a drawing: the lettered points, and the joints whose place has no letter yet."""
    record = skeleton.record
    points = {name: skeleton.points[name] for name in record.points}
    for name, joint in record.joints.items():
        of_many = name[:-1] in record.points  # one of several about a lettered point, as B3a about B3
        if not joint.type.turning or joint.type.slides > 1 or of_many:
            continue
        if all(np.linalg.norm(skeleton.points[name] - at) > 1e-9 for at in points.values()):
            points[name] = skeleton.points[name]
    return points
