import dataclasses
from itertools import accumulate

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.errors import UnknownNameError, UsageError
from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.joints.universal import UNIVERSAL
from assur.numerics.least_squares import minimise
from assur.numerics.rotations import from_vector, to_vector
from assur.topology.chains import Chain, ChainJoint
from assur.topology.directions import unit
from assur.topology.notation import parse_chain
from assur.topology.screws.configurations import configurations, home_is_special
from assur.topology.screws.edges import closure
from assur.topology.screws.linkage import part
from assur.topology.screws.placing import place
from assur.topology.screws.twists import (
    UnclearRankError,
    clear_rank,
    dimensions,
    edges,
    fixed_directions,
    motion_space,
    poc_dimensions,
)
from examples import examples
from twist_chains import closure_jacobian, generic_edges, limb_motion, poses, residuals


def _around(text, count=3):
    """A limb with its axes turned about z, once for each limb; `<a>` in the text is a direction of the first limb."""
    limbs = []
    for angle in 2 * np.pi * np.arange(count) / count:
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        parts = text.split("<")
        limb = parts[0]
        for piece in parts[1:]:
            vector, rest = piece.split(">")
            limb += ",".join(repr(float(item)) for item in turn @ [float(item) for item in vector.split(",")]) + rest
        limbs.append(limb)
    return limbs


def _placed(texts, seed=0, **options):
    return place([parse_chain(text) for text in texts], seed=seed, **options)


def _platform(linkage, **options):
    return poc_dimensions(generic_edges(linkage, **options), "base", "platform")


# poc-theory.md, section 2: text, (t, r, dim)
CHAINS = {
    "P": ("P[x]", (1, 0, 1)),
    "R": ("R[x]", (0, 1, 1)),
    "H": ("H[x]", (1, 1, 1)),
    "C": ("C[x]", (1, 1, 2)),
    "U": ("U[x,y]", (0, 2, 2)),
    "S": ("S", (0, 3, 3)),
    "PP": ("P[x] P[0.6,0.8,0]", (2, 0, 2)),
    "PPP": ("P[x] P[0.6,0.8,0] P[z]", (3, 0, 3)),
    "PPP in a plane": ("P[x] P[0.6,0.8,0] P[y]", (2, 0, 2)),
    "R|R": ("R[x] R[x]", (1, 1, 2)),
    "R|R|R": ("R[x] R[x] R[x]", (2, 1, 3)),
    "R|R then P across": ("R[x] R[x] P[y]", (2, 1, 3)),
    "P, P across R": ("P[y] P[z] R[x]", (2, 1, 3)),
    "R|R then P along": ("R[x] R[x] P[x]", (2, 1, 3)),
    "R|R then P oblique": ("R[x] R[x] P[0.6,0.8,0]", (3, 1, 3)),
    "R|R|C": ("R[x] R[x] C[x]", (3, 1, 4)),
    "P|R|R|R": ("P[x] R[x] R[x] R[x]", (3, 1, 4)),
    "R,R,P,P": ("R[x] R[x] P[y] P[x]", (3, 1, 4)),
    "P-R-Pa-R": ("P[x] R[y] P(4R)[z] R[y]", (3, 1, 4)),
    "R,R in a point": ("R[x]@A R[y]@A", (0, 2, 2)),
    "R,R,R in a point": ("R[x]@A R[y]@A R[0.6,0,0.8]@A", (0, 3, 3)),
    "R skew to R": ("R[x] R[y]", (1, 2, 2)),
    "R|R across R": ("R[x] R[x] R[y]", (2, 2, 3)),
    "R|R|R across R|R": ("R[x] R[x] R[x] R[y] R[y]", (3, 2, 5)),
    "RRR, RRR": ("R[x] R[x] R[x] R[y] R[y] R[y]", (3, 2, 5)),
    "RPS": ("R[x] P[y] S", (2, 3, 5)),
    "S-S": ("S S", (2, 3, 5)),
    "UPS": ("U[x,y] P[z] S", (3, 3, 6)),
    "UPU displaced at will": ("U[x,y] P[z] U[y,x]", (3, 3, 5)),
    "P(4R)": ("P(4R)[x]", (1, 0, 1)),
    "P(4S)": ("P(4S)[x]", (2, 2, 4)),
    "P(2US)": ("P(2US)[x]", (2, 2, 4)),
    "P(4U)": ("P(4U)[x]", (2, 1, 3)),
    "2P4R": ("{P[y] R[x] R[x] | P[y] R[x] R[x]}", (2, 1, 3)),
    "HSOC1": ("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", (3, 2, 5)),
    "HSOC2": ("P[y] P(4R)[x] P(4R)[y]", (3, 0, 3)),
    # pitfalls of section 3
    "z,x,z": ("R[z] R[x] R[z]", (2, 3, 3)),
    "z,z,x,z,z": ("R[z] R[z] R[x] R[z] R[z]", (3, 3, 5)),
    "R then P across": ("R[x] P[y]", (2, 1, 2)),
    "coaxial": ("R[x]@A R[x]@A", (0, 1, 1)),
    "four R of a plane": ("R[x] R[x] R[x] R[x]", (2, 1, 3)),
}


@pytest.mark.parametrize("seed", [0, 1, 2])
@pytest.mark.parametrize("name", CHAINS)
def test_a_chain_moves_its_end_link_as_the_theory_says(name, seed):
    text, expected = CHAINS[name]
    assert _platform(_placed([text], seed), seed=seed) == expected


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_upu_in_the_translation_mode(seed):
    assert _platform(_placed(["U[x,y] P[z] U[y,x]"], seed), hold="orientation") == (3, 2, 5)


# poc-theory.md, section 5: limbs, hold, freedoms of the limbs, xi, platform (t, r, dim)
UPU = "U[<0,1,0>;<1,0,0.2>] P[<0.3,0.2,1>] U[<1,0,0.2>;<0,1,0>]"
PAPER = ["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[x] P(4R)[y]"]
DELTA_4S = _around("R[<0,1,0>] P(4S)[<0,1,0>]")
THREE_UPU = _around(UPU)
MECHANISMS = {
    "Delta R-R-Pa-R": (_around("R[<0,1,0>] R[<0,1,0>] P(4R)[<1,0,0.3>] R[<0,1,0>]"), None, [4] * 3, [5, 4], (3, 0, 3)),
    "Delta 4S": (DELTA_4S, None, [5] * 3, [6, 6], (3, 0, 3)),
    "linear Delta 4S": (
        [f"P[z] P(4S)[{a}]" for a in ("x", "0.6,0.8,0", "0.6,-0.8,0")],
        None,
        [5] * 3,
        [6, 6],
        (3, 0, 3),
    ),
    "linear Delta P-R-Pa-R": (_around("P[z] R[<0,1,0>] P(4R)[<1,0,0>] R[<0,1,0>]"), None, [4] * 3, [5, 4], (3, 0, 3)),
    "Orthoglide": (
        ["P[x] R[x] P(4R)[y] R[x]", "P[y] R[y] P(4R)[z] R[y]", "P[z] R[z] P(4R)[x] R[z]"],
        None,
        [4] * 3,
        [5, 4],
        (3, 0, 3),
    ),
    "3-UPU": (THREE_UPU, "orientation", [5] * 3, [6, 6], (3, 0, 3)),
    "tripteron": ([f"P[{a}] R[{a}] R[{a}] R[{a}]" for a in "xyz"], None, [4] * 3, [5, 4], (3, 0, 3)),
    "3-CRR": ([f"C[{a}] R[{a}] R[{a}]" for a in "xyz"], None, [4] * 3, [5, 4], (3, 0, 3)),
    "3-RRC": (_around("R[<0,1,0>] R[<0,1,0>] C[<0,1,0>]"), None, [4] * 3, [5, 4], (3, 0, 3)),
    "3-RRR": (["R[z] R[z] R[z]"] * 3, None, [3] * 3, [3, 3], (2, 1, 3)),
    "3-RPR": (["R[z] P[x] R[z]"] * 3, None, [3] * 3, [3, 3], (2, 1, 3)),
    "five-bar": (["R[z] R[z] R[z]", "R[z] R[z]"], None, [3, 2], [3], (2, 1, 2)),
    "3-RPS": (_around("R[<0,1,0>] P[<0.3,0,1>] S"), None, [5] * 3, [6, 6], (3, 2, 3)),
    "6-UPS": (["U[x,y] P[z] S"] * 6, None, [6] * 6, [6] * 5, (3, 3, 6)),
}


@pytest.mark.parametrize("seed", [0, 1, 2])
@pytest.mark.parametrize("name", MECHANISMS)
def test_a_mechanism_has_the_loops_freedoms_and_platform_of_the_theory(name, seed):
    texts, hold, freedoms, xi, platform = MECHANISMS[name]
    chains = [parse_chain(text) for text in texts]
    found = generic_edges(place(chains, seed=seed), seed=seed, hold=hold)
    ends = list(accumulate(len(chain.joints) for chain in chains))
    ranks = [clear_rank(closure(found[:end])) for end in ends]
    assert np.diff(ranks).tolist() == xi
    counts = [sum(edge.freedoms for edge in found[start:end]) for start, end in zip([0, *ends], ends, strict=False)]
    assert counts == freedoms
    assert sum(freedoms) - sum(xi) == platform[2]
    assert poc_dimensions(found, "base", "platform") == platform


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_papers_mechanism(seed):
    linkage = _placed(PAPER, seed)
    values = configurations(linkage, seed=seed)
    whole, collapsed = edges(linkage, values, collapsed=False), edges(linkage, values)
    assert closure(whole).shape[1:] == (24, 17)
    assert clear_rank(closure(whole)) == 14
    assert closure(collapsed).shape[1:] == (12, 11)
    loop = clear_rank(closure(collapsed[:6]))
    assert (loop, clear_rank(closure(collapsed)) - loop) == (3, 5)
    for found in (whole, collapsed):
        assert poc_dimensions(found, "base", "platform") == (3, 0, 3)
    first, second = ([edge.name for edge in collapsed[part]] for part in (slice(0, 8), slice(8, 11)))
    assert dimensions(limb_motion(collapsed, first, "base", "platform")) == (3, 2, 5)
    assert dimensions(limb_motion(collapsed, second, "base", "platform")) == (3, 0, 3)


def test_the_rotations_of_the_papers_first_chain_stay_in_the_plane_of_its_two_axes():
    found = generic_edges(_placed(PAPER[:1]))
    translations, rotations = fixed_directions(motion_space(found, "base", "platform"))
    assert len(translations) == 3
    assert rotations.shape == (1, 3)  # R3's axis y turns with the loop about x, so x alone is fixed
    np.testing.assert_allclose(np.abs(rotations), [[1, 0, 0]], atol=1e-6)


@pytest.mark.parametrize("seed", [29, 96])
def test_a_direction_that_turns_little_is_not_fixed(seed):
    """The planes of a 3-RPS mechanism's rotations happen to have nearly a line in common at these configurations."""
    found = generic_edges(_placed(_around("R[<0,1,0>] P[z] S"), seed), seed=seed)
    translations, rotations = fixed_directions(motion_space(found, "base", "platform"))
    assert (len(translations), len(rotations)) == (3, 0)


@pytest.mark.parametrize(
    ("text", "fixed_t", "fixed_r"),
    [
        ("R[x] R[x] R[x]", 2, 1),
        ("P[y] R[z] R[z]", 2, 1),
        ("P[x] P(4R)[y]", 2, 0),
        ("R[x] P[y]", 2, 1),
        ("R[x] R[y]", 0, 1),
        ("P[x] R[y] P[z]", 2, 1),
        ("P[x] P(4R)[x]", 1, 0),
        ("C[z] R[z]", 1, 1),
    ],
)
def test_fixed_directions_are_those_that_never_turn(text, fixed_t, fixed_r):
    basis = motion_space(generic_edges(_placed([text])), "base", "platform")
    assert [len(rows) for rows in fixed_directions(basis)] == [fixed_t, fixed_r]


def _moved(linkage, rotation, shift, size):
    """The linkage somewhere else and in another size."""
    joints = {}
    for name, joint in linkage.joints.items():
        omega, velocity = joint.screws[:, :3] @ rotation.T, joint.screws[:, 3:] @ rotation.T
        turning = np.any(omega, axis=1)[:, None]
        velocity = np.where(turning, size * velocity + np.cross(shift, omega), velocity)
        screws, point = np.concatenate([omega, velocity], axis=1), size * rotation @ joint.point + shift
        joints[name] = dataclasses.replace(joint, screws=screws, point=point)
    return dataclasses.replace(
        linkage, joints=joints, point=size * rotation @ linkage.point + shift, length=size * linkage.length
    )


@pytest.mark.parametrize("name", ["Delta 4S", "3-UPU", "3-RPS", "3-RRC"])
@pytest.mark.parametrize(("far", "size"), [(0.0, 1.0), (1e3, 1.0), (1.0, 1e-4), (10.0, 1e3)])
def test_neither_place_nor_size_matters(name, far, size):
    texts, hold, _, xi, platform = MECHANISMS[name]
    rng = np.random.default_rng(5)
    moved = _moved(_placed(texts), from_vector(rng.normal(size=3)), far * size * rng.normal(size=3), size)
    found = generic_edges(moved, hold=hold)
    assert clear_rank(closure(found)) == sum(xi)
    assert poc_dimensions(found, "base", "platform") == platform


def test_columns_have_one_size_whatever_the_unit():
    linkage = _placed(["C[x] H[y]"])
    large = _moved(linkage, np.eye(3), np.zeros(3), 1000.0)
    for one, other in zip(edges(linkage, configurations(linkage)), edges(large, configurations(large)), strict=True):
        np.testing.assert_allclose(one.twists, other.twists, atol=1e-12)


@pytest.mark.parametrize("name", ["paper", "Delta 4S", "3-RPS", "3-UPU"])
def test_the_motion_space_is_what_the_assembled_linkage_does(name):
    """Steps along every freedom of the joints, loops closed again: how the platform moves, by differences."""
    texts = PAPER if name == "paper" else MECHANISMS[name][0]
    hold = None if name == "paper" else MECHANISMS[name][1]
    linkage = _placed(texts)
    values = configurations(linkage, count=1, hold=hold)
    basis = motion_space(edges(linkage, values, collapsed=False), "base", "platform")[0]
    matrix = closure_jacobian(linkage, values)[0]
    _, singular, turned = np.linalg.svd(matrix)
    free = turned[np.sum(singular > 1e-7) :]
    step = 1e-4
    either = np.concatenate([values + step * free, values - step * free])
    closed = minimise(
        lambda at, _: (residuals(linkage, at), closure_jacobian(linkage, at)), either, tolerance=1e-13, max_steps=30
    )
    assert np.max(np.abs(residuals(linkage, closed.x))) < 1e-12
    rotation, shift = poses(linkage, closed.x)["platform"]
    here = rotation @ linkage.point + shift
    count = len(free)
    spin = to_vector(rotation[:count] @ rotation[count:].swapaxes(1, 2)) / (2 * step)
    moves = np.concatenate([spin, (here[:count] - here[count:]) / (2 * step)], axis=1).T  # (6, F)
    assert np.linalg.matrix_rank(moves, tol=1e-4) == basis.shape[1]
    np.testing.assert_allclose(moves, basis @ (basis.T @ moves), atol=1e-6)


AXES = [unit(axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (0.3, -0.5, 0.8))]


@st.composite
def _chains(draw):
    joints = []
    for kind in draw(st.lists(st.sampled_from("RRRPPUS"), min_size=1, max_size=7)):
        first = draw(st.sampled_from(AXES))
        if kind == "U":
            axes = (first, draw(st.sampled_from([axis for axis in AXES if axis != first])))
        else:
            axes = () if kind == "S" else (first,)
        joints.append(ChainJoint({"R": REVOLUTE, "P": PRISMATIC, "U": UNIVERSAL, "S": SPHERICAL}[kind], axes))
    return Chain(tuple(joints))


@examples(60)
@given(_chains(), st.integers(0, 1000))
def test_a_chain_from_its_other_end_has_as_many_motions(chain, seed):
    """The twist of the base against the platform is the opposite one: dim and r agree, whatever the placing."""
    turned = Chain(tuple(dataclasses.replace(joint, axes=joint.axes[::-1]) for joint in reversed(chain.elements)))
    t, r, dim = _platform(place([chain], seed=seed), seed=seed)
    other_t, other_r, other_dim = _platform(place([turned], seed=seed + 1), seed=seed + 1)
    assert (r, dim) == (other_r, other_dim)
    freedoms = sum(joint.freedoms for joint in chain.elements)
    assert max(t, r, other_t) <= dim <= min(6, freedoms, t + r, other_t + r)


def test_a_limb_by_itself_moves_as_it_does_in_its_mechanism():
    linkage = _placed(MECHANISMS["Delta R-R-Pa-R"][0], actuated=["R1.1", "R2.1"])
    names = [edge.name for edge in edges(linkage, configurations(linkage))]
    limb = part(linkage, names[:4], "platform")
    assert list(limb.groups) == ["Pa1.3"]
    assert limb.inputs == (("R1.1", 0),)
    assert len(limb.joints) == 7
    assert _platform(limb) == (3, 1, 4)
    inside = limb_motion(generic_edges(linkage), names[:4], "base", "platform")
    assert dimensions(inside) == (3, 1, 4)
    with pytest.raises(UnknownNameError, match="unknown joint 'R9'"):
        part(linkage, ["R9"], "platform")


@pytest.mark.parametrize(("kind", "freedoms", "spins"), [("4R", 1, 0), ("4S", 4, 2), ("4U", 3, 0), ("2US", 4, 0)])
def test_a_parallelogram_is_one_edge_with_the_freedoms_of_the_theory(kind, freedoms, spins):
    linkage = _placed([f"P[z] P({kind})[y] R[x]"])
    values = configurations(linkage)
    found = edges(linkage, values)
    assert [edge.name for edge in found] == ["P1", "Pa1", "R1"]
    generalised = found[1]
    assert generalised.freedoms == freedoms
    assert (generalised.parent, generalised.child) == ("link 1", "link 2")
    assert generalised.joints == ("Pa1.a", "Pa1.b", "Pa1.c", "Pa1.d")
    gram = generalised.twists.swapaxes(1, 2) @ generalised.twists
    np.testing.assert_allclose(gram, np.broadcast_to(np.eye(freedoms), gram.shape), atol=1e-12)
    whole = edges(linkage, values, collapsed=False)
    columns = sum(edge.freedoms for edge in whole) - 2
    assert columns - clear_rank(closure(whole)) == freedoms + spins


def test_inputs_are_columns_of_their_edges():
    linkage = _placed(["C[x] P(4R)[y] R[z]"], actuated=["C1", "Pa1"])
    found = edges(linkage, configurations(linkage))
    assert [(edge.name, edge.inputs) for edge in found] == [("C1", (0,)), ("Pa1", (0,)), ("R1", ())]
    both = dataclasses.replace(linkage, inputs=(("C1", 0), ("C1", 1)))
    assert edges(both, configurations(both))[0].inputs == (0, 1)
    driven = _placed(["P(4U)[x]"], actuated=["Pa1"])
    assert edges(driven, configurations(driven), collapsed=False)[0].inputs == (0,)
    with pytest.raises(UsageError, match="'Pa1' has 3 freedoms and an input inside"):
        edges(driven, configurations(driven))


def test_other_assemblies_of_the_3_upu_are_other_operation_modes():
    linkage = _placed(THREE_UPU)
    starts = np.random.default_rng(0).uniform(-np.pi, np.pi, (40, 15))
    ends = minimise(
        lambda at, _: (residuals(linkage, at), closure_jacobian(linkage, at)),
        starts,
        tolerance=1e-11,
        max_steps=80,
        max_change=0.5,
    )
    values = ends.x[ends.converged]
    turned = np.linalg.norm(to_vector(poses(linkage, values)["platform"][0]), axis=1)
    modes = {
        mode: {poc_dimensions(edges(linkage, row[None]), "base", "platform") for row in values[chosen]}
        for mode, chosen in (("translation", turned < 1e-9), ("other", turned > 0.1))
    }
    assert modes["translation"] == {(3, 0, 3)}
    assert modes["other"] - {(3, 0, 3)}
    with pytest.raises(UnclearRankError, match="disagree"):
        poc_dimensions(edges(linkage, values), "base", "platform")


SPECIAL_UPU = _around("U[<0,1,0>;<1,0,0>] P[z] U[<1,0,0>;<0,1,0>]")
"""With all P along z the three couples are along z at home, so that the platform could turn two ways more."""


def test_a_home_where_modes_meet_gives_no_answer_unless_the_mode_is_said():
    linkage = _placed(SPECIAL_UPU)
    home = edges(linkage, np.zeros((1, 15)))
    assert poc_dimensions(home, "base", "platform") == (3, 2, 5)
    assert _platform(linkage, hold="orientation") == (3, 0, 3)
    with pytest.raises(UnclearRankError, match="home has freedoms that are lost on the way"):
        _platform(linkage)


def test_z_x_z_against_x_z_has_two_modes_at_home_and_no_answer():
    """Either the middle joint stays and the outer two turn about z, or the first stays and the others go along."""
    linkage = _placed(["R[z] R[x] R[z]", "P[x] P[y] P[z] U[x,z]"])
    values = configurations(linkage, count=16)
    assert home_is_special(linkage, values)
    stays = np.abs(values[:, :2]) < 1e-5
    assert np.all(np.sum(stays, axis=1) == 1)
    assert np.all(np.any(stays, axis=0))
    with pytest.raises(UnclearRankError, match="home has freedoms that are lost on the way"):
        generic_edges(linkage)


def test_a_rank_without_a_clear_gap_is_refused():
    slanted = np.array([[[1.0, 0.0, 0.0], [0.0, 2e-7, 0.0], [0.0, 0.0, 0.5e-7]]])
    with pytest.raises(UnclearRankError, match=r"2\.0e-07 counts and one of 5\.0e-08 does not"):
        clear_rank(slanted)
    assert clear_rank(slanted * [1.0, 1.0, 1e-6]) == 2
    assert clear_rank(np.zeros((2, 3, 0))) == 0
    assert clear_rank(np.zeros((2, 3, 3))) == 0
    with pytest.raises(UnclearRankError, match="disagree on a rank: 1, 2"):
        clear_rank(np.stack([np.diag([1.0, 0.0]), np.eye(2)]))


def test_a_linkage_that_is_nearly_special_everywhere_is_refused_after_several_tries():
    """Two slides a few 1e-7 rad apart: what counts and what does not depends on the threshold."""
    slides = [ChainJoint(PRISMATIC, (unit((1.0, slope, 0.0)),)) for slope in (0.0, 2e-7)]
    third = ChainJoint(PRISMATIC, (unit((1.0, 0.0, 4e-8)),))
    linkage = place([Chain((*slides, third))])
    with pytest.raises(UnclearRankError, match="5 sets of configurations were tried"):
        generic_edges(linkage)
