"""Turns about axes through one point: all ways in which they make a rotation together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.limbs.point_closure import CLOSE, point_closure
from assur.kinematics.limbs.serial import ElementaryMotion, displacement
from assur.numerics import rotations

FloatArray = NDArray[np.float64]


def concurrent_turns(motions: Sequence[ElementaryMotion], rotation: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Joint values (K, k) of turns that make a rotation (3, 3), and by how much (K,) roots were made real for them.

    The turns before the last one take its axis to where it is to be; the last one then does the rest.

    Errors:
        MovingLimbError: there are infinitely many.

    >>> axes = np.eye(3)[[2, 1, 0]]
    >>> turns = [ElementaryMotion("turn", axis, np.zeros(3), k, 1) for k, axis in enumerate(axes)]
    >>> values, _ = concurrent_turns(turns, rotations.from_angles(0.3, 0.2, 0.1))
    >>> sorted(values.round(6).tolist())
    [[-2.841593, 2.941593, -3.041593], [0.3, 0.2, 0.1]]
    """
    if not motions:
        fits = bool(np.linalg.norm(rotation - np.eye(3)) < CLOSE)
        return np.zeros((int(fits), 0)), np.zeros(int(fits))
    *before, last = (replace(motion, point=np.zeros(3)) for motion in motions)
    closure = point_closure(before, last.axis, rotation @ last.axis, 1.0)
    rows, bent = [], []
    for values, own in zip(closure.values, closure.bent, strict=True):
        rest = rotation
        for motion, value in zip(before, values, strict=True):
            rest = displacement(motion, value)[0].T @ rest
        vector = rotations.to_vector(rest)
        missed = float(np.linalg.norm(rotations.cross(vector, last.axis)))
        if missed < CLOSE:
            rows.append([*values, last.sense * (vector @ last.axis)])
            bent.append(max(own, missed))
    return np.array(rows).reshape(len(rows), len(motions)), np.array(bent)


def ball_values(ball: ElementaryMotion, rotation: FloatArray) -> FloatArray:
    """The rotation vector (3,) of a ball joint that makes a rotation (3, 3)."""
    own = ball.axis @ rotation @ ball.axis.T
    return rotations.to_vector(own if ball.sense > 0 else own.T)


def along(line: FloatArray, end: FloatArray) -> FloatArray:
    """A rotation (3, 3) that takes one direction onto another, also onto the opposite one."""
    start, end = line / np.linalg.norm(line), end / np.linalg.norm(end)
    if start @ end > -0.5:
        return rotations.taking(start, end)
    across = rotations.cross(start, np.eye(3)[np.argmin(np.abs(start))])
    half_turn = rotations.about_axis(across / np.linalg.norm(across), np.asarray(np.pi))
    return np.asarray(rotations.taking(-start, end) @ half_turn)
