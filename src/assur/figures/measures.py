"""Measures: how the parameters of a file place the points of every link, as steps and angles that are drawn."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from assur.figures.labels import formula_text, node_latex
from assur.figures.letters import letter
from assur.model.file.parameters import parameter_formulas
from assur.model.formula import Formula, parse
from assur.model.mechanism import MechanismRecord
from assur.model.syntax import Call, Name, Negative, Node, Operands, evaluate
from assur.model.written import JointFormulas, NumberReading, WrittenVector
from assur.numerics import rotations
from assur.scene.camera import Camera
from assur.scene.skeleton import Skeleton

FloatArray = NDArray[np.float64]
VISIBLE = 0.012
"""Share of the mechanism's size below which a step is too short to bear arrows: 1 mm of a page of 90."""
MOST = 4
"""Points placed by three coordinates each; those of more would hide the mechanism, and the caption names them."""
SHARE = 0.3
"""At which share of a radius the arc of its angle is drawn."""
_SAMPLES = 24


@dataclass(frozen=True, eq=False)
class PlacedStep:
    """A part of the way from a link's origin to one of its points, along an axis of its frame or along a radius.

    Attributes:
        latex: its length, without a sign and without dollar signs.
        names: the parameters in it.
        points: (2, 3) its ends in the base frame.
    """

    latex: str
    names: frozenset[str]
    points: FloatArray

    @property
    def size(self) -> float:
        """Its length."""
        return float(np.linalg.norm(self.points[1] - self.points[0]))


@dataclass(frozen=True, eq=False)
class Placement:
    """How a point is placed on its link: steps from the link's origin, the last of which ends at it.

    Attributes:
        arc: of a point that is placed by a radius and an angle, that angle, as points (k, 3) about the origin.
    """

    link: str
    point: str
    steps: tuple[PlacedStep, ...]
    arc: PlacedStep | None = None

    @property
    def parts(self) -> tuple[PlacedStep, ...]:
        """Its steps and its angle."""
        return (*self.steps, self.arc) if self.arc else self.steps

    @property
    def names(self) -> frozenset[str]:
        """Every parameter in it."""
        return frozenset[str]().union(*(part.names for part in self.parts))


class Measures(NamedTuple):
    """What is drawn: placements, and of these the parts that bear their letters; of each other parameter why not."""

    placements: tuple[Placement, ...]
    lettered: tuple[PlacedStep, ...]
    undrawn: dict[str, str]

    @property
    def steps(self) -> list[PlacedStep]:
        """Every step that is drawn: the whole way to each point."""
        return [step for placement in self.placements for step in placement.steps]

    @property
    def arcs(self) -> list[PlacedStep]:
        """Every angle that is drawn: those with a letter."""
        return [item.arc for item in self.placements if item.arc in self.lettered and item.arc]


def placements(skeleton: Skeleton) -> list[Placement]:
    """How every joint, on either side, every lettered point and the platform's point are placed.

    >>> from assur.model.registry import load_record
    >>> from assur.scene.companion import companion
    >>> from assur.scene.skeleton import skeleton
    >>> from assur.kinematics.home import home_values
    >>> record = load_record("fivebar")
    >>> found = placements(skeleton(record, companion(record), home_values(record)))
    >>> [(item.link, item.point, [step.latex for step in item.steps]) for item in found][2]
    ('crank1', 'B1', ['l_{1}'])
    """
    placed = []
    for link, point, written in _written_points(skeleton.record):
        placement = _placement(skeleton, link, point, written)
        if placement.steps:
            placed.append(placement)
    return placed


def _written_points(record: MechanismRecord) -> Iterator[tuple[str, str, WrittenVector]]:
    for joint in record.joints.values():
        if joint.written:
            yield joint.parent, joint.name, joint.written.at
            yield joint.child, joint.name, joint.written.child_at
    for point in record.points.values():
        if point.written:
            yield point.link, point.name, point.written
    if record.platform.written:
        yield record.platform.link, "O'", record.platform.written


def _placement(skeleton: Skeleton, link: str, point: str, written: WrittenVector) -> Placement:
    reading = NumberReading(vars(skeleton.record.values), math, float)
    rotation, origin = skeleton.frames[link]
    axes = rotation @ (np.array(written.limb.matrix(reading), dtype=float) if written.limb else np.eye(3))
    polar = _polar(written)
    ways: list[tuple[Node, frozenset[str], FloatArray]] = []
    arc = None
    if polar:
        radius, angle = polar
        turned = float(evaluate(angle, reading.names, math, float))
        way = axes @ np.array([math.cos(turned), math.sin(turned), 0.0])
        value = float(evaluate(radius, reading.names, math, float))
        ways.append((radius, _names(radius), value * way))
        if _names(angle) and value:
            turns = rotations.about_axis(axes[:, 2], np.linspace(0.0, turned, _SAMPLES))
            arc = PlacedStep(node_latex(_unsigned(angle)), _names(angle), origin + SHARE * value * (turns @ axes[:, 0]))
    along = [
        (part.root, part.names, float(reading.value(part)) * axes[:, k])
        for k, part in enumerate(written.parts)
        if part.names and not (polar and k < 2)
    ]
    ways += sorted(along, key=lambda way: -float(np.linalg.norm(way[2])))
    steps, at = [], origin
    for node, names, way in ways:
        steps.append(PlacedStep(node_latex(_unsigned(node)), names, np.array([at, at + way])))
        at = at + way
    return Placement(link, point, tuple(steps), arc)


def _polar(written: WrittenVector) -> tuple[Node, Node] | None:
    """Radius and angle of a point that is written as r cos a, r sin a."""
    x, y = _turned(written.parts[0], "cos"), _turned(written.parts[1], "sin")
    return x if x and x == y else None


def _turned(part: Formula, function: str) -> tuple[Node, Node] | None:
    """Radius and angle of a product with the cosine or the sine of an angle."""
    root = part.root
    if isinstance(root, Operands) and len(root.rest) == 1 and root.rest[0][0] == "*":
        pair = (root.first, root.rest[0][1])
        for radius, turn in (pair, pair[::-1]):
            if isinstance(turn, Call) and turn.function == function:
                return radius, turn.of
    return None


def _names(node: Node) -> frozenset[str]:
    match node:
        case Name(text):
            return frozenset({text})
        case Negative(of) | Call(_, of):
            return _names(of)
        case Operands(first, rest):
            return _names(first).union(*(_names(term) for _, term in rest))
        case _:
            return frozenset()


def _unsigned(node: Node) -> Node:
    return node.of if isinstance(node, Negative) else node


def measures(skeleton: Skeleton, camera: Camera) -> Measures:
    """What to draw so that every parameter is seen once, beside the lengths that rods bear already.

    The limb, and of it the part, that shows a parameter most plainly is chosen: alone, on the shortest way, not end on.
    """
    record = skeleton.record
    seen = {name for rod in skeleton.rods if rod.length and rod.size for name in parse(rod.length).names}
    every = placements(skeleton)
    undrawn = _reasons(skeleton, camera, every, seen)
    open_names = [name for name in record.parameters if name not in seen and name not in undrawn]
    undrawn |= _coordinates(every, {*open_names})
    drawn: list[Placement] = []
    lettered: dict[str, PlacedStep] = {}
    for name in open_names:
        if name in seen or name in undrawn:
            continue
        needed = {*open_names} - seen
        item, part = min(
            ((item, part) for item in every for part in item.parts if name in part.names),
            key=lambda pair: (
                _hidden(skeleton, camera, pair[1]),
                len(pair[1].names),
                pair[0] not in drawn,
                len(pair[0].steps),
                -min(_length(camera, part) for part in pair[0].parts if part.names & needed),
            ),
        )
        if item not in drawn:
            drawn.append(item)
        lettered.setdefault(part.latex, part)
        seen |= part.names
    return Measures(tuple(drawn), tuple(lettered.values()), undrawn)


def _coordinates(every: list[Placement], names: set[str]) -> dict[str, str]:
    """Parameters, of many points, that are the three coordinates of one point and nothing else."""
    places: dict[str, set[str]] = {}
    for item in every:
        for name in item.names:
            places.setdefault(name, set()).add(item.point)
    own = [
        item
        for item in every
        if len(item.steps) == 3 and item.names <= names and all(places[name] == {item.point} for name in item.names)
    ]
    return {name: f"coordinates of {letter(item.point)}" for item in own for name in item.names if len(own) > MOST}


def _length(camera: Camera, part: PlacedStep) -> float:
    flat = camera.project(part.points)
    return float(np.sum(np.linalg.norm(np.diff(flat, axis=0), axis=1)))


def _hidden(skeleton: Skeleton, camera: Camera, part: PlacedStep) -> bool:
    return _length(camera, part) < VISIBLE * skeleton.size


def _reasons(skeleton: Skeleton, camera: Camera, every: list[Placement], seen: set[str]) -> dict[str, str]:
    """Why parameters are not drawn, in words that stand in brackets behind their letters."""
    record = skeleton.record
    formulas = parameter_formulas(record)
    shown = {
        name for item in every for part in item.parts if not _hidden(skeleton, camera, part) for name in part.names
    }
    reasons = {}
    for name, parameter in record.parameters.items():
        if name in shown or name in seen:
            continue
        whole = next((other for other, formula in formulas.items() if name in formula.names), "")
        directed = next((joint for joint in record.joints.values() if _directs(joint.written, name)), None)
        if whole:
            reasons[name] = f"it is in {formula_text(whole)[:-1]}={formula_text(formulas[whole].text)[1:]}"
        elif directed:
            reasons[name] = f"direction of the axis of {letter(directed.name)}"
        elif any(name in item.names for item in every):
            reasons[name] = "seen end on" if parameter.value else "zero"
        else:
            reasons[name] = "no point of a link is placed by it"
    return reasons


def _directs(written: JointFormulas | None, name: str) -> bool:
    """Whether a parameter is in the direction of an axis."""
    axes = (*written.axes, *([written.child_axis] if written.child_axis else ())) if written else ()
    return any(name in part.names for axis in axes for part in axis.parts)
