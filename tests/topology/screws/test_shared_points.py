"""Points that limbs share: found where they are in the base or the platform, and only there."""

import dataclasses

import numpy as np
import pytest

import assur
from assur.topology.analysis import analyse
from assur.topology.chains import Chain
from assur.topology.notation import parse_chains
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.placing import place
from assur.topology.screws.recognition import recognised
from assur.topology.screws.shared_points import common_end, end_point, point_of_platform

SPHERICAL = ["R[x]@O R[0,1,0.3]@O R[0.3,0,1]@O", "R[y]@O R[0.3,0,1]@O R[1,0.3,0]@O", "R[z]@O R[1,0.3,0]@O R[0,1,0.3]@O"]


def placed(*texts: str, scale: float = 1.0) -> Linkage:
    """The chains in space without their labels, away from the origin, in another unit."""
    found = place(parse_chains(texts))
    return moved(found, scale, np.array([3.0, -2.0, 5.0]))


def moved(linkage: Linkage, scale: float, shift: np.ndarray) -> Linkage:
    joints = {}
    for name, joint in linkage.joints.items():
        screws = joint.screws.copy()
        screws[:, 3:] = scale * screws[:, 3:] + np.cross(scale * shift, screws[:, :3])
        joints[name] = dataclasses.replace(joint, screws=screws, point=scale * (joint.point + shift))
    return dataclasses.replace(linkage, joints=joints, point=scale * (linkage.point + shift), length=scale)


def labels(linkage: Linkage) -> list[list[str]]:
    """The labels of the limbs that are recognised, as a, b, c in the order in which they occur."""
    chains: tuple[Chain, ...] = recognised(linkage) or ()
    found = [[getattr(joint, "point", "") for joint in chain.joints] for chain in chains]
    order = dict.fromkeys(label for limb in found for label in limb if label)
    letters = dict(zip(order, "abcdefgh", strict=False)) | {"": ""}
    return [[letters[label] for label in limb] for limb in found]


def off_axis(linkage: Linkage, name: str, shift: np.ndarray) -> Linkage:
    """The linkage with one joint's axis shifted."""
    joint = linkage.joints[name]
    screws = joint.screws.copy()
    screws[:, 3:] += np.cross(shift, screws[:, :3])
    return dataclasses.replace(
        linkage,
        joints={**linkage.joints, name: dataclasses.replace(joint, screws=screws, point=joint.point + shift)},
    )


@pytest.mark.parametrize("scale", [1e-3, 1.0, 400.0])
@pytest.mark.parametrize(
    ("texts", "expected"),
    [
        (SPHERICAL, [["a", "a", "a"]] * 3),
        (["R[x]@O R[y]@O", "R[y]@O R[z]@O R[x]@O"], [["a", "a"], ["a", "a", "a"]]),
        (["R[x]@O S R[y]@O", "R[y]@O S R[z]@O", "R[z]@O S R[x]@O"], [["a", "", "a"]] * 3),
        # shared in the base alone, and in the platform alone
        (["U[x,y]@A P[z] S", "U[y,x]@A P[z] S"], [["a", "", ""], ["a", "", ""]]),
        (["U[x,y] P[z] S@B", "R[x] R[x] R[x]@B R[y]@B R[z]@B"], [["", "", "a"], ["", "", "a", "a", "a"]]),
        # a point of the base and of the platform, because one limb turns about it
        (["S@O", "U[x,y]@O P[z] S", "U[x,y] P[z] S@O"], [["a"], ["a", "", ""], ["", "", "a"]]),
        # one axis; an axis through the centre of another limb's joint
        (["R[x]@A R[y] R[y]", "R[x]@A R[z] R[z]"], [["a", "", ""], ["a", "", ""]]),
        (["S@A P[z] S", "R[x]@A R[y] R[y] S"], [["a", "", ""], ["a", "", "", ""]]),
        # one point at home, of the base in one limb and of the platform in another: not one point
        (["U[x,y]@A P[z] S", "U[x,y] P[z] S@A"], [["", "", ""], ["", "", ""]]),
        # axes in the middle of limbs that meet those of another limb at home only
        (["R[x] R[y]@A R[z]@A R[x]", "R[y] R[z]@A R[x]@A R[y]"], [["", "a", "a", ""], ["", "b", "b", ""]]),
        (["R[x]@A R[y]@A", "R[y] R[z]@A R[x]@A R[y]"], [["a", "a"], ["", "b", "b", ""]]),
    ],
)
def test_the_points_that_limbs_share(texts, expected, scale):
    linkage = placed(*texts, scale=scale)
    assert labels(dataclasses.replace(linkage, point=linkage.point + scale)) == expected


@pytest.mark.parametrize(("shift", "same"), [(1e-3, False), (1e-5, False), (1e-12, True)])
def test_points_that_are_near_are_not_the_same(shift, same):
    linkage = placed("R[x]@O R[y]@O R[z]@O", "U[x,y]@O P[z] S")
    found = labels(off_axis(linkage, "U1", np.array([0.0, 0.0, shift])))
    assert found == [["a", "a", "a"], ["a" if same else "", "", ""]]


def test_a_limb_of_another_centre_is_no_part_of_the_wrist():
    linkage = placed(*SPHERICAL)
    for name in ("R7", "R8", "R9"):
        linkage = off_axis(linkage, name, np.array([0.0, 1e-4, 0.0]))
    assert labels(linkage) == [["a", "a", "a"], ["a", "a", "a"], ["b", "b", "b"]]


def test_a_point_at_the_origin_is_a_point():
    linkage = place(parse_chains(SPHERICAL))
    centre = linkage.point
    at_origin = moved(linkage, 1.0, -centre)
    assert float(np.max(np.abs(at_origin.point))) == 0.0
    assert labels(at_origin) == [["a", "a", "a"]] * 3


@pytest.mark.parametrize(
    ("texts", "label"),
    [
        (SPHERICAL, "O"),
        (["R[x]@O R[y]@O", "U P S"], "O"),
        (["R[x]@O R[y]@O", "S@B"], ""),
        (["R[x]@O R[y]@O", "R[x]@O R[y]@O P[z]"], ""),
        (["U P S"] * 6, ""),
    ],
)
def test_the_common_end_is_of_all_limbs_that_may_resist(texts, label):
    assert common_end(parse_chains(texts)) == label


def test_o_prime_is_the_common_end_only_where_it_is_there():
    chains = parse_chains(SPHERICAL)
    linkage = place(chains)
    np.testing.assert_allclose(end_point(linkage, chains[0]), linkage.point, atol=1e-12)
    assert point_of_platform(linkage, chains) == "O"
    elsewhere = dataclasses.replace(linkage, point=linkage.point + np.array([0.0, 0.0, 1e-3]))
    assert point_of_platform(elsewhere, chains) == ""


AT_ONE_POINT = [
    (SPHERICAL, (0, 3, 3)),
    (["R[x]@O R[y]@O R[z]@O", "U P S", "U P S", "U P S"], (0, 3, 3)),
    (["S@O", "U P S", "U P S", "U P S"], (0, 3, 3)),
    (["R[x]@O R[y]@O", "R[y]@O R[z]@O R[x]@O"], (0, 2, 2)),
    (["P[z] S@O", "P[z] S@O", "U P S"], (1, 3, 4)),
    (["C[x]@A", "C[x]@A"], (2, 1, 2)),
    (["R[x]@A", "R[x]@A"], (0, 1, 1)),
    (["R[x] R[x] S@O", "R[y] R[y] S@O"], (1, 3, 4)),
    # planar, then spherical
    (["R[x] R[x] R[x] R[y]@O R[z]@O", "P[x] S@O"], (0, 3, 3)),
]


def test_limbs_that_end_in_one_point_may_have_one_that_slides_along_it():
    found = assur.topology(["R[x] P[z] U[y,z@Q]", "C[y] P[z] U[x,z@Q]", "S P[x] C[z]@Q"])
    assert (found.dof, found.poc.dim) == (3, 3)


@pytest.mark.parametrize(("texts", "numbers"), AT_ONE_POINT)
def test_both_routes_see_the_platform_where_its_limbs_meet(texts, numbers):
    facts = assur.topology(texts)
    assert facts.routes_agree is True
    assert (facts.poc.t, facts.poc.r, facts.poc.dim) == numbers


@pytest.mark.parametrize("at_end", [True, False])
def test_a_joint_graph_and_its_notation_have_one_answer_at_one_point(at_end):
    linkage = place(parse_chains(SPHERICAL))
    linkage = linkage if at_end else dataclasses.replace(linkage, point=linkage.point + np.array([0.2, 0.5, 0.3]))
    facts = analyse(linkage)
    assert facts.routes_agree is True
    assert (facts.poc.t, facts.poc.r, facts.poc.dim) == ((0, 3, 3) if at_end else (2, 3, 3))
