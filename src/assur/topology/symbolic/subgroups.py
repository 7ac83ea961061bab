"""A limb as a product of subgroups, and which limbs hold back nothing that another one does not.

Displacements from home are a product, e^(θ1 ξ1) e^(θ2 ξ2) ..., of screws as they stand at home. So a limb is a word of
subgroups: rotations about a line or about a point, translations, the planar group G(u) and Schoenflies' X(u), of which
the last three have no place. A limb whose word is within that of another one lets its end link do nothing that the
other one does not allow too, M ∩ M' = M, wherever the joints of the other one are.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from assur.topology.directions import Vector, parallel, span
from assur.topology.symbolic.blocks import structure
from assur.topology.symbolic.elementary import Elementary, Turn
from assur.topology.symbolic.motion import Limb, motion_at_home, motion_of
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spaces import translations
from assur.topology.symbolic.spans import ALL, NOTHING, Span


@dataclass(frozen=True)
class Subgroup:
    """A subgroup of displacements at its place at home.

    Attributes:
        axis: of its rotations; None where it has none, or all of them about a point.
        slides: its translations.
        points: labels of points on its axis, or of its centre; empty where they are unknown, or it has no place.
        ball: whether it rotates about every axis through its point.
    """

    axis: Vector | None
    slides: Span
    points: frozenset[str] = frozenset()
    ball: bool = False

    @property
    def has_place(self) -> bool:
        """Whether it matters where its axis is: translations across the axis move that anywhere."""
        return self.ball or (self.axis is not None and not self.slides.contains_plane(self.axis))

    def contains(self, other: Subgroup) -> bool:
        """Whether every displacement of another one is one of its own.

        >>> z, x = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
        >>> line, plane = Subgroup(z, NOTHING, frozenset("A")), Subgroup(z, Span((x, (0.0, 1.0, 0.0))))
        >>> plane.contains(line), line.contains(plane), line.contains(Subgroup(z, NOTHING, frozenset("B")))
        (True, False, False)
        """
        if not all(self.slides.contains(direction) for direction in other.slides.fixed):
            return False
        if other.axis is None and not other.ball:
            return True
        same_place = not self.has_place or not self.points.isdisjoint(other.points)
        if self.ball:
            return same_place
        return not other.ball and parallel(self.axis, other.axis) and same_place


def word(chain: Sequence[Elementary]) -> tuple[Subgroup, ...] | None:
    """The subgroups whose product a chain is; None where it has turns or slides that are none.

    >>> z, x = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
    >>> letters = word([Turn(x, "R1", "A"), Turn(z, "R2"), Turn(z, "R3"), Turn(z, "R4")])
    >>> [(letter.axis, letter.slides.dim) for letter in letters]
    [((1.0, 0.0, 0.0), 0), ((0.0, 0.0, 1.0), 2)]
    """
    runs = _runs(chain)
    return None if runs is None else tuple(letter for letter, _ in runs)


def _runs(chain: Sequence[Elementary]) -> list[tuple[Subgroup, tuple[Elementary, ...]]] | None:
    """The subgroups of a chain with what each of them is made of."""
    found: list[tuple[Subgroup, tuple[Elementary, ...]]] = []
    left = tuple(chain)
    while left:
        tried = ((count, _one(left[:count])) for count in range(len(left), 0, -1))
        count, letter = next(((count, letter) for count, letter in tried if letter is not None), (0, None))
        if letter is None:
            return None
        found.append((letter, left[:count]))
        left = left[count:]
    return found


def within(word_of_one: Sequence[Subgroup], other: Sequence[Subgroup]) -> bool:
    """Whether the product of some subgroups lies in that of others: each in one of them, in their order."""
    place = 0
    for letter in word_of_one:
        while place < len(other) and not other[place].contains(letter):
            place += 1
        if place == len(other):
            return False
    return True


def that_hold_back(limbs: Sequence[Limb]) -> tuple[Limb, ...]:
    """Limbs that share points, without those whose word contains that of another limb; of equal ones the first stays.

    A limb that is special at home could not follow the others from there, and stays.
    """
    if not any(first.labels & second.labels for first, second in combinations(limbs, 2)):
        return tuple(limbs)
    words = [word(limb.chain) if _regular(limb) else None for limb in limbs]
    kept = list(range(len(limbs)))
    for index, letters in reversed(list(enumerate(words))):
        others = [words[other] for other in kept if other != index]
        if letters is not None and any(within(other, letters) for other in others if other is not None):
            kept.remove(index)
    return tuple(limbs[index] for index in kept)


def parts_that_all_allow(limbs: Sequence[Limb]) -> Iterator[Limb]:
    """Limbs with some of their subgroups at rest, which all other limbs allow: motions that start at home."""
    if not any(first.labels & second.labels for first, second in combinations(limbs, 2)):
        return
    words = [word(limb.chain) for limb in limbs]
    for index, limb in enumerate(limbs):
        runs = _runs(limb.chain) or []
        others = [other and _beside_balls(other) for other in words[:index] + words[index + 1 :]]
        for count in range(1, len(runs)):
            for moving in combinations(runs, count):
                letters = [letter for letter, _ in moving]
                if all(other is not None and within(letters, other) for other in others):
                    chain = tuple(part for _, parts in moving for part in parts)
                    yield replace(limb, chain=chain, structure=structure(chain), freedoms=len(chain))


def _beside_balls(letters: Sequence[Subgroup]) -> tuple[Subgroup, ...]:
    """The same product, slides in a plane beside a ball as the planar group: the ball rotates about its normal too."""
    beside = [letters[max(place - 1, 0) : place + 2] for place in range(len(letters))]
    return tuple(
        replace(letter, axis=letter.slides.normal)
        if letter.axis is None and len(letter.slides.fixed) == 2 and any(other.ball for other in others)
        else letter
        for letter, others in zip(letters, beside, strict=True)
    )


def axes_through(label: str, chain: Sequence[Elementary]) -> list[Vector | None]:
    """Axes through a point, without those of groups that have no place; None for every axis of a ball joint.

    >>> z = (0.0, 0.0, 1.0)
    >>> turns = [Turn(z, "R1", "A"), Turn(z, "R2"), Turn(z, "R3")]
    >>> axes_through("A", turns[:2]), axes_through("A", turns)
    ([(0.0, 0.0, 1.0)], [])
    """
    letters = word(chain)
    if letters is None:
        return [turn.direction for turn in chain if isinstance(turn, Turn) and label in turn.labels]
    return [letter.axis for letter in letters if letter.has_place and label in letter.points]


def share_a_sphere(limbs: Sequence[Limb], centre: str) -> bool:
    """Whether limbs let a link turn about a point as a sphere does, and in no other way.

    Each can do so that has rotations about three axes through the point, not in one plane: about lines through it, or
    in a group without a place. All that it resists at home are then forces through the point, across its slides. Where
    its limbs' slides have no direction in common, the link has three freedoms at home, and as many it keeps.
    """
    words = [word(limb.chain) for limb in limbs]
    if any(letters is None or not _turns_about(letters, centre) for letters in words):
        return False
    free = ALL
    for letters in words:
        slides = NOTHING
        for letter in letters or ():
            slides = slides.with_span(letter.slides)
        free = free.meet(slides)
    return not free.dim


def _turns_about(letters: Sequence[Subgroup], centre: str) -> bool:
    """Whether three independent rotations about a point are among subgroups that move it by their slides alone."""
    if any(letter.has_place and centre not in letter.points for letter in letters):
        return False
    axes = [letter.axis for letter in letters if letter.axis is not None]
    return any(letter.ball for letter in letters) or len(span(axes)) == 3


def _regular(limb: Limb) -> bool:
    """Whether a limb has as many motions at home as displaced."""
    home, moved = motion_at_home(limb), motion_of(limb)
    return not isinstance(home, Refusal) and not isinstance(moved, Refusal) and home.dim == moved.dim


def _one(run: Sequence[Elementary]) -> Subgroup | None:
    """The one subgroup that slides and turns generate; None where they do not fill one."""
    turns = [part for part in run if isinstance(part, Turn)]
    if any(turn.pitch or not turn.finite for turn in turns):
        return None
    if any(turn.direction is None for turn in turns):
        ball = len(run) == 3 and all(turn.direction is None and turn.point == turns[0].point for turn in turns)
        return Subgroup(None, NOTHING, turns[0].shared, ball=True) if ball and len(turns) == 3 else None
    axis = turns[0].direction if turns else None
    moved = translations(structure(run))
    if not moved.is_fixed or not all(parallel(turn.direction, axis) for turn in turns):
        return None
    if axis is None:
        return Subgroup(None, moved)
    if moved.dim == 0 or moved.contains_plane(axis) or (moved.dim == 1 and moved.contains(axis)):
        return Subgroup(axis, moved, frozenset[str]().union(*(turn.shared for turn in turns)))
    return None
