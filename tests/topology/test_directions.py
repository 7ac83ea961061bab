"""Directions: vector algebra against NumPy, what they span, and slips of the pen."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.topology.directions import (
    AXES,
    coplanar,
    cross,
    dot,
    near_slips,
    normal,
    parallel,
    perpendicular,
    plane_basis,
    rotated,
    span,
    unit,
)

WRITTEN = [unit(v) for v in [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, 0, -1), (1, 2, 3), (-1, 0, 0)]]
units = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1).map(unit)


@given(units, units)
def test_products_are_those_of_arrays(first, second):
    assert np.allclose(cross(first, second), np.cross(first, second), atol=1e-15)
    assert dot(first, second) == pytest.approx(np.dot(first, second), abs=1e-15)


@given(units)
def test_a_plane_basis_is_orthonormal_and_perpendicular(axis):
    rows = np.array([axis, *plane_basis(axis)])
    assert np.allclose(rows @ rows.T, np.eye(3), atol=1e-12)


@given(units, units, st.floats(-6, 6))
def test_turning_back_gives_the_vector_again(vector, axis, angle):
    assert rotated(rotated(vector, axis, angle), axis, -angle) == pytest.approx(vector, abs=1e-12)
    assert dot(rotated(vector, axis, angle), axis) == pytest.approx(dot(vector, axis), abs=1e-12)


def test_three_vectors_in_a_plane():
    x, y, z = AXES
    assert coplanar(x, y, unit((1, 1, 0)))
    assert not coplanar(x, y, z)
    assert normal(x, y) == (0.0, 0.0, 1.0)


@given(st.lists(st.sampled_from(WRITTEN), max_size=4))
def test_a_span_has_the_rank_of_its_vectors_and_contains_them(vectors):
    basis, rows = span(vectors), np.array(vectors, dtype=float).reshape(-1, 3)
    assert len(basis) == (np.linalg.matrix_rank(rows) if vectors else 0)
    assert np.allclose(rows @ basis.T @ basis, rows)


def test_parallel_in_either_sense():
    assert parallel((1, 0, 0), (-1, 0, 0))
    assert not parallel((1, 0, 0), unit((1, 1e-6, 0)))
    assert not parallel(None, None)
    assert perpendicular((1, 0, 0), (0, 1, 0))
    assert not perpendicular((1, 0, 0), unit((1e-6, 1, 0)))


def test_no_direction_in_the_zero_vector():
    with pytest.raises(ZeroDivisionError):
        unit((0, 0, 0))


@pytest.mark.parametrize(
    ("vector", "found"), [((1, 1e-4, 0), "parallel"), ((1e-4, 1, 0), "perpendicular"), ((1, 1, 0), ""), ((0, 0, 1), "")]
)
def test_near_slips(vector, found):
    assert [kind for _, _, kind in near_slips([(1.0, 0.0, 0.0), unit(vector)])] == ([found] if found else [])
