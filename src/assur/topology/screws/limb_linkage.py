"""A limb of a linkage as a linkage of its own, with O' where the entry of a single limb has it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from assur.topology.chains import Chain, Element, InnerLoop, Parallelogram
from assur.topology.screws.linkage import Linkage, part
from assur.topology.screws.shared_points import SAME, end_point, size_of

FloatArray = NDArray[np.float64]


def limb_linkage(linkage: Linkage, chain: Chain) -> Linkage:
    """The joints of one limb alone; O' is fixed in the end link, on its last R axis or joint centre at home.

    Where last axes have a point in common, and nothing behind them moves it, O' is that point.
    """
    tip = end_point(linkage, chain)
    tip = _tip(linkage, chain.elements) if tip is None else tip
    return part(linkage, [joint.name for joint in chain.joints], linkage.platform, tip)


def is_seen_at_end(linkage: Linkage, chain: Chain) -> bool:
    """Whether O' of a linkage is where the entry of this limb has it."""
    away = linkage.point - limb_linkage(linkage, chain).point
    return bool(np.max(np.abs(away)) < SAME * size_of(linkage))


def seen_at_end(linkage: Linkage, chains: Sequence[Chain] | None) -> Linkage:
    """A graph that is one limb, with O' where the entry of that limb has it; any other as it is."""
    if chains is None or len(chains) != 1:
        return linkage
    return replace(linkage, point=limb_linkage(linkage, chains[0]).point)


def limb_values(linkage: Linkage, limb: Linkage, values: FloatArray) -> FloatArray:
    """The joint values (N, k) of a limb among those (N, n) of its linkage."""
    slices = linkage.slices
    return np.concatenate([values[:, slices[name]] for name in limb.joints], axis=1)


def _tip(linkage: Linkage, elements: Sequence[Element]) -> FloatArray | None:
    """Where the last axis or centre of some elements is at home, None if nothing in them turns their end."""
    for element in reversed(elements):
        if isinstance(element, InnerLoop):
            if all(_tip(linkage, branch) is not None for branch in element.branches):
                return linkage.point  # no axis of a loop's branches is one of its output link
        elif isinstance(element, Parallelogram):
            if element.kind != "4R":
                group = linkage.groups[element.name]
                far = [linkage.joints[name] for name in group.joints]
                return next(joint.point for joint in far if group.child in (joint.parent, joint.child))
        elif element.type.turning:
            return linkage.joints[element.name].point
    return None
