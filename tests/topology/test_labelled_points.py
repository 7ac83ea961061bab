"""Points that axes share: written, placed, and what mechanisms of the literature make of them."""

import re
from pathlib import Path

import numpy as np
import pytest

from assur.derived_topology import topology
from assur.errors import UsageError
from assur.topology.chains import ChainJoint
from assur.topology.labelled_points import tied_points
from assur.topology.notation import NotationError, parse_chains, plain_text
from assur.topology.screws.placing import place

DOCUMENTED = re.findall(
    r"^\| ([\w -]+) \| (`[^|]*`) \| [^|]*F = (\d), κ = (\d)",
    (Path(__file__).parents[2] / "docs" / "topology.md").read_text(),
    re.MULTILINE,
)


@pytest.mark.parametrize(("name", "cell", "dof", "kappa"), DOCUMENTED)
def test_the_examples_of_the_documentation(name, cell, dof, kappa):
    found = topology(re.findall("`([^`]*)`", cell))
    assert (found.dof, found.coupling_degree) == (int(dof), int(kappa))


def test_the_documentation_has_such_examples():
    assert len(DOCUMENTED) == 4


def test_the_exechon_without_its_common_line():
    assert topology(["U[x,y] P[z] R[y]", "U[x,y] P[z] R[y]", "S P[z] R[x]"]).dof == 2


@pytest.mark.parametrize(
    "limbs",
    [
        ["U[x@O,y] P[z] R[y]", "U[x@O,y] P[z] R[y]", "S P[z] R[x]"],
        ["R[x]@O@A R[y]@A P[z] R[y]", "R[x]@O@B R[y]@B P[z] R[y]", "S P[z] R[x]"],
        ["U[x,y]@O P[z] R[y]", "U[x,y]@O P[z] R[y]", "S P[z] R[x]"],
        ["U[x@O,y] P[z] R[y]", "U[x@O,y] P[z] R[y]", "R[x] P[z] U[x,y]"],
    ],
)
def test_the_rules_know_limbs_that_turn_about_one_line(limbs):
    found = topology(limbs)
    assert (found.poc.t, found.poc.r, found.poc.dim, found.known.route) == (3, 2, 3, "both")


@pytest.mark.parametrize(
    "text", ["R[x]@A@B R[y]@B", "U[x@A,y]", "U[x@A@B; 0,0.6,0.8@D]@C", "R[1,2,0]@A@B", "U[x,y@A] S@B", "C[z]@A@B"]
)
def test_written_and_read_back(text):
    assert plain_text(parse_chains([text])[0]) == text


def test_a_label_in_the_brackets_of_an_only_axis_is_one_behind_it():
    inside, behind = parse_chains(["R[x@A] C[y@B@D]", "R[x]@A C[y]@B@D"])
    assert [joint.points_on(0) for joint in inside.joints] == [joint.points_on(0) for joint in behind.joints]


def _off(linkage, joint, axis, place):
    """How far a point is from an axis of a placed joint."""
    turn = linkage.joints[joint].screws[axis, :3]
    return np.linalg.norm(np.cross(place - linkage.joints[joint].point, turn))


@pytest.mark.parametrize("seed", range(3))
def test_axes_run_through_all_their_points_and_points_stay_apart(seed):
    chains = parse_chains(["U[x@O,y]@A P[z] R[y@Q]", "U[x@O,y@B]@D P[z] R[0,3,4]@B@Q"])
    linkage = place(chains, seed=seed)
    points = linkage.joints
    names = [joint.name for chain in chains for joint in chain.joints]
    places = tied_points(chains, names, np.random.default_rng(seed))
    assert set(places) == {"O", "A", "B", "D", "Q"}
    assert _off(linkage, "U1", 0, places["O"]) < 1e-12 > _off(linkage, "U2", 0, places["O"])
    assert _off(linkage, "U2", 1, places["B"]) < 1e-12 > _off(linkage, "R2", 0, places["Q"])
    assert np.linalg.norm(points["U1"].point - points["U2"].point) > 1e-3
    assert min(np.linalg.norm(places[first] - places[other]) for first, other in ("OA", "OD", "DB", "BQ")) > 1e-3


@pytest.mark.parametrize(
    ("limbs", "limb", "position"),
    [
        (["R[x]@A@B", "R[y]@A@B"], 2, 6),
        (["R[x]@A@B R[y]@B@D R[1,1,0.5]@A@D"], 0, 28),
    ],
)
def test_two_labels_of_one_point(limbs, limb, position):
    with pytest.raises(NotationError, match="one point with the labels") as error:
        parse_chains(limbs)
    assert (error.value.limb, error.value.position) == (limb, position)
    assert "lies along their line" in (error.value.hint or "")


def test_points_need_an_axis_each():
    joint = parse_chains(["R[x]@A"])[0].joints[0]
    with pytest.raises(UsageError, match="points on 2 axes of R"):
        ChainJoint(joint.type, joint.axes, through=(("B",), ()))
