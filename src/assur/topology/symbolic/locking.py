"""Chains with some joints locked: what is left, in a general configuration.

A locked joint is a rigid piece of its chain, but it keeps the angle that it has in some general configuration, not the
one as written. So the chain is displaced first, its end link held in its orientation: parallel axes turn, each by
an angle of its own, and what stands between the first and the last of them is turned with them. Then joints are locked.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.joints.steps import Step
from assur.topology.chains import ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.directions import AXES, Vector, parallel, rotated, span
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.union import inner_loop

ANYWHERE = 0.7
"""Angle (rad) by which the first axis is turned: no part of a right angle, or of an angle between common axes."""

FURTHER = 0.31
"""Each axis after it is turned by so much more (rad), so that no two links turn alike."""

ELSEWHERE = 0.23
"""The first axis of each limb after the first is turned by so much more (rad): symmetry at home is no law."""

SEVERAL_WAYS = "a limb can keep the orientation of its end in several ways, so its axes have no general place"


def locked(elements: Sequence[Element], names: Collection[str], limb: int = 0) -> tuple[Element, ...] | Refusal:
    """The elements that still move, from base to end link, where some joints are locked.

    Args:
        elements: of a chain whose end link keeps its orientation.
        names: of joints, "P1", or of one of several freedoms, "C1.1" (of a C the translation, of a U the first axis).
        limb: its number in the mechanism, so that equal limbs are not displaced alike.

    Returns:
        What is left, at a general configuration; nothing of an inner loop that a branch without joints holds. Or why
        that is not known.

    >>> from assur.topology.notation import parse_chain
    >>> chain = parse_chain("R[z] P[x] R[z] C[x]")
    >>> [item.name for item in locked(chain.elements, {"R1", "C1.1"})]
    ['P1', 'R2', 'C1']
    """
    displaced = _displaced(_apart(elements, names), names, ANYWHERE + ELSEWHERE * limb)
    return displaced if isinstance(displaced, Refusal) else _left(displaced, names)


def _apart(elements: Sequence[Element], names: Collection[str]) -> tuple[Element, ...]:
    """The elements with joints taken apart that are locked in part and would not keep their directions as they turn."""
    kept: list[Element] = []
    for element in elements:
        if isinstance(element, InnerLoop):
            kept.append(InnerLoop(tuple(_apart(branch, names) for branch in element.branches), element.name))
        elif isinstance(element, ChainJoint) and _makes_directions(element) and element.name not in names:
            kept += _parts(element) if _is_touched(element, names) else [element]
        else:
            kept.append(element)
    return tuple(kept)


def _makes_directions(joint: ChainJoint) -> bool:
    """Whether some of its directions are made of its axes, by a rule that says other ones once these have turned."""
    return len(joint.directions) > len(joint.axes)


def _parts(joint: ChainJoint) -> list[ChainJoint]:
    """Its steps, each as a joint."""
    steps = enumerate(joint.type.steps, 1)
    return [dataclasses.replace(_single(joint, step), name=f"{joint.name}.{number}") for number, step in steps]


def _left(elements: Sequence[Element], names: Collection[str]) -> tuple[Element, ...]:
    """The elements that are not locked; axes that met in a point do not where a locked joint moved one of them off."""
    left: list[Element] = []
    seen: set[str] = set()
    apart: set[str] = set()
    for element in elements:
        point = element.point if isinstance(element, ChainJoint) else ""
        if point in apart and isinstance(element, ChainJoint):
            element = dataclasses.replace(element, point=f"{point}'")
        left += _left_of(element, names)
        seen.add(point)
        if _is_touched(element, names):
            apart |= seen - {point}
    return tuple(left)


def _is_touched(element: Element, names: Collection[str]) -> bool:
    """Whether a joint, or some joint of a loop, is locked."""
    if isinstance(element, InnerLoop):
        return any(_is_touched(inner, names) for branch in element.branches for inner in branch)
    parts = (f"{element.name}.{number}" for number in range(1, element.freedoms + 1))
    return any(name in names for name in (element.name, *parts))


def _left_of(element: Element, names: Collection[str]) -> list[Element]:
    """One element, or the part of it that is not locked."""
    if isinstance(element, InnerLoop):
        branches = tuple(_left(branch, names) for branch in element.branches)
        return [InnerLoop(branches, element.name)] if all(branches) else []
    if element.name in names:
        return []
    if isinstance(element, Parallelogram) or element.type.ball:
        return [element]
    steps = element.type.steps
    free = [step for number, step in enumerate(steps, 1) if f"{element.name}.{number}" not in names]
    return [element] if len(free) == len(steps) else [_single(element, step) for step in free]


def _single(joint: ChainJoint, step: Step) -> ChainJoint:
    """One step of a joint as a joint."""
    axes = (joint.directions[step.direction],)
    if step.kind == "slide":
        return dataclasses.replace(joint, type=PRISMATIC, axes=axes, point="", through=())
    through = joint.through[step.direction : step.direction + 1]
    return dataclasses.replace(joint, type=REVOLUTE, axes=axes, through=through)


# ---- a general configuration ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Turn:
    """A rotation of a chain: about an axis as written, or about every axis (None, a ball joint)."""

    axis: Vector | None


@dataclass
class _Block:
    """Parallel axes, around what stands between them: the places of its turns in the chain."""

    axis: Vector
    places: list[int]


def _displaced(elements: Sequence[Element], names: Collection[str], first: float) -> tuple[Element, ...] | Refusal:
    """The chain where its axes are turned by general angles, the first as given, and its end link is not turned."""
    turns = _turns_of(elements)
    if isinstance(turns, Refusal):
        return turns
    word = [turn.axis for some in turns for turn in some]
    angles = _angles(word, first)
    if isinstance(angles, Refusal):
        return angles
    displaced: list[Element] = []
    active: list[tuple[Vector, float]] = []
    backwards = _after_ball(word, angles)
    place = 0
    for element, some in zip(elements, turns, strict=True):
        ball = any(turn.axis is None for turn in some)
        if ball:
            active = backwards
            place += len(some)
            displaced.append(element)
            continue
        inner = [(axis, angles[place + index]) for index, axis in enumerate(word[place : place + len(some)]) if axis]
        moved = _turned(element, active, [angle for _, angle in inner], names, first)
        if isinstance(moved, Refusal):
            return moved
        displaced.append(moved)
        for axis, angle in inner:
            active = _followed(active, axis, angle)
        place += len(some)
    return tuple(displaced)


def _turns_of(elements: Sequence[Element]) -> list[list[_Turn]] | Refusal:
    """The rotations of each element, in order."""
    turns: list[list[_Turn]] = []
    for element in elements:
        if isinstance(element, InnerLoop):
            motion = inner_loop(element)
            if not isinstance(motion, Motion):
                return motion
            if motion.rotations.dim > 1 or not motion.rotations.is_fixed:
                return Refusal("an inner loop has several rotations, or one whose axis turns")
            turns.append([_Turn(axis) for axis in motion.rotations.fixed])
        elif isinstance(element, Parallelogram):
            turns.append([] if element.kind == "4R" else [_Turn(element.axis)])
        elif not element.type.turning:
            turns.append([])
        else:
            turns.append([_Turn(axis) for axis in element.axes] or [_Turn(None)])
    return turns


def _angles(word: Sequence[Vector | None], first: float) -> list[float] | Refusal:
    """General angles of the turns of a chain that leave its end link unturned, those of ball joints left out as 0.

    Parallel axes with nothing but whole blocks between them make a block, whose angles add up to zero. What is so found
    must be all: as many freedoms as the axes as written have at first order.
    """
    angles = [first + FURTHER * index for index in range(len(word))]
    if None in word:
        return [0.0 if axis is None else angle for axis, angle in zip(word, angles, strict=True)]
    axes = [axis for axis in word if axis is not None]
    blocks = _blocks(axes)
    free = sum(len(block.places) - 1 for block in blocks)
    if free != len(axes) - (len(span(axes)) if axes else 0):
        return Refusal(SEVERAL_WAYS)
    for block in blocks:
        *before, last = block.places
        sense = [1.0 if _along(axes[index], block.axis) else -1.0 for index in block.places]
        total = sum(way * angles[index] for way, index in zip(sense, before, strict=False))
        angles[last] = -sense[-1] * total
    return angles


def _blocks(axes: Sequence[Vector]) -> list[_Block]:
    """The axes as blocks, one inside another; an axis without a parallel one that it could turn with is its own."""
    done: list[_Block] = []
    opened: list[_Block] = []
    for index, axis in enumerate(axes):
        depth = next((k for k in reversed(range(len(opened))) if parallel(opened[k].axis, axis)), None)
        if depth is None:
            opened.append(_Block(axis, [index]))
        else:
            done += opened[depth + 1 :]
            del opened[depth + 1 :]
            opened[depth].places.append(index)
    return [*done, *opened]


def _along(first: Vector, second: Vector) -> bool:
    """Whether two parallel axes point the same way."""
    return sum(a * b for a, b in zip(first, second, strict=True)) > 0


def _followed(active: Sequence[tuple[Vector, float]], axis: Vector, angle: float) -> list[tuple[Vector, float]]:
    """Rotations in order from the base once one more follows; parallel neighbours are one, and vanish at zero."""
    if not active or not parallel(active[-1][0], axis):
        return [*active, (axis, angle)] if angle else list(active)
    last, sum_of = active[-1]
    total = sum_of + (angle if _along(last, axis) else -angle)
    return [*active[:-1], (last, total)] if abs(total) > 1e-12 else list(active[:-1])  # rounding of a sum of angles


def _after_ball(word: Sequence[Vector | None], angles: Sequence[float]) -> list[tuple[Vector, float]]:
    """The rotations of the link behind the last ball joint: those behind it, turned back from the end link."""
    behind: list[tuple[Vector, float]] = []
    for axis, angle in zip(reversed(word), reversed(angles), strict=True):
        if axis is None:
            break
        behind = _followed(behind, axis, -angle)
    return behind


def _turned(
    element: Element,
    active: Sequence[tuple[Vector, float]],
    angles: Sequence[float],
    names: Collection[str],
    first: float,
) -> Element | Refusal:
    """An element behind some rotations; its own angles displace its second axis, or the branches of a loop."""
    if isinstance(element, InnerLoop):
        locked_turn = any(
            _is_touched(inner, names) and _axes_of(inner) for branch in element.branches for inner in branch
        )
        branches = []
        for number, branch in enumerate(element.branches):
            start = first + ELSEWHERE * (number + 1) / 2  # between the limbs
            moved = _turned_branch(branch, angles[0] if angles else 0.0, start) if locked_turn else tuple(branch)
            if isinstance(moved, Refusal):
                return moved
            branches.append(tuple(_rigidly(inner, active) for inner in moved))
        return InnerLoop(tuple(branches), element.name)
    if isinstance(element, Parallelogram) or len(element.axes) < 2:
        return _rigidly(element, active)
    near, far = element.axes
    axes = (_direction(near, active), _direction(far, _followed(active, near, angles[0])))
    return dataclasses.replace(element, axes=axes)


def _turned_branch(branch: Sequence[Element], net: float, first: float) -> tuple[Element, ...] | Refusal:
    """A branch of a planar loop, its axes turned by general angles that add up to the turn of the output link."""
    axes = [axis for joint in branch for axis in _axes_of(joint)]
    if any(not parallel(axes[0], axis) for axis in axes) or any(isinstance(joint, InnerLoop) for joint in branch):
        return Refusal("a joint is locked in an inner loop that is not planar")
    moved: list[Element] = []
    passed = 0
    for joint in branch:
        angle = 0.0 if not passed else net if passed == len(axes) else first + FURTHER * passed
        moved.append(_rigidly(joint, [(axes[0], angle)] if angle else []))
        passed += len(_axes_of(joint))
    return tuple(moved)


def _axes_of(element: Element) -> tuple[Vector, ...]:
    """Axes that a joint turns about; three at right angles for a ball joint, none for a slide or a 4R parallelogram."""
    if isinstance(element, InnerLoop):
        return tuple(_axes_in(element.branches[0]))
    if isinstance(element, Parallelogram):
        return () if element.kind == "4R" else (element.axis,)
    return () if not element.type.turning else element.axes or AXES


def _axes_in(elements: Sequence[Element]) -> Iterator[Vector]:
    for element in elements:
        yield from _axes_of(element)


def _rigidly(element: Element, active: Sequence[tuple[Vector, float]]) -> Element:
    """An element that is turned as a whole."""
    if not active:
        return element
    if isinstance(element, InnerLoop):
        return InnerLoop(
            tuple(tuple(_rigidly(inner, active) for inner in branch) for branch in element.branches), element.name
        )
    if isinstance(element, Parallelogram):
        return dataclasses.replace(element, axis=_direction(element.axis, active))
    return dataclasses.replace(element, axes=tuple(_direction(axis, active) for axis in element.axes))


def _direction(direction: Vector, active: Sequence[tuple[Vector, float]]) -> Vector:
    """A direction behind rotations about axes as written, the first of them next to the base."""
    for axis, angle in reversed(active):
        if not parallel(axis, direction):
            direction = rotated(direction, axis, angle)
    return direction
