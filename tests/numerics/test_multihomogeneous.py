"""Roots on a product of lines: their number is the permanent, elimination finds the same, curves are noticed."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from assur.numerics.multihomogeneous import monomial_count, multihomogeneous, root_count

TRIANGLE = ((3, 3, 1), (1, 3, 3), (3, 1, 3))


def _random(seed: int, *shapes: tuple[int, ...]) -> list[np.ndarray]:
    rng = np.random.default_rng(seed)
    return [rng.normal(size=shape) + 1j * rng.normal(size=shape) for shape in shapes]


def _values(equations: list[np.ndarray], roots: np.ndarray) -> np.ndarray:
    """Every equation (k) at every root (N, n), divided by the sum of its terms' sizes."""
    found = []
    for part in equations:
        powers = np.array(list(np.ndindex(part.shape)))
        terms = part.ravel() * np.prod(roots[:, None] ** powers, axis=-1)
        found.append(np.sum(terms, axis=1) / np.sum(np.abs(terms), axis=1))
    return np.abs(np.array(found))


@pytest.mark.parametrize(
    ("shapes", "count"),
    [
        ([(4,)], 3),
        ([(3, 3), (3, 3)], 8),
        ([(2, 1), (2, 3)], 2),  # the second unknown occurs in one equation only
        (TRIANGLE, 16),
        ([(3, 3, 1), (1, 3, 3), (3, 3, 3)], 24),
        ([(2, 2, 2, 2)] * 4, 24),
    ],
)
def test_there_are_as_many_roots_as_the_permanent_says(shapes: list[tuple[int, ...]], count: int) -> None:
    equations = _random(len(shapes), *shapes)
    found = multihomogeneous(equations)
    assert found.isolated
    assert found.error < 1e-12
    assert len(found.values) == found.count == root_count(np.array(shapes) - 1) == count
    assert np.max(_values(equations, found.values)) < 1e-10
    gaps = np.linalg.norm(found.values[:, None] - found.values[None], axis=-1) + 9 * np.eye(count)
    assert np.min(gaps) > 1e-3


def test_elimination_finds_the_same() -> None:
    first, second = _random(7, (3, 3), (3, 3))
    places = np.exp(2j * np.pi * np.arange(9) / 9)  # Sylvester's determinant has degree 8 in x
    rows = [np.einsum("kj,k->j", part, place ** np.arange(3)) for place in places for part in (first, second)]
    shifted = [[[*row, 0], [0, *row]] for row in rows]
    determinants = [np.linalg.det(np.concatenate(pair)) for pair in zip(shifted[::2], shifted[1::2], strict=True)]
    expected = Polynomial(np.fft.fft(determinants) / 9).roots()
    ours = multihomogeneous([first, second]).values[:, 0]
    assert len(ours) == len(expected) == 8
    assert np.max(np.min(np.abs(ours[:, None] - expected), axis=1)) < 1e-9


def test_a_double_root_comes_twice_and_one_at_infinity_not_at_all() -> None:
    square = np.array([[1, -2, 1], [0, 0, 0]])  # (y - 1)^2, no x
    line = np.array([[-3, 1, 0], [1, 0, 0]])  # x + y = 3
    found = multihomogeneous([np.ascontiguousarray(square[:1]), line[:, :2]])
    assert found.count == 2
    np.testing.assert_allclose(found.values, [[2.0, 1.0]] * 2, atol=1e-6)
    steep = np.array([[1, 0], [0, 1]]), np.array([[-2, 1], [0, 0]])[:1]  # x y = -1, y = 2
    assert multihomogeneous(list(steep)).values.real.round(9).tolist() == [[-0.5, 2.0]]
    away = np.array([[1, 1], [0, 1]]), np.array([[1, 1]])  # 1 + y + x y = 0, 1 + y = 0: x is zero
    assert len(multihomogeneous(list(away)).values) == 0


def test_a_curve_of_roots_is_noticed() -> None:
    first, second, _ = _random(1, *TRIANGLE)
    assert not multihomogeneous([first, second, first]).isolated


def test_three_distances_need_64_monomials() -> None:
    assert monomial_count(np.array(TRIANGLE) - 1) == 64
