"""Axes that are meant to be parallel and are not: one that leaves the others, or two that nearly meet."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames
from assur.kinematics.answers.at_border import quantity_text
from assur.model.mechanism import MechanismRecord
from assur.numerics.rotations import cross

FloatArray = NDArray[np.float64]

SAME = 1e-6
NEARLY = np.radians(10.0)
"""Below `SAME` (rad) axes are parallel; below `NEARLY` they may have been meant to be."""


def axes_hint(record: MechanismRecord, values: FloatArray, joints: Sequence[str]) -> str:
    """Which axes of joints with one axis among `joints` are, at joint values (n,), probably meant to be parallel.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> axes_hint(record, home_values(record), tuple(record.joints))
    ''
    """
    placed = frames(record, values)
    axes = {
        name: placed[joint.parent][0] @ joint.axes[0]
        for name, joint in record.joints.items()
        if name in joints and joint.type.turns == 1
    }
    names = list(axes)
    angles = {
        (one, other): float(np.arctan2(np.linalg.norm(cross(axes[one], axes[other])), abs(axes[one] @ axes[other])))
        for place, one in enumerate(names)
        for other in names[:place]
    }
    near = {pair: angle for pair, angle in angles.items() if SAME < angle < NEARLY}
    if near:
        one, other = min(near, key=lambda pair: (round(near[pair], 9), not _share_link(record, pair)))
        apart = quantity_text(record, near[one, other], "angle", digits=3)
        return f"the axes of {other} and {one} are {apart} from parallel"
    for name in names:
        rest = [other for other in names if other != name]
        among = [angle for pair, angle in angles.items() if name not in pair]
        own = [angle for pair, angle in angles.items() if name in pair]
        if len(rest) > 2 and max(among) <= SAME < min(own):
            return f"the axis of {name} is not parallel to those of {', '.join(rest)}"
    return ""


def _share_link(record: MechanismRecord, pair: tuple[str, str]) -> bool:
    first, second = (record.joints[name] for name in pair)
    return not {first.parent, first.child}.isdisjoint((second.parent, second.child))
