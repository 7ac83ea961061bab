"""Directions in brackets: what they mean, and that they read back to the last digit."""

import math

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from assur.topology.directions import unit
from assur.topology.notation import NotationError, parse_chain
from assur.topology.notation.brackets import direction, direction_text, read_directions
from assur.topology.notation.errors import Source

numbers = st.floats(-1e3, 1e3) | st.floats(allow_nan=False, allow_infinity=False) | st.integers(-9, 9).map(float)


def read(text):
    return [placed.vector for placed in read_directions(Source(text), text, 0, len(text))]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x", [(1, 0, 0)]),
        ("-y", [(0, -1, 0)]),
        (" + Z ", [(0, 0, 1)]),
        ("0,0,-2", [(0, 0, -1)]),
        (".6, 0, 8e-1", [(0.6, 0, 0.8)]),
        ("x,-y", [(1, 0, 0), (0, -1, 0)]),
        ("x;0,3.,4", [(1, 0, 0), (0, 0.6, 0.8)]),
        ("3,0,4,x", [(0.6, 0, 0.8), (1, 0, 0)]),
        ("1,0,0; 0,1,0", [(1, 0, 0), (0, 1, 0)]),
    ],
)
def test_directions(text, expected):
    assert read(text) == [pytest.approx(vector, abs=1e-15) for vector in expected]


@given(st.tuples(numbers, numbers, numbers).filter(any))
@example((5e-324, 0.0, 0.0))
@example((1.7e308, -1.7e308, 1.7e308))
@example((1.0, 2.0, 0.0))
@example((0.6, 0.8, 1e-15))
def test_a_direction_reads_back_to_the_last_digit(parts):
    vector = direction(parts)
    assert math.hypot(*vector) == pytest.approx(1, abs=4e-15)
    largest = max(map(abs, parts))
    assert [part * largest for part in vector] == pytest.approx(
        [part / math.hypot(*(other / largest for other in parts)) for part in parts], rel=1e-12, abs=1e-13 * largest
    )
    assert read(direction_text(vector)) == [vector]


@given(st.tuples(*[st.integers(-9, 9)] * 3).filter(any))
def test_whole_numbers_stay_short(parts):
    assert len(direction_text(unit(parts))) <= 2 or len(read(direction_text(unit(parts)))) == 1


def test_truncated_digits_of_three_fold_symmetry_are_accepted():
    text = "R[1,0,0] R[0.5,0.866,0] R[-0.5,0.866,0] P[-0.866,0.5,0] P[y]"
    axes = [joint.axes[0] for joint in parse_chain(text).joints]
    assert axes[1] == pytest.approx((0.5, math.sqrt(3) / 2, 0), abs=2e-5)
    assert all(math.hypot(*axis) == pytest.approx(1, abs=1e-15) for axis in axes)


@pytest.mark.parametrize(
    ("text", "column", "hint"),
    [
        ("R[0,5,0,866,0]", 8, "decimal points"),
        ("R[0,5;0,866;0]", 8, "decimal points"),
        ("R[0,5,0,866,0,0]", 8, "decimals"),
        ("R[1,2]", 2, "three numbers"),
        ("R[1,,0]", 4, "three numbers"),
        ("R[]", 2, "[x]"),
        ("R[xy]", 2, "[x,y]"),
        ("R[1,y,0]", 4, "three numbers"),
        ("R[1/2,0,0]", 2, "decimal points"),
        ("R[0.5 0.866 0]", 2, "three numbers"),
        ("R[0,0,0]", 2, "not zero"),
        ("R[-0,0.0,0e9]", 2, "not zero"),
        ("R[nan,0,0]", 2, "[x]"),
        ("R[1e999,0,0]", 2, ""),
        ("R[x,y]", 4, "point"),
        ("U[x]", 2, "U[x,y]"),
        ("U[x,y,z]", 6, "U[x,y]"),
        ("U[(1,0,0),(0,1,0)]", 2, "[x,y]"),
        ("S[x]", 2, ""),
        ("P(4R)[x,y]", 8, "point"),
        ("R[x][y]", 4, ""),
    ],
)
def test_what_is_no_direction(text, column, hint):
    with pytest.raises(NotationError) as error:
        parse_chain(text)
    assert error.value.position == column
    assert hint in error.value.hint
