"""Special constraints: that they hold finitely, whose they are, and which are of no use."""

import re
from functools import lru_cache

import numpy as np
import pytest

from assur.topology.counting.inputs import default_inputs
from assur.topology.counting.special_constraints import connected, special_constraints, way_to
from assur.topology.notation import parse_chains
from assur.topology.screws.configurations import configurations
from assur.topology.screws.edges import Edge
from assur.topology.screws.limb_linkage import limb_linkage
from assur.topology.screws.placing import place
from assur.topology.screws.twists import edges, generic_values
from twist_chains import poses

AROUND = ("0,1,0", "-0.8660254037844386,-0.5,0", "0.8660254037844386,-0.5,0")
H4 = ["{R[x] P(4S)[x] | R[y] P(4S)[y]} R[z]"] * 2
STILL, TURNS_ABOUT_ONE = "the platform does not rotate", "the platform rotates about one fixed direction only"
PLANE = "O' stays in a known plane"
MECHANISMS = {
    "tripteron": ([f"P[{u}] R[{u}] R[{u}] R[{u}]" for u in "xyz"], {STILL}),
    "3-CRR": ([f"C[{u}] R[{u}] R[{u}]" for u in "xyz"], {STILL}),
    "the paper's": (["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[x] P(4R)[y]"], {STILL}),
    "Delta 4S": ([f"R[{u}] P(4S)[{u}]" for u in AROUND], {STILL}),
    "Delta 4R": ([f"R[{u}] R[{u}] P(4R)[1,0.2,0.3] R[{u}]" for u in AROUND], {STILL}),
    "H4": (H4, {TURNS_ABOUT_ONE}),
    "planar 3-RRR": (["R[z] R[z] R[z]"] * 3, {TURNS_ABOUT_ONE, PLANE}),
    "3-UPS and planar RRR": (["U P S"] * 3 + ["R[z] R[z] R[z]"], {TURNS_ABOUT_ONE, PLANE}),
    "Sarrus": (["R[x] R[x] R[x]", "R[y] R[y] R[y]"], {STILL, "O' stays on a known line"}),
    "3-RPS": ([f"R[{u}] P[0.1,0.2,1] S" for u in AROUND], set()),
    "6-UPS": (["U P S"] * 6, set()),
}


@lru_cache
def found(name, count=4):
    chains = parse_chains(MECHANISMS[name][0])
    linkage = place(chains, actuated=default_inputs(chains))
    values = generic_values(linkage, count)
    return chains, linkage, special_constraints(edges(linkage, values), "base", "platform")


@pytest.mark.parametrize("name", MECHANISMS)
def test_what_the_whole_mechanism_sees_to(name):
    _, _, constraints = found(name)
    assert {item.words for item in constraints if not item.words.startswith("by ")} == MECHANISMS[name][1]


def kept(turns):
    """Directions of a link, (3, k), that stay as they are where it does not turn about some directions (2 or 3, 3)."""
    return np.eye(3) if len(turns) == 3 else np.cross(*turns)[:, None]


@pytest.mark.parametrize("name", MECHANISMS)
def test_what_the_whole_mechanism_sees_to_holds_finitely(name):
    """At other configurations than those it was found at: orientations, not angular velocities."""
    _, linkage, constraints = found(name)
    rotation, shift = poses(linkage, generic_values(linkage, 6, seed=5))["platform"]
    moved = rotation @ linkage.point + shift - linkage.point
    assert np.max(np.abs(moved)) > 0.05
    for item in constraints:
        if not item.words.startswith("by "):
            turns, slides = item.rows[:, :3], item.rows[:, 3:]
            np.testing.assert_allclose(slides @ moved.T, 0, atol=1e-9)
            if turns.any():
                axes = kept(turns)
                np.testing.assert_allclose(
                    rotation @ axes, np.broadcast_to(axes, (len(rotation), *axes.shape)), atol=1e-9
                )


@pytest.mark.parametrize("name", MECHANISMS)
def test_what_a_limb_sees_to_holds_for_the_limb_alone(name):
    """Displaced at will with its inputs held: the rest of the mechanism has no part in it."""
    chains, linkage, constraints = found(name)
    alone = [item for item in constraints if item.words.startswith("by ")]
    for item in alone:
        names = set(re.match("by (.*) alone", item.words)[1].split(", "))
        (chain,) = [chain for chain in chains if {joint.name for joint in chain.joints} == names]
        limb = limb_linkage(linkage, chain)
        values = configurations(limb, 5)
        for joint, component in limb.inputs:
            values[:, limb.slices[joint].start + component] = 0.3
        rotation, shift = poses(limb, values)["platform"]
        turns, slides = item.rows[:, :3], item.rows[:, 3:]
        places = (rotation @ linkage.point + shift) @ slides.T
        np.testing.assert_allclose(places, np.broadcast_to(places[0], places.shape), atol=1e-9)
        if turns.any():
            turned = rotation @ kept(turns)
            np.testing.assert_allclose(turned, np.broadcast_to(turned[0], turned.shape), atol=1e-9)


def test_each_limb_of_the_tripteron_holds_a_plane_and_one_rotation():
    _, _, constraints = found("tripteron")
    limbs = ("P1, R1, R2, R3", "P2, R4, R5, R6", "P3, R7, R8, R9")
    words = {item.words: item.rows for item in constraints}
    assert words.keys() == {STILL, *(f"by {limb} alone {said}" for limb in limbs for said in (TURNS_ABOUT_ONE, PLANE))}
    for limb, axis in zip(limbs, np.eye(3), strict=True):
        rows = words[f"by {limb} alone {PLANE}"]
        np.testing.assert_allclose(np.abs(rows), [[0, 0, 0, *axis]], atol=1e-9)


def test_a_limb_with_a_loop_of_its_own_is_not_asked():
    _, _, constraints = found("the paper's")
    said = [item.words for item in constraints if item.words.startswith("by ")]
    assert said == ["by P3, Pa1, Pa2 alone the platform does not rotate"]


def test_not_even_where_one_of_its_branches_alone_would_say_as_much():
    linkage = place(parse_chains(["{P[x] | P[x]} P[y] P[z]", "U P S"]), actuated=["P1"])
    words = [item.words for item in special_constraints(edges(linkage, generic_values(linkage)), "base", "platform")]
    assert words == ["the platform does not rotate"]


def test_a_single_joint_from_base_to_platform_is_a_limb():
    chains = parse_chains(["P[x]", "R[y] R[y] R[y]"])
    linkage = place(chains)
    words = [item.words for item in special_constraints(edges(linkage, configurations(linkage)), "base", "platform")]
    assert "by P1 alone the platform does not rotate" in words
    assert "by P1 alone O' stays on a known line" in words


@pytest.mark.parametrize(
    ("actuated", "held"),
    [([], ""), (["P1"], PLANE), (["P1", "P3"], "O' stays on a known line"), (["P1", "P2", "P3"], "at a known point")],
)
def test_what_is_given_of_a_limb_is_known_of_the_platform(actuated, held):
    linkage = place(parse_chains(["P[x] P[y] P[z]", "U P S"]), actuated=actuated)
    known = special_constraints(edges(linkage, configurations(linkage)), "base", "platform")
    said = [item.words for item in known if item.words.startswith("by P1, P2, P3 alone O'")]
    assert [held in words for words in said] == [True] * bool(actuated)


def test_turning_that_is_blocked_about_one_direction_alone_is_of_no_use():
    turns = np.zeros((2, 6, 2))
    turns[:, 0, 0] = turns[:, 1, 1] = 1.0
    (point,) = special_constraints([Edge("U1", "base", "platform", turns)], "base", "platform")[:1]
    assert point.words == "O' stays at a known point"
    assert not any(
        "rotate" in item.words for item in special_constraints([Edge("U1", "base", "p", turns)], "base", "p")
    )


# ---- ways -----------------------------------------------------------------------------------------------------


def edge(name, start, end, freedoms=1, inputs=()):
    return Edge(name, start, end, np.zeros((1, 6, freedoms)), (name,), inputs)


def names(some):
    return [item.name for item in some]


LOOP = [edge("A", "base", "a"), edge("B", "a", "b"), edge("C", "b", "base")]


def test_the_way_on_has_the_fewest_freedoms_and_does_not_pass_the_base():
    long = [edge("D", "a", "m"), edge("E", "m", "n"), edge("F", "n", "platform")]
    short = [edge("G", "b", "platform", 4)]
    home = [edge("H", "base", "platform")]
    links = ("base", "a", "b")
    assert names(way_to("platform", links, [*LOOP, *long, *short, *home], "base")) == ["D", "E", "F"]
    driven = [*LOOP, *long, edge("G", "b", "platform", 4, (0, 1)), *home]
    assert names(way_to("platform", links, driven, "base")) == ["G"]
    assert names(way_to("platform", (*links, "platform"), driven, "base")) == []
    assert names(way_to("platform", links, [*LOOP, *home], "base")) == []
    assert names(way_to("platform", ("base",), [*LOOP, *home], "base")) == []
    assert names(way_to("platform", (), [*LOOP, *home], "base")) == []


def test_among_equal_ways_the_order_of_links_decides_and_then_that_of_edges():
    ways = [edge("D", "b", "platform"), edge("E", "a", "platform")]
    assert names(way_to("platform", ("a", "b"), [*LOOP, *ways], "base")) == ["E"]
    assert names(way_to("platform", ("b", "a"), [*LOOP, *ways], "base")) == ["D"]
    twins = [edge("D", "a", "platform"), edge("E", "a", "platform")]
    assert names(way_to("platform", ("a",), [*LOOP, *twins], "base")) == ["D"]


def test_what_is_connected():
    pieces = [edge("A", "base", "a"), edge("B", "b", "a"), edge("C", "c", "d")]
    assert connected(pieces, "base") == ("base", "a", "b")
    assert connected(pieces, "elsewhere") == ()
