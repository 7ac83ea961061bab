"""Limb types: chains that could have the required motion, each one once, with the joint that is driven."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import accumulate, permutations, product
from typing import Literal

import numpy as np

from assur.joints.cylindrical import CYLINDRICAL
from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.joints.universal import UNIVERSAL
from assur.synthesis.inner_loops import INNER_LOOPS
from assur.synthesis.isomorphism import Key, limb_key
from assur.synthesis.poses import is_special, twists_at_will
from assur.synthesis.positions import upright
from assur.synthesis.required import RequiredMotion
from assur.synthesis.words import AXES, Word, crossing, words
from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram, ParallelogramKind
from assur.topology.directions import NAMED, Vector
from assur.topology.screws.edges import rank

Actuators = Literal["base", "leg", "any"]
"""Where the driven joint of a limb stands: the first joint, the first P between two joints that turn, or any one."""

FREE = 6
"""Freedoms of a limb that constrains nothing."""

KEPT = 8
"""Lists of limb types that are kept: to write one takes a second, and an explanation asks for it again."""

FREE_LIMB_JOINTS = 3
"""Of the limbs that constrain nothing only the shortest are listed, with one ball joint each."""

SHORT = (2, 3)
"""Joints of limbs of which only the constraints at home are asked."""

TYPES = {"R": REVOLUTE, "P": PRISMATIC, "C": CYLINDRICAL, "U": UNIVERSAL, "S": SPHERICAL}

FREEDOMS_OF = {letter: joint.freedoms for letter, joint in TYPES.items()}

KINDS: dict[str, ParallelogramKind] = {"A": "4R", "B": "4S", "D": "2US"}

JOINT_KINDS = (*TYPES, *(f"P({kind})" for kind in KINDS.values()))
"""What limbs are made of, as it is written."""

_Group = tuple[str, str]
"""A joint and its axes: ("R", "x"), ("U", "xy"), ("A", "z") for a P(4R), ("S", "")."""


@dataclass(frozen=True)
class LimbType:
    """A limb in its first position, and the indices of its driven joints (of a C, its translation)."""

    chain: Chain
    driven: tuple[int, ...]
    key: Key

    @cached_property
    def joints(self) -> int:
        """Joints; a U and a parallelogram count as one."""
        return len(self.chain.joints)

    @property
    def loop(self) -> InnerLoop | None:
        """The inner loop that it begins with."""
        first = self.chain.elements[0]
        return first if isinstance(first, InnerLoop) else None

    @property
    def freedoms(self) -> int:
        """Sum of f."""
        return sum(joint.freedoms for joint in self.chain.joints)

    @property
    def joint_kinds(self) -> frozenset[str]:
        """Kinds of its joints, of `JOINT_KINDS`."""
        return frozenset(
            f"P({joint.kind})" if isinstance(joint, Parallelogram) else joint.type.letter for joint in self.chain.joints
        )

    @property
    def on_base(self) -> tuple[int, ...]:
        """Indices of the joints that stand on the base: the first one, or the first one of each branch."""
        lengths = [len(branch) for branch in self.loop.branches[:-1]] if self.loop else []
        return tuple(accumulate(lengths, initial=0))

    @property
    def driven_columns(self) -> tuple[int, ...]:
        """Places of the driven freedoms among the freedoms of the limb; the translation of a C comes first."""
        return tuple(sum(joint.freedoms for joint in self.chain.joints[:place]) for place in self.driven)

    @property
    def passive_slides(self) -> int:
        """Number of P and C along which nothing drives; a parallelogram is none."""
        rest = (joint for place, joint in enumerate(self.chain.joints) if place not in self.driven)
        return sum(isinstance(joint, ChainJoint) and joint.type in (PRISMATIC, CYLINDRICAL) for joint in rest)

    @cached_property
    def parallelograms(self) -> int:
        """Number of parallelograms."""
        return sum(isinstance(joint, Parallelogram) for joint in self.chain.joints)

    @cached_property
    def hinged(self) -> int:
        """Number of P(4R)."""
        return sum(isinstance(joint, Parallelogram) and joint.kind == "4R" for joint in self.chain.joints)


@lru_cache(KEPT)
def limb_types(motion: RequiredMotion, max_joints: int, actuators: Actuators) -> tuple[LimbType, ...]:
    """Every limb that can be told apart, has a joint to drive and no freedom that shows as passive or idle, once.

    Whether it has the motion is for the two routes to say. Of several ways to write a limb, the first is taken that is
    no special configuration of it, as P[x] R[z] P[x] is one of P[x] R[z] P[y].

    >>> from assur.synthesis.required import MOTIONS
    >>> from assur.topology.notation import plain_text
    >>> found = {plain_text(limb.chain) for limb in limb_types(MOTIONS["3T"], 3, "base")}
    >>> "C[x] R[x] R[x]" in found, "P[x] R[x] R[x] R[x]" in found
    (True, False)
    """
    serial = (
        (Chain(tuple(_element(group) for group in groups)), (driven,))
        for groups, driven in _candidates(motion, max_joints, actuators)
    )
    return _once(serial, motion)


@lru_cache(KEPT)
def short_types(motion: RequiredMotion, actuators: Actuators, *, passive: bool = False) -> tuple[LimbType, ...]:
    """Limbs of two or three joints R, P, C, U and S with axes along x, y, z, each once, regular as written.

    Args:
        motion: at home; relations to its axis are told apart.
        actuators: where the driven joint stands.
        passive: whether limbs without a driven joint are meant instead, which have as many freedoms as the motion.

    >>> from assur.synthesis.required import PARASITIC
    >>> from assur.topology.notation import plain_text
    >>> "R[x] P[y] S" in {plain_text(limb.chain) for limb in short_types(PARASITIC["1T2R"], "leg")}
    True
    """
    pairs = permutations(AXES, 2)
    groups = [*((letter, axis) for letter in "RPC" for axis in AXES), *(("U", f + s) for f, s in pairs), ("S", "")]
    return tuple(limb for limb in _once(_short(motion, groups, actuators, passive), motion) if _is_regular(limb))


def _short(
    motion: RequiredMotion, groups: Sequence[_Group], actuators: Actuators, passive: bool
) -> Iterator[tuple[Chain, tuple[int, ...]]]:
    for count in SHORT:
        for word in product(groups, repeat=count):
            freedoms = sum(FREEDOMS_OF[letter] for letter, _ in word)
            if not motion.dim <= freedoms <= (motion.dim if passive else FREE):
                continue
            chain = Chain(tuple(map(_element, word)))
            if passive:
                yield chain, ()
                continue
            for driven in driven_joints([letter for letter, _ in word], actuators):
                if not _spoils_a_cylinder(word, driven):
                    yield chain, (driven,)


def _is_regular(limb: LimbType) -> bool:
    """Whether all its freedoms are independent as written."""
    twists = twists_at_will(limb.chain, np.random.default_rng(limb.freedoms), 1, 0.0)
    return rank(twists) == limb.freedoms


@lru_cache(KEPT)
def hybrid_types(motion: RequiredMotion, max_joints: int) -> tuple[LimbType, ...]:
    """Limbs that begin with an inner loop of the catalogue, each once; the first joints of its branches are driven.

    Args:
        motion: required of the platform.
        max_joints: on the way through one branch.

    >>> from assur.synthesis.required import MOTIONS
    >>> from assur.topology.notation import plain_text
    >>> found = {plain_text(limb.chain) for limb in hybrid_types(MOTIONS["3T"], 5)}
    >>> "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]" in found
    True
    """
    return _once(_hybrid_candidates(motion, max_joints), motion)


def _hybrid_candidates(motion: RequiredMotion, max_joints: int) -> Iterator[tuple[Chain, tuple[int, ...]]]:
    always = _always(motion)
    for row in INNER_LOOPS:
        room = max_joints - max(map(len, row.loop.branches))
        driven = tuple(accumulate((len(branch) for branch in row.loop.branches[:-1]), initial=0))
        for turn, loop in row.turned_loops(motion):
            begun = row.turned_by(turn)
            for freedoms in range(max(0, motion.dim - row.freedoms), FREE - row.freedoms):
                for word in words(freedoms, room, always=always, begun=begun):
                    for groups in _groupings(word):
                        if len(groups) <= room and not _spoils_a_cylinder(groups, -1):
                            rest = tuple(_element(group) for group in groups)
                            yield Chain((loop, *rest)), driven


def _once(candidates: Iterable[tuple[Chain, tuple[int, ...]]], motion: RequiredMotion) -> tuple[LimbType, ...]:
    """Each limb once; of several ways to write it the first that is no special configuration."""
    ways: dict[Key, list[tuple[Chain, tuple[int, ...]]]] = {}
    for chain, driven in candidates:
        ways.setdefault(limb_key(chain, motion, driven), []).append((chain, driven))
    types = []
    for key, written in ways.items():
        chain, driven = next((way for way in written if not is_special(way[0])), written[0])
        types.append(LimbType(upright(chain, motion), driven, key))
    return tuple(types)


def _candidates(
    motion: RequiredMotion, max_joints: int, actuators: Actuators
) -> Iterator[tuple[tuple[_Group, ...], int]]:
    """Every way to write a limb, and the place of its driven joint."""
    always = _always(motion)
    for freedoms in range(motion.dim, FREE + 1):
        free = freedoms == FREE
        joints = min(max_joints, FREE_LIMB_JOINTS) if free else max_joints
        for word in words(freedoms, joints, always=always, ball=free):
            for groups in _groupings(word):
                for driven in driven_joints([letter for letter, _ in groups], actuators):
                    if len(groups) <= joints and not _spoils_a_cylinder(groups, driven):
                        yield groups, driven


def _always(motion: RequiredMotion) -> str:
    """Name of the direction that a motion singles out."""
    return next((name for name, vector in NAMED.items() if vector == motion.axis), "")


def _groupings(word: Word, start: int = 0) -> Iterator[tuple[_Group, ...]]:
    """The word with any neighbouring R that cross taken together as a U, or not."""
    if start == len(word):
        yield ()
        return
    for rest in _groupings(word, start + 1):
        yield (word[start], *rest)
    if crossing(word, start):
        joint = ("U", word[start][1] + word[start + 1][1])
        for rest in _groupings(word, start + 2):
            yield (joint, *rest)


def driven_joints(letters: Sequence[str], actuators: Actuators) -> tuple[int, ...]:
    """The places of the joints of which one is driven, of a limb with these letters, A for a P(4R).

    >>> driven_joints("UPU", "leg"), driven_joints("UPU", "base"), driven_joints("RUPR", "any")
    ((1,), (), (0, 2, 3))
    """
    can = tuple(place for place, letter in enumerate(letters) if letter in "RPC")
    if actuators == "any":
        return can
    if actuators == "base":
        return can[:1] if can[:1] == (0,) else ()
    turning = [index for index, letter in enumerate(letters) if letter not in "PA"]
    inside = [index for index in range(turning[0], turning[-1]) if letters[index] == "P"] if turning else []
    return tuple(inside[:1])


def _spoils_a_cylinder(groups: tuple[_Group, ...], driven: int) -> bool:
    """Whether a P slides along the next R, and neither is driven: together they are a C, which is listed."""
    for index, (letter, axis) in enumerate(groups):
        if letter == "P" and index != driven:
            before = next((place for place in range(index - 1, -1, -1) if groups[place][0] not in "PA"), driven)
            behind = next((place for place in range(index + 1, len(groups)) if groups[place][0] not in "PA"), driven)
            if before != driven and groups[before][1][-1:] == axis:
                return True
            if behind != driven and groups[behind][1][:1] == axis:
                return True
    return False


def _element(group: _Group) -> Element:
    letter, names = group
    axes: tuple[Vector, ...] = tuple(NAMED[name] for name in names)
    kind = KINDS.get(letter)
    return Parallelogram(kind, axes[0]) if kind else ChainJoint(TYPES[letter], axes)
