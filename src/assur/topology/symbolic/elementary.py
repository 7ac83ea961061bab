"""A chain as the rules see it: slides that translate and turns that rotate, one after the other.

A cylindrical joint is a slide and a turn, a universal joint two turns at one point, a spherical joint three. A
parallelogram is a slide whose direction turns; an inner loop is a slide and at most one turn.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from assur.topology.chains import ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.directions import Vector
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spans import Span, along


@dataclass(frozen=True)
class Slide:
    """Pure translations between two links that keep their orientation to each other.

    Attributes:
        span: their directions, fixed in the link before or turning.
        name: the joint or loop that makes them.
    """

    span: Span
    name: str


@dataclass(frozen=True)
class Turn:
    """A rotation about one axis between two links.

    Attributes:
        direction: of the axis, fixed in both links; None where it is any of those of a spherical joint, or a rod's.
        name: the joint or loop that makes it.
        point: label of a point on the axis, the centre of a joint with several axes.
        further: labels of other points on it.
        finite: False for a parallelogram's rotation about its rods, which is a freedom but turns nothing.
        located: False where nothing says where the axis lies (an inner loop's).
        pitch: whether it advances as it turns.
    """

    direction: Vector | None
    name: str
    point: str = ""
    finite: bool = True
    located: bool = True
    pitch: bool = False
    further: tuple[str, ...] = ()

    @property
    def labels(self) -> tuple[str, ...]:
        """All labels of points on the axis, of a centre first; those that begin with # are of nothing else."""
        return (self.point, *self.further) if self.point else self.further

    @property
    def shared(self) -> frozenset[str]:
        """The labels that other joints may have too."""
        return frozenset(label for label in self.labels if not label.startswith("#"))


Elementary = Slide | Turn

ROD = Span((), 2)
"""The translations of a parallelogram with S or U joints: perpendicular to rods that swing freely."""


def elementary(
    elements: Iterable[Element], loop: Callable[[InnerLoop], tuple[Elementary, ...] | Refusal]
) -> tuple[Elementary, ...] | Refusal:
    """The slides and turns of a chain from base to end link.

    Args:
        elements: the chain's, in order.
        loop: gives the slides and turns that an inner loop is worth, or why it has none.
    """
    parts: list[Elementary] = []
    count: dict[str, int] = {}
    for index, element in enumerate(elements):
        if isinstance(element, InnerLoop):
            solved = loop(element)
            if isinstance(solved, Refusal):
                return solved
            parts += solved
            continue
        letter = "P" if isinstance(element, Parallelogram) else element.type.letter
        count[letter] = count.get(letter, 0) + 1
        name = element.name or f"{letter}{count[letter]}"
        if isinstance(element, Parallelogram):
            parts += _of_parallelogram(element, name, f"#{index}")
        else:
            parts += _of_joint(element, name, element.point or f"#{index}")
    return tuple(parts)


def _of_joint(joint: ChainJoint, name: str, centre: str) -> list[Elementary]:
    """`centre` is the point of a joint with several axes: its label, or one that nothing else has."""
    if joint.type.ball:
        return [Turn(None, name, centre)] * 3
    point = centre if joint.type.turns > 1 else joint.point
    parts: list[Elementary] = []
    for step in joint.type.steps:
        direction, last = joint.directions[step.direction], parts[-1] if parts else None
        if step.kind != "slide":
            further = tuple(label for label in joint.points_on(step.direction) if label != point)
            parts.append(Turn(direction, name, point, pitch=step.kind == "screw", further=further))
        elif isinstance(last, Slide):
            parts[-1] = Slide(last.span.with_direction(direction), name)
        else:
            parts.append(Slide(along(direction), name))
    return parts


def _of_parallelogram(joint: Parallelogram, name: str, centre: str) -> list[Elementary]:
    if joint.kind == "4R":
        return [Slide(Span((), 1, joint.axis), name)]
    swing: list[Elementary] = [Slide(ROD, name), Turn(joint.axis, name, centre)]
    return swing if joint.kind == "4U" else [*swing, Turn(None, name, centre, finite=False)]
