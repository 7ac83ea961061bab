"""Which axes of a chain keep meeting in a point as it moves, and which are one and the same line.

A label on two neighbouring axes says that they share a point. They go on doing so while nothing between them moves
the point off: a slide along one of the two axes moves it along that axis, which then runs through both points.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from assur.topology.directions import Vector, parallel
from assur.topology.symbolic.elementary import Elementary, Slide, Turn
from assur.topology.symbolic.spans import Span

GENERAL = -1
"""A point that no axis runs through."""


@dataclass(frozen=True)
class Line:
    """A rotation axis in space.

    Attributes:
        index: its number; coaxial turns are one line.
        name: the joint that makes it.
        points: the common points that it runs through.
    """

    index: int
    name: str
    points: frozenset[int] = frozenset()


@dataclass(frozen=True)
class Meeting:
    """The lines of a chain.

    Attributes:
        lines: of its turns, in order; coaxial turns have the same one.
        end: the point O' on the last axis or at its joint's centre, GENERAL where the last axis does not keep it.
        ends: labels of the points that the last axis keeps, and the points.
    """

    lines: tuple[Line, ...]
    end: int
    ends: tuple[tuple[str, int], ...] = ()


@dataclass
class _Walk:
    """Where a walk along the chain has come to."""

    lines: list[Line] = field(default_factory=list)
    last: Turn | None = None
    line: int = -1
    point: int = GENERAL
    labelled: dict[str, int] = field(default_factory=dict)
    points: int = 0
    moved: Span = field(default_factory=Span)

    def new_point(self) -> int:
        self.points += 1
        return self.points - 1

    def through(self, line: int, point: int) -> None:
        self.lines[line] = replace(self.lines[line], points=self.lines[line].points | {point})


def meeting(chain: Sequence[Elementary]) -> Meeting:
    """The lines of a chain's turns, and O'.

    >>> z, x = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
    >>> found = meeting([Turn(z, "R1", "A"), Turn(x, "R2", "A"), Turn(x, "R3")])
    >>> [sorted(line.points) for line in found.lines]
    [[0], [0], [1]]
    """
    walk = _Walk()
    indices: list[int] = []
    for item in chain:
        if isinstance(item, Slide):
            walk.moved = walk.moved.with_span(item.span)
        elif not item.finite:
            walk.lines.append(Line(len(walk.lines), item.name, frozenset({walk.point})))
            indices.append(len(walk.lines) - 1)
        else:
            _turn(walk, item)
            indices.append(walk.line)
    ends = tuple(walk.labelled.items()) if not walk.moved.dim else ()
    end = _end(walk)
    return Meeting(tuple(walk.lines[index] for index in indices), end, ends)


def _turn(walk: _Walk, turn: Turn) -> None:
    """The next turn: a new line, or the last one again; through the last point, or through a new one."""
    last, moved = walk.last, walk.moved
    shared = [label for label in turn.labels if label in walk.labelled] if _line_or_point(moved) else []
    walk.last, walk.moved = turn, Span()
    before = last is not None and _runs_along(last.direction, moved)
    after = _runs_along(turn.direction, moved)
    old, previous = walk.labelled, walk.line
    if not (shared and last is not None and before and after and parallel(last.direction, turn.direction)):
        _new_line(walk, turn)
    kept = {} if moved.dim else {label: old[label] for label in shared}
    walk.labelled = {label: kept[label] if label in kept else walk.new_point() for label in turn.labels}
    walk.point = walk.labelled[(shared or turn.labels)[0]] if turn.labels else GENERAL
    for point in walk.labelled.values():
        walk.through(walk.line, point)
    for label in shared if moved.dim else ():
        if before:
            walk.through(previous, walk.labelled[label])
        if after:
            walk.through(walk.line, old[label])


def _new_line(walk: _Walk, turn: Turn) -> None:
    walk.line = len(walk.lines)
    walk.lines.append(Line(walk.line, turn.name))


def _pass_through(walk: _Walk) -> None:
    if walk.point != GENERAL:
        walk.through(walk.line, walk.point)


def _end(walk: _Walk) -> int:
    """O' on the last axis: its labelled point where nothing follows, another one where it slides along the axis."""
    last, moved = walk.last, walk.moved
    if last is None or not last.located or not _line_or_point(moved) or not _runs_along(last.direction, moved):
        return GENERAL
    if moved.dim or walk.point == GENERAL:
        walk.point = walk.new_point()
        _pass_through(walk)
    return walk.point


def _line_or_point(moved: Span) -> bool:
    """Whether slides move a point nowhere, or along one fixed line."""
    return moved.is_fixed and moved.dim <= 1


def _runs_along(direction: Vector | None, moved: Span) -> bool:
    """Whether slides move a point along an axis, or not at all."""
    return moved.dim == 0 or (direction is not None and moved.dim == 1 and moved.contains(direction))
