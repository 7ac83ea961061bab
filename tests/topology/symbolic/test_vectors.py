from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.topology import directions
from assur.topology.directions import unit
from assur.topology.symbolic.vectors import aligned, coplanar, cross, dot, normal, plane_basis, rotated, square

units = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1).map(unit)


@given(units, units)
def test_products_and_relations_are_those_of_arrays(first, second):
    assert np.allclose(cross(first, second), np.cross(first, second), atol=1e-15)
    assert dot(first, second) == pytest.approx(np.dot(first, second), abs=1e-15)
    assert aligned(first, second) == directions.parallel(first, second)
    assert square(first, second) == directions.perpendicular(first, second)


@given(units)
def test_a_plane_basis_is_orthonormal_and_perpendicular(axis):
    rows = np.array([axis, *plane_basis(axis)])
    assert np.allclose(rows @ rows.T, np.eye(3), atol=1e-12)


@given(units, units, st.floats(-6, 6))
def test_turning_back_gives_the_vector_again(vector, axis, angle):
    assert rotated(rotated(vector, axis, angle), axis, -angle) == pytest.approx(vector, abs=1e-12)
    assert dot(rotated(vector, axis, angle), axis) == pytest.approx(dot(vector, axis), abs=1e-12)


def test_three_vectors_in_a_plane():
    x, y, z = np.eye(3).tolist()
    assert coplanar(tuple(x), tuple(y), unit((1, 1, 0)))
    assert not coplanar(tuple(x), tuple(y), tuple(z))
    assert normal(tuple(x), tuple(y)) == (0.0, 0.0, 1.0)
