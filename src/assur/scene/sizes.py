"""How thick links are drawn: as it is asked for, as the companion says, or as thick as neighbouring joints leave room.

The thickness is that of a flat bar. Widths, pins, balls, carriages and rails are multiples of it. Where nothing is
said it is a share of the mechanism's size at home, less where two joints of one link, or two rods of links that share
no joint, are so near to each other that what is drawn about them would overlap.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from functools import lru_cache
from itertools import combinations
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.home import home_values
from assur.model.mechanism import MechanismRecord
from assur.numerics.segments import segment_distances
from assur.scene.companion import Companion, companion, length
from assur.scene.skeleton import JointMark, Skeleton, skeleton

FloatArray = NDArray[np.float64]
Record = TypeVar("Record", bound=MechanismRecord)
USUAL, MOST = 0.018, 0.1
"""Thickness as a share of the mechanism's size at home: where there is room, and what may be asked for at most."""

ROOM = 0.3
"""Room between what is drawn about two neighbouring joints of one link, in thicknesses."""

RODS = 3.0
"""Distance of the axes of two rods of links that share no joint, in thicknesses, at least."""

ONE_PLACE = 1e-6
"""Joints nearer to each other than this share of the size are in one place, as those of a hinge of three links."""


@lru_cache(maxsize=64)
def thickness(record: MechanismRecord) -> float:
    """Thickness of a flat bar, in the mechanism's unit: asked for, the companion's, or what there is room for.

    >>> from assur.model.registry import load_record
    >>> thickness(with_thickness(load_record("fivebar"), 4.0))
    4.0
    """
    if record.thickness is not None:
        return record.thickness
    names = companion(record)
    return length(record, names.thickness) if names.thickness else automatic(record, names)


def automatic(record: MechanismRecord, names: Companion) -> float:
    """The thickness where nothing is said: `USUAL`, or less, so that no two joints of a link overlap."""
    drawn = skeleton(record, names, home_values(record))
    return min([USUAL * drawn.size, *(limit for _, limit in limits(drawn)), rods_apart(drawn) / RODS])


def rods_apart(drawn: Skeleton) -> float:
    """Least distance of two rods of links that share no joint; those that cross are left out, infinite without any.

    Crossing rods meet however thin they are.
    """
    hinged = [{joint.parent, joint.child} for joint in drawn.record.joints.values()]
    asked = [
        (near, far)
        for (first, near), (second, far) in combinations(drawn.bars(), 2)
        if first != second and {first, second} not in hinged
    ]
    if not asked:
        return math.inf
    ends = np.array(asked)  # (k, 2, 2, 3)
    distances = segment_distances(ends[:, 0, 0], ends[:, 0, 1], ends[:, 1, 0], ends[:, 1, 1])
    return float(np.min(distances[distances > ONE_PLACE * drawn.size], initial=math.inf))


def limits(drawn: Skeleton) -> Iterator[tuple[tuple[str, str], float]]:
    """Of every two joints of one link that are apart: their names, and the thickness at which they have just room.

    Telescopes are left out: what is drawn about them is on the leg, not at a point of it.
    """
    for link in drawn.record.links:
        of_link = [
            mark for mark in drawn.marks if link in (mark.joint.parent, mark.joint.child) and not mark.telescopes
        ]
        for first, second in combinations(of_link, 2):
            way = second.at - first.at
            apart = float(np.linalg.norm(way))
            if apart > ONE_PLACE * drawn.size:
                needed = _takes(first, way / apart) + _takes(second, way / apart) + ROOM
                yield (first.joint.name, second.joint.name), apart / needed


def _takes(mark: JointMark, way: FloatArray) -> float:
    """Half of what is drawn about a joint along a way (3,), in thicknesses: that of a cylinder about its axis."""
    along, across = mark.joint.type.room
    cosine = abs(float(mark.axes[0] @ way)) if len(mark.axes) else 0.0
    return along * cosine + across * math.sqrt(max(1.0 - cosine**2, 0.0))


def with_thickness(record: Record, value: float) -> Record:
    """The same mechanism drawn with another thickness, in its length unit; other dimensions keep it.

    Errors: `UsageError` for one that is not positive, and one above `MOST` of the mechanism's size.

    >>> from assur.model.registry import load_record
    >>> with_thickness(load_record("fivebar"), 2.5).thickness
    2.5
    """
    names = companion(record)
    largest = MOST * skeleton(record, names, home_values(record)).size
    if not 0 < value <= largest:
        raise UsageError(
            f"{record.name}: a thickness of {value:g} {record.unit}; it must be above 0 and at most {largest:.3g}",
            hint=f"left out it is {thickness(record):.3g} {record.unit}",
        )
    return dataclasses.replace(record, thickness=float(value))
