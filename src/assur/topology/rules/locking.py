"""Chains with some joints locked: what is left, in a general configuration.

A locked joint is a rigid piece of its chain, but it is locked anywhere, not only as written. So what a locked axis
has turned goes on pointing in another direction: everything up to the next axis parallel to it, which turns back
because the end link keeps its orientation.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Iterator, Sequence

from assur.topology.chains import ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.directions import Vector
from assur.topology.joints import CYLINDRICAL, PRISMATIC, REVOLUTE
from assur.topology.rules.vectors import aligned, rotated

ANYWHERE = 0.7
"""Angle (rad) by which a locked axis is turned: no part of a right angle, or of an angle between common axes."""


def locked(elements: Sequence[Element], names: Collection[str]) -> tuple[Element, ...]:
    """The elements that still move, from base to end link, where some joints are locked.

    Args:
        elements: of a chain whose end link keeps its orientation.
        names: of joints, "P1", or of one of two freedoms, "C1.1" (of a C the translation, of a U the first axis).

    Returns:
        What is left; nothing of an inner loop that a branch without joints holds.

    >>> from assur.topology.notation import parse_chain
    >>> chain = parse_chain("R[z] P[x] R[z] C[x]")
    >>> [item.name for item in locked(chain.elements, {"R1", "C1.1"})]
    ['P1', 'R2', 'C1']
    """
    left: list[Element] = []
    turned: Vector | None = None
    for index, element in enumerate(elements):
        left += _left_of(element if turned is None else _turned(element, turned), names)
        if turned is not None and _comes_back([element], turned):
            turned = None
        stopped = _locked_axis(element, names)
        if stopped is not None and _comes_back(elements[index + 1 :], stopped):
            turned = stopped
    return tuple(left)


def _left_of(element: Element, names: Collection[str]) -> list[Element]:
    """One element, or the part of it that is not locked."""
    if isinstance(element, InnerLoop):
        branches = tuple(locked(branch, names) for branch in element.branches)
        return [InnerLoop(branches, element.name)] if all(branches) else []
    if element.name in names:
        return []
    if isinstance(element, Parallelogram) or element.freedoms != 2:
        return [element]
    free = [index for index in (0, 1) if f"{element.name}.{index + 1}" not in names]
    if len(free) != 1:
        return [element] if free else []
    if element.type is not CYLINDRICAL:
        return [dataclasses.replace(element, type=REVOLUTE, axes=(element.axes[free[0]],))]
    if free == [1]:
        return [dataclasses.replace(element, type=REVOLUTE)]
    return [dataclasses.replace(element, type=PRISMATIC, point="")]


def _locked_axis(element: Element, names: Collection[str]) -> Vector | None:
    """The last axis of a joint, if it is locked."""
    if not isinstance(element, ChainJoint) or not element.axes or element.type is PRISMATIC:
        return None
    return element.axes[-1] if element.name in names or f"{element.name}.2" in names else None


def _comes_back(elements: Sequence[Element], axis: Vector) -> bool:
    """Whether something turns back what a locked axis has turned: a parallel axis, or a ball joint."""
    return any(other is None or aligned(other, axis) for other in _axes_of_turns(elements))


def _axes_of_turns(elements: Sequence[Element]) -> Iterator[Vector | None]:
    """Axes about which some elements turn, in order; None for any axis."""
    for element in elements:
        if isinstance(element, InnerLoop):
            yield from _axes_of_turns(element.branches[0])
        elif isinstance(element, Parallelogram):
            if element.kind != "4R":
                yield element.axis
        elif element.type is not PRISMATIC:
            yield from element.axes or (None,)


def _turned(element: Element, axis: Vector) -> Element:
    """An element behind a locked axis; what stands behind an axis that turns back is as written."""
    if isinstance(element, InnerLoop):
        branches = tuple(tuple(_turned(item, axis) for item in branch) for branch in element.branches)
        return InnerLoop(branches, element.name)
    if isinstance(element, Parallelogram):
        return dataclasses.replace(element, axis=rotated(element.axis, axis, ANYWHERE))
    if element.type is not PRISMATIC and element.axes and aligned(element.axes[0], axis):
        return element
    return dataclasses.replace(element, axes=tuple(rotated(item, axis, ANYWHERE) for item in element.axes))
