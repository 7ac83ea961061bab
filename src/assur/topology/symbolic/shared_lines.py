"""The one line that all limbs turn about, of base or of platform.

Where the first axis of each limb is one line of the base, the platform turns about that line whatever else its limbs
do; so with last axes and a line of the platform. Nothing that limbs resist has a moment about it, and couples are
across it.
"""

from __future__ import annotations

from collections.abc import Sequence

from assur.topology.directions import Vector, parallel
from assur.topology.symbolic.elementary import Turn
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.orientations import Orientations
from assur.topology.symbolic.subgroups import axes_through


def shared_line(limbs: Sequence[Motion], taken: Orientations) -> Vector | None:
    """The direction of the line that all limbs turn about, where it stays as written and they share nothing else.

    Args:
        limbs: those that resist anything.
        taken: orientations of the platform; a line of the platform stays only if that turns about no other direction.

    >>> from assur.topology.notation import parse_chains
    >>> from assur.topology.symbolic.orientations import EVERY
    >>> from assur.topology.symbolic.union import serial
    >>> limbs = [serial(chain) for chain in parse_chains(["R[z]@O P[x] R[y] R[z]", "R[z]@O R[x] R[x] S"])]
    >>> shared_line(limbs, EVERY)
    (0.0, 0.0, 1.0)
    """
    chains = [limb.limb.chain for limb in limbs if limb.limb]
    labels = frozenset[str]().union(*(limb.limb.labels for limb in limbs if limb.limb))
    if len(labels) != 1 or len(chains) < len(limbs):
        return None
    label = next(iter(labels))
    if any(len(axes_through(label, chain)) != 1 for chain in chains):
        return None
    for place in (0, -1):
        ends = [chain[place] for chain in chains]
        axes = [end.direction for end in ends if isinstance(end, Turn) and label in end.labels]
        axis = axes[0] if len(axes) == len(ends) else None
        if axis is not None and all(parallel(axis, other) for other in axes):
            stays = place == 0 or (taken.dim < 2 and all(parallel(axis, turned) for turned in taken.axes))
            return axis if stays else None
    return None
