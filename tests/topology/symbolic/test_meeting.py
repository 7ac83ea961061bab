import pytest

from assur.topology.notation import parse_chain
from assur.topology.symbolic.elementary import elementary
from assur.topology.symbolic.meeting import GENERAL, meeting


def _meeting(text):
    return meeting(elementary(parse_chain(text).elements, None))


def _share(text, first, second):
    lines = _meeting(text).lines
    return bool(lines[first].points & lines[second].points)


@pytest.mark.parametrize(
    ("text", "first", "second", "shared"),
    [
        ("R[x]@A R[y]@A", 0, 1, True),
        ("R[x] R[y]", 0, 1, False),
        ("R[x]@A R[y]@B", 0, 1, False),
        ("U[x,y]", 0, 1, True),
        ("S", 0, 2, True),
        # another axis between moves the point off
        ("R[x]@A R[y] R[z]@A", 0, 2, False),
        ("R[x]@A R[y]@B R[z]@A", 0, 2, False),
        # so does a slide, unless it is along one of the two axes
        ("R[x]@A P[z] R[y]@A", 0, 1, False),
        ("R[x]@A P[x] R[y]@A", 0, 1, True),
        ("R[x]@A P[y] R[y]@A", 0, 1, True),
        ("R[x]@A P[x] P[z] R[y]@A", 0, 1, False),
        ("R[x]@A P(4R)[x] R[y]@A", 0, 1, False),
        ("R[y]@A C[x]@A", 0, 1, True),
        # the point moves along the second axis, away from the first
        ("R[x]@A R[y]@A P[y] R[z]@A", 0, 2, False),
        ("R[x]@A R[y]@A P[y] R[z]@A", 1, 2, True),
    ],
)
def test_which_axes_keep_meeting(text, first, second, shared):
    assert _share(text, first, second) == shared


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("R[z]@A R[z]@A", 1),
        ("R[z]@A P[z] R[z]@A", 1),
        ("R[z]@A P[x] R[z]@A", 2),
        ("R[z]@A P[z] R[z]", 2),
        ("U[x,y]@A R[y]@A", 2),
        ("R[z]@A R[x]@A R[z]@A", 3),
    ],
)
def test_coaxial_turns_are_one_line(text, lines):
    assert len(set(_meeting(text).lines)) == lines


@pytest.mark.parametrize("text", ["R[z] P[x]", "R[z] P[1,0,1]", "S P[x]", "R[z] P(4R)[x]", "P[x] P[y]"])
def test_the_last_axis_does_not_keep_a_point_that_slides_off(text):
    assert _meeting(text).end == GENERAL


@pytest.mark.parametrize("text", ["R[z]", "R[z] P[z]", "C[z]", "S", "U[x,y]", "R[x]@A R[y]@A"])
def test_the_last_axis_keeps_a_point_that_does_not_leave_it(text):
    found = _meeting(text)
    assert found.end in found.lines[-1].points


def test_at_a_labelled_centre_all_axes_keep_it():
    found = _meeting("R[x]@A R[y]@A")
    assert all(found.end in line.points for line in found.lines)
