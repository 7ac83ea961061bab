"""What interval arithmetic proves for a report about one configuration."""

from __future__ import annotations

from assur.errors import UsageError
from assur.kinematics.answers.solution import Solution
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION, is_angle
from assur.workspace.certified.largest import LargestShape, largest
from assur.workspace.slices import slice_at

TOLERANCE = 1e-2
"""How near the proved and the refuted edge of a cube shall be."""


def cube(record: MechanismRecord, configuration: Solution) -> LargestShape:
    """The largest cube about a configuration that is proved reached and free of singularities; angles are held there.

    >>> from assur.kinematics.position import direct
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> 0 < cube(record, next(iter(direct(record, [2.0, 1.0])))).size
    True
    """
    names = record.platform.pose
    if any(name in QUATERNION for name in names):
        raise UsageError("the orientation of its pose is a quaternion, about which no cube is looked for")
    at = dict(zip(names, map(float, configuration.pose), strict=True))
    turned = {name: value for name, value in at.items() if is_angle(name)}
    free = slice_at(record, turned).free
    centre = {name: at[name] for name in free}
    return largest(record, "cube", centre, mode=configuration.working_mode, held=turned, tolerance=TOLERANCE)
