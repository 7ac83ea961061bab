"""Classes of limbs with equal motion, so that the rules are asked once for all their members."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import chain as joined
from itertools import combinations_with_replacement, product

import numpy as np

from assur.synthesis.limb_motions import CandidateLimb
from assur.topology.chains import InnerLoop
from assur.topology.directions import span
from assur.topology.symbolic.motion import Mode, Motion
from assur.topology.symbolic.orientations import Orientations, orientations
from assur.topology.symbolic.spans import Span
from assur.topology.symbolic.union import serial

Class = tuple[CandidateLimb, ...]
"""Limbs with the same motion, the simplest first."""

Simplicity = tuple[int, int, int, tuple[str, ...]]
"""Joints, parallelograms, kinds of limbs, texts."""

AMONG = 20_000
"""The simplest members are looked for among about so many, of the simplest limbs of each class."""


def classes(limbs: Sequence[CandidateLimb]) -> tuple[Class, ...]:
    """The limbs by their motion; a limb on which the rules refuse is a class of its own."""
    members_by_motion: dict[object, list[CandidateLimb]] = {}
    for limb in sorted(limbs, key=lambda limb: simplicity([limb])):
        members_by_motion.setdefault(_motion_key(limb), []).append(limb)
    ordered = sorted(
        members_by_motion.values(), key=lambda members: (members[0].type.freedoms, simplicity(members[:1]))
    )
    return tuple(map(tuple, ordered))


def chosen_classes(
    every: Sequence[Class], limbs: int, drives: int, *, equal: bool = False
) -> Iterator[tuple[Class, ...]]:
    """One class for each limb, such that they have so many drives together; their order makes no difference.

    Args:
        every: the classes.
        limbs: their number.
        drives: of the mechanism.
        equal: whether all limbs are of one class.
    """
    sets = ((members,) * limbs for members in every) if equal else combinations_with_replacement(every, limbs)
    return (chosen for chosen in sets if sum(len(members[0].type.driven) for members in chosen) == drives)


def are_equal(chosen: Sequence[Class]) -> bool:
    """Whether it is one class again and again."""
    return all(members is chosen[0] for members in chosen)


def number_of_members(chosen: Sequence[Class]) -> int:
    """Ways to take one limb of each class; of equal classes, the order makes no difference."""
    counts = Counter(map(id, chosen))
    sizes = {id(members): len(members) for members in chosen}
    return math.prod(math.comb(sizes[key] + count - 1, count) for key, count in counts.items())


def simplest_members(chosen: Sequence[Class]) -> list[tuple[CandidateLimb, ...]]:
    """One limb of each class, not all equal, the simplest first."""
    different = [limbs for limbs in _members(chosen) if any(limb is not limbs[0] for limb in limbs)]
    return sorted(different, key=simplicity)


def simplicity(limbs: Sequence[CandidateLimb]) -> Simplicity:
    """What limbs with equal motions are ranked by."""
    joints = sum(limb.type.joints for limb in limbs)
    parallelograms = sum(limb.type.parallelograms for limb in limbs)
    return (joints, parallelograms, len({id(limb) for limb in limbs}), tuple(limb.text for limb in limbs))


def _members(chosen: Sequence[Class]) -> Iterator[tuple[CandidateLimb, ...]]:
    simplest = int(AMONG ** (1 / len(chosen)))
    counts = Counter(map(id, chosen))
    groups = {id(members): members[:simplest] for members in chosen}
    choices = [combinations_with_replacement(groups[key], count) for key, count in counts.items()]
    for parts in product(*choices):
        yield tuple(joined.from_iterable(parts))


def _motion_key(limb: CandidateLimb) -> object:
    """Equal for limbs with the same motion in their first position, and with inner loops that count alike.

    These do where the ways through their branches have the same motions, too.
    """
    if not limb.motions:
        return limb.text
    loop, *rest = limb.chains[0].elements
    if not isinstance(loop, InnerLoop):
        return _key_of(limb.motions[0])
    mode: Mode = "free" if limb.motions[0].orientations.dim else "translation"
    ways = [serial((*branch, *rest), mode) for branch in loop.branches]
    if not all(isinstance(way, Motion) for way in ways):
        return limb.text
    keys = sorted((repr(_key_of(way)) for way in ways if isinstance(way, Motion)), key=str)
    return (_key_of(limb.motions[0]), tuple(keys), sum(edge.freedoms for edge in limb.edges[0]))


def _key_of(motion: Motion) -> tuple[object, ...]:
    taken = orientations(motion.limb.structure) if motion.limb and motion.rotations.turning else motion.orientations
    return (motion.freedoms, _span_key(motion.translations), _span_key(motion.rotations), _axes_key(taken))


def _axes_key(taken: Orientations) -> tuple[object, ...]:
    """The axes without their sense; one that turns in the base may be fixed in the end link."""
    return (taken.dim, *(_span_key(Span((axis,))) for axis in taken.axes))


def _span_key(subspace: Span) -> tuple[object, ...]:
    """A subspace by its projector, which does not depend on the basis."""
    basis = span(subspace.fixed)
    projector = np.round(basis.T @ basis, 6) + 0.0
    return (tuple(projector.ravel().tolist()), subspace.turning, subspace.plane)
