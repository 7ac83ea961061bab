"""Determinants over component arrays, against LAPACK and against exact integers."""

import numpy as np
import pytest

from assur.errors import UsageError
from assur.numerics.small_matrices import determinant


@pytest.mark.parametrize("size", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("batch", [(), (1,), (7,), (3, 1, 2), (0,)])
def test_agrees_with_lapack(size, batch):
    matrices = np.random.default_rng(size).normal(size=(*batch, size, size))
    rows = [[matrices[..., r, k] for k in range(size)] for r in range(size)]
    found = determinant(rows)
    assert found.shape == batch
    np.testing.assert_allclose(found, np.linalg.det(matrices), rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("size", [1, 2, 3])
def test_plain_zeros_anywhere_change_nothing(size):
    rng = np.random.default_rng(11)
    for pattern in range(1, 2 ** (size * size)):
        keep = np.array([pattern >> bit & 1 for bit in range(size * size)], dtype=bool).reshape(size, size)
        numbers = rng.integers(1, 9, size=(2, size, size)) * keep
        rows = [[numbers[:, r, k] * 1.0 if keep[r, k] else 0 for k in range(size)] for r in range(size)]
        np.testing.assert_array_equal(determinant(rows), np.rint(np.linalg.det(numbers)))


def test_entries_broadcast():
    column, row = np.arange(1.0, 4.0).reshape(3, 1), np.arange(5.0, 7.0)
    found = determinant([[column, 1.0], [2, row]])
    np.testing.assert_array_equal(found, column * row - 2)


def test_shape_is_that_of_all_entries_even_where_a_zero_hides_them():
    assert determinant([[0, 0], [np.ones(4), 1.0]]).shape == (4,)


@pytest.mark.parametrize("rows", [[], [[1.0, 2.0]], [[1.0], [2.0]], [[1.0, 2.0], [3.0]]])
def test_refuses_what_is_not_square(rows):
    with pytest.raises(UsageError, match="square"):
        determinant(rows)
