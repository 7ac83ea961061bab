"""Every order of freedoms that a limb could have, as words: letters of joints with an axis x, y or z each.

Axes are parallel or perpendicular to each other, so each lies along x, y or z of the configuration as written.
A direction that no joint before it has is as good as any other new one: the first is taken.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

Letter = tuple[str, str]
"""A joint and its axis: ("R", "x"), ("P", "y"), ("C", "x"); A is a P(4R), B a P(4S), D a P(2US); S has none."""

Word = tuple[Letter, ...]

FREEDOMS = {"R": 1, "P": 1, "A": 1, "C": 2, "S": 3, "B": 4, "D": 4}
AXES = ("x", "y", "z")
ROTATIONS = 3
"""A motion has at most three independent rotations, and one direction of R at most three that are not passive."""


@dataclass(frozen=True)
class Begun:
    """A word as far as it goes.

    `known` are the directions that have been used, `slides` the P joints ("Py", "Az") since the last turn, `blocks` the
    runs of parallel R as (axis, number).
    """

    word: Word = ()
    known: frozenset[str] = frozenset()
    slides: tuple[str, ...] = ()
    blocks: tuple[tuple[str, int], ...] = ()


NOTHING = Begun()


def words(
    freedoms: int,
    joints: int,
    *,
    always: str = "",
    ball: bool = False,
    begun: Begun = NOTHING,
) -> Iterator[Word]:
    """Words with so many freedoms and no passive or idle freedom that shows in the word itself.

    Where the platform turns, three directions of R are left out: they would turn it in every way, and only an
    operation mode would keep it to one axis.

    Args:
        freedoms: sum of f.
        joints: at most so many joints, if neighbouring R that cross are taken together as a U.
        always: the axis about which the platform turns, known everywhere; "" where it keeps its orientation.
        ball: whether the word has one S; without it, none.
        begun: what stands before the word, as an inner loop, and does not count.

    Example: three independent translations without parallelograms are PPP.

    >>> [word for word in words(3, 3) if all(letter == "P" for letter, _ in word)]
    [(('P', 'x'), ('P', 'y'), ('P', 'z'))]
    """
    start = replace(begun, known=begun.known | frozenset(always))
    for word, blocks in _grow(start, freedoms, ball):
        if (ball or _can_turn(blocks, always)) and _fewest_joints(word) <= joints:
            yield word


def _grow(state: Begun, rest: int, ball: bool) -> Iterator[tuple[Word, tuple[tuple[str, int], ...]]]:
    """Words, each with its blocks since the S, if it has one."""
    if rest == 0:
        if not ball:
            yield state.word, state.blocks
        return
    for letter in ("R", "P", "A", "C") if ball else ("R", "P", "A", "C", "B", "D"):
        if FREEDOMS[letter] > rest - (FREEDOMS["S"] if ball else 0):
            continue
        for axis in _choices(state.known):
            grown = _with(state, letter, axis)
            if grown is not None:
                yield from _grow(grown, rest - FREEDOMS[letter], ball)
    if ball and rest >= FREEDOMS["S"]:
        grown = Begun((*state.word, ("S", "")), state.known, (), ())
        yield from _grow(grown, rest - FREEDOMS["S"], False)


def _choices(known: frozenset[str]) -> list[str]:
    """Directions that differ: those known, and one that is not."""
    free = [axis for axis in AXES if axis not in known]
    return [axis for axis in AXES if axis in known or axis in free[:1]]


def _with(state: Begun, letter: str, axis: str) -> Begun | None:
    """One joint more, or None where it brings a passive freedom."""
    word = (*state.word, (letter, axis))
    if letter in "BD":
        return None if any(before in "BD" for before, _ in state.word) else _behind_rods(state, word, axis)
    slides = (*state.slides, f"A{axis}" if letter == "A" else f"P{axis}")
    if letter != "R" and not _independent(slides):
        return None
    if letter in "PA":
        return replace(state, word=word, known=state.known | {axis}, slides=slides)
    blocks = state.blocks
    again = bool(blocks) and blocks[-1][0] == axis
    blocks = (*blocks[:-1], (axis, blocks[-1][1] + 1)) if again else (*blocks, (axis, 1))
    if len(blocks) > ROTATIONS or blocks[-1][1] > ROTATIONS:
        return None
    return Begun(word, state.known | {axis}, (f"P{axis}",) if letter == "C" else (), blocks)


def _behind_rods(state: Begun, word: Word, axis: str) -> Begun:
    """A word with a parallelogram of rods, whose far link may turn about the axis without any other joint's help."""
    before = state.blocks[:-1] if state.blocks and state.blocks[-1][0] == axis else state.blocks
    return Begun(word, state.known | {axis}, (), (*before, (axis, ROTATIONS)))


@cache
def _independent(slides: tuple[str, ...]) -> bool:
    """Whether P joints with no turn between them are independent; a P(4R) moves anywhere in its plane."""
    generator = np.random.default_rng(len(slides))
    lines = [_line(kind, generator) for kind in slides]
    return int(np.linalg.matrix_rank(np.array(lines))) == len(lines)


def _line(kind: str, generator: np.random.Generator) -> FloatArray:
    axis = np.eye(3)[AXES.index(kind[1])]
    return axis if kind[0] == "P" else np.cross(axis, generator.normal(size=3))


def _can_turn(blocks: tuple[tuple[str, int], ...], always: str) -> bool:
    """Whether every block can turn, and the platform about its axis.

    A block with a single R turns only if the platform does so about its axis. A first and a third block that are
    parallel make one where the platform keeps its orientation.
    """
    counts = list(blocks)
    if len(blocks) == ROTATIONS and not always and blocks[0][0] == blocks[2][0]:
        counts = [(blocks[0][0], blocks[0][1] + blocks[2][1]), blocks[1]]
    if always and (len(blocks) == ROTATIONS or always not in dict(blocks)):
        return False
    return all(count > 1 or axis == always for axis, count in counts)


def _fewest_joints(word: Word) -> int:
    """Joints if as many as possible neighbouring R that cross are taken as U."""
    count, index = 0, 0
    while index < len(word):
        index += 2 if crossing(word, index) else 1
        count += 1
    return count


def crossing(word: Word, index: int) -> bool:
    """Whether the joint at a place and the next one are R that cross, which may be a U."""
    pair = word[index : index + 2]
    return [letter for letter, _ in pair] == ["R", "R"] and pair[0][1] != pair[1][1]
