"""Joint values without trigonometry: a length itself, an angle's cosine and sine, a ball joint's quaternion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.joints.joint_type import JointType
from assur.joints.steps import Step
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]
Numbers = TypeVar("Numbers", NDArray[np.float64], NDArray[np.complex128])


@lru_cache(maxsize=64)
def state_names(record: MechanismRecord) -> dict[str, tuple[str, ...]]:
    """Names of the numbers of each joint, with the index of the coordinate that they belong to.

    >>> from assur.model.registry import load_record
    >>> list(state_names(load_record("orthoglide")).values())[:2]
    [('length0',), ('cos1', 'sin1')]
    """
    slices = joint_graph(record).slices
    names: dict[str, tuple[str, ...]] = {}
    for name, joint in record.joints.items():
        start = slices[name].start
        names[name] = tuple(f"{number}{start + first}" for step, first in joint.type.places for number in step.numbers)
    return names


@dataclass(frozen=True, eq=False)
class _Alike:
    """Steps of one kind: places (c, s) of their coordinates among the joint values, (k, s) of their numbers."""

    step: Step
    coordinates: IntArray
    numbers: IntArray


@lru_cache(maxsize=64)
def _alike(record: MechanismRecord) -> tuple[_Alike, ...]:
    slices = joint_graph(record).slices
    places: dict[str, list[tuple[Step, range, range]]] = {}
    row = 0
    for name, joint in record.joints.items():
        for step, first in joint.type.places:
            start = slices[name].start + first
            own = step, range(start, start + len(step.kinds)), range(row, row + len(step.numbers))
            places.setdefault(step.kind, []).append(own)
            row += len(step.numbers)
    return tuple(
        _Alike(steps[0], np.array(coordinates).T, np.array(numbers).T)
        for steps, coordinates, numbers in (zip(*own, strict=True) for own in places.values())
    )


def state_of(record: MechanismRecord, values: Numbers) -> Numbers:
    """The state (k, b), in the order of `state_names`, of joint values (n, b), complex ones too.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> state_of(record, np.zeros((5, 1)))[:4, 0]
    array([1., 0., 1., 0.])
    """
    count = sum(own.numbers.size for own in _alike(record))
    state = np.empty((count, values.shape[1]), dtype=np.result_type(values, float))
    for own in _alike(record):
        state[own.numbers] = own.step.state(values[own.coordinates])
    return state


def changes_of(record: MechanismRecord, values: FloatArray, rates: FloatArray) -> FloatArray:
    """How fast the state (k, b) of joint values (n, b) changes at rates (n, b).

    Those of a ball joint are its angular velocity in the parent's frame.
    """
    return changes_at(record, state_of(record, values), rates)


def changes_at(record: MechanismRecord, state: Numbers, rates: Numbers) -> Numbers:
    """The same at a state (k, b), which may be complex."""
    changes = np.empty_like(state)
    for own in _alike(record):
        changes[own.numbers] = own.step.changes(state[own.numbers], rates[own.coordinates])
    return changes


def unit_state(record: MechanismRecord, state: Numbers) -> Numbers:
    """A state (k, b) near one, complex or not, in which cosines, sines and quaternions have a sum of squares 1.

    >>> from assur.model.registry import load_record
    >>> unit_state(load_record("fivebar"), np.tile([[1.0], [0.1]], (5, 1)))[:2, 0].round(6).tolist()
    [0.995037, 0.099504]
    """
    answer = state.copy()
    for own in _alike(record):
        if own.step.kind in ("turn", "ball"):
            answer[own.numbers] /= np.sqrt(np.sum(state[own.numbers] ** 2, axis=0))
    return answer


def values_of(record: MechanismRecord, state: FloatArray) -> FloatArray:
    """Joint values (n, b) of a state (k, b), angles within half a turn.

    >>> from assur.model.registry import load_record
    >>> record = load_record("delta_4s")
    >>> values = np.linspace(-0.9, 0.9, len(record.coordinates))[:, None]
    >>> bool(np.allclose(values_of(record, state_of(record, values)), values))
    True
    """
    answer = np.empty((len(record.coordinates), state.shape[1]))
    for own in _alike(record):
        numbers = state[own.numbers]
        if own.step.kind == "turn":
            answer[own.coordinates[0]] = np.arctan2(numbers[1], numbers[0])
        elif own.step.kind == "ball":
            turned = rotations.from_quaternion(np.moveaxis(numbers, 0, -1))
            answer[own.coordinates] = np.moveaxis(rotations.to_vector(turned), -1, 0)
        else:
            answer[own.coordinates[0]] = numbers[-1]
    return answer


def joint_state(joint_type: JointType, values: FloatArray) -> FloatArray:
    """The numbers (k, b) of one joint at its values (f, b)."""
    return np.concatenate([step.state(values[first : first + len(step.kinds)]) for step, first in joint_type.places])


def ball_rates(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Angular velocity per rate of each part of the rotation vectors of joint values (n, b): rows (9 s, b).

    Nine for each of the s ball joints, in the joints' order: the matrix row by row.
    """
    for own in _alike(record):
        if own.step.kind == "ball":
            matrices = rotations.left_jacobian(np.moveaxis(values[own.coordinates], 0, -1))  # (s, b, 3, 3)
            return np.moveaxis(matrices, 1, -1).reshape(9 * own.coordinates.shape[1], values.shape[1])
    return np.empty((0, values.shape[1]))
