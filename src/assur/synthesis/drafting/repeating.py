"""One limb in notation, repeated about z: the chains of a symmetric mechanism."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence

from assur.errors import UsageError
from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.directions import Vector
from assur.topology.notation import parse_chain, parse_chains, plain_text
from assur.topology.notation.brackets import direction

LEAST, MOST = 2, 60
PRIME = "'"


def repeated(text: str, count: int) -> tuple[Chain, ...]:
    """A limb and its turns about z, evenly spaced.

    A label is a point of each limb's own. But a limb whose axes all run through one point turns about it, and so do
    its turns about the same one: about points of their own they would not move.

    Errors:
        NotationError: the text is no chain. UsageError: fewer than 2 limbs, or more than 60.

    >>> [chain.text for chain in repeated("R[y] U[x,y]@A S@A", 2)]
    ['R[y] U[x,y]@A1 S@A1', 'R[-y] U[-x,-y]@A2 S@A2']
    >>> [chain.text for chain in repeated("R[x]@O R[y]@O R[z]@O", 2)]
    ['R[x]@O R[y]@O R[z]@O', 'R[-x]@O R[-y]@O R[z]@O']
    """
    if not LEAST <= count <= MOST:
        raise UsageError(f"{count} limbs; allowed: {LEAST} to {MOST}", hint="--count says how often a limb is there")
    limb = parse_chain(text)
    shared = has_one_centre(limb)
    return parse_chains([plain_text(Chain(_turned(limb.elements, number, count, shared))) for number in range(count)])


def has_one_centre(limb: Chain) -> bool:
    """Whether all axes of a limb run through one labelled point, and nothing slides."""
    labels = {element.point if isinstance(element, ChainJoint) else "" for element in limb.elements}
    return len(labels) == 1 and "" not in labels


def _turned(elements: Sequence[Element], number: int, count: int, shared: bool) -> tuple[Element, ...]:
    angle = 2 * math.pi * number / count
    turned: list[Element] = []
    for element in elements:
        if isinstance(element, InnerLoop):
            branches = tuple(_turned(branch, number, count, shared) for branch in element.branches)
            turned.append(dataclasses.replace(element, branches=branches))
        elif isinstance(element, Parallelogram):
            turned.append(dataclasses.replace(element, axis=_about_z(element.axis, angle)))
        else:
            axes = tuple(_about_z(axis, angle) for axis in element.axes)
            label = element.point if shared else _of_limb(element.point, number)
            through = tuple(tuple(_of_limb(point, number) for point in points) for points in element.through)
            turned.append(dataclasses.replace(element, axes=axes, point=label, through=through))
    return tuple(turned)


def _of_limb(label: str, number: int) -> str:
    """A label of the first limb as that of another one."""
    return f"{label.rstrip(PRIME)}{number + 1}{PRIME * label.count(PRIME)}" if label else ""


def _about_z(axis: Vector, angle: float) -> Vector:
    cosine, sine = math.cos(angle), math.sin(angle)
    return direction((cosine * axis[0] - sine * axis[1], sine * axis[0] + cosine * axis[1], axis[2]))
