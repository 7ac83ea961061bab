"""Polynomials as sequences of coefficients, constant term first: algebra over any number type, and all roots of floats.

The algebra is used by kernels: coefficients may be arrays, intervals, symbols, dual numbers, and a plain 0 or 1. The
roots are found outside the kernels, for whole batches. A polynomial in the cosine and the sine of an angle becomes
one in t = tan(angle/2) by `half_angle`; there a root at infinity is the angle pi, which `angle_of` gives back.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import zip_longest
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Number = Any
Polynomial = Sequence[Number]
FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

NOTHING = 1e-200
"""A coefficient smaller than this part of the largest counts as zero."""
POLISHING = 6


def add(a: Polynomial, b: Polynomial) -> tuple[Number, ...]:
    """Sum a + b.

    >>> add((1, 2), (0, 1, 5))
    (1, 3, 5)
    """
    return tuple(_sum(first, second) for first, second in zip_longest(a, b, fillvalue=0))


def subtract(a: Polynomial, b: Polynomial) -> tuple[Number, ...]:
    """Difference a - b."""
    return add(a, scaled(b, -1))


def scaled(a: Polynomial, factor: Number) -> tuple[Number, ...]:
    """Product of a polynomial and a number."""
    return tuple(_product(factor, part) for part in a)


def multiply(a: Polynomial, b: Polynomial) -> tuple[Number, ...]:
    """Product a b.

    >>> multiply((1, 1), (1, -1))
    (1, 0, -1)
    """
    total: list[Number] = [0] * (len(a) + len(b) - 1)
    for i, first in enumerate(a):
        for j, second in enumerate(b):
            total[i + j] = _sum(total[i + j], _product(first, second))
    return tuple(total)


def half_angle(terms: Mapping[tuple[int, int], Number], degree: int) -> tuple[Number, ...]:
    """The polynomial in t = tan(angle/2), of degree 2 `degree`, of a polynomial in the cosine and the sine.

    Args:
        terms: (i, j) -> factor of cos^i sin^j; i + j is at most `degree`.
        degree: of the polynomial in cosine and sine; all is multiplied by (1 + t^2)^degree.

    Example: 3 cos + 4 sin = 5.

    >>> half_angle({(1, 0): 3, (0, 1): 4, (0, 0): -5}, 1)
    (-2, 8, -8)
    """
    total: tuple[Number, ...] = (0,) * (2 * degree + 1)
    for (i, j), factor in terms.items():
        basis: tuple[Number, ...] = (1,)
        for part, times in (((1, 0, -1), i), ((0, 2), j), ((1, 0, 1), degree - i - j)):
            for _ in range(times):
                basis = multiply(basis, part)
        total = add(total, scaled(basis, factor))
    return total


def _nothing(value: Number) -> bool:
    return type(value) is int and value == 0


def _sum(a: Number, b: Number) -> Number:
    return b if _nothing(a) else a if _nothing(b) else a + b


def _product(a: Number, b: Number) -> Number:
    return 0 if _nothing(a) or _nothing(b) else a * b


def roots(coefficients: ArrayLike) -> ComplexArray:
    """All complex roots (..., d) of polynomials (..., d + 1), the constant term first; multiple roots as often.

    Eigenvalues of companion matrices in a scaled unknown, then Aberth's simultaneous Newton steps, each taken only
    where it makes the polynomial smaller. Leading coefficients that are zero give infinite roots, which stand last;
    a polynomial that is zero everywhere, or not finite, gives NaN.

    >>> roots([2.0, -3.0, 1.0, 0.0]).real
    array([ 1.,  2., inf])
    """
    given = np.asarray(coefficients, dtype=float)
    degree = given.shape[-1] - 1
    flat = given.reshape(-1, degree + 1)
    largest = np.max(np.abs(flat), axis=-1, initial=0.0)
    sound = np.isfinite(largest) & (largest > 0)
    present = (np.abs(flat) > NOTHING * largest[:, None]) & sound[:, None]
    all_roots = np.full((len(flat), degree), complex(np.nan, np.nan))
    low, high = np.argmax(present, axis=-1), degree - np.argmax(present[:, ::-1], axis=-1)
    for first, last in {(int(a), int(b)) for a, b in zip(low[sound], high[sound], strict=True)}:
        rows = sound & (low == first) & (high == last)
        all_roots[rows, last:] = complex(np.inf, 0)
        all_roots[rows, :first] = 0
        all_roots[rows, first:last] = _finite_roots(flat[rows, first : last + 1])
    return all_roots.reshape((*given.shape[:-1], degree))


def _finite_roots(coefficients: FloatArray) -> ComplexArray:
    """Roots (N, d) of polynomials (N, d + 1) whose first and last coefficients are not zero."""
    degree = coefficients.shape[-1] - 1
    if degree == 0:
        return np.zeros((len(coefficients), 0), dtype=complex)
    ends = np.frexp(coefficients[:, [0, -1]])[1]
    power = np.rint((ends[:, 0] - ends[:, 1]) / degree).astype(int)  # the unknown is 2^power times the scaled one
    shifts = power[:, None] * np.arange(degree + 1)
    top = np.max(np.frexp(coefficients)[1] + shifts, axis=-1, keepdims=True)
    even = np.ldexp(coefficients, shifts - top)
    companion = np.zeros((len(even), degree, degree))
    companion[:, np.arange(1, degree), np.arange(degree - 1)] = 1.0
    companion[:, :, -1] = -even[:, :-1] / even[:, -1:]
    polished = approached(np.linalg.eigvals(companion).astype(complex), lambda at: _values(even, at))
    return np.asarray(np.sort_complex(polished) * np.exp2(power.astype(float))[:, None])


def approached(
    points: ComplexArray, values: Callable[[ComplexArray], tuple[FloatArray, ComplexArray]], steps: int = POLISHING
) -> ComplexArray:
    """Roots (..., d) of polynomials after Aberth's steps from points near them.

    A step that does not make the polynomial smaller is not taken; points that are not finite stay.

    Args:
        points: all roots of each polynomial, nearly.
        values: at points (..., d) the polynomial's size, and its derivative over it.
        steps: at most so many.
    """
    value, logarithmic = values(points)
    other = ~np.eye(points.shape[-1], dtype=bool) & np.isfinite(points)[..., None, :]
    for _ in range(steps):
        gaps = points[..., :, None] - points[..., None, :]
        push = np.sum(np.where(other & (gaps != 0), 1 / np.where(gaps == 0, 1, gaps), 0), axis=-1)
        denominator = logarithmic - push
        usable = (value > 0) & np.isfinite(denominator) & (denominator != 0)
        moved = points - np.where(usable, 1 / np.where(usable, denominator, 1), 0)
        new_value, new_logarithmic = values(moved)
        better = new_value < value
        if not np.any(better):
            break
        points = np.where(better, moved, points)
        value, logarithmic = np.where(better, new_value, value), np.where(better, new_logarithmic, logarithmic)
    return points


def _values(coefficients: FloatArray, at: ComplexArray) -> tuple[FloatArray, ComplexArray]:
    """|p| / max(1, |t|)^d and p'/p at points (N, d); beyond 1 through the reversed polynomial, so nothing overflows."""
    degree = coefficients.shape[-1] - 1
    far = np.abs(at) > 1
    safe = np.where(at == 0, 1, at)
    near_it = np.where(far, 1 / safe, at)
    value, slope = np.zeros_like(at), np.zeros_like(at)
    for k in range(degree, -1, -1):
        slope = slope * near_it + value
        value = value * near_it + np.where(far, coefficients[:, degree - k, None], coefficients[:, k, None])
    ratio = slope / np.where(value == 0, 1, value)
    return np.abs(value), np.where(far, (degree - near_it * ratio) / safe, ratio)


def angle_of(tangents: ComplexArray) -> ComplexArray:
    """The angles whose half has these tangents, real parts in (-pi, pi]; pi at infinity, no real angle at +-i.

    >>> (angle_of(roots([1.0, -1.0, 0.0])) / np.pi).round(12).real
    array([0.5, 1. ])
    """
    infinite = np.isinf(tangents)
    finite = np.where(infinite, 0, tangents)
    poles = (finite == 1j) | (finite == -1j)
    angle = 2 * np.arctan(np.where(poles, 0, finite))
    angle = np.where(infinite | (angle.real <= -np.pi), np.pi + 1j * angle.imag, angle)
    return np.asarray(np.where(poles, np.inf * 1j, angle))


def nearness(
    coefficients: ArrayLike, points: ComplexArray, rounding: ArrayLike
) -> tuple[NDArray[np.bool_], NDArray[np.intp]]:
    """Whether roots (..., d) of polynomials (..., d + 1) may be real, and how many roots lie where each may lie.

    Nobody can tell polynomials apart whose coefficients differ by less than `rounding` (..., d + 1). From the real
    point x below a root, m roots are at most s away; if

        |a_d| prod_k max(|x - t_k|, s) <= sum_j rounding_j |x|^j,

    one of these polynomials has about x a root m times. So a root whose own distance is such an s may be real; the
    number is the largest such m, at least 1. Distances are chords of the circle of which the real line is an image, so
    that infinity is a point as any other. Where the polynomial vanishes or is not finite nothing is real.

    Returns:
        may_be_real (..., d), count (..., d): a root that may be real and is alone is a simple real one.

    Example: a double root, split by rounding, a simple one and a complex pair.

    >>> coefficients = np.polynomial.polynomial.polyfromroots([2, 2, -1, 1j, -1j]).real
    >>> real, count = nearness(coefficients, roots(coefficients), 1e-14 * np.abs(coefficients))
    >>> sorted(count[real].tolist()), int(real.sum())
    ([1, 2, 2], 3)
    """
    given = np.asarray(coefficients, dtype=float)
    degree = given.shape[-1] - 1
    flat, all_roots = given.reshape(-1, degree + 1), points.reshape(-1, degree)
    change = np.broadcast_to(np.asarray(rounding, dtype=float), given.shape).reshape(flat.shape)
    with np.errstate(all="ignore"):
        largest = np.max(np.abs(flat), axis=-1, keepdims=True, initial=0.0)
        flat, change = flat / largest, change / largest
        far = np.isinf(all_roots)
        finite = np.where(far, 0, all_roots)
        length = np.where(far, 1, np.sqrt(1 + np.abs(finite) ** 2))
        # points (1, t) / sqrt(1 + |t|^2), and below each root a real one, (cosine, sine)
        first_part, second_part = np.where(far, 0, 1 / length), np.where(far, 1, finite / length)
        beyond = np.abs(all_roots) > 1
        nearer = np.where(far, 0, np.where(beyond, 1 / np.where(finite == 0, 1, finite), finite))
        angle = np.arctan2(2 * nearer.real, 1 - np.abs(nearer) ** 2)[:, :, None] / 2
        turned = beyond[:, :, None]
        cosine = np.where(turned, np.sin(angle), np.cos(angle))
        sine = np.where(turned, np.cos(angle), np.sin(angle))
        chords = np.abs(cosine * second_part[:, None] - sine * first_part[:, None])  # (N, root, from each root)
        last = np.take_along_axis(np.abs(flat), (degree - np.sum(far, axis=-1))[:, None], axis=-1)
        size = last * np.prod(length, axis=-1, keepdims=True)
        powers = np.arange(degree + 1)
        bound = np.sum(change[:, None] * np.abs(cosine ** (degree - powers) * sine**powers), axis=-1)
        levels = np.sort(chords, axis=-1)
        reached = np.prod(np.maximum(levels[:, :, None], levels[..., None]), axis=-1) * size[..., None]
        products = np.prod(np.maximum(chords, np.diagonal(chords, axis1=1, axis2=2)[..., None]), axis=-1) * size
        real = products <= bound
        count = np.maximum(np.sum(reached <= bound[..., None], axis=-1), 1)
    return real.reshape(points.shape), count.reshape(points.shape)
