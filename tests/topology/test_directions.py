"""Directions and the subspaces that they span: lattice laws against NumPy, and slips of the pen."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.topology.directions import complement, contains, meet, near_slips, parallel, perpendicular, span, unit

AXES = [unit(v) for v in [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, 0, -1), (1, 2, 3), (-1, 0, 0)]]
some = st.lists(st.sampled_from(AXES), max_size=4)


@given(some, some)
def test_dimensions_of_sum_and_meeting_add_up(first, second):
    one, two, both = span(first), span(second), span([*first, *second])
    assert len(one) + len(two) == len(both) + len(meet(one, two))
    assert len(both) == np.linalg.matrix_rank(np.array([*first, *second]).reshape(-1, 3)) if first or second else True


@given(some)
def test_the_complement_is_perpendicular_and_complete(vectors):
    basis = span(vectors)
    rest = complement(basis)
    assert len(basis) + len(rest) == 3
    assert np.allclose(basis @ rest.T, 0)
    assert all(contains(basis, vector) for vector in vectors)
    assert not any(contains(basis, unit(row)) for row in rest)


def test_parallel_in_either_sense():
    assert parallel((1, 0, 0), (-1, 0, 0))
    assert not parallel((1, 0, 0), unit((1, 1e-6, 0)))
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
