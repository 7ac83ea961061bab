"""Vectors of components: against NumPy in batches, exactly with fractions, and as identities in SymPy."""

from fractions import Fraction

import numpy as np
import pytest
import sympy

from assur.numerics import rotations, vectors
from assur.numerics.dual import Dual
from assur.numerics.intervals.interval import Interval
from assur.numerics.number_types import Floats

RNG = np.random.default_rng(7)
A, B, C = RNG.normal(size=(3, 3, 5))  # three batches of five vectors, components first
ANGLES = RNG.uniform(-np.pi, np.pi, size=(2, 5))
PAIRS = [(np.cos(angle), np.sin(angle)) for angle in ANGLES]
EXACT = (Fraction(3, 5), Fraction(4, 5))


def columns(vector):
    return np.stack(np.broadcast_arrays(*vector), axis=-1)


def matrices(matrix):
    """A matrix of components as an array (5, 3, 3)."""
    rows = [columns([np.broadcast_to(entry, (5,)) for entry in row]) for row in matrix]
    return np.stack(rows, axis=-2)


@pytest.mark.parametrize(
    ("found", "expected"),
    [
        (vectors.add(A, B), A + B),
        (vectors.subtract(A, B), A - B),
        (vectors.scaled(A, 2.5), 2.5 * A),
        (vectors.dot(A, B), np.einsum("ik,ik->k", A, B)),
        (vectors.cross(A, B), np.cross(A, B, axis=0)),
        (vectors.length(Floats(), A), np.linalg.norm(A, axis=0)),
        (vectors.triple(A, B, C), np.linalg.det(np.stack([A.T, B.T, C.T], axis=-2))),
    ],
    ids=["add", "subtract", "scaled", "dot", "cross", "length", "triple"],
)
def test_agrees_with_numpy(found, expected):
    np.testing.assert_allclose(np.array(found), expected, rtol=1e-13, atol=1e-14)


def test_products_of_matrices_and_vectors_agree_with_numpy():
    first, second = RNG.normal(size=(2, 3, 3))
    np.testing.assert_allclose(vectors.apply(first, A), first @ A, rtol=1e-13)
    np.testing.assert_allclose(vectors.product(first, second), first @ second, rtol=1e-13)
    np.testing.assert_array_equal(vectors.transposed(first), first.T)


@pytest.mark.parametrize(("about", "axis"), [(vectors.about_x, 0), (vectors.about_y, 1), (vectors.about_z, 2)])
def test_rotations_about_axes_are_right_handed(about, axis):
    np.testing.assert_allclose(
        matrices(about(PAIRS[0])), rotations.about_axis(np.eye(3)[axis], ANGLES[0]), rtol=0, atol=1e-15
    )


def test_rotation_of_a_quaternion():
    quaternion = RNG.normal(size=(5, 4))
    quaternion /= np.linalg.norm(quaternion, axis=-1, keepdims=True)
    found = matrices(vectors.of_quaternion(*quaternion.T))
    np.testing.assert_allclose(found, rotations.from_quaternion(quaternion), rtol=0, atol=1e-14)


def test_rotation_of_a_quaternion_is_exact_over_fractions():
    half = Fraction(1, 2)
    assert vectors.of_quaternion(half, half, half, half) == ((0, 0, 1), (1, 0, 0), (0, 1, 0))


def test_sums_and_differences_of_angles():
    total, rest = vectors.sum_of_angles(*PAIRS), vectors.difference_of_angles(*PAIRS)
    for found, angle in ((total, ANGLES[0] + ANGLES[1]), (rest, ANGLES[0] - ANGLES[1])):
        np.testing.assert_allclose(found, (np.cos(angle), np.sin(angle)), rtol=0, atol=1e-15)
    assert vectors.sum_of_angles(EXACT, EXACT) == (Fraction(-7, 25), Fraction(24, 25))
    assert vectors.sum_of_angles(EXACT, vectors.opposite(EXACT)) == (1, 0)
    assert vectors.difference_of_angles(EXACT, EXACT) == (1, 0)


def test_smallest_rotation_agrees_with_that_of_arrays():
    for start, end in zip(A.T, B.T, strict=True):
        start, end = start / np.linalg.norm(start), end / np.linalg.norm(end)
        found = np.array(vectors.taking(tuple(start), tuple(end)))
        # near the opposite direction, where there is no smallest rotation, rounding errors grow as the denominator says
        allowed = 1e-15 / (1 + start @ end) + 1e-15
        np.testing.assert_allclose(found, rotations.taking(start, end), rtol=0, atol=allowed)
        np.testing.assert_allclose(found @ found.T, np.eye(3), rtol=0, atol=2 * allowed)


def test_smallest_rotation_is_exact_over_fractions():
    start = (Fraction(1, 3), Fraction(2, 3), Fraction(2, 3))
    end = (Fraction(2, 7), Fraction(-3, 7), Fraction(6, 7))
    turned = vectors.taking(start, end)
    assert vectors.apply(turned, start) == end
    assert vectors.product(turned, vectors.transposed(turned)) == ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    axis = vectors.cross(start, end)
    assert vectors.apply(turned, axis) == axis


def test_identities_hold_for_symbols():
    a, b, c = (sympy.symbols(f"{name}:3") for name in "abc")
    right = vectors.subtract(vectors.scaled(b, vectors.dot(a, c)), vectors.scaled(c, vectors.dot(a, b)))
    difference = vectors.subtract(vectors.cross(a, vectors.cross(b, c)), right)
    assert [sympy.expand(entry) for entry in difference] == [0, 0, 0]
    assert sympy.expand(vectors.triple(a, b, c) - sympy.Matrix([a, b, c]).det()) == 0


def test_dual_numbers_carry_derivatives_through():
    angle = 0.3
    turn = (Dual(np.cos(angle), -np.sin(angle)), Dual(np.sin(angle), np.cos(angle)))
    x, y, _ = vectors.apply(vectors.about_z(turn), (2.0, 1.0, 0.0))
    assert float(x.derivative) == pytest.approx(-float(y.value), abs=1e-15)
    assert float(y.derivative) == pytest.approx(float(x.value), abs=1e-15)


def test_integer_zeros_stay_exact_beside_intervals():
    x = Interval.of(0.1)
    product = vectors.product(((x, 0, 0), (0, 1, 0), (0, 0, 1)), ((1, 0, 0), (0, x, 0), (0, 0, 1)))
    assert [[type(entry) for entry in row] for row in product] == [
        [Interval, int, int],
        [int, Interval, int],
        [int, int, int],
    ]
    assert product[0][0] is x
