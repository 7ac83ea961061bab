"""Derivatives of the unit twists along a motion, exact: a screw is carried by the body in which its axis is fixed.

The rate of a screw $ carried with twist V is the Lie bracket [V, $] = (w x $w, w x $v + v x $w). The coordinates of a
spherical joint are a rotation vector; the matrix that turns its rates into an angular velocity has a derivative
of its own.
"""

from __future__ import annotations

from math import factorial

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame, frames, screws
from assur.joint_graph.tree import joint_graph
from assur.model.mechanism import Joint, MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]

TERMS = 9
"""Of the series of the rotation vector's coefficients: exact to rounding up to one rad."""


def screw_rates(record: MechanismRecord, values: FloatArray, rates: FloatArray) -> FloatArray:
    """Derivative (..., 6, n) of the unit twists of `assur.joint_graph.tree.screws` along joint rates (..., n).

    Example: the driven crank's own axis stands still.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> screw_rates(record, record.home, np.ones(5))[:, record.input_indices].tolist() == [[0.0, 0.0]] * 6
    True
    """
    graph = joint_graph(record)
    placed = frames(record, values)
    unit = screws(record, values)
    bodies = _body_twists(record, unit, rates)
    change = np.zeros_like(unit)
    for name, joint in record.joints.items():
        where = graph.slices[name]
        body = bodies[joint.parent]
        for column in range(where.start, where.stop):
            change[..., column] = _bracket(body, unit[..., column])
            if not joint.type.ball:
                body = body + unit[..., column] * rates[..., column, None]
        if joint.type.ball:
            turn = placed[joint.parent][0] @ _rotation_vector_rates(values[..., where], rates[..., where])
            change[..., :3, where] += turn
            change[..., 3:, where] += np.cross(_point(joint, placed)[..., :, None], turn, axis=-2)
    return change


def _body_twists(record: MechanismRecord, unit: FloatArray, rates: FloatArray) -> dict[str, FloatArray]:
    """Twist (..., 6) of every link at joint rates (..., n), along the spanning tree."""
    graph = joint_graph(record)
    bodies = {record.base: np.zeros(unit.shape[:-1])}
    for joint, forward in graph.tree:
        near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
        where = graph.slices[joint.name]
        own = (unit[..., where] @ rates[..., where, None])[..., 0]
        bodies[far] = bodies[near] + (own if forward else -own)
    return bodies


def _bracket(body: FloatArray, screw: FloatArray) -> FloatArray:
    """Rate (..., 6) of a screw that a body carries along: the Lie bracket of the two twists."""
    turn, shift = body[..., :3], body[..., 3:]
    axis, moment = screw[..., :3], screw[..., 3:]
    return np.concatenate([np.cross(turn, axis), np.cross(turn, moment) + np.cross(shift, axis)], axis=-1)


def _point(joint: Joint, placed: dict[str, Frame]) -> FloatArray:
    rotation, origin = placed[joint.parent]
    return np.asarray(rotation @ joint.at + origin)


def _rotation_vector_rates(vector: FloatArray, rate: FloatArray) -> FloatArray:
    """Derivative (..., 3, 3) of the matrix 1 + a K + b K^2 from a rotation vector's rates to an angular velocity.

    K is the vector's cross product matrix, a = (1 - cos r) / r^2 and b = (r - sin r) / r^3 of its length r.
    """
    squared = np.sum(vector * vector, axis=-1)[..., None, None]
    growth = 2.0 * np.sum(vector * rate, axis=-1)[..., None, None]  # of r^2
    cross, moved = rotations.skew(vector), rotations.skew(rate)
    (a, a_slope), (b, b_slope) = _coefficient(squared, 2), _coefficient(squared, 3)
    first = a_slope * growth * cross + a * moved
    return np.asarray(first + b_slope * growth * (cross @ cross) + b * (moved @ cross + cross @ moved))


def _coefficient(squared: FloatArray, order: int) -> tuple[FloatArray, FloatArray]:
    """sum_k (-s)^k / (2 k + order)! for s = r^2 and its derivative by s; order 2 is a, order 3 is b."""
    small = np.minimum(squared, 1.0)
    weights = [(-1.0) ** k / factorial(2 * k + order) for k in range(TERMS)]
    series = np.polynomial.Polynomial(weights)
    safe = np.maximum(squared, 1.0)
    length = np.sqrt(safe)
    if order == 2:
        value = (1.0 - np.cos(length)) / safe
        slope = (np.sin(length) / (2.0 * length) - value) / safe
    else:
        value = (length - np.sin(length)) / (safe * length)
        slope = ((1.0 - np.cos(length)) / (2.0 * safe) - 1.5 * value) / safe
    near = squared <= 1.0
    return np.where(near, series(small), value), np.where(near, series.deriv()(small), slope)
