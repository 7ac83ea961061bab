import dataclasses

import numpy as np
import pytest

from assur.joints.revolute import REVOLUTE
from assur.numerics.rotations import to_vector
from assur.topology.notation import parse_chain
from assur.topology.screws.configurations import ImmobileError, configurations, home_is_special
from assur.topology.screws.linkage import Linkage, LinkageJoint
from assur.topology.screws.placing import place
from twist_chains import closure_jacobian, poses, residuals

PAPER = ("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[x] P(4R)[y]")
DELTA = ("R[y] P(4S)[y]", "R[0.6,0.8,0] P(4S)[0.6,0.8,0]", "R[x] P(4S)[x]")
UPU = "U[y,x] P[0.2,0.1,1] U[x,y]"
THREE_UPU = (UPU, "U[0.6,0.8,0; 0,0.6,0.8] P[0,0.3,1] U[0,0.6,0.8; 0.6,0.8,0]", "U[z,y] P[1,0.2,0.2] U[y,z]")
LOOPED = {
    "paper": PAPER,
    "delta": DELTA,
    "stewart": ("U[x,y] P[z] S",) * 6,
    "planar": ("R[z] R[z] R[z]",) * 3,
    "one limb": ("{P[y] R[x] R[x] | P[y] R[x] R[x]} P(4U)[y] R[y]",),
}


def _placed(texts, seed=0):
    return place([parse_chain(text) for text in texts], seed=seed)


def _turned(linkage, values, link):
    return to_vector(poses(linkage, values)[link][0])


def _skewness(linkage, values):
    """By how much the short links of each parallelogram differ in direction, (groups, N)."""
    placed = poses(linkage, values)
    found = []
    for group in linkage.groups.values():
        near = linkage.joints[group.joints[0]].point, linkage.joints[group.joints[3]].point
        far = linkage.joints[group.joints[1]].point, linkage.joints[group.joints[2]].point
        sides = []
        for link, (first, second) in ((group.parent, near), (group.child, far)):
            sides.append(placed[link][0] @ (second - first))
        found.append(np.linalg.norm(sides[0] - sides[1], axis=1))
    return np.array(found)


@pytest.mark.parametrize("name", LOOPED)
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_loops_are_closed_after_a_finite_displacement(name, seed):
    linkage = _placed(LOOPED[name], seed)
    values = configurations(linkage, count=5, seed=seed)
    assert values.shape[0] == 5
    assert np.max(np.abs(residuals(linkage, values))) < 1e-11
    size = np.max(np.abs(values), axis=1)
    assert np.all((size > 0.25) & (size < 1.0))
    assert np.min(np.max(np.abs(values[:, None] - values[None]) + 9 * np.eye(5)[..., None], axis=2)) > 1e-2


def test_a_seed_gives_the_same_configurations():
    linkage = _placed(PAPER)
    assert np.array_equal(configurations(linkage, seed=7), configurations(linkage, seed=7))
    assert not np.allclose(configurations(linkage, seed=7), configurations(linkage, seed=8))


def test_a_chain_without_loops_goes_anywhere():
    linkage = _placed(["R[x] P[y] H[z] U[x,y]"])
    values = configurations(linkage, count=200)
    assert values.shape == (200, 5)
    assert np.all(np.max(np.abs(values), axis=0) > [3.0, 0.9, 3.0, 3.0, 3.0])


def test_values_have_the_unit_of_the_linkage():
    linkage = _placed(["R[x] P[y]"])
    large = dataclasses.replace(linkage, length=50.0)
    np.testing.assert_allclose(configurations(large), configurations(linkage) * [1.0, 50.0])


def test_in_the_translation_mode_the_platform_does_not_turn_and_otherwise_it_does():
    limb = _placed([UPU])
    values = configurations(limb, hold="orientation")
    assert np.max(np.abs(_turned(limb, values, "platform"))) < 1e-11
    assert np.min(np.max(np.abs(values), axis=1)) > 0.25
    assert np.min(np.linalg.norm(_turned(limb, configurations(limb), "platform"), axis=1)) > 0.1
    whole = _placed(THREE_UPU)
    values = configurations(whole, hold="orientation")
    assert np.max(np.abs(_turned(whole, values, "platform"))) < 1e-11
    assert np.max(np.abs(residuals(whole, values))) < 1e-11


@pytest.mark.parametrize("kind", ["4S", "2US"])
@pytest.mark.parametrize("text", ["R[y] P({})[y]", "{{R[x] P({})[x] | R[y] P({})[y]}} R[z]", "P({})[x] P(4R)[z]"])
def test_a_limb_alone_keeps_its_parallelograms(text, kind):
    linkage = _placed([text.format(kind, kind)])
    values = configurations(linkage)
    assert np.max(np.abs(residuals(linkage, values))) < 1e-11
    assert np.max(_skewness(linkage, values)) < 1e-11


def test_the_delta_keeps_its_parallelograms_by_itself():
    linkage = _placed(DELTA)
    values = configurations(linkage)
    assert np.max(_skewness(linkage, values)) < 1e-10
    assert np.max(np.abs(_turned(linkage, values, "platform"))) < 1e-10


def test_two_limbs_of_a_delta_do_not_keep_their_parallelograms_unless_they_are_held():
    linkage = _placed(DELTA[:2])
    assert np.min(np.max(_skewness(linkage, configurations(linkage)), axis=0)) > 1e-3
    held = configurations(linkage, hold="parallelograms")
    assert np.max(_skewness(linkage, held)) < 1e-11
    assert np.max(np.abs(residuals(linkage, held))) < 1e-11
    assert np.min(np.max(np.abs(held), axis=1)) > 0.25
    turning = _placed(["P[x] R[z] P(4S)[y]", "R[z] P[x] P[y]"])
    held = configurations(turning, hold="parallelograms")
    assert np.min(np.linalg.norm(_turned(turning, held, "platform"), axis=1)) > 1e-3


def test_a_structure_has_no_other_configuration_than_home():
    assert np.array_equal(configurations(_placed(["R[z] R[z]", "R[z]"])), np.zeros((4, 3)))


def _triangle(height):
    """Three hinges of one plane, the links between them closed: a structure, flat at height 0."""
    points = [np.array(point) for point in ((0.0, 0.0, 0.0), (1.0, height, 0.0), (2.5, 0.0, 0.0))]
    links = ["base", "one", "two", "base"]
    joints = {}
    for number, point in enumerate(points):
        screw = np.concatenate([[0, 0, 1], np.cross(point, [0, 0, 1])])[None]
        joints[f"R{number}"] = LinkageJoint(f"R{number}", REVOLUTE, links[number], links[number + 1], screw, point)
    return Linkage(joints, "base", "two", points[1])


def test_a_freedom_that_is_only_instantaneous_is_refused():
    assert np.array_equal(configurations(_triangle(0.5)), np.zeros((4, 3)))
    flat = _triangle(0.0)
    assert np.linalg.matrix_rank(closure_jacobian(flat, np.zeros((1, 3)))[0]) == 2
    with pytest.raises(ImmobileError, match="have a freedom at home but do not close 4 times"):
        configurations(flat)


@pytest.mark.parametrize("seed", range(6))
def test_another_rigid_assembly_is_no_displacement(seed):
    """Six joints in one loop that are rigid, but not to first order; they close elsewhere too."""
    linkage = _placed(["P[x] R[0.6,0.8,0] R[0.6,0.8,0]", "R[x] R[0.6,0.8,0] R[x]"], seed)
    with pytest.raises(ImmobileError):
        configurations(linkage)


def test_home_is_special_where_it_has_freedoms_that_are_lost_on_the_way():
    special = _placed(["U[y,x] P[z] U[x,y]", "U[x,y] P[z] U[y,x]"])
    assert home_is_special(special, configurations(special))
    assert not home_is_special(special, configurations(special, hold="orientation"), hold="orientation")
    general = _placed(THREE_UPU)
    assert not home_is_special(general, configurations(general))
    arm = _placed(["R[x] R[y]"])
    assert not home_is_special(arm, configurations(arm))
