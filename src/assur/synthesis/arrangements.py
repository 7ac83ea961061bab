"""How limbs stand to each other such that their constraints at home leave a motion: positions, and lines they share."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial
from itertools import chain as joined
from itertools import combinations_with_replacement, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from assur.numerics.rotations import about_axis
from assur.synthesis.classes import AMONG, Class, simplicity
from assur.synthesis.home_constraints import ZERO, HomeConstraints, constraints_of, home_twists, together
from assur.synthesis.limb_motions import CandidateLimb
from assur.synthesis.limbs import FREE
from assur.synthesis.positions import DIGITS, SWAP
from assur.synthesis.required import RequiredMotion
from assur.synthesis.shared_axes import LABELS, End, Lines, axes_at, on_common_lines, with_common_lines
from assur.topology.chains import Chain
from assur.topology.directions import Vector, parallel

FloatArray = NDArray[np.float64]

_THIRDS = (about_axis(np.array([0.0, 0.0, 1.0]), np.radians(np.array(angle))) for angle in (120.0, 240.0))

TURNS = (np.eye(3), SWAP, *(np.round(turn, DIGITS) for turn in _THIRDS))
"""Positions of a limb: as written, with x and y exchanged, turned about z by a third and by two thirds of a turn."""

EVENLY = (0, 2, 3)
"""Positions of three limbs evenly about z."""


class PlacedClass(NamedTuple):
    """How a limb of a class stands: in which position, and turning about which line, if any.

    Attributes:
        limbs: the class, or those of it that can turn about the line.
        place: index of the position in `TURNS`.
        end: link in which the line stands.
        kinds: the same limbs, those together that a line holds alike.
    """

    limbs: Class
    place: int
    end: End = ""
    kinds: tuple[Class, ...] = ()


@dataclass(frozen=True, eq=False)
class ArrangedClasses:
    """Limbs by the class of each, in an arrangement in which their constraints leave the motion at home.

    Attributes:
        chosen: the class of each limb, or those of it that can turn about its line.
        places: the position of each.
        lines: about which some of them turn, of the base or the platform.
    """

    chosen: tuple[Class, ...]
    places: tuple[int, ...]
    lines: Lines

    def chains(self, limbs: Sequence[CandidateLimb]) -> tuple[Chain, ...]:
        """How limbs, one of each class, stand in it."""
        return with_common_lines(self._placed(limbs), self.lines)

    def unnamed(self, limbs: Sequence[CandidateLimb]) -> list[Chain]:
        """The same, joints not named through the mechanism."""
        return on_common_lines(self._placed(limbs), self.lines)

    def _placed(self, limbs: Sequence[CandidateLimb]) -> list[Chain]:
        return [limb.chains[place] for limb, place in zip(limbs, self.places, strict=True)]

    @property
    def members(self) -> int:
        """Mechanisms that it stands for; limbs of one class that stand alike change places."""
        return math.prod(math.comb(len(limbs) + count - 1, count) for limbs, count in self._slots())

    @property
    def equal(self) -> list[tuple[CandidateLimb, ...]]:
        """Its mechanisms of equal limbs, the simplest first."""
        first, *others = self.chosen
        return [(limb,) * len(self.chosen) for limb in first if all(limb in other for other in others)]

    def simplest(self) -> list[tuple[CandidateLimb, ...]]:
        """One limb of each class, the simplest first, among the simplest of each class."""
        few = int(AMONG ** (1 / len(self.chosen)))
        choices = [combinations_with_replacement(limbs[:few], count) for limbs, count in self._slots()]
        return sorted((tuple(joined.from_iterable(parts)) for parts in product(*choices)), key=simplicity)

    def _slots(self) -> list[tuple[Class, int]]:
        """Limbs of one class that stand alike side by side, and how many; those evenly about z do."""
        places = (0,) * len(self.places) if self.places == EVENLY else self.places
        on = {number: end for end, numbers in self.lines.items() for number in numbers}
        counts = Counter(
            (id(limbs), place, on.get(number, ""))
            for number, (limbs, place) in enumerate(zip(self.chosen, places, strict=True))
        )
        by_id = {id(limbs): limbs for limbs in self.chosen}
        return [(by_id[number], count) for (number, _, _), count in counts.items()]


def arranged_classes(sets: Iterable[tuple[Class, ...]], motion: RequiredMotion) -> Iterator[ArrangedClasses]:
    """Those of the sets, one class for each limb, that leave just the motion at home, in each such arrangement.

    Limbs share no more lines than that takes: on a line stand limbs of a class whose axes next to its link are
    parallel, and the least sets of them with which the motion is left.
    """

    @cache
    def wrenches(limb: CandidateLimb, slot: int, place: int, end: End) -> FloatArray:
        return constraints_of(home_twists(limb.type.chain, TURNS[place], slot, end)).wrenches

    def constraints(stands: Sequence[PlacedClass]) -> HomeConstraints:
        return together([wrenches(stand.limbs[0], slot, stand.place, stand.end) for slot, stand in enumerate(stands)])

    turning = cache(_turning)
    for chosen in sets:
        for places in _placements(chosen):
            alone = [PlacedClass(limbs, place, "", (limbs,)) for limbs, place in zip(chosen, places, strict=True)]
            apart = constraints(alone)
            if apart.leave(motion):
                yield ArrangedClasses(chosen, places, {})
            elif apart.resist_turns_of(motion):
                least: list[Counter[PlacedClass]] = []
                for stands in _sharing(alone, turning):
                    kinds = [(some, _turn_about_lines(some)) for some in _choices(stands, _of_each_kind)]
                    left = [
                        (some, lines)
                        for some, lines in kinds
                        if not any(few <= lines for few in least) and constraints(some).leave(motion)
                    ]
                    least += [lines for _, lines in left]
                    yield from map(_arranged, [stands] if len(left) == len(kinds) else [some for some, _ in left])


Turning = Callable[[Class, int], tuple[tuple[Vector, PlacedClass], ...]]
"""The axes next to a link about which limbs of a class turn in a position, and those limbs."""


def _turning(limbs: Class, place: int) -> tuple[tuple[Vector, PlacedClass], ...]:
    forces = constraints_of(home_twists(limbs[0].type.chain, TURNS[0], place)).forces.T
    around: dict[tuple[End, Vector], dict[CandidateLimb, frozenset[Vector]]] = {}
    for limb, end in product(limbs, LABELS):
        axes = [(abs(x), abs(y), abs(z)) for x, y, z in axes_at(limb.chains[0], end)]  # along x, y and z
        if any(np.any(abs(np.cross(forces, axis)) > ZERO) for axis in axes):  # else forces run anywhere beside it
            around.setdefault((end, axes[0]), {})[limb] = frozenset(axes)
    return tuple((_axis(able, place, end), _stand(able, place, end)) for (end, _), able in around.items())


def _axis(able: Iterable[CandidateLimb], place: int, end: End) -> Vector:
    return axes_at(next(iter(able)).chains[place], end)[0]


def _stand(able: Mapping[CandidateLimb, frozenset[Vector]], place: int, end: End) -> PlacedClass:
    kinds = (tuple(limb for limb in able if able[limb] == axes) for axes in dict.fromkeys(able.values()))
    return PlacedClass(tuple(able), place, end, tuple(kinds))


def _sharing(alone: Sequence[PlacedClass], turning: Turning) -> list[tuple[PlacedClass, ...]]:
    """The ways in which limbs turn about one line of the base, one of the platform or both, those of few limbs first.

    Two or more are on a line, none is on both.
    """
    around: dict[End, list[Vector]] = {end: [] for end in LABELS}
    for stand in alone:
        for axis, on in turning(stand.limbs, stand.place):
            if not any(parallel(axis, other) for other in around[on.end]):
                around[on.end].append(axis)

    def on_or_off(stand: PlacedClass, lines: Mapping[End, Vector | None]) -> list[PlacedClass]:
        return [*(on for axis, on in turning(stand.limbs, stand.place) if parallel(axis, lines[on.end])), stand]

    ways = []
    for pair in product(*([None, *axes] for axes in around.values())):
        lines = dict(zip(around, pair, strict=True))
        for stands in _choices(alone, partial(on_or_off, lines=lines)):
            counts = Counter(stand.end for stand in stands)
            if all(counts[end] > 1 for end, line in lines.items() if line):
                ways.append(stands)
    return sorted(ways, key=lambda stands: sum(bool(stand.end) for stand in stands))


def _choices(
    stands: Sequence[PlacedClass], options: Callable[[PlacedClass], Sequence[PlacedClass]]
) -> Iterator[tuple[PlacedClass, ...]]:
    """One of the options of each; limbs of one class that stand alike change places."""
    slots: dict[PlacedClass, list[int]] = {}
    for slot, stand in enumerate(stands):
        slots.setdefault(stand, []).append(slot)
    for parts in product(*(combinations_with_replacement(options(stand), len(some)) for stand, some in slots.items())):
        chosen = dict(zip(joined.from_iterable(slots.values()), joined.from_iterable(parts), strict=True))
        yield tuple(chosen[slot] for slot in range(len(stands)))


def _of_each_kind(stand: PlacedClass) -> list[PlacedClass]:
    return [PlacedClass(limbs, stand.place, stand.end) for limbs in stand.kinds]


def _turn_about_lines(stands: Sequence[PlacedClass]) -> Counter[PlacedClass]:
    return Counter(stand for stand in stands if stand.end)


def _arranged(stands: Sequence[PlacedClass]) -> ArrangedClasses:
    ends = [stand.end for stand in stands]
    lines: Lines = {end: tuple(slot for slot, on in enumerate(ends) if on == end) for end in ends if end}
    return ArrangedClasses(tuple(stand.limbs for stand in stands), tuple(stand.place for stand in stands), lines)


def _placements(chosen: Sequence[Class]) -> list[tuple[int, ...]]:
    """Positions of limbs, each set once: at right angles, evenly about z; free ones as written."""
    free = [limbs[0].type.freedoms == FREE for limbs in chosen]

    def stood(places: Sequence[int]) -> list[tuple[int, int]]:
        return sorted((id(limbs), place) for limbs, place in zip(chosen, places, strict=True))

    kept: dict[str, tuple[int, ...]] = {}
    for places in product((0, 1), repeat=len(chosen)):
        across = [0 if none else 1 - place for none, place in zip(free, places, strict=True)]  # x and y exchanged
        if not any(none and place for none, place in zip(free, places, strict=True)):
            kept.setdefault(repr(min(stood(places), stood(across))), places)
    several = len(chosen) == len(EVENLY) and sum(free) < len(chosen) - 1
    return [*kept.values(), EVENLY] if several else list(kept.values())
