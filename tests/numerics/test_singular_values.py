"""Closed forms of singular values beside LAPACK: random, nearly equal, graded and singular matrices."""

import numpy as np
import pytest
import sympy

from assur.errors import UsageError
from assur.numerics import singular_values as closed
from assur.numerics.number_types import Floats, Symbols
from assur.numerics.recording.tape import Recorder
from assur.numerics.singular_values import (
    condition_index,
    float_condition_index,
    largest_eigenvalue,
    largest_singular_value,
)

COUNT = 20_000
LARGEST_ERROR = 2e-14
"""As the module says."""


def rows_of(matrices):
    return [[matrices[..., r, c] for c in range(matrices.shape[-1])] for r in range(matrices.shape[-2])]


def matrices(size, spread, seed=3):
    """Matrices (N, k, k) with singular values that are told by `spread`(rng, N, k)."""
    rng = np.random.default_rng(seed)
    left, right = (np.linalg.qr(rng.normal(size=(COUNT, size, size)))[0] for _ in range(2))
    return np.einsum("nij,nj,nkj->nik", left, spread(rng, COUNT, size), right)


def spreads():
    def random(rng, count, size):
        return 10 ** rng.uniform(-1, 1, (count, size))

    def graded(rng, count, size):
        return 10 ** rng.uniform(-4, 4, (count, size))

    def nearly_equal(rng, count, size):
        return 1 - 10 ** rng.uniform(-16, -2, (count, size))

    def two_large(rng, count, size):
        values = np.sort(rng.uniform(0.1, 1, (count, size)))[:, ::-1].copy()
        values[:, 1] = values[:, 0] * (1 - 10 ** rng.uniform(-16, -6, count))
        return values

    def two_small(rng, count, size):
        values = np.sort(rng.uniform(0.1, 1, (count, size)))[:, ::-1].copy()
        values[:, -1] = values[:, -2] * (1 - 10 ** rng.uniform(-16, -6, count))
        return values

    return {item.__name__: item for item in (random, graded, nearly_equal, two_large, two_small)}


@pytest.mark.parametrize(
    ("size", "spread"),
    [
        pytest.param(size, spread, id=f"{size}-{name}")
        for size in (1, 2, 3)
        for name, spread in spreads().items()
        if size > 1 or not name.startswith("two")  # there is one value only
    ],
)
def test_agrees_with_lapack_within_the_stated_error(size, spread):
    given = matrices(size, spread)
    largest = np.linalg.svd(given, compute_uv=False)[:, 0]
    found = np.broadcast_to(largest_singular_value(Floats(), rows_of(given)), largest.shape)
    np.testing.assert_allclose(found, largest, rtol=LARGEST_ERROR, atol=0)


def test_the_polynomial_is_the_cosine_of_a_third():
    angle = np.linspace(0, np.pi, 100_001)
    np.testing.assert_allclose(closed._third(np.cos(angle / 2)), np.cos(angle / 3), rtol=2e-15, atol=0)


def test_the_discriminant_is_the_product_of_squared_gaps():
    x, y, d, e, f = sympy.symbols("x y d e f")
    s = sympy.Matrix([[x, d, e], [d, y, f], [e, f, 0]])
    t = sympy.Symbol("t")
    wanted = sympy.discriminant(s.charpoly(t).as_expr(), t)
    assert sympy.expand(closed._discriminant(x, y, d, e, f) - wanted) == 0


def test_largest_eigenvalue_where_eigenvalues_meet_and_where_all_are_negative():
    rng = np.random.default_rng(0)
    turn = np.linalg.qr(rng.normal(size=(COUNT, 3, 3)))[0]
    for values in ([1.0, 1.0, 0.2], [1.0, 0.2, 0.2], [-1.0, -1.0, -3.0], [-1.0, -2.0, -2.0], [2.0, 0.0, -2.0]):
        s = np.einsum("nij,j,nkj->nik", turn, values, turn)
        entries = [s[:, r, c] for r, c in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
        found = largest_eigenvalue(Floats(), entries)
        np.testing.assert_allclose(found, max(values), atol=LARGEST_ERROR * max(map(abs, values)))


@pytest.mark.parametrize("size", [1, 2, 3, 4])
def test_condition_index_is_that_of_the_quotient(size):
    rng = np.random.default_rng(size)
    a, b = rng.normal(size=(2, COUNT, size, size))
    sizes = np.linalg.svd(np.linalg.solve(a, b), compute_uv=False)
    index, smallest = float_condition_index(rows_of(a), rows_of(b))
    np.testing.assert_allclose(index, sizes[:, -1] / sizes[:, 0], rtol=1e-7, atol=1e-13)
    np.testing.assert_allclose(smallest, sizes[:, -1], rtol=1e-7, atol=1e-13)
    assert np.median(np.abs(index * sizes[:, 0] / sizes[:, -1] - 1)) < 1e-13


@pytest.mark.parametrize("size", [1, 2, 3, 4])
@pytest.mark.parametrize("which", [(1, 0), (0, 1), (1, 1)])
def test_singular_matrices_have_index_zero(size, which):
    first, second = (np.diag([1.0] * (size - 1) + [1.0 - zero]) for zero in which)
    index, smallest = float_condition_index(rows_of(first[None]), rows_of(second[None]))
    assert index == 0
    assert (smallest == 0) == bool(which[1])


def test_zeros_isotropic_and_plain_entries():
    assert float(largest_singular_value(Floats(), [[0.0, 0, 0], [0, 0, 0], [0, 0, 0]])) == 0
    assert float(largest_singular_value(Floats(), [[2.0, 0, 0], [0, 2.0, 0], [0, 0, 2.0]])) == 2
    assert float(largest_singular_value(Floats(), [[0.0, -3.0], [0, 0]])) == 3
    assert float(largest_singular_value(Floats(), [[-3.0]])) == 3


def test_two_by_two_over_symbols_is_exact():
    a = sympy.Matrix([[1, 2], [3, 4]])
    square = largest_singular_value(Symbols(), a.tolist()) ** 2
    assert abs(float(sympy.N(square * square - 30 * square + 4, 30))) < 1e-12


def test_recorded_has_the_bits_of_floats():
    given = matrices(3, spreads()["random"])
    other = matrices(3, spreads()["random"], seed=4)
    recorder = Recorder()
    cells = [recorder.varying(f"m{k}") for k in range(18)]
    square = [[cells[9 * m + 3 * r : 9 * m + 3 * r + 3] for r in range(3)] for m in range(2)]
    index, smallest = condition_index(recorder, *square)
    found = recorder.tape({"index": index, "smallest": smallest}).evaluate(
        [*given.reshape(COUNT, 9).T, *other.reshape(COUNT, 9).T], []
    )
    wanted = float_condition_index(rows_of(given), rows_of(other))
    np.testing.assert_array_equal(found["index"], wanted[0])
    np.testing.assert_array_equal(found["smallest"], wanted[1])


@pytest.mark.parametrize("rows", [[], [[1.0, 2.0]], [[1.0] * 4] * 4])
def test_refuses_other_sizes(rows):
    with pytest.raises(UsageError, match="rows of"):
        largest_singular_value(Floats(), rows)
