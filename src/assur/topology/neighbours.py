"""Neighbours of a mechanism: one joint relaxed, neighbouring joints merged, limbs joined, or other joints driven."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from assur.joints.catalogue import BY_LETTER
from assur.joints.joint_type import JointType
from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.directions import Vector, parallel, unit
from assur.topology.notation.plain import plain_text

ELSEWHERE: Vector = unit((2.0, 5.0, 11.0))
"""A direction that no axis of a mechanism is likely to have anything to do with, for an axis that may be any."""

RELAXED = {"R": "CUS", "P": "C", "U": "S"}
"""Joints of which a joint is a part."""

DRIVES = 16
"""Sets of drives that are tried, those near the base first."""

BALL = 3
"""Rotations of a ball joint."""


@dataclass(frozen=True)
class Neighbour:
    """A mechanism that differs in one thing: what `change` says, its limbs as text, and its drives as "limb.joint"."""

    change: str
    chains: tuple[str, ...]
    actuate: tuple[str, ...]


def neighbours(chains: Sequence[Chain], driven: Sequence[str], sets: Sequence[Sequence[str]]) -> Iterator[Neighbour]:
    """The neighbours, without a look at how they move.

    Args:
        chains: the limbs, with names of joints that are unique.
        driven: names of the driven joints.
        sets: admissible sets of drives, as names of joints.

    >>> from assur.topology.notation import parse_chains
    >>> limbs = parse_chains(["P[x] R[x] S", "P[y] R[y] S"])
    >>> [one.change for one in neighbours(limbs, ["P1", "P2"], ()) if "S1" in one.change]
    ['limbs 1 and 2 joined at S1, S2']
    """
    found = [
        *(("drives moved", tuple(chains), tuple(names)) for names in sets[:DRIVES] if set(names) != set(driven)),
        *((said, limbs, tuple(driven)) for said, limbs in _of_one_limb(chains, driven)),
        *((said, limbs, tuple(driven)) for said, limbs in _joined(chains, driven)),
    ]
    for change, limbs, names in found:
        numbers = _numbers(limbs, names)
        said = f"{change} to {', '.join(names)}" if change == "drives moved" else change
        if len(numbers) == len(names):
            yield Neighbour(said, tuple(map(plain_text, limbs)), numbers)


def _numbers(chains: Sequence[Chain], names: Sequence[str]) -> tuple[str, ...]:
    """Joints by their names as "limb.joint"."""
    places = {
        joint.name: f"{limb}.{number}"
        for limb, chain in enumerate(chains, 1)
        for number, joint in enumerate(chain.joints, 1)
        if isinstance(joint, ChainJoint) or joint.kind == "4R"
    }
    return tuple(places[name] for name in names if name in places)


def _of_one_limb(chains: Sequence[Chain], driven: Sequence[str]) -> Iterator[tuple[str, tuple[Chain, ...]]]:
    for index, chain in enumerate(chains):
        for said, elements in (*_relaxed(chain.elements, driven), *_merged(chain.elements, driven)):
            yield said, (*chains[:index], replace(chain, elements=elements, text=""), *chains[index + 1 :])


def _relaxed(elements: Sequence[Element], driven: Sequence[str]) -> Iterator[tuple[str, tuple[Element, ...]]]:
    """With another joint in the place of one that is not driven, in inner loops too."""
    for place, element in enumerate(elements):
        if isinstance(element, InnerLoop):
            for number, branch in enumerate(element.branches):
                for said, other in _relaxed(branch, driven):
                    branches = (*element.branches[:number], other, *element.branches[number + 1 :])
                    yield said, (*elements[:place], replace(element, branches=branches), *elements[place + 1 :])
        elif isinstance(element, ChainJoint) and element.name not in driven:
            for letter in RELAXED.get(element.type.letter, ""):
                joint = _with_more(element, BY_LETTER[letter])
                yield f"{element.name} to {letter}", (*elements[:place], joint, *elements[place + 1 :])


def _with_more(joint: ChainJoint, new: JointType) -> ChainJoint:
    """A joint of another type on the same axes; an axis more is any."""
    axes = (*joint.axes, ELSEWHERE)[: new.axes]
    return replace(joint, type=new, axes=axes, through=() if len(axes) != len(joint.axes) else joint.through)


def _merged(elements: Sequence[Element], driven: Sequence[str]) -> Iterator[tuple[str, tuple[Element, ...]]]:
    """With one joint in the place of two or three neighbours that are not driven."""
    for count in (2, 3):
        for place in range(len(elements) - count + 1):
            part = elements[place : place + count]
            if all(isinstance(joint, ChainJoint) and joint.name not in driven and not joint.general for joint in part):
                joint = _one([joint for joint in part if isinstance(joint, ChainJoint)])
                if joint is not None:
                    names = ", ".join(own.name for own in part)
                    said = f"{names} merged into one {joint.type.letter}"
                    yield said, (*elements[:place], joint, *elements[place + count :])


def _one(joints: Sequence[ChainJoint]) -> ChainJoint | None:
    """The joint that has the freedoms of some; None where there is none."""
    letters = "".join(joint.type.letter for joint in joints)
    axes = tuple(axis for joint in joints for axis in joint.axes)
    if letters in ("PR", "RP") and parallel(axes[0], axes[1]):
        return ChainJoint(BY_LETTER["C"], axes[:1], name=joints[0].name)
    if letters == "RR" and not parallel(axes[0], axes[1]):
        return ChainJoint(BY_LETTER["U"], axes, name=joints[0].name)
    if letters in ("RU", "UR", "RRR") and np.linalg.matrix_rank(np.array(axes)) == BALL:
        return ChainJoint(BY_LETTER["S"], (), name=joints[0].name)
    return None


def _joined(chains: Sequence[Chain], driven: Sequence[str]) -> Iterator[tuple[str, tuple[Chain, ...]]]:
    """With two limbs that lead to one link, and the last joints of one of them from there on."""
    for (i, first), (j, second) in combinations(enumerate(chains), 2):
        for count in range(1, min(len(first.elements), len(second.elements))):
            tail, other = first.elements[-count:], second.elements[-count:]
            if not all(map(_are_alike, tail, other)) or any(part.name in driven for part in (*tail, *other)):
                break
            loop = InnerLoop((first.elements[:-count], second.elements[:-count]))
            names = ", ".join(part.name for part in (*tail, *other))
            limb = replace(first, elements=(loop, *tail), text="")
            rest = tuple(limb if place == i else chain for place, chain in enumerate(chains) if place != j)
            yield f"limbs {i + 1} and {j + 1} joined at {names}", rest


def _are_alike(first: Element, second: Element) -> bool:
    """Whether two joints can be one: the same type, along the same axes."""
    if isinstance(first, Parallelogram) and isinstance(second, Parallelogram):
        return first.kind == second.kind and parallel(first.axis, second.axis)
    if not (isinstance(first, ChainJoint) and isinstance(second, ChainJoint)):
        return False
    return first.type is second.type and all(map(parallel, first.axes, second.axes))
