"""Parasitic elements, held against ranks at points of the platform that the search does not know."""

import numpy as np
import pytest

from assur.topology.analysis import sample
from assur.topology.counting.parasitic import least_dependent, parasitic_elements
from assur.topology.notation import parse_chains
from assur.topology.screws.placing import place
from assur.topology.screws.twists import in_platform

LEFT, RIGHT = "R[-0.5,0.8660254037844386,0]", "R[0.5,0.8660254037844386,0]"
EXACT = 1e-6
LIMBS = {
    "P[x] U[x,y]": 0,
    "U[x,y] P[z]": 0,
    "R[x] S": 0,
    "S R[x]": 0,
    "R[x] R[y] R[y] R[y]": 0,
    "R[x] R[y]": 1,
    "R[z] U[x,y] U[x,y]": 1,
}
PLATFORMS = [
    (["R[y] P[z] S", f"{LEFT} P[z] S", f"{RIGHT} P[z] S"], 1),
    (["U[x@O,y] P[z] R[y]", "U[x@O,y] P[z] R[y]", "S P[z] R[x]"], 2),
    (["R[z] R[z] R[z]", "R[z] R[z]"], 0),
    (["P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]"], 0),
]


def home_of(texts):
    return sample(place(parse_chains(texts)))


def dependent_at(space, point):
    """t + r - dim at a point of the frame that twists (N, 6, k) stand in, by rank."""
    moved = space[:, 3:] + np.cross(space[:, :3], point, axisa=1, axisb=0, axisc=1)
    count = [np.linalg.matrix_rank(part, tol=EXACT).max() for part in (moved, space[:, :3])]
    return sum(count) - space.shape[-1]


@pytest.mark.parametrize(("text", "number"), LIMBS.items())
def test_limbs_that_are_virtual_chains_have_none(text, number):
    home = home_of([text])
    assert parasitic_elements(home.linkage, home.values, home.space) == number


@pytest.mark.parametrize(("texts", "number"), PLATFORMS)
def test_no_point_by_chance_has_fewer_than_are_said(texts, number):
    home = home_of(texts)
    assert parasitic_elements(home.linkage, home.values, home.space) == number
    space = in_platform(home.linkage, home.values, home.space)
    assert all(dependent_at(space, point) >= number for point in np.random.default_rng(1).normal(size=(20, 3)))


def test_a_3_rps_has_its_one_at_a_ball_joint():
    home = home_of(PLATFORMS[0][0])
    centre = home.linkage.joints["S1"].point - home.linkage.point
    space = in_platform(home.linkage, home.values, home.space)
    assert dependent_at(space, centre) == 1
    assert dependent_at(space, centre + 0.1) == 2


def test_what_is_more_than_asked_for_is_said_to_be_more():
    home = home_of(PLATFORMS[1][0])
    assert least_dependent(in_platform(home.linkage, home.values, home.space), most=0) == 1
