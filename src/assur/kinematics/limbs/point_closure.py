"""Turns and slides, three at most, that take a point to where it is to be: all of them, complex ones counted.

M1(q1) M2(q2) M3(q3) p = p'. What M1 leaves as it is of a point, its place along the axis and its distance from a point
of that, or its two coordinates across a slide, is known of M2 M3 p: two equations in q2 and q3, in each of which the
unknowns of M2 are at most squared. Their resultant is a polynomial of q3 alone (D. L. Pieper 1968).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.limbs.serial import ElementaryMotion, applied, displacement
from assur.numerics.rotations import cross

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

SAMPLES = 32
"""Places at which a resultant is read: more than the 17 coefficients that it can have."""
VANISHING = 1e-9
"""Part of the largest below which a coefficient is rounding."""
REAL = 1e-3
"""A root this near to a real one is tried: parts of a double root come out some 1e-8 apart, of a triple one 1e-5."""
DOUBTFUL = 1e-6
"""What is bent by more than this may belong to a double root, or to none."""
STEPS = 3
"""Newton steps from a root to a solution: of one that is known to half of the digits two lead to all of them."""
ROUNDING = 1e-11
"""By so much a solution misses its place at most, in sizes."""
ON_AXIS = 1e-6
"""Part of the limb's size up to which a point lies on an axis, so that turning about it moves nothing."""
CLOSE = 1e-2
"""Part of the limb's size by which a point may miss its place for Newton's method to be asked: a root that is tried as
a real one misses it by as much as it was bent."""


class MovingLimbError(Exception):
    """A limb closes in infinitely many ways, or nearly so."""

    def __init__(self) -> None:
        super().__init__("a limb closes in infinitely many ways, or nearly so")


@dataclass(frozen=True, eq=False)
class PointClosure:
    """All ways to take a point to its place.

    Attributes:
        values: (K, k) joint values of the k motions.
        bent: (K,) by how much a root was made real, or the point misses its place.
        roots: how many complex roots were looked at.
    """

    values: FloatArray
    bent: FloatArray
    roots: int


def point_closure(
    motions: Sequence[ElementaryMotion], point: FloatArray, place: FloatArray, size: float
) -> PointClosure:
    """Values of three motions or fewer that take a point (3,) to its place (3,), the last motion acting first.

    `size` is a length to which the limb's points compare.

    Errors:
        MovingLimbError: there are infinitely many.

    Example: two links of length 1 in a plane reach (1, 1) in two ways.

    >>> axis = np.array([0.0, 0.0, 1.0])
    >>> links = [ElementaryMotion("turn", axis, np.array([k, 0.0, 0.0]), k, 1) for k in (0.0, 1.0)]
    >>> closure = point_closure(links, np.array([2.0, 0.0, 0.0]), np.array([1.0, 1.0, 0.0]), 1.0)
    >>> np.degrees(sorted(closure.values.tolist())).round(6) + 0.0
    array([[  0.,  90.],
           [ 90., -90.]])
    """
    if not motions:
        stays = int(np.linalg.norm(point - place) < CLOSE * size)
        return PointClosure(np.zeros((stays, 0)), np.zeros(stays), 1)
    first, *others = motions
    values, bent = np.zeros((1, 0)), np.zeros(1)
    looked = 1
    if len(others) == 2:
        polynomial = _resultant(motions, point, place, size)
        roots, bent = _roots(others[1], polynomial, size)
        values = roots[:, None]
        looked = len(polynomial) - 1
    if others:
        points = _followed(others[1:], values, point)
        pieces = [(np.zeros((0, len(others))), np.zeros(0))]
        for k, polynomials in enumerate(zip(*_kept(first, others[0], points, place, size), strict=True)):
            for own, more in _each(others[0], polynomials, size):
                last = np.broadcast_to(values[k], (len(own), len(others) - 1))
                pieces.append((np.column_stack([own, last]), np.maximum(more, bent[k])))
        values, bent = (np.concatenate(part) for part in zip(*pieces, strict=True))
        looked *= 2
    points = _followed(others, values, point)
    whole = np.column_stack([_taking(first, points, place), values])
    missed = np.linalg.norm(_followed(motions, whole, point) - place, axis=-1) / size
    whole, bent, points = whole[missed < CLOSE], bent[missed < CLOSE], points[missed < CLOSE]
    if first.kind == "turn" and np.any(_from_axis(first, points) < ON_AXIS * size):
        raise MovingLimbError
    whole, missed = _polished(motions, whole, point, place, size)
    return PointClosure(whole, np.where(missed < ROUNDING, 0.0, np.maximum(bent, missed)), looked)


def _polished(
    motions: Sequence[ElementaryMotion], values: FloatArray, point: FloatArray, place: FloatArray, size: float
) -> tuple[FloatArray, FloatArray]:
    """Values (N, k) after some Newton steps, and by how much (N,) the point then misses its place, in sizes.

    A resultant may have a solution as a double root that is none, which is known to half of the digits only.
    """
    for _ in range(STEPS):
        moved = np.broadcast_to(point, (len(values), 3))
        columns: list[FloatArray] = []
        for motion, column in reversed([*zip(motions, values.T, strict=True)]):
            rotation, shift = displacement(motion, column)
            moved = (rotation @ moved[..., None])[..., 0] + shift
            columns = [(rotation @ own[..., None])[..., 0] for own in columns]
            rate = np.broadcast_to(motion.axis, moved.shape)
            rate = rate if motion.kind == "slide" else cross(motion.axis, moved - motion.point)
            columns.insert(0, motion.sense * rate)
        slopes = np.stack(columns, axis=-1) / [size if motion.kind == "turn" else 1.0 for motion in motions]
        steps = np.linalg.pinv(slopes, rcond=VANISHING) @ ((place - moved) / size)[..., None]
        values = values + steps[..., 0] * [1.0 if motion.kind == "turn" else size for motion in motions]
    return values, np.linalg.norm(_followed(motions, values, point) - place, axis=-1) / size


def distance_closure(motion: ElementaryMotion, point: FloatArray, other: FloatArray, distance: float) -> PointClosure:
    """Values of a motion that bring a point (3,) to a distance from another (3,). Errors: MovingLimbError.

    >>> slide = ElementaryMotion("slide", np.array([1.0, 0.0, 0.0]), np.zeros(3), 0, 1)
    >>> sorted(distance_closure(slide, np.array([0.0, 3.0, 0.0]), np.zeros(3), 5.0).values.ravel().round(9).tolist())
    [-4.0, 4.0]
    """
    size = max(distance, float(np.max(np.abs(point - other))), float(np.max(np.abs(motion.point - other))))
    about = ElementaryMotion("turn", np.array([0.0, 0.0, 1.0]), other, motion.index, 1)
    place = other + distance * about.axis
    polynomial = _kept(about, motion, point[None], place, size)[1][0]
    if not _depends(motion, polynomial):
        if abs(polynomial[_constant(motion)]) < CLOSE:
            raise MovingLimbError
        return PointClosure(np.zeros((0, 1)), np.zeros(0), 2)
    values, bent = _roots(motion, polynomial, size)
    return PointClosure(values[:, None], bent, 2)


def _followed(motions: Sequence[ElementaryMotion], values: FloatArray, points: FloatArray) -> FloatArray:
    """Points (3,) or (N, 3) moved by motions with values (N, k), the last one first."""
    moved = np.broadcast_to(points, (len(values), 3))
    for motion, column in reversed([*zip(motions, values.T, strict=True)]):
        moved = applied(motion, column, moved)
    return moved


def _from_axis(motion: ElementaryMotion, points: FloatArray) -> FloatArray:
    """Distances (N,) of points (N, 3) from the line of a motion."""
    return np.asarray(np.linalg.norm(cross(points - motion.point, motion.axis), axis=-1))


def _taking(motion: ElementaryMotion, points: FloatArray, place: FloatArray) -> FloatArray:
    """How far (N,) a motion goes that takes points (N, 3) as near to a place as it can."""
    if motion.kind == "slide":
        return np.asarray(motion.sense * ((place - points) @ motion.axis))
    before, after = points - motion.point, place - motion.point
    sine = cross(before, after) @ motion.axis
    cosine = before @ after - (before @ motion.axis) * (after @ motion.axis)
    return np.asarray(motion.sense * np.arctan2(sine, cosine))


def _kept(
    first: ElementaryMotion, middle: ElementaryMotion, points: FloatArray, place: FloatArray, size: float
) -> tuple[ComplexArray, ComplexArray]:
    """Two polynomials (N, 3) each of M2 at points (N, 3): what M1 leaves of M2 p is that of the place.

    Coefficients of the powers 0, 1, 2 of exp(i q2) for a turn, of q2 in sizes for a slide.
    """
    along, constant, across = _parts(middle, points, size)
    if first.kind == "slide":
        rows = np.linalg.svd(first.axis[None])[2][1:]
        start, end = constant, place / size
        one, two = (_polynomial(middle, along @ row, (start - end) @ row, across @ row) for row in rows)
        return one, two
    start, end = constant - first.point / size, (place - first.point) / size
    axis = first.axis
    one = _polynomial(middle, along @ axis, (start - end) @ axis, across @ axis)
    more = _dot(start, start) - end @ end
    if middle.kind == "turn":  # M2 p = start + along cos + across sin, of which the two last are equal and square
        more = more + _dot(along, along)
        return one, _polynomial(middle, 2 * _dot(start, along), more, 2 * _dot(start, across))
    return one, _polynomial(middle, 2 * _dot(start, along), more, np.ones(len(points)))


def _parts(motion: ElementaryMotion, points: FloatArray, size: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """M p of points (N, 3) in sizes: (N, 3) times the cosine, constant, times the sine; or times q, constant, none."""
    if motion.kind == "slide":
        along = np.broadcast_to(motion.sense * motion.axis, points.shape)
        return along, points / size, np.zeros(points.shape)
    offset = points - motion.point
    kept = (offset @ motion.axis)[..., None] * motion.axis
    return (offset - kept) / size, (motion.point + kept) / size, motion.sense * cross(motion.axis, offset) / size


def _polynomial(motion: ElementaryMotion, along: FloatArray, constant: FloatArray, across: FloatArray) -> ComplexArray:
    """Of a cos q + c + b sin q, times exp(i q); or of c + a q + b q^2."""
    if motion.kind == "slide":
        return np.stack([constant, along, across], axis=-1).astype(complex)
    return np.stack([0.5 * (along + 1j * across), constant + 0j, 0.5 * (along - 1j * across)], axis=-1)


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(np.sum(a * b, axis=-1))


def _resultant(motions: Sequence[ElementaryMotion], point: FloatArray, place: FloatArray, size: float) -> ComplexArray:
    """Coefficients of the powers of exp(i q3), or of q3 in sizes: where both equations of M2 have a common root.

    It is read at places all around the circle; its coefficients are their Fourier transform.
    """
    first, middle, last = motions
    angles = 2 * np.pi * np.arange(SAMPLES) / SAMPLES
    places = angles if last.kind == "turn" else size * np.exp(1j * angles)
    f, g = _kept(first, middle, applied(last, places, np.broadcast_to(point, (SAMPLES, 3))), place, size)
    (f0, f1, f2), (g0, g1, g2) = f.T, g.T
    if np.max(np.abs([f2, g2])) < VANISHING:
        values = f1 * g0 - f0 * g1
    else:
        values = (f2 * g0 - f0 * g2) ** 2 - (f2 * g1 - f1 * g2) * (f1 * g0 - f0 * g1)
    powers = np.fft.fft(values) / SAMPLES
    if last.kind == "turn":
        powers = np.roll(powers, SAMPLES // 2)
    largest = np.max(np.abs(powers))
    if largest < VANISHING:
        raise MovingLimbError
    used = np.flatnonzero(np.abs(powers) > VANISHING * largest)
    return np.asarray(powers[used[0] : used[-1] + 1] if last.kind == "turn" else powers[: used[-1] + 1])


def _each(
    motion: ElementaryMotion, polynomials: Sequence[ComplexArray], size: float
) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Real roots of those polynomials (3,) that depend on the motion."""
    depending = [own for own in polynomials if _depends(motion, own)]
    if not depending and max(abs(own[_constant(motion)]) for own in polynomials) < CLOSE:
        raise MovingLimbError
    for own in depending:
        yield _roots(motion, own, size)


def _depends(motion: ElementaryMotion, polynomial: ComplexArray) -> bool:
    return bool(np.max(np.abs(np.delete(polynomial, _constant(motion)))) > VANISHING)


def _constant(motion: ElementaryMotion) -> int:
    """Where the coefficient stands that no motion changes."""
    return 1 if motion.kind == "turn" else 0


def _roots(motion: ElementaryMotion, powers: ComplexArray, size: float) -> tuple[FloatArray, FloatArray]:
    """Values (K,) of a motion at roots that are nearly real, and by how much (K,) they are not."""
    roots = np.roots(powers[::-1])
    if motion.kind == "slide":
        bent, values = np.abs(roots.imag), roots.real * size
    else:
        roots = roots[roots != 0]
        bent, values = np.abs(np.log(np.abs(roots))), np.angle(roots)
    return values[bent < REAL], bent[bent < REAL]
