import pytest

from assur.topology.notation import parse_chain
from assur.topology.symbolic.at_home import at_home
from assur.topology.symbolic.elementary import elementary
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spaces import rotations, translations


def _at_home(text):
    return at_home(elementary(parse_chain(text).elements, None))


@pytest.mark.parametrize(
    ("text", "t", "r"),
    [
        ("R[z] R[x] R[z]", 1, 2),
        ("R[z]@A R[x] R[z]@A", 0, 2),
        ("P[x] R[z] P[x]", 1, 1),
        ("U[x,y] P[z] U[y,x]", 3, 2),
        ("R[x] R[y] R[0.6,0.8,0]", 1, 2),
        ("R[x] R[y] R[z]", 0, 3),
        ("S R[x]", 1, 3),
    ],
)
def test_the_motion_space_as_written(text, t, r):
    found = _at_home(text)
    assert (translations(found).dim, rotations(found).dim) == (t, r)


def test_three_axes_through_a_point_and_in_one_plane_are_refused():
    assert isinstance(_at_home("R[x]@A R[y]@A R[0.6,0.8,0]@A"), Refusal)
