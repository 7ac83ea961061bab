"""Mechanisms with single copies of dimensions off, in batches: the joint graph over arrays, closed by chords.

No derivative of the product goes into them: that of the gaps is by differences.
"""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.geometry import Geometry, characteristic_length, joint_scales, written_joint
from assur.joint_graph.state import joint_state
from assur.joint_graph.tree import joint_graph
from assur.joints.steps import STILL
from assur.model.written import NumberReading
from assur.numerics import rotations

FUNCTIONS = SimpleNamespace(sqrt=np.sqrt, sin=np.sin, cos=np.cos, pi=np.pi)
STEPS = 8
"""Chords from tolerances of a thousandth: each gains three digits."""


@dataclass(frozen=True, eq=False)
class Settled:
    """The platform's frames (N, 3, 3) and (N, 3), and what stays open of the loops (N,), in lengths."""

    turn: np.ndarray
    point: np.ndarray
    left: np.ndarray


def settled(record, values, off, driven=None):
    """Assemblies near joint values (n,) with copies off by (N,) each, in lengths and rad, and inputs by (N,) each."""
    count = len(next(iter({**off, **(driven or {})}.values())))
    given = np.tile(values[:, None], (1, count))
    for item in record.drives:
        given[item.coordinate.index] += item.sign * np.asarray((driven or {}).get(item.name, np.zeros(count)))
    held = [item.coordinate.index for item in record.drives]
    passive = np.setdiff1d(np.arange(len(values)), held)
    slopes = _slopes(record, values, passive)
    inverse = np.linalg.pinv(slopes, rcond=1e-9)
    dimensions = _geometry(record, off)
    scales = joint_scales(record)[passive]
    for _ in range(STEPS):
        _, gaps = _at(record, given, dimensions)
        given = _turned_on(record, given, passive, -(inverse @ gaps) * scales[:, None])
    own, gaps = _at(record, given, dimensions)
    rotation, point = own.platform
    full = [[np.broadcast_to(number, count) for number in row] for row in rotation]
    whole = np.moveaxis(np.array(full, dtype=float), -1, 0)
    place = np.stack([np.broadcast_to(number, count) for number in point], axis=-1)
    return Settled(whole, place.astype(float), np.abs(gaps).max(axis=0))


def moved(record, values, off, driven=None):
    """Displacement and rotation vector (N, 6) against the mechanism as it is, and what stays open (N,)."""
    after = settled(record, values, off, driven)
    before = settled(record, values, {}, {record.drives[0].name: np.zeros(1)})
    turned = rotations.to_vector(after.turn @ before.turn[0].T)
    return np.concatenate([after.point - before.point[0], turned], axis=1), after.left


def _slopes(record, values, passive):
    """Change (6 v, q) of the gaps per joint coordinate over its scale."""
    step, size = 1e-6, len(passive)
    still = _geometry(record, {})
    steps = step * joint_scales(record)[passive][:, None] * np.eye(size)
    ends = [
        _at(record, _turned_on(record, np.tile(values[:, None], (1, size)), passive, sense * steps), still)[1]
        for sense in (-1.0, 1.0)
    ]
    return (ends[1] - ends[0]) / (2.0 * step)


def _turned_on(record, values, passive, steps):
    """Joint values (n, N) after steps (q, N) of passive ones; balls turn on from where they stand."""
    whole = np.zeros_like(values)
    whole[passive] = steps
    after = values + whole
    for turn in joint_graph(record).turns:
        first, second = (rotations.from_vector(part[turn].T) for part in (whole, values))
        after[turn] = rotations.to_vector(first @ second).T
    return after


def _at(record, values, dimensions):
    graph, length = joint_graph(record), characteristic_length(record)
    state = {name: joint_state(joint.type, values[graph.slices[name]]) for name, joint in record.joints.items()}
    own = Configuration(graph, dimensions, state)
    rows = []
    for joint in graph.cut:
        distance, gap = own.gap(joint)
        rows += [number + np.zeros(values.shape[1]) for number in distance]
        turn = np.array([[number + np.zeros(values.shape[1]) for number in row] for row in gap])
        rows += list(length * rotations.to_vector(np.moveaxis(turn, -1, 0)).T)
    return own, np.array(rows)


def _geometry(record, off):
    joints = {}
    for name, joint in record.joints.items():
        limb = name.rpartition(".")[0]
        in_parent, in_child = (
            written_joint(joint, _reading(record, off, limb, link)) for link in (joint.parent, joint.child)
        )
        joints[name] = replace(in_parent, child_at=in_child.child_at)
    point = record.platform.written
    own = point.vector(_reading(record, off, "", record.platform.link)) if point else STILL
    return Geometry(joints, own, 1)


def _reading(record, off, limb, link):
    names = {}
    for name, parameter in record.parameters.items():
        copies = {name, f"{link}.{name}"} | ({f"{limb}.{name}"} if limb else set())
        names[name] = parameter.inside + sum(off[copy] for copy in copies if copy in off)
    return NumberReading(names, FUNCTIONS, float)
