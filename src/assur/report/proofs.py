"""What interval arithmetic proves for a report: each answer, or in one line why there is none."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from assur.errors import MechanismFileError, UsageError
from assur.kinematics.answers.solution import Solution
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION, is_angle
from assur.workspace.certified.largest import LargestShape, largest
from assur.workspace.certified.region import CertifiedWorkspace, certified_workspace
from assur.workspace.slices import MOST, slice_at

REFUSED = (UsageError, MechanismFileError)
"""What says that an analysis does not apply to a mechanism, or not to its file as it is."""

GAPS = {1: 1e-4, 2: 1e-4, 3: 1e-2}
"""How near the bounds of a volume shall be, by the number of coordinates on which the region depends."""

TOLERANCE = 1e-2
"""How near the proved and the refuted edge of a cube shall be."""

Answer = TypeVar("Answer")


def reason(error: UsageError | MechanismFileError) -> str:
    """Why an analysis was refused, in one line, without a path of this machine."""
    if isinstance(error, MechanismFileError):
        first = error.problems[0]
        return f"{first.path}: {first.found}"
    return error.message


def attempt(make: Callable[[], Answer]) -> Answer | str:
    """What it makes, or why that is refused.

    >>> from assur.model.registry import load_record
    >>> attempt(lambda: workspace_bounds(load_record("zeng2019"))).unit
    'mm^3'
    """
    try:
        return make()
    except REFUSED as error:
        return reason(error)


def workspace_bounds(record: MechanismRecord) -> CertifiedWorkspace:
    """Proved bounds of the default working mode's volume and of its sections, as near as takes a few seconds.

    >>> from assur.model.registry import load_record
    >>> found = workspace_bounds(load_record("zeng2019"))
    >>> found.paving.names, found.gap
    (('x', 'z'), 0.0001)
    """
    coarse = certified_workspace(record, gap=GAPS[MOST])
    gap = GAPS[len(coarse.paving.names)] if coarse.paving.names else GAPS[1]
    return coarse if gap == coarse.gap else certified_workspace(record, gap=gap)


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
