import numpy as np
import pytest

from assur.synthesis.home_constraints import BESIDE, constraints_of, home_twists, together
from assur.synthesis.required import PARASITIC
from assur.topology.notation import parse_chain

RISING = PARASITIC["1T2R"]
AS_WRITTEN = np.eye(3)


def constraints(text, seed=1):
    return constraints_of(home_twists(parse_chain(text), AS_WRITTEN, seed))


@pytest.mark.parametrize(
    ("text", "forces", "couples"),
    [
        ("R[y] P[z] S", "y", ""),
        ("P[z] R[y] S", "y", ""),
        ("S P[z] R[x]", "x", ""),
        ("U[x,y] P[z] R[y]", "y", "z"),
        ("U[x,y] P[z] S", "", ""),
        ("P[x] P[y] R[z]", "z", "xy"),
        ("C[x] P[y] R[x]", "", "yz"),
    ],
)
def test_directions_of_forces_and_couples_are_those_known_by_hand(text, forces, couples):
    """A limb with an S pushes through it along its R; U and R with parallel axes in a plane hold its turn about z."""
    met = constraints(text)
    for basis, axes in ((met.forces, forces), (met.couples, couples)):
        expected = np.diag([float(axis in axes) for axis in "xyz"])
        assert np.allclose(basis @ basis.T, expected)
    assert met.key == constraints(text, 2).key


def test_a_limb_allows_a_motion_that_it_does_not_resist():
    assert constraints("R[y] P[z] S").allows(RISING)
    assert not constraints("R[z] P[x] S").allows(RISING), "it pushes along z"
    assert not constraints("P[x] P[y] R[z]").allows(RISING)


def test_three_forces_across_z_leave_a_translation_and_two_rotations():
    turns = [np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]]) for a in (0, 2.1, 4.2)]
    limb = parse_chain("R[y] P[z] S")
    wrenches = [constraints_of(home_twists(limb, turn, slot)).wrenches for slot, turn in enumerate(turns)]
    assert together(wrenches).leave(RISING)
    assert not together(wrenches[:2]).leave(RISING)


def test_an_axis_on_a_line_that_limbs_share_runs_through_a_point_of_it():
    limb = parse_chain("U[x,y] P[z] R[y]")
    for end, column, point in (("base", 0, np.zeros(3)), ("platform", 3, BESIDE)):
        for seed in (1, 2):
            twists = home_twists(limb, AS_WRITTEN, seed, end)
            assert np.allclose(twists[3:, column], np.cross(point, twists[:3, column]))
    assert np.linalg.norm(home_twists(limb, AS_WRITTEN, 1)[3:, 0]) > 0.1


def test_two_limbs_on_one_line_resist_less_together():
    limb = parse_chain("U[x,y] P[z] R[y]")
    apart = together([constraints_of(home_twists(limb, AS_WRITTEN, slot)).wrenches for slot in (0, 1)])
    on_line = together([constraints_of(home_twists(limb, AS_WRITTEN, slot, "base")).wrenches for slot in (0, 1)])
    assert (len(apart.wrenches), len(on_line.wrenches)) == (3, 2)
