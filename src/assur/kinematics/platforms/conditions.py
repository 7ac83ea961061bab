"""What a limb, or a pose that leaves coordinates open, says of the platform: linear forms and quadrics of its soma.

They are read from poses that are drawn: what is zero at all of these is zero at all that the limb allows, since its
poses are an irreducible variety. So nothing is recognised by the names of joints: a leg on two ball joints says one
quadric, a ball joint that moves on a circle five, three turns eight, a planar limb twenty-six.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.kinematics.limbs.serial import SerialLimb, composed, displacement
from assur.kinematics.platforms.soma import PAIRS, SIZE, STUDY, products, soma_of, spheres
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
Draw = Callable[[int, np.random.Generator], Frame]

SAMPLES = 2 * len(PAIRS)
ZERO = 1e-11
"""Singular values of drawn poses, the largest being 1, that are rounding."""
INDEPENDENT = 1e-9
"""Those of conditions of length 1 that are: they are known to fewer digits."""
SURE = 1e3
"""By how much the smallest that is not must be above that."""


class UncertainConditionsError(Exception):
    """Whether something holds at all poses of a limb cannot be told from rounding."""

    def __init__(self) -> None:
        super().__init__("what limbs say of the platform cannot be told from rounding")


@dataclass(frozen=True, eq=False)
class Conditions:
    """Linear forms (k, 8) and quadrics (r, 36) that are zero, orthonormal; without Study's quadric."""

    linear: FloatArray
    quadrics: FloatArray

    @cached_property
    def spheres(self) -> FloatArray:
        """Quadrics (s, 36) among them that are sums of |p|^2, p, R' p, R and 1."""
        _, _, right = np.linalg.svd(np.concatenate([spheres(), STUDY[None]]))
        others = right[len(spheres()) + 1 :]
        left, sizes, _ = np.linalg.svd(self.quadrics @ others.T)
        return np.asarray(left[:, np.sum(sizes > INDEPENDENT) :].T @ self.quadrics)


def series_conditions(limb: SerialLimb, size: float) -> Conditions:
    """Of a series of joints; places are in lengths `size`. Errors: UncertainConditionsError.

    >>> from assur.kinematics.limbs.networks import limbs_of
    >>> from assur.model.registry import load_record
    >>> series_conditions(limbs_of(load_record("planar_3rrr"))[0], 1.0).linear.shape
    (4, 8)
    """
    return conditions_at(partial(_drawn_series, limb, size), size)


def series_points(limb: SerialLimb, size: float, count: int, rng: np.random.Generator) -> FloatArray:
    """Soma (count, 8) of poses by chance."""
    rotation, place = _drawn_series(limb, size, count, rng)
    return soma_of((rotation, place / size))


def orientation_conditions(rotation: FloatArray) -> Conditions:
    """Of a platform that does not turn, in an orientation (3, 3).

    >>> orientation_conditions(np.eye(3)).linear.shape
    (3, 8)
    """
    stands = soma_of((rotation[None], np.zeros((1, 3))))[:, : SIZE // 2]
    across = np.linalg.svd(stands)[2][1:]
    return Conditions(np.concatenate([across, np.zeros_like(across)], axis=1), np.zeros((0, len(PAIRS))))


def _drawn_series(limb: SerialLimb, size: float, count: int, rng: np.random.Generator) -> Frame:
    frames = np.broadcast_to(limb.zero[0], (count, 3, 3)), np.broadcast_to(limb.zero[1], (count, 3))
    for motion in reversed(limb.motions):
        if motion.kind == "ball":
            turned = drawn_rotations(rng, count)
            step = turned, motion.point - turned @ motion.point
        else:
            reach = size if motion.kind == "slide" else np.pi
            step = displacement(motion, rng.uniform(-reach, reach, count))
            if motion.kind == "screw":  # as a turn and a slide, which is all that can be said by polynomials
                step = step[0], step[1] + rng.uniform(-size, size, (count, 1)) * motion.axis
        frames = composed(step, frames)
    return frames


def conditions_at(draw: Draw, size: float) -> Conditions:
    """What holds at all frames of the platform that `draw` gives. Errors: UncertainConditionsError."""
    rotation, place = draw(SAMPLES, np.random.default_rng(0))
    return conditions_of(soma_of((rotation, place / size)))


def conditions_of(soma: NDArray[np.inexact]) -> Conditions:
    """What holds at all coordinates (N, 8), which may be complex. Errors: UncertainConditionsError."""
    rows = soma / np.linalg.norm(soma, axis=1, keepdims=True)
    quadrics = _zero_at(products(rows))
    return Conditions(_zero_at(rows), _independent(quadrics - np.outer(quadrics @ STUDY, STUDY)))


def joined(conditions: Iterable[Conditions]) -> Conditions:
    """All of them at once. Errors: UncertainConditionsError, where some are nearly the same."""
    parts = [*conditions]
    linear = np.concatenate([np.zeros((0, SIZE)), *(own.linear for own in parts)])
    quadrics = np.concatenate([np.zeros((0, len(PAIRS))), *(own.quadrics for own in parts)])
    return Conditions(_independent(linear), _independent(quadrics))


def drawn_rotations(rng: np.random.Generator, count: int) -> FloatArray:
    """Rotations (count, 3, 3) by chance."""
    drawn = rng.normal(size=(count, 4))
    return rotations.from_quaternion(drawn / np.linalg.norm(drawn, axis=1, keepdims=True))


def _zero_at(rows: NDArray[np.inexact]) -> FloatArray:
    """What (k, n) is zero at all rows (N, n), more of them than n."""
    _, sizes, right = np.linalg.svd(np.concatenate([rows.real, rows.imag]))
    return np.asarray(right[_rank(sizes / sizes[0], ZERO) :])


def _independent(rows: FloatArray) -> FloatArray:
    """An orthonormal basis of rows of length 1."""
    _, sizes, right = np.linalg.svd(rows, full_matrices=False)
    return np.asarray(right[: _rank(sizes, INDEPENDENT)])


def _rank(sizes: FloatArray, zero: float) -> int:
    rank = int(np.sum(sizes > zero))
    if rank and sizes[rank - 1] < SURE * zero:
        raise UncertainConditionsError
    return rank
