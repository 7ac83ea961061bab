import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.topology.directions import unit
from assur.topology.symbolic.spans import ALL, NOTHING, Span, along, plane_across
from examples import examples

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
DIRECTIONS = (X, Y, Z, unit((1, 1, 0)), unit((0.3, 0.5, 0.8)))

directions = st.sampled_from(DIRECTIONS)
steps = st.lists(st.tuples(st.sampled_from(["direction", "line", "line in plane", "turn", "turn freely"]), directions))


def _built(steps):
    span = Span()
    for name, direction in steps:
        match name:
            case "direction":
                span = span.with_direction(direction)
            case "line":
                span = span.with_line()
            case "line in plane":
                span = span.with_line(in_plane=direction)
            case "turn":
                span = span.turned(direction)
            case "turn freely":
                span = span.turned(None)
    return span


def _turn(rng, axis):
    if axis is None:
        return np.linalg.qr(rng.normal(size=(3, 3)))[0]
    k = np.cross(np.eye(3), axis)
    angle = rng.uniform(0.3, 2.8)
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def _drawn(steps, rng):
    """The same steps done to vectors: what the span stands for at one moment."""
    vectors = np.zeros((0, 3))
    for name, direction in steps:
        match name:
            case "direction":
                vectors = np.vstack([vectors, direction])
            case "line":
                vectors = np.vstack([vectors, rng.normal(size=3)])
            case "line in plane":
                vectors = np.vstack([vectors, np.cross(direction, rng.normal(size=3))])
            case "turn":
                vectors = vectors @ _turn(rng, direction)
            case "turn freely":
                vectors = vectors @ _turn(rng, None)
    return vectors


def _rank(vectors):
    return int(np.linalg.matrix_rank(vectors, tol=1e-7)) if len(vectors) else 0


@examples(300)
@given(steps, st.integers(0, 10**6))
def test_a_span_has_the_rank_of_what_it_stands_for(steps, seed):
    assert _built(steps).dim == _rank(_drawn(steps, np.random.default_rng(seed)))


@examples(300)
@given(steps, directions, st.integers(0, 10**6))
def test_what_a_span_contains_it_contains_at_every_moment(steps, direction, seed):
    span = _built(steps)
    vectors = _drawn(steps, np.random.default_rng(seed))
    assert span.contains(direction) == (_rank(np.vstack([vectors, direction])) == span.dim)


@examples(300)
@given(steps, steps, st.integers(0, 10**6))
def test_sum_and_meet_have_the_ranks_of_what_they_stand_for(first, second, seed):
    one, other = _built(first), _built(second)
    rng = np.random.default_rng(seed)
    a, b = _drawn(first, rng), _drawn(second, rng)
    together = _rank(np.vstack([a, b]))
    assert one.with_span(other).dim == together
    assert one.meet(other).dim == _rank(a) + _rank(b) - together


@given(steps)
def test_the_complement_of_the_complement_is_the_span(steps):
    span = _built(steps)
    back = span.complement.complement
    assert span.complement.dim == 3 - span.dim
    assert (back.dim, len(back.fixed), back.plane is None) == (span.dim, len(span.fixed), span.plane is None)
    assert all(back.contains(direction) for direction in span.fixed)


@given(steps, directions)
def test_a_slide_along_the_axis_of_a_turn_stays(steps, direction):
    span = _built(steps).with_direction(direction)
    assert span.turned(direction).contains(direction)


def test_two_lines_that_turn_in_one_plane_make_it():
    assert NOTHING.with_line(in_plane=Y).with_line(in_plane=Y).contains_plane(Y)


def test_two_lines_that_turn_in_different_planes_make_a_plane_that_turns():
    span = NOTHING.with_line(in_plane=Y).with_line(in_plane=Z)
    assert (span.dim, span.fixed, span.complement) == (2, (), Span((), 1))


@pytest.mark.parametrize(
    ("span", "axis", "fixed", "turning", "plane"),
    [
        (along(Z), Z, 1, 0, None),
        (along(X), Z, 0, 1, Z),
        (along(unit((1, 0, 1))), Z, 0, 1, None),
        (plane_across(Z), Z, 2, 0, None),
        (plane_across(X), Z, 1, 1, None),
        (plane_across(unit((1, 0, 1))), Z, 0, 2, None),
        (Span((), 1, Z), Z, 0, 1, Z),
        (Span((), 1, X), Z, 0, 1, None),
        (ALL, None, 3, 0, None),
        (plane_across(Z), None, 0, 2, None),
    ],
)
def test_what_a_turn_leaves_fixed(span, axis, fixed, turning, plane):
    turned = span.turned(axis)
    assert (len(turned.fixed), turned.turning, turned.plane) == (fixed, turning, plane)


def test_a_plane_that_contains_the_axis_keeps_that_line():
    assert plane_across(X).turned(Z).fixed == (Z,)
