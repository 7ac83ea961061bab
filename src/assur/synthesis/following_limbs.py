"""Limbs that can follow a virtual chain by finite displacements: words of R and P, some axes through its point.

All words of one length are looked at together: those whose twists at home hold the motion's, then those that close with
the virtual chain at each of its poses. An axis runs through the point only where it must, and no joint stays at rest.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from functools import cache, lru_cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.joints.universal import UNIVERSAL
from assur.synthesis.classes import Class, simplicity
from assur.synthesis.isomorphism import limb_key
from assur.synthesis.limb_motions import STILL, CandidateLimb, known_at_will
from assur.synthesis.limbs import FREE, KEPT, Actuators, LimbType, driven_joints
from assur.synthesis.placed_series import DRAWS, SIZE, PlacedSeries, at_point, best_of, following, series_of
from assur.synthesis.positions import turned
from assur.synthesis.virtual_chains import POSES, TURNS, VirtualChain
from assur.synthesis.words import AXES
from assur.topology.chains import BASE, PLATFORM, Chain, ChainJoint
from assur.topology.directions import NAMED
from assur.topology.notation import parse_chain, plain_text
from assur.topology.screws.edges import Edge, null_basis

FloatArray = NDArray[np.float64]
Words = NDArray[np.intp]

KINDS = "RPOS"
"""Of a letter: a revolute joint anywhere, a prismatic one, a revolute one whose axis runs through the point, and one of
the three of a ball joint that stands elsewhere."""

KINDS_OF_JOINTS = ("R", "P", "U", "S")
"""What limbs are made of, as it is written."""

SINGLE = KINDS.index("S") * len(AXES)
"""So many letters stand by themselves."""

BALL = tuple(range(SINGLE, SINGLE + len(AXES)))

POINT = "O"
"""Label of the point."""

TRIES = 3
"""So often a limb is drawn anew that does not get to the poses."""

INDEPENDENT = 1e-5
"""Smallest singular value of the twists of a limb whose freedoms are independent; links are about one long."""

HELD = 1e-8
"""How far the twists of the motion may be from those of a limb that holds them."""

DIGITS = 5
"""Decimals to which constraints are compared."""


@lru_cache(FREE * KEPT)
def following_words(motion: VirtualChain, freedoms: int, *, idle: bool = False) -> Words:
    """Words (M, freedoms) of limbs that follow the motion, letters by number: kind times three plus axis.

    Args:
        motion: with its virtual chain.
        freedoms: letters of a word.
        idle: whether one R may stay at rest.
    """
    every = np.array(list(_spelled(freedoms)), dtype=np.intp)
    again = (every[:, 1:] == every[:, :-1]) & (every[:, 1:] >= len(AXES))  # the same slide or line twice
    words: Words = every[~np.any(again, axis=1)]
    if len(motion.translations) == len(AXES):  # then points make no difference
        words = words[np.all(words < KINDS.index("O") * len(AXES), axis=1)]
    twists = _series(words, 1).at(np.zeros(words.shape))[2]
    asked = motion.series.at(np.zeros((1, motion.dim)))[2]
    basis, singular, _ = np.linalg.svd(twists, full_matrices=False)
    outside = asked - basis @ (np.swapaxes(basis, -1, -2) @ asked)
    words = words[(singular[:, -1] > INDEPENDENT) & (np.max(np.abs(outside), axis=(1, 2)) < HELD)]
    if not len(words):
        return words
    follows, values = following(_series(words), motion.series, motion.values)
    words = words[follows]
    moving = _moving(_series(words), motion, values[follows], idle=idle)
    return _without_needless_points(words, moving)


def _spelled(freedoms: int) -> Iterator[tuple[int, ...]]:
    """All words of a length, those without a ball joint first."""
    yield from product(range(SINGLE), repeat=freedoms)
    for others in product(range(SINGLE), repeat=freedoms - len(BALL)) if freedoms >= len(BALL) else ():
        for place in range(len(others) + 1):
            yield (*others[:place], *BALL, *others[place:])


def _series(words: Words, draws: int = DRAWS) -> PlacedSeries:
    generator = np.random.default_rng(words.shape[1])
    kinds = words // len(AXES)
    axes, turning = np.eye(3)[words % len(AXES)], kinds != KINDS.index("P")
    ball, anywhere = (kinds == KINDS.index("S"))[..., None], (kinds == KINDS.index("R"))[..., None]
    points = generator.uniform(-SIZE, SIZE, (draws, 1, words.shape[1], 3))
    placed = (np.where(ball, one[:, :1], np.where(anywhere, one, 0.0)) for one in points)
    return best_of([PlacedSeries(axes, one, turning) for one in placed])


def _moving(series: PlacedSeries, motion: VirtualChain, values: FloatArray, *, idle: bool) -> NDArray[np.bool_]:
    """Whether the freedoms of series (M) are independent at the poses, and each joint moves, or all but one."""
    count, poses, freedoms = values.shape
    twists = series.repeated(poses).at(values.reshape(count * poses, freedoms))[2]
    asked = np.tile(motion.series.repeated(poses).at(motion.values)[2], (count, 1, 1))
    rates = np.max(np.abs(np.linalg.pinv(twists) @ asked), axis=2).reshape(count, poses, freedoms)
    smallest = np.linalg.svd(twists, compute_uv=False)[:, -1].reshape(count, poses)
    rests = np.max(rates, axis=1) < STILL
    at_rest = np.sum(rests, axis=1) <= int(idle)
    at_rest &= ~np.any(rests & ~series.turning, axis=1)
    kept: NDArray[np.bool_] = (np.min(smallest, axis=1) > INDEPENDENT) & at_rest
    return kept


def _without_needless_points(words: Words, kept: NDArray[np.bool_]) -> Words:
    """The words that are kept, without those that follow as well with one axis less through the point."""
    follow = {tuple(word) for word in words.tolist()}
    through = KINDS.index("O") * len(AXES)

    def needs(word: Sequence[int]) -> bool:
        freed = (
            [*word[:place], letter - through, *word[place + 1 :]]
            for place, letter in enumerate(word)
            if through <= letter < SINGLE
        )
        return not any(tuple(other) in follow for other in freed)

    return np.array([word for word in words[kept].tolist() if needs(word)], dtype=np.intp).reshape(-1, words.shape[1])


def following_types(
    motion: VirtualChain, max_joints: int, actuators: Actuators, *, idle: bool = False
) -> tuple[LimbType, ...]:
    """Limbs that follow a motion, each once: of R and P, and the same with neighbours taken together as U and S.

    >>> from assur.synthesis.virtual_chains import rows_named
    >>> from assur.topology.notation import plain_text
    >>> found = {plain_text(limb.chain) for limb in following_types(rows_named("3R")[0], 3, "base")}
    >>> "R[x]@O R[y]@O R[z]@O" in found, "R[x]@O U[y,z]@O" in found
    (True, True)
    """
    every = range(motion.dim, FREE)
    return tuple(limb for freedoms in every for limb in types_with(motion, freedoms, max_joints, actuators, idle=idle))


@lru_cache(FREE * KEPT)
def types_with(
    motion: VirtualChain, freedoms: int, max_joints: int, actuators: Actuators, *, idle: bool = False
) -> tuple[LimbType, ...]:
    """Those of `following_types` with so many freedoms."""
    ways: dict[object, LimbType] = {}
    for word in following_words(motion, freedoms, idle=idle).tolist():
        for chain in _chains(word):
            letters = [joint.type.letter for joint in chain.joints if isinstance(joint, ChainJoint)]
            for driven in driven_joints(letters, actuators) if len(letters) <= max_joints else ():
                key = limb_key(chain, motion, (driven,))
                ways.setdefault(key, LimbType(chain, (driven,), key))
    return tuple(ways.values())


def _chains(word: Sequence[int]) -> Iterator[Chain]:
    """The word with each letter a joint, and with neighbours behind the first, or all of them, taken together.

    A ball joint that stands elsewhere than in the point is one in each.
    """
    letters = [(KINDS[letter // len(AXES)], AXES[letter % len(AXES)]) for letter in word]
    ways = {tuple(_taken_together(letters, start)) for start in (len(letters), 1, 0)}
    for groups in sorted(ways, key=repr):
        yield Chain(tuple(_joint(group) for group in groups))


_Letters = tuple[tuple[str, str], ...]


def _taken_together(letters: Sequence[tuple[str, str]], start: int) -> Iterator[_Letters]:
    """Letters one by one, behind a place three axes through the point as S and two that cross as U."""
    place = 0
    while place < len(letters):
        group = tuple(letters[place : place + 3])
        kinds, axes = zip(*group, strict=True)
        if kinds == ("S",) * 3 or (place >= start and kinds == ("O",) * 3 and len({*axes}) == 3):
            size = 3
        elif place >= start and {*kinds[:2]} <= {"R", "O"} and len({*axes[:2]}) == 2:
            size = 2
        else:
            size = 1
        yield group[:size]
        place += size


def _joint(group: _Letters) -> ChainJoint:
    kinds = "".join(kind for kind, _ in group)
    axes = tuple(NAMED[axis] for _, axis in group)
    whole = POINT if set(kinds) == {"O"} else ""
    if len(group) == 3:
        return ChainJoint(SPHERICAL, (), whole)
    if len(group) == 2:
        through = tuple((POINT,) if kind == "O" else () for kind in kinds) if "O" in kinds and not whole else ()
        return ChainJoint(UNIVERSAL, axes, whole, through=through)
    return ChainJoint(PRISMATIC if kinds == "P" else REVOLUTE, axes, whole)


def following_limbs(motion: VirtualChain, types: Sequence[LimbType], limbs: int) -> list[CandidateLimb]:
    """The limbs with their twists at the poses of the motion, of other lengths for each limb of a mechanism.

    Their places are numbered: those of the first limb turned in each way, those of the second, and so on.
    """
    usable = []
    for freedoms in sorted({limb.freedoms for limb in types}):
        some = [limb for limb in types if limb.freedoms == freedoms]
        turned_ways = [_edges(motion, some, slot, turn) for slot in range(limbs) for turn in TURNS[motion.symmetry]]
        for limb, edges in zip(some, zip(*turned_ways, strict=True), strict=True):
            placed = tuple(edge for edge in edges if edge is not None)
            if len(placed) == len(edges):
                usable.append(_candidate(limb, motion, limbs, placed))
    return usable


def _edges(motion: VirtualChain, types: Sequence[LimbType], slot: int, turn: FloatArray) -> list[Edge | None]:
    """Each limb at the poses of the motion; none where it does not get there or its freedoms are not independent."""
    followed: list[Edge | None] = [None] * len(types)
    for attempt in range(TRIES):
        rest = [number for number, edge in enumerate(followed) if edge is None]
        if not rest:
            break
        chains = [types[number].chain for number in rest]
        series = series_of(chains, np.random.default_rng((slot, attempt))).turned(turn)
        reached, values = following(series, motion.series, motion.values)
        count, poses, freedoms = values.shape
        twists = (
            series.repeated(poses).at(values.reshape(count * poses, freedoms))[2].reshape(count, poses, 6, freedoms)
        )
        smallest = np.min(np.linalg.svd(twists, compute_uv=False)[..., -1], axis=1)
        for row, number in enumerate(rest):
            if reached[row] and smallest[row] > INDEPENDENT:
                driven = types[number].driven_columns
                followed[number] = Edge("limb", BASE, PLATFORM, twists[row], inputs=driven)
    return followed


def _candidate(limb: LimbType, motion: VirtualChain, limbs: int, edges: tuple[Edge, ...]) -> CandidateLimb:
    ways = tuple(parse_chain(plain_text(turned(limb.chain, turn))) for turn in TURNS[motion.symmetry])
    generator = np.random.default_rng(limb.freedoms)
    alone = series_of([ways[0]], generator).repeated(POSES)
    twists = alone.at(generator.uniform(-1.0, 1.0, (POSES, limb.freedoms)))[2]
    known = known_at_will(ways[0], at_point(twists, generator.normal(size=3)))
    return CandidateLimb(limb, ways * limbs, known, (), tuple((edge,) for edge in edges))


def classes_by_constraints(limbs: Sequence[CandidateLimb], motion: VirtualChain) -> tuple[Class, ...]:
    """Limbs with the same constraints at every pose; one whose constraints vary with its lengths is alone."""
    other = len(TURNS[motion.symmetry])
    members: dict[object, list[CandidateLimb]] = {}
    for limb in sorted(limbs, key=lambda limb: simplicity([limb])):
        here, there = (_constrained(limb, place) for place in (0, other))
        members.setdefault((limb.type.freedoms, here if here == there else limb.text), []).append(limb)
    return tuple(sorted(map(tuple, members.values()), key=lambda some: (some[0].type.freedoms, simplicity(some[:1]))))


def _constrained(limb: CandidateLimb, place: int) -> tuple[float, ...]:
    """The space of its wrenches at each pose, the same numbers for the same space."""
    basis = wrenches(limb, place)
    return tuple((np.round(basis @ np.swapaxes(basis, -1, -2), DIGITS) + 0.0).ravel().tolist())


def wrenches(limb: CandidateLimb, place: int) -> FloatArray:
    """What it resists at the poses (N, 6, 6 - f), moment and force at the origin."""
    (edge,) = limb.edges[place]
    return null_basis(np.swapaxes(edge.twists, -1, -2))


def sets_leaving(
    sets: Iterable[tuple[Class, ...]], motion: VirtualChain
) -> Iterator[tuple[tuple[Class, ...], tuple[int, ...]]]:
    """Those of the sets, one class for each limb, that leave just the motion together; the first places where they do.

    Args:
        sets: as `chosen_classes` gives them.
        motion: with its virtual chain.
    """
    resisted: dict[object, FloatArray] = {}
    for chosen in sets:
        places = places_leaving(chosen, motion, resisted)
        if places is not None:
            yield chosen, places


def places_leaving(
    chosen: Sequence[Class], motion: VirtualChain, resisted: dict[object, FloatArray] | None = None
) -> tuple[int, ...] | None:
    """The first places in which limbs leave just the motion together.

    Args:
        chosen: the class of each limb.
        motion: with its virtual chain.
        resisted: what limbs resist, by class and place, as far as it is known; it grows.
    """
    known: dict[object, FloatArray] = {} if resisted is None else resisted

    def resists(some: Class, place: int) -> FloatArray:
        if (id(some), place) not in known:
            known[id(some), place] = wrenches(some[0], place)
        return known[id(some), place]

    ways = len(TURNS[motion.symmetry])
    for turn in _turns(ways, len(chosen)):
        places = tuple(slot * ways + way for slot, way in enumerate(turn))
        together = [resists(some, place) for some, place in zip(chosen, places, strict=True)]
        if np.all(_ranks(np.concatenate(together, axis=-1)) == FREE - motion.dim):
            return places
    return None


@cache
def _turns(ways: int, limbs: int) -> tuple[tuple[int, ...], ...]:
    """The way in which each limb is turned; limbs turned in many ways come first, as their drives can do more."""
    every = product(range(ways), repeat=limbs)
    return tuple(sorted(every, key=lambda turn: (max(Counter(turn).values()), turn)))


def _ranks(spaces: FloatArray) -> NDArray[np.intp]:
    if not spaces.shape[-1]:
        return np.zeros(len(spaces), dtype=np.intp)
    ranks: NDArray[np.intp] = np.sum(np.linalg.svd(spaces, compute_uv=False) > INDEPENDENT, axis=-1)
    return ranks
