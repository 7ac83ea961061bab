"""Chains recognised in a linkage: its limbs, with the directions of their axes and the points that axes share."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterable, Iterator, Mapping
from itertools import count
from typing import cast

from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram, ParallelogramKind
from assur.topology.directions import EXACT, Vector, unit
from assur.topology.screws.common_lines import with_common_lines
from assur.topology.screws.limbs import LinkagePath, limbs
from assur.topology.screws.linkage import Group, Linkage, LinkageJoint
from assur.topology.screws.shared_points import Line, line_of, meet, pivoted, size_of, with_shared_points


def recognised(linkage: Linkage) -> tuple[Chain, ...] | None:
    """The limbs with their axes at home, parallelograms as one element; None where the graph has no limbs of these.

    Neighbouring axes that meet (or coincide) get the label of their common point, also where slides stand between them:
    one along an axis leaves that axis where it is. Limbs whose first axes meet in one
    point of the base, or whose last axes meet in one point of the platform, have one label for it. O' has a label
    where a limb ends in it.
    """
    if linkage.parted:
        return None
    inside = {name for group in linkage.groups.values() for name in group.joints}
    paths = [
        LinkagePath(joint.parent, joint.child, (_joint(joint),))
        for name, joint in linkage.joints.items()
        if name not in inside
    ]
    paths += [
        LinkagePath(group.parent, group.child, (_parallelogram(group, linkage),)) for group in linkage.groups.values()
    ]
    paths_of_limbs = limbs(paths, linkage.base, linkage.platform)
    if paths_of_limbs is None:
        return None
    lines = {name: line_of(joint) for name, joint in linkage.joints.items()}
    size = size_of(linkage)
    labels = (f"M{number}" for number in count(1))
    marked = [Chain(_marked(chain.elements, lines, labels, size)) for chain in paths_of_limbs]
    return with_common_lines(with_shared_points(marked, lines, labels, size, linkage.point), linkage, labels, size)


def _joint(joint: LinkageJoint) -> ChainJoint:
    """A joint with its axes at home: of a C the one axis, of an S none."""
    rows = {step.direction: joint.screws[first] for step, first in joint.type.places}
    axes = [rows[k][:3] if rows[k][:3].any() else rows[k][3:] for k in range(joint.type.axes)]
    return ChainJoint(joint.type, tuple(_direction(axis) for axis in axes), name=joint.name)


def _direction(axis: Iterable[float]) -> Vector:
    """An axis at home, where loops are closed to rounding: what cannot be told from zero is zero."""
    return unit(0.0 if abs(part) < EXACT else part for part in unit(axis))


def _parallelogram(group: Group, linkage: Linkage) -> Parallelogram:
    """Its hinge direction (4R), or else the direction of the short link on the parent's side."""
    kind = cast(ParallelogramKind, group.kind.removeprefix("P(").removesuffix(")"))
    corners = [linkage.joints[name] for name in group.joints]
    if kind == "4R":
        return Parallelogram(kind, _direction(corners[0].screws[0, :3]), group.name)
    near = [corner.point for corner in corners if group.parent in (corner.parent, corner.child)]
    return Parallelogram(kind, _direction(near[1] - near[0]), group.name)


def _marked(
    elements: tuple[Element, ...], lines: Mapping[str, Line], labels: Iterator[str], size: float
) -> tuple[Element, ...]:
    """The elements with a label on every run of neighbours whose axes run through one point, slides passed over."""
    marked: list[Element] = []
    run: list[ChainJoint] = []
    for element in elements:
        if isinstance(element, ChainJoint) and pivoted(element.type):
            if not meet([lines[joint.name] for joint in (*run, element) if pivoted(joint.type)], size):
                marked += _labelled(run, labels)
                run = []
            run.append(element)
            continue
        if run and isinstance(element, ChainJoint) and not element.type.turning:
            run.append(element)
            continue
        marked += _labelled(run, labels)
        run = []
        if isinstance(element, InnerLoop):
            branches = tuple(_marked(branch, lines, labels, size) for branch in element.branches)
            element = InnerLoop(branches, element.name or _called(branches))
        marked.append(element)
    return (*marked, *_labelled(run, labels))


def _called(branches: tuple[tuple[Element, ...], ...]) -> str:
    """The name of a loop's rotation, after the first joint of each branch: R12 for a loop on P1 and P2."""
    numbers = [re.search(r"\d+$", getattr(branch[0], "name", "")) for branch in branches]
    return "R" + "".join(number.group() for number in numbers if number) if all(numbers) else ""


def _labelled(run: list[ChainJoint], labels: Iterator[str]) -> list[ChainJoint]:
    """The joints of a run, its axes with one label if there are several; slides among them have none."""
    if sum(pivoted(joint.type) for joint in run) < 2:
        return run
    label = next(labels)
    return [dataclasses.replace(joint, point=label) if pivoted(joint.type) else joint for joint in run]
