"""Joint values without trigonometry: a length itself, an angle's cosine and sine, a ball joint's quaternion."""

from __future__ import annotations

from collections.abc import Collection
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.model.joint_graph import joint_graph
from assur.model.mechanism import MechanismRecord
from assur.topology.joints import HELICAL, SPHERICAL

FloatArray = NDArray[np.float64]


@lru_cache(maxsize=64)
def state_names(record: MechanismRecord) -> dict[int, tuple[str, ...]]:
    """Names of the numbers of each coordinate; all three of a ball joint at its first.

    Errors:
        UsageError: a helical joint, whose angle is also a length: its cosine and sine do not tell it.

    >>> from assur.model.registry import load_record
    >>> list(state_names(load_record("orthoglide")).values())[:2]
    [('length0',), ('cos1', 'sin1')]
    """
    names: dict[int, tuple[str, ...]] = {}
    slices = joint_graph(record).slices
    for name, joint in record.joints.items():
        first = slices[name].start
        if joint.type is HELICAL:
            where = f"{record.name}: joint {name} is helical"
            raise UsageError(f"{where}: its angle is a length too", hint="close the loops by assemble")
        if joint.type is SPHERICAL:
            names[first] = tuple(f"{part}{first}" for part in "wxyz")
            continue
        for k, kind in enumerate(joint.type.kinds, start=first):
            names[k] = (f"length{k}",) if kind == "length" else (f"cos{k}", f"sin{k}")
    return names


def state_of(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """The state (k, b), in the order of `state_names`, of joint values (n, b).

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> state_of(record, np.zeros((5, 1)))[:4, 0]
    array([1., 0., 1., 0.])
    """
    names = state_names(record)
    state, row = np.empty((sum(map(len, names.values())), values.shape[1])), 0
    for k, own in names.items():
        if len(own) == 1:
            state[row] = values[k]
        elif len(own) == 2:
            np.cos(values[k], out=state[row])
            np.sin(values[k], out=state[row + 1])
        else:
            state[row : row + 4] = _quaternions(values[k : k + 3])
        row += len(own)
    return state


def move(
    record: MechanismRecord, values: FloatArray, begun: FloatArray, state: FloatArray, rows: Collection[int]
) -> None:
    """Joint values (n, b), changed in place, whose state (k, b) went from one to another in some of its rows.

    Angles become those nearest the values before, whole turns included.
    """
    row = 0
    for k, names in state_names(record).items():
        now, then = state[row : row + len(names)], begun[row : row + len(names)]
        if row not in rows:
            pass
        elif len(names) == 1:
            values[k] = now[0]
        elif len(names) == 2:
            values[k] += np.arctan2(now[1] * then[0] - now[0] * then[1], now[0] * then[0] + now[1] * then[1])
        else:
            values[k : k + 3] = _rotation_vectors(now, values[k : k + 3])
        row += len(names)


def _quaternions(vectors: FloatArray) -> FloatArray:
    """Unit quaternions (4, b) of rotation vectors (3, b)."""
    angle = np.sqrt(np.sum(vectors**2, axis=0))
    return np.concatenate([np.cos(0.5 * angle)[None], 0.5 * np.sinc(0.5 * angle / np.pi) * vectors])


def _rotation_vectors(quaternions: FloatArray, near: FloatArray) -> FloatArray:
    """Rotation vectors (3, b) of unit quaternions (4, b), of those that differ by whole turns the one nearest."""
    size = np.sqrt(np.sum(quaternions[1:] ** 2, axis=0))
    angle = 2.0 * np.arctan2(size, quaternions[0])
    with np.errstate(invalid="ignore", divide="ignore"):
        axis = np.where(size > 0.0, quaternions[1:] / size, 0.0)
    turns = np.round((np.sum(axis * near, axis=0) - angle) / (2 * np.pi))
    return np.asarray((angle + 2 * np.pi * turns) * axis)
