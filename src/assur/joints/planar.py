"""The planar joint: slides along two directions of a plane, and a turn about its normal."""

from __future__ import annotations

import math
from collections.abc import Sequence

from assur.joints.joint_type import JointType
from assur.joints.steps import SLIDE, TURN
from assur.numerics.vectors import Vector, cross

BASIS: tuple[Vector, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def plane(axes: Sequence[Vector]) -> tuple[Vector, ...]:
    """The normal, and the two directions (3,) that the child slides along.

    The first is the axis of the frame that follows the one next to the normal, x after z, less what it has along the
    normal; the second completes a right-handed frame. Of several axes as near to the normal the first counts.

    >>> plane([(0.0, 0.0, 1.0)])
    ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    >>> plane([(0.0, 0.6, 0.8)])[1:]
    ((1.0, 0.0, 0.0), (0.0, 0.8, -0.6))
    """
    (normal,) = axes
    near = max(range(3), key=lambda k: abs(normal[k]))
    following = (near + 1) % 3
    share = normal[following]
    if share:
        x, y, z = (a - share * b for a, b in zip(BASIS[following], normal, strict=True))
        size = math.sqrt(x * x + y * y + z * z)
        first: Vector = (x / size, y / size, z / size)
    else:
        first = BASIS[following]
    a, b, c = cross(normal, first)
    return normal, first, (a + 0.0, b + 0.0, c + 0.0)


PLANAR = JointType(
    name="planar",
    letter="E",
    components=("first", "second", "rotation"),
    steps=(SLIDE.along(1), SLIDE.along(2), TURN),
    axes=1,
    lookalikes="ЕΕ",
    room=(1.6, 3.2),
    directions=plane,
)
