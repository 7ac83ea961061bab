"""Lines and points that end axes of universal joints share: seen in places alone, as in files of mechanisms."""

import dataclasses

import numpy as np
import pytest

from assur.topology.analysis import analyse
from assur.topology.notation import parse_chains
from assur.topology.screws.placing import place
from assur.topology.screws.recognition import recognised

EXECHON = ["U[x@O,y] P[z] R[y]", "U[x@O,y] P[z] R[y]", "S P[z] R[x]"]
WRIST = [
    "U[x@O; 0,1,1] P[0,1,-1] U[0,1,1; 1,2,0@O]",
    "U[y@O; 1,0,1] P[1,0,-1] U[1,0,1; 0,1,2@O]",
    "U[z@O; 1,1,0] P[1,-1,0] U[1,1,0; 2,0,1@O]",
]


def _labels(limbs, end):
    chains = recognised(place(parse_chains(limbs)))
    return [chain.elements[end].points_on(end) for chain in chains]


def test_first_axes_on_one_line():
    first, second, third = _labels(EXECHON, 0)
    assert first == second != () == third


def test_axes_of_base_and_platform_that_meet_in_one_point():
    assert len({*_labels(WRIST, 0), *_labels(WRIST, -1)}) == 1


@pytest.mark.parametrize(
    "limbs", [["U[x,y] P[z] R[y]"] * 3, ["U[x,y] P[z] R[y]", "U[y,z] P[x] R[z]", "U[z,x] P[y] R[x]"]]
)
def test_axes_that_do_not_meet(limbs):
    assert _labels(limbs, 0) == [(), (), ()]


@pytest.mark.parametrize(
    ("limbs", "numbers"),
    [(EXECHON, (3, 2, 3)), (["U[x@O,y] P[z] R[y]", "U[x@O,y] P[z] R[y]", "R[x] P[z] U[x,y]"], (3, 2, 3))],
)
def test_the_rules_know_what_is_seen(limbs, numbers):
    found = analyse(place(parse_chains(limbs), actuated=["P1", "P2", "P3" if "S" in limbs[2] else "R3"]))
    assert (found.poc.t, found.poc.r, found.poc.dim, found.known.route) == (*numbers, "both")


def test_the_wrist_by_both_routes():
    linkage = place(parse_chains(WRIST), actuated=["P1", "P2", "P3"])
    found = analyse(dataclasses.replace(linkage, point=np.array([0.3, 0.4, 0.5])))
    assert (str(found.poc), found.dof, found.known.route) == ("t²(moving) r³", 3, "both")
