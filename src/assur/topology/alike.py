"""Limbs that are alike: the same joints and drives in the same order, with the same angles and points between axes."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.directions import Vector, dot

Kind = tuple[object, ...]

DIGITS = 9
"""Of cosines that are compared."""


def alike_limbs(chains: Sequence[Chain], driven: Collection[str]) -> tuple[tuple[int, ...], ...]:
    """Numbers of the limbs, from 1, those together that are alike, in whatever way they stand.

    Args:
        chains: the limbs.
        driven: names of the joints that are driven.

    >>> from assur.topology.notation import parse_chains
    >>> alike_limbs(parse_chains(["P[x] R[x]", "R[x] R[y]", "P[z] R[z]"]), ["P1", "P2"])
    ((1, 3), (2,))
    """
    kinds: dict[Kind, list[int]] = {}
    for number, chain in enumerate(chains, 1):
        kinds.setdefault(_kind(chain, driven), []).append(number)
    return tuple(tuple(numbers) for numbers in kinds.values())


def _kind(chain: Chain, driven: Collection[str]) -> Kind:
    axes = [axis for joint in chain.joints if not joint.general for axis in _axes(joint)]
    cosines = tuple(round(abs(dot(first, second)), DIGITS) for first in axes for second in axes)
    return (*(_form(element, driven) for element in chain.elements), cosines, _points(chain))


def _form(element: Element, driven: Collection[str]) -> Kind:
    if isinstance(element, InnerLoop):
        return tuple(tuple(_form(inner, driven) for inner in branch) for branch in element.branches)
    kind = element.kind if isinstance(element, Parallelogram) else element.type.letter
    return kind, element.general, element.name in driven


def _axes(joint: ChainJoint | Parallelogram) -> tuple[Vector, ...]:
    return joint.axes if isinstance(joint, ChainJoint) else (joint.axis,)


def _points(chain: Chain) -> tuple[tuple[int, int, int], ...]:
    """Which axes run through which points: numbers of joint, axis and point, points in the order in which they come."""
    numbers: dict[str, int] = {}
    return tuple(
        (place, axis, numbers.setdefault(label, len(numbers)))
        for place, joint in enumerate(chain.joints)
        if isinstance(joint, ChainJoint)
        for axis in range(max(1, len(joint.axes)))
        for label in joint.points_on(axis)
    )
