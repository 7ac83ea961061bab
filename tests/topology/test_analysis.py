"""The whole topology of a linkage: both routes, modes, and linkages that POC theory does not represent."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.joints.revolute import REVOLUTE
from assur.topology.agreement import RoutesDisagreeError
from assur.topology.analysis import analyse, sample
from assur.topology.counting.inputs import numbered_inputs
from assur.topology.notation import parse_chains
from assur.topology.screws.linkage import Linkage, LinkageJoint
from assur.topology.screws.placing import place

PAPER = ["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[x] P(4R)[y]"]


def numbers(poc):
    return poc.t, poc.r, poc.dim


def test_the_paper_from_its_notation():
    found = assur.topology(PAPER)
    assert numbers(found.poc) == (3, 0, 3)
    assert [numbers(limb.poc) for limb in found.limbs] == [(3, 2, 5), (3, 0, 3)]
    assert str(found.limbs[0].poc) == "t³ r²(∥◇(R12, R5))"
    assert (found.dof, found.xi, found.delta, found.coupling_degree) == (3, (3, 5), (1, -1), 1)
    assert (found.redundant_constraints.collapsed, found.redundant_constraints.joint_graph) == (4, 10)
    assert found.redundant_by_loop == (("loop 1", 3), ("loop 2", 1), ("Pa1", 3), ("Pa2", 3))
    assert found.routes_agree
    assert found.decoupling.inputs_of("y") == ("P1", "P2")


def test_the_paper_from_its_joint_graph_and_from_the_literatures_notation_is_the_same():
    literature = [
        "HSOC{-◇(P1(2P4R), P2(2P4R)) ⊥ R[x](2P4R) ⊥ R3[y] ∥ R4-}",
        "-P3[y]-P(4R)[x]-P(4R)[y]-",
    ]
    graph, text = assur.topology("zeng2019"), assur.topology(literature)
    assert str(graph.limbs[0].poc) == str(text.limbs[0].poc) == "t³ r²(∥◇(R12, R3))"
    assert [(loop.xi, loop.delta) for loop in graph.loops] == [(loop.xi, loop.delta) for loop in text.loops]
    assert graph.redundant_constraints == text.redundant_constraints
    assert graph.decoupling.depends == text.decoupling.depends


@pytest.mark.parametrize(("mode", "expected"), [("home", (3, 3, 5)), ("translation", (3, 2, 5))])
def test_a_limb_has_one_answer_for_each_mode_that_is_asked_for(mode, expected):
    found = assur.topology("U[x,z] P[y] U[z,x]", mode=mode)
    assert numbers(found.limbs[0].poc) == expected
    assert found.routes_agree


def test_a_joint_graph_without_limbs_is_known_by_twists_alone():
    # a bridge between two limbs: no chains from base to platform in the sense of the theory
    rng = np.random.default_rng(3)
    links = [("base", "a"), ("a", "p"), ("base", "c"), ("c", "p"), ("a", "c"), ("base", "p")]
    joints = {}
    for index, (parent, child) in enumerate(links):
        point = rng.normal(size=3) * (1, 1, 0)
        screw = np.array([[0, 0, 1, *np.cross(point, (0, 0, 1))]])
        name = f"R{index}"
        joints[name] = LinkageJoint(name, REVOLUTE, parent, child, screw, point)
    found = analyse(Linkage(joints, "base", "p", rng.normal(size=3)))
    assert found.limbs == ()
    assert found.known.route == "twists"
    assert "no limbs" in found.known.refusal
    assert not found.routes_agree
    assert (found.dof, found.poc.dim) == (0, 0)


def bennett(first=0.9, short=1.0, long=1.7, small=0.5):
    """Joints of Bennett's linkage at one of its closed configurations: a / sin α = b / sin β."""
    large = float(np.arcsin(long * np.sin(small) / short))
    second = 2 * np.arctan(np.sin((large + small) / 2) / np.sin((large - small) / 2) / np.tan(first / 2))
    turns, lengths, twists = (first, second, -first, -second), (short, long) * 2, (small, large) * 2
    frame, axes = np.eye(4), []
    for turn, length, twist in zip(turns, lengths, twists, strict=True):
        axes.append((frame[:3, 2].copy(), frame[:3, 3].copy()))
        c, s, u, v = np.cos(turn), np.sin(turn), np.cos(twist), np.sin(twist)
        frame = frame @ np.array(
            [[c, -s * u, s * v, length * c], [s, c * u, -c * v, length * s], [0, v, u, 0], [0, 0, 0, 1]]
        )
    assert np.allclose(frame, np.eye(4))
    return axes


def test_bennetts_loop_is_refused_with_the_reason_and_not_answered():
    links = ("base", "one", "coupler", "two", "base")
    joints = {}
    for index, (axis, point) in enumerate(bennett()):
        name = f"R{index + 1}"
        screw = np.concatenate([axis, np.cross(point, axis)])[None]
        joints[name] = LinkageJoint(name, REVOLUTE, links[index], links[index + 1], screw, point)
    built = Linkage(joints, "base", "coupler", np.array([0.3, 0.4, 0.5]))
    assert sample(built).poc[2] == 1  # it moves
    with pytest.raises(RoutesDisagreeError, match=r"loop 1 \(R1, R2, R3, R4\): the rules say") as raised:
        analyse(built)
    assert "Bennett" in raised.value.hint


def test_inputs_of_what_does_not_move_are_refused():
    with pytest.raises(UsageError, match=r"3 actuated joints \(R1, R4, R7\) for 0 degrees of freedom"):
        assur.topology(["R[z] R[z] R[0.6,0,0.8]"] * 3, actuate=["1.1", "2.1", "3.1"])


PLANAR = ["R[z] R[z] R[z]"] * 4
UPR_RPU = [*["R[x]@O R[y] P[z] R[y]"] * 2, *["R[x] P[z] R[x] R[y]@B"] * 2]


@pytest.mark.parametrize(
    ("limbs", "actuate", "redundancy"),
    [
        (PLANAR, "1.1,2.1,3.1,4.1", 1),
        (PLANAR, "1.1,2.1,3.1,4.1,1.2", 2),
        (PAPER, "1.1,1.4,2.1,1.2", 1),
        (UPR_RPU, "1.3,2.3,3.2,4.2", 1),
    ],
    ids=["planar 4-RRR", "planar 4-RRR, five drives", "the paper's", "2UPR-2RPU"],
)
def test_redundant_inputs(limbs, actuate, redundancy):
    """Each set of inputs that is said to determine the mechanism does so by itself, with the same coupling degree."""
    found = assur.topology(limbs, actuate=actuate)
    asked = found.actuation
    assert (asked.verdict, asked.redundancy, found.coupling_degree) == ("redundant", redundancy, None)
    assert "are redundant" in found.coupling_refusal
    numbers = {numbered_inputs(parse_chains(limbs), [place])[0]: place for place in actuate.split(",")}
    for part in found.determining:
        alone = assur.topology(limbs, actuate=[numbers[name] for name in part.drives])
        assert (alone.actuation.verdict, alone.coupling_degree) == ("valid", part.coupling_degree)
        assert set(part.drives) | set(part.following) == set(asked.inputs)
    others = set(combinations(asked.inputs, asked.needed)) - {part.drives for part in found.determining}
    for drives in others:
        assert assur.topology(limbs, actuate=[numbers[name] for name in drives]).actuation.verdict != "valid"


def test_answers_do_not_depend_on_the_placing():
    chains = parse_chains(PAPER)
    facts = [analyse(place(chains, seed=seed, actuated=["P1", "P2", "P3"]), chains) for seed in range(4)]
    assert len({(str(item.poc), item.dof, item.xi, item.delta, item.decoupling.depends) for item in facts}) == 1


@pytest.mark.parametrize("branches", [("R[y] R[y]", "R[y] R[y] R[y]"), ("P[y] R[y] R[y]", "R[y] R[y] R[y]")])
def test_the_order_of_the_branches_of_a_loop_makes_no_difference(branches):
    one, other = branches
    found = [assur.topology(f"{{{first} | {second}}} P[y]") for first, second in ((one, other), (other, one))]
    assert numbers(found[0].poc) == numbers(found[1].poc)
    assert found[0].routes_agree
    assert found[1].routes_agree


def test_there_is_no_coupling_degree_where_the_inputs_depend_on_each_other():
    found = assur.topology(PAPER, actuate=["1.1", "1.2", "1.4"])
    assert found.actuation.verdict == "dependent"
    assert found.coupling_degree is None
    assert found.assur_chains == ()


def test_default_inputs_that_are_too_many_are_left_out_and_said():
    found = assur.topology(["R[z] R[z] R[z]", "R[z]"])
    assert (found.dof, found.inputs, found.coupling_degree) == (1, ("R1",), 0)
    assert "only R1, of R1, R4" in found.notes[0]


def test_a_platform_that_can_turn_has_no_translation_mode():
    with pytest.raises(UsageError, match="no translation mode"):
        assur.topology(["R[z] R[z] R[z]"] * 3, mode="translation")


def test_declared_facts_that_are_wrong_are_said(tmp_path):
    file = tmp_path / "mine.toml"
    text = (
        'format = 1\nkind = "topology"\nname = "mine"\nchains = ["R[z] R[z] R[z]", "R[z] R[z]"]\n[declared]\ndof = %s\n'
    )
    file.write_text(text % 2, encoding="utf-8")
    assert assur.topology(file).notes == ()
    file.write_text(text % 4, encoding="utf-8")
    assert assur.topology(file).notes == ("declared dof = 4, computed 2",)


@pytest.mark.parametrize("text", ["R[z] R[x]", "P[x] S", "R[z] {R[z] R[z] | R[z] R[z]} R[x]"])
def test_a_limb_alone_is_seen_wherever_its_linkage_says(text):
    placed = place(parse_chains([text]))
    at_end, beside = (analyse(replace(placed, point=placed.point + away)) for away in (np.zeros(3), np.ones(3)))
    assert (at_end.known.route, beside.known.route) == ("both", "both")
    assert beside.poc.t == at_end.poc.t + 1 + (text == "P[x] S")
