"""From sketches with their directions to chains: types, labels of shared points, names."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from assur.joints.catalogue import BY_LETTER
from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.directions import Vector
from assur.topology.notation.groups import Groups
from assur.topology.notation.names import JointNames
from assur.topology.notation.sketch import ElementSketch, JointSketch, Sketch


def build(sketches: Sequence[Sketch], vectors: Sequence[Sequence[Vector]]) -> tuple[Chain, ...]:
    """The chains of a mechanism.

    Errors:
        NotationError: two labels for one point.
    """
    names = JointNames([sketch.names for sketch in sketches])
    labels = _fresh_labels({label for sketch in sketches for label in sketch.written_labels})
    chains = []
    for sketch, axes in zip(sketches, vectors, strict=True):
        points = _points(sketch, labels)
        elements = tuple(_element(sketch, element, axes, points, names) for element in sketch.elements)
        chains.append(Chain(elements, sketch.source.text, *sketch.ends))
    return tuple(chains)


def _element(
    sketch: Sketch, element: ElementSketch, axes: Sequence[Vector], points: dict[int, str], names: JointNames
) -> Element:
    if isinstance(element, JointSketch):
        return _joint(sketch, element, axes, points, names)
    branches = tuple(
        tuple(_element(sketch, part, axes, points, names) for part in branch) for branch in element.branches
    )
    loop = InnerLoop(branches)
    return InnerLoop(branches, names.of_loop(element.name, loop))


def _joint(
    sketch: Sketch, drawn: JointSketch, axes: Sequence[Vector], points: dict[int, str], names: JointNames
) -> ChainJoint | Parallelogram:
    joint = drawn.joint
    directions = tuple(axes[slot] for slot in drawn.slots)
    general = bool(directions) and not any(sketch.slots[slot].placed or sketch.slots[slot].tied for slot in drawn.slots)
    if joint.kind:
        return Parallelogram(joint.kind, directions[0], names.of_joint("Pa", joint.name), general, joint.bar)
    name = names.of_joint(joint.letter, joint.name)
    point, through = points.get(joint.at, ""), joint.points[1]
    return ChainJoint(BY_LETTER[joint.letter], directions, point, name, general, through)


def _points(sketch: Sketch, fresh: Iterator[str]) -> dict[int, str]:
    """Label of every joint (by its place in the text) that shares a point or has a label."""
    places = sorted({*sketch.labels, *(at for first, second, _ in sketch.meetings for at in (first, second))})
    groups = Groups(len(places))
    known = {places.index(at): (label, at) for at, label in sketch.labels.items()}
    for near, far, at in sketch.meetings:
        first, second = groups.of(places.index(near)), groups.of(places.index(far))
        if first in known and second in known and known[first][0] != known[second][0]:
            offending = f"a contradiction: one point with the labels {known[first][0]} and {known[second][0]}"
            raise sketch.source.error(at, offending, "one label for a point", "an axis runs through one labelled point")
        groups.join(first, second)
        if first in known or second in known:
            known[groups.of(first)] = known.get(first) or known[second]
    for number in range(len(places)):
        if groups.of(number) == number and number not in known:
            known[number] = (next(fresh), 0)
    return {at: known[groups.of(number)][0] for number, at in enumerate(places)}


def _fresh_labels(used: set[str]) -> Iterator[str]:
    """A, B, ..., Z, A1, B1, ... without those that are used."""
    number = 0
    while True:
        for letter in "ABCDEFGHIJKLMNOPQRSTUVWXYZ":
            label = f"{letter}{number or ''}"
            if label not in used:
                yield label
        number += 1
