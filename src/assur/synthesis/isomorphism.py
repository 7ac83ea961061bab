"""When two limbs are the same: a canonical form that forgets names, senses, frames and orders that make no difference.

An axis about which something turns cuts a limb into *stretches*; a stretch holds directions that stay fixed
against each other: the axis that leads into it, its P joints, the axis that leads out of it. Stretches that
are not turned against each other while the platform has the required motion share a frame. So two limbs are the same if
the same kinds of joints stand in the same order, and the directions in each frame have the same relations.

Between two axes the order of P joints makes no difference, but it does which of them is driven. A limb and its
reverse are different, because the actuator stands near the base.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, permutations, product
from typing import Any

from assur.errors import UsageError
from assur.synthesis.required import RequiredMotion
from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.directions import EXACT, Vector, parallel

Key = tuple[Any, ...]
"""Canonical form: nested tuples of texts and numbers, to be compared for equality."""

BASE, TURNED = "base", "turned"
"""Frames: that of the base, and that of a platform which turns."""


_Path = tuple[tuple[Element, str], ...]
"""Joints in series, each with the mark of its actuator."""


@dataclass(frozen=True)
class _Direction:
    """A direction of a stretch, and what has it: "P", "P*" (driven), "P(4R)", or "" for the axis of a turn."""

    kind: str
    axis: Vector


@dataclass(frozen=True)
class _Turn:
    """An axis about which something turns, of which joint, and the labelled points on it; no axis for a ball joint."""

    kind: str
    points: tuple[int, ...]
    axis: Vector | None


def limb_key(chain: Chain, motion: RequiredMotion, driven: Collection[int] = ()) -> Key:
    """Canonical form of a limb whose platform has a wanted motion.

    Args:
        chain: a series, or an inner loop and then a series; the order of the loop's branches makes no difference.
        motion: the platform's; directions that it singles out are the same in all limbs.
        driven: indices of the joints with actuators, branches flattened; none if they do not matter.

    Errors:
        UsageError: the limb has another inner loop.

    Example: the order of neighbouring P joints makes no difference, nor do the names of the axes.

    >>> from assur.synthesis.required import MOTIONS
    >>> from assur.topology.notation import parse_chain
    >>> first, second = parse_chain("P[x] P[z] R[z] R[z]"), parse_chain("P[x] P[y] R[x] R[x]")
    >>> space = MOTIONS["3T"]
    >>> limb_key(first, space) == limb_key(second, space), limb_key(first, space, (0,)) == limb_key(second, space, (0,))
    (True, False)
    """
    branches, rest = _marked(chain, driven)
    return min((_key_of(order, rest, motion) for order in permutations(branches)), key=repr)


def _marked(chain: Chain, driven: Collection[int]) -> tuple[list[_Path], _Path]:
    """The branches of an inner loop that stands first, of a series one without joints; and the rest; with marks."""
    first = chain.elements[0]
    loop = first.branches if isinstance(first, InnerLoop) else ((),)
    branches, start = [], 0
    for branch in (*loop, chain.elements[1:] if isinstance(first, InnerLoop) else chain.elements):
        marks = ["*" if start + place in driven else "" for place in range(len(branch))]
        branches.append(tuple(zip(branch, marks, strict=True)))
        start += len(branch)
    return branches[:-1], branches[-1]


def _key_of(branches: Sequence[_Path], rest: _Path, motion: RequiredMotion) -> Key:
    """The form with the branches in this order: the way through the first, then each other up to the output link."""
    kinds: list[Key] = []
    directions: list[list[_Direction]] = []
    frames: list[str] = []
    output = ""
    for number, branch in enumerate(branches):
        turns, stretches = _cut((*branch, *rest))
        own = [_frame_of_path(frame, number) for frame in _frames(turns, motion)]
        for stretch, directions_of_motion in zip((stretches[0], stretches[-1]), motion.marks, strict=True):
            stretch += [_Direction("", axis) for axis in directions_of_motion]
        if len(branches) > 1:
            ends, inside = _cut(branch)
            last = own[len(inside) - 1]
            if number:
                own = [output if frame == last else frame for frame in own[: len(inside)]]
                turns, stretches = ends, [[*stretches[0]] if not place else part for place, part in enumerate(inside)]
            else:
                output = last
            kinds.append((len(ends), len(inside)))
        kinds.append(tuple((turn.kind, turn.points) for turn in turns))
        directions += stretches
        frames += own
    return (tuple(kinds), min(_described(ordered, frames) for ordered in _orders(directions)))


def _frame_of_path(frame: str, number: int) -> str:
    """Frames of the way through another branch are others, but for those of base and platform."""
    return frame if frame in (BASE, TURNED) or not number else f"{frame}, branch {number}"


def mechanism_key(limbs: Iterable[Key]) -> Key:
    """Canonical form of several limbs side by side: their order makes no difference."""
    return tuple(sorted(limbs, key=repr))


def _cut(path: _Path) -> tuple[list[_Turn], list[list[_Direction]]]:
    """The turns, and the stretches before, between and behind them."""
    turns: list[_Turn] = []
    stretches: list[list[_Direction]] = [[]]
    labels: dict[str, int] = {}
    for element, mark in path:
        if isinstance(element, Parallelogram):
            kind = f"P({element.kind})"
            axes: tuple[Vector, ...] = (element.axis,)
        elif isinstance(element, ChainJoint):
            kind, axes = element.type.letter, element.axes
        else:
            raise UsageError("a limb with an inner loop that does not stand first has no canonical form")
        if kind in ("P", "P(4R)"):
            stretches[-1].append(_Direction(kind + mark, axes[0]))
            continue
        for place, axis in enumerate(axes):
            points = element.points_on(place) if isinstance(element, ChainJoint) else ()
            numbers = tuple(labels.setdefault(label, len(labels)) for label in points)
            turns.append(_Turn(kind + mark, numbers, axis))
            stretches[-1].append(_Direction("", axis))
            stretches.append([_Direction("", axis)])
        if not axes:
            point = element.point if isinstance(element, ChainJoint) else ""
            turns.append(_Turn(kind + mark, (labels.setdefault(point, len(labels)),) if point else (), None))
            stretches.append([])
    return turns, stretches


def _frames(turns: Sequence[_Turn], motion: RequiredMotion) -> list[str]:
    """The frame of each stretch.

    Neighbouring parallel axes are a block. While the platform has its motion, a block turns what is behind it by
    nothing in all, unless its axis is that of the motion; of three blocks, the first and the last undo each other
    where they are parallel. Behind a ball joint, or more blocks, only the platform is known again.
    """
    blocks = _blocks(turns)
    last = TURNED if motion.rotations else BASE
    axes = [turns[block[0]].axis for block in blocks]
    wrapped = len(blocks) == 3 and not motion.rotations and _along(axes[0], axes[2])
    simple = all(axes) and (len(blocks) <= 2 or wrapped) and len(motion.rotations) < 2
    frames, frame = [BASE], BASE
    for number, block in enumerate(blocks):
        frames += [f"inside {place}" for place in block[:-1]]
        if not simple:
            frame = f"behind {block[-1]}"
        elif wrapped:
            frame = "wrapped" if number < 2 else BASE
        elif motion.rotations and _along(axes[number], motion.rotations[0]):
            frame = TURNED
        frames.append(frame)
    return [*frames[:-1], last if turns else BASE]


def _blocks(turns: Sequence[_Turn]) -> list[list[int]]:
    blocks: list[list[int]] = []
    for place, turn in enumerate(turns):
        if blocks and _along(turns[place - 1].axis, turn.axis):
            blocks[-1].append(place)
        else:
            blocks.append([place])
    return blocks


def _along(first: Vector | None, second: Vector | None) -> bool:
    return first is not None and second is not None and parallel(first, second)


def _orders(stretches: Sequence[Sequence[_Direction]]) -> Iterator[list[list[_Direction]]]:
    """The stretches with their P joints in every order; axes of turns keep their places."""
    choices = [permutations([element for element in stretch if element.kind]) for stretch in stretches]
    for chosen in product(*choices):
        orders = [iter(order) for order in chosen]
        yield [
            [next(order) if element.kind else element for element in stretch]
            for stretch, order in zip(stretches, orders, strict=True)
        ]


def _described(stretches: Sequence[Sequence[_Direction]], frames: Sequence[str]) -> Key:
    """Kinds in each stretch, then relations in each frame, in the order in which frames first occur."""
    kinds = tuple(tuple(element.kind for element in stretch) for stretch in stretches)
    numbers = tuple(list(dict.fromkeys(frames)).index(frame) for frame in frames)
    shared = [
        [element.axis for stretch, of in zip(stretches, frames, strict=True) if of == frame for element in stretch]
        for frame in dict.fromkeys(frames)
    ]
    return (kinds, numbers, tuple(_relations(axes) for axes in shared))


def _relations(axes: Sequence[Vector]) -> Key:
    """Relations of all pairs, and which triples with an oblique pair lie in one plane."""
    pairs = {(i, j): _relation(axes[i], axes[j]) for i, j in combinations(range(len(axes)), 2)}
    oblique = {pair for pair, relation in pairs.items() if relation == "oblique"}
    flat = tuple(
        triple
        for triple in combinations(range(len(axes)), 3)
        if oblique & set(combinations(triple, 2)) and _in_one_plane(*(axes[index] for index in triple))
    )
    return (tuple(pairs.values()), flat)


def _relation(first: Vector, second: Vector) -> str:
    cosine = abs(sum(a * b for a, b in zip(first, second, strict=True)))
    if cosine < EXACT:
        return "perpendicular"
    return "parallel" if parallel(first, second) else "oblique"


def _in_one_plane(first: Vector, second: Vector, third: Vector) -> bool:
    (a, b, c), (d, e, f), (g, h, i) = first, second, third
    return abs(a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)) < EXACT
