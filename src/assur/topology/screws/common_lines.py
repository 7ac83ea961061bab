"""Lines that limbs have in common beside their joints: first axes of universal joints on one line, or through a point.

A universal joint has a centre of its own; that its first axis lies on the line of another limb's, fixed in the base, or
that three such axes meet, is seen at home and stays so. So it is of last axes, fixed in the platform. Where axes of
the base and of the platform meet in one point at home, that has one label.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from assur.topology.chains import Chain, ChainJoint
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.shared_points import SAME, Line, common_place, meet, pivoted

FloatArray = NDArray[np.float64]


def with_common_lines(
    chains: Sequence[Chain], linkage: Linkage, labels: Iterator[str], size: float
) -> tuple[Chain, ...]:
    """The limbs with a label on end axes that lie on one line, or that meet in one point as three or more.

    Args:
        chains: limbs of the linkage.
        linkage: at home.
        labels: new ones.
        size: of the linkage.
    """
    marked = list(chains)
    points: list[tuple[FloatArray, str]] = []
    for end in (0, -1):
        places = {index: line for index, chain in enumerate(chains) if (line := _end_axis(chain, linkage, end))}
        if any(_has_centre(chains[index], end) for index in places):
            for group in _groups(places, size):
                point, along = common_place([places[index] for index in group])
                known = () if along.any() else (label for other, label in points if _same(point, other, size))
                label = next(iter(known), "") or next(labels)
                points += [] if along.any() else [(point, label)]
                for index in group:
                    marked[index] = _with_label(marked[index], end, label)
    return tuple(marked)


def _end_axis(chain: Chain, linkage: Linkage, end: int) -> Line | None:
    """The axis of a limb that is fixed in the base, or in the platform."""
    joint = chain.elements[end]
    if not isinstance(joint, ChainJoint) or not pivoted(joint.type) or not joint.axes:
        return None
    placed = linkage.joints[joint.name]
    return placed.point, placed.screws[end, :3]


def _has_centre(chain: Chain, end: int) -> bool:
    joint = chain.elements[end]
    return isinstance(joint, ChainJoint) and len(joint.axes) > 1


def _groups(places: dict[int, Line], size: float) -> list[list[int]]:
    """Limbs whose axes are one line, and all together where three or more meet in one point."""
    lines: list[list[int]] = []
    for index, line in places.items():
        same = next((group for group in lines if _one_line(places[group[0]], line, size)), None)
        if same is None:
            lines.append([index])
        else:
            same.append(index)
    groups = [group for group in lines if len(group) > 1]
    if len(lines) > 2 and meet([places[group[0]] for group in lines], size):
        groups.append(sorted(places))
    return groups


def _same(point: FloatArray, other: FloatArray, size: float) -> bool:
    return float(np.max(np.abs(point - other))) < SAME * size


def _one_line(first: Line, second: Line, size: float) -> bool:
    if float(np.max(np.abs(np.cross(first[1], second[1])))) > SAME:
        return False
    return bool(common_place([first, second])[1].any()) and meet([first, second], size)


def _with_label(chain: Chain, end: int, label: str) -> Chain:
    """A limb with one label more on its end axis."""
    elements = list(chain.elements)
    joint = elements[end]
    if isinstance(joint, ChainJoint):
        through = list(joint.through or ((),) * len(joint.axes))
        through[end] = (*through[end], label)
        alone = len(joint.axes) == 1 and not joint.point
        change = {"point": label} if alone else {"through": tuple(through)}
        elements[end] = dataclasses.replace(joint, **change)
    return Chain(tuple(elements), chain.text)
