"""A mechanism with dimensions as topology sees it: a linkage closed at home, and its limbs as chains of axes."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from itertools import count

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closure import characteristic_length
from assur.kinematics.home import home_values
from assur.model.joint_graph import frames, joint_graph, screws
from assur.model.mechanism import GeneralisedJoint, Joint, MechanismRecord
from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram, ParallelogramKind
from assur.topology.directions import unit
from assur.topology.joints import HELICAL, PRISMATIC, REVOLUTE, SPHERICAL, UNIVERSAL
from assur.topology.limbs import Path, limbs
from assur.topology.linkage import Group, Linkage, LinkageJoint

FloatArray = NDArray[np.float64]
Line = tuple[FloatArray, FloatArray]
"""A point in the base frame, and the direction of an axis or zero where every axis through it counts."""

TURNING = (REVOLUTE, HELICAL, UNIVERSAL, SPHERICAL)
"""Joints that may share a point with a neighbour."""

MEETING = 1e-9
"""Axes nearer than this share of the mechanism's size meet."""


def linkage(record: MechanismRecord) -> Linkage:
    """The joint graph in its closed home, lengths in the mechanism's unit.

    >>> from assur.model.registry import load_record
    >>> len(linkage(load_record("zeng2019")).joints)
    17
    """
    values = home_values(record)
    placed = frames(record, values)
    twists = screws(record, placed, values)
    slices = joint_graph(record).slices
    joints = {
        name: LinkageJoint(name, item.type, item.parent, item.child, twists[:, slices[name]].T, _point(item, placed))
        for name, item in record.joints.items()
    }
    groups = {
        name: Group(name, item.kind, item.joints, item.parent, item.child) for name, item in record.generalised.items()
    }
    rotation, origin = placed[record.platform.link]
    return Linkage(
        joints=joints,
        base=record.base,
        platform=record.platform.link,
        point=rotation @ record.platform.point + origin,
        groups=groups,
        inputs=tuple(
            (i.coordinate.joint, i.coordinate.index - slices[i.coordinate.joint].start) for i in record.inputs
        ),
        length=characteristic_length(record),
    )


def chains(record: MechanismRecord) -> tuple[Chain, ...] | None:
    """The limbs with their axes at home, parallelograms as one element; None where the graph has no limbs.

    Neighbouring axes that meet (or coincide) get the label of their common point.
    """
    at_home = linkage(record)
    inside = {name for item in record.generalised.values() for name in item.joints}
    paths = [
        Path(item.parent, item.child, (_joint(record, at_home.joints[name]),))
        for name, item in record.joints.items()
        if name not in inside
    ]
    paths += [Path(item.parent, item.child, (_parallelogram(item, at_home),)) for item in record.generalised.values()]
    found = limbs(paths, record.base, record.platform.link)
    if found is None:
        return None
    lines = {_label(record, name): _line(joint) for name, joint in at_home.joints.items()}
    labels = (f"M{number}" for number in count(1))
    return tuple(Chain(_marked(chain.elements, lines, labels)) for chain in found)


def _point(joint: Joint, placed: dict[str, tuple[FloatArray, FloatArray]]) -> FloatArray:
    rotation, origin = placed[joint.parent]
    point: FloatArray = rotation @ joint.at + origin
    return point


def _label(record: MechanismRecord, name: str) -> str:
    return record.joints[name].alias or name


def _joint(record: MechanismRecord, joint: LinkageJoint) -> ChainJoint:
    """A joint with its axes at home: of a C the one axis, of an S none."""
    rows = joint.screws[: joint.type.axes]
    axes = [row[3:] if joint.type is PRISMATIC or not row[:3].any() else row[:3] for row in rows]
    return ChainJoint(joint.type, tuple(unit(axis) for axis in axes), name=_label(record, joint.name))


def _parallelogram(item: GeneralisedJoint, at_home: Linkage) -> Parallelogram:
    """Its hinge direction (4R), or else the direction of the short link on the parent's side."""
    kind: ParallelogramKind = item.kind.removeprefix("P(").removesuffix(")")  # type: ignore[assignment]  # checked on reading
    corners = [at_home.joints[name] for name in item.joints]
    if kind == "4R":
        return Parallelogram(kind, unit(corners[0].screws[0, :3]), item.name)
    near = [corner.point for corner in corners if item.parent in (corner.parent, corner.child)]
    return Parallelogram(kind, unit(near[1] - near[0]), item.name)


def _line(joint: LinkageJoint) -> Line:
    """An R or H joint's axis; of a U or S its centre alone, which no line describes."""
    return joint.point, joint.screws[0, :3] if joint.type in (REVOLUTE, HELICAL) else np.zeros(3)


def _marked(elements: tuple[Element, ...], lines: Mapping[str, Line], labels: Iterator[str]) -> tuple[Element, ...]:
    """The elements with a label on every run of neighbours whose axes run through one point."""
    marked: list[Element] = []
    run: list[ChainJoint] = []
    for element in elements:
        if isinstance(element, ChainJoint) and element.type in TURNING:
            if not _meet([lines[item.name] for item in (*run, element)]):
                marked += _labelled(run, labels)
                run = []
            run.append(element)
            continue
        marked += _labelled(run, labels)
        run = []
        if isinstance(element, InnerLoop):
            element = InnerLoop(tuple(_marked(branch, lines, labels) for branch in element.branches), element.name)
        marked.append(element)
    return (*marked, *_labelled(run, labels))


def _labelled(run: list[ChainJoint], labels: Iterator[str]) -> list[ChainJoint]:
    if len(run) < 2:
        return run
    label = next(labels)
    return [dataclasses.replace(item, point=label) for item in run]


def _meet(lines: list[Line]) -> bool:
    """Whether some axes and centres have a point in common: the least-squares point misses none of them."""
    planes = [np.eye(3) - np.outer(axis, axis) for _, axis in lines]
    rows = np.vstack(planes)
    wanted = np.concatenate([plane @ point for plane, (point, _) in zip(planes, lines, strict=True)])
    found = np.linalg.lstsq(rows, wanted)[0]
    size = max(float(np.max(np.abs(wanted))), 1e-300)
    return bool(np.max(np.abs(rows @ found - wanted)) < MEETING * size)
