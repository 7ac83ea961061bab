"""Decoupling: the Jacobian against finite differences, a closed form, and what is left when inputs are locked."""

import dataclasses
from functools import lru_cache

import numpy as np
import pytest

import assur
from assur.kinematics.structure import linkage as structure
from assur.numerics.rotations import to_vector
from assur.topology import analysis
from assur.topology.answers import answers
from assur.topology.counting.decoupling import Decoupling, JudgedPattern, by_jacobian, by_rules, jacobian, judged
from assur.topology.counting.inputs import default_inputs
from assur.topology.notation import parse_chains
from assur.topology.screws.configurations import configurations
from assur.topology.screws.edges import Edge, along, closure, column_names, input_columns, null_basis
from assur.topology.screws.placing import place
from assur.topology.screws.twists import edges
from assur.topology.symbolic.refusals import Refusal
from twist_chains import closure_jacobian, poses, residuals

TRIPTERON = [f"P[{u}] R[{u}] R[{u}] R[{u}]" for u in "xyz"]
CRR = [f"C[{u}] R[{u}] R[{u}]" for u in "xyz"]
PAPER = ["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[x] P(4R)[y]"]
AROUND = ("0,1,0", "-0.8660254037844386,-0.5,0", "0.8660254037844386,-0.5,0")
MECHANISMS = {
    "tripteron": TRIPTERON,
    "3-CRR": CRR,
    "3-RRC": [f"R[{u}] R[{u}] C[{u}]" for u in AROUND],
    "planar 3-RRR": ["R[z] R[z] R[z]"] * 3,
    "five-bar": ["R[z] R[z] R[z]", "R[z] R[z]"],
    "3-RPS": [f"R[{u}] P[0.1,0.2,1] S" for u in AROUND],
    "6-UPS": ["U P S"] * 6,
    "6-SPS": ["S P[x] S", "S P[y] S", "S P[z] S"] * 2,
    "Delta 4S": [f"R[{u}] P(4S)[{u}]" for u in AROUND],
    "the paper's": PAPER,
}


@lru_cache
def placed(name, seed=0):
    chains = parse_chains(MECHANISMS[name])
    legs = {"6-UPS", "6-SPS", "3-RPS"} & {name}
    names = [joint.name for chain in chains for joint in chain.joints[1:2]] if legs else default_inputs(chains)
    linkage = place(chains, seed=seed, actuated=names)
    return linkage, configurations(linkage, 3, seed)


def sensitivity(linkage, values, step):
    """Change (6, n) of the platform's place per change of each input, by closing the loops again: no twists."""
    columns = [linkage.slices[joint].start + component for joint, component in linkage.inputs]

    def platform(wanted):
        found = values.copy()
        for _ in range(12):
            missing = np.concatenate([residuals(linkage, found[None])[0], found[columns] - wanted])
            slope = np.concatenate([closure_jacobian(linkage, found[None])[0], np.eye(len(found))[columns]])
            found = found - np.linalg.lstsq(slope, missing, rcond=1e-9)[0]
        assert np.max(np.abs(missing)) < 1e-10
        rotation, shift = poses(linkage, found[None])[linkage.platform]
        return rotation[0] @ linkage.point + shift[0], rotation[0]

    found = []
    for index in range(len(columns)):
        change = step * np.eye(len(columns))[index]
        (after, turned), (before, old) = platform(values[columns] + change), platform(values[columns] - change)
        found.append(np.concatenate([(after - before) / linkage.length, to_vector(turned @ old.T)]) / (2 * step))
    return np.stack(found, axis=-1)


@pytest.mark.parametrize("name", MECHANISMS)
def test_the_jacobian_is_how_the_platform_follows_its_inputs(name):
    linkage, values = placed(name)
    for here in values[:2]:
        (found,) = jacobian(edges(linkage, here[None]), "base", "platform")
        step = 1e-3 / max(1.0, np.max(np.abs(found)))  # close to a singular configuration the platform runs fast
        coarse, fine = sensitivity(linkage, here, step), sensitivity(linkage, here, step / 2)
        measured = (4 * fine - coarse) / 3
        np.testing.assert_allclose(found, measured, atol=1e-6 * np.max(np.abs(found)))


def test_the_papers_mechanism_follows_its_closed_form():
    """Where y depends on yA1 and yA2 alone, half of each."""
    mechanism = assur.load("zeng2019")
    linkage = structure(mechanism)
    values = configurations(linkage, 4)
    start = mechanism.home_values[[list(linkage.slices).index(name) for name in ("P1", "P2", "P3")]]
    compared = 0
    for here in values:
        (ours,) = jacobian(edges(linkage, here[None]), linkage.base, linkage.platform)
        rotation, shift = poses(linkage, here[None])[linkage.platform]
        pose = rotation[0] @ linkage.point + shift[0]
        inputs = [start[i] + here[linkage.slices[name].start] for i, name in enumerate(("P1", "P2", "P3"))]
        solutions = mechanism.inverse(pose)
        for mode, reached in zip(solutions.modes, solutions.inputs, strict=True):
            if np.allclose(reached, inputs, atol=1e-6):
                theirs = mechanism.velocity_map(pose, "".join("+" if sign > 0 else "-" for sign in mode)).matrix
                np.testing.assert_allclose(ours[:3], theirs, atol=1e-9)
                np.testing.assert_allclose(ours[3:], 0, atol=1e-9)
                np.testing.assert_allclose(ours[1], [0.5, 0.5, 0], atol=1e-9)
                compared += 1
    assert compared == len(values)


def test_the_papers_statement_of_partial_decoupling():
    found = assur.topology("zeng2019").decoupling
    assert found.outputs == ("x", "y", "z")
    assert found.inputs_of("y") == ("P1", "P2")
    assert found.inputs_of("x") == found.inputs_of("z") == ("P1", "P2", "P3")
    assert found.kind == "partial"


def left_by_locking(given):
    """The pattern by the theory's own words: with all inputs but one locked, which outputs still move."""
    columns, actuated = column_names(given), input_columns(given)
    names = {columns[index] for index in actuated}
    free = null_basis(closure(given))
    pattern = []
    for one in actuated:
        others = [index for index in actuated if index != one]
        held = free @ null_basis(free[:, others]) if others else free
        moves = along(given, "base", "platform") @ held
        sizes = np.max(np.abs(np.concatenate([moves[:, 3:], moves[:, :3]], axis=1)), axis=(0, 2))
        pattern.append(sizes > 1e-7)
    assert len(names) == len(actuated)
    return np.array(pattern).T


@pytest.mark.parametrize("name", MECHANISMS)
def test_locking_all_inputs_but_one_gives_the_same_pattern(name):
    linkage, values = placed(name)
    given = edges(linkage, values)
    found = by_jacobian(given, "base", "platform")
    pattern = left_by_locking(given)
    rows = [("x", "y", "z", "rx", "ry", "rz").index(output) for output in found.outputs]
    assert pattern[rows].tolist() == [list(row) for row in found.depends]
    assert not np.delete(pattern, rows, axis=0).any()


@pytest.mark.parametrize(
    ("name", "kind", "outputs"),
    [
        ("tripteron", "full", ("x", "y", "z")),
        ("3-CRR", "full", ("x", "y", "z")),
        ("the paper's", "partial", ("x", "y", "z")),
        ("planar 3-RRR", "none", ("x", "y", "rz")),
        ("five-bar", "none", ("x", "y", "rz")),
        ("Delta 4S", "none", ("x", "y", "z")),
        ("3-RPS", "none", ("x", "y", "z", "rx", "ry", "rz")),
    ],
)
def test_how_far_mechanisms_are_decoupled(name, kind, outputs):
    linkage, values = placed(name)
    found = by_jacobian(edges(linkage, values), "base", "platform")
    assert (found.kind, found.outputs) == (kind, outputs)


def test_kinds():
    def kind(*rows):
        return Decoupling(tuple("xyz"[: len(rows)]), tuple("abc"[: len(rows[0])]), rows).kind

    assert kind((False, True), (True, False)) == "full"
    assert kind((True, True), (False, True)) == "partial"
    assert kind((True, True), (True, True)) == "none"


def slide(name, rows, start, end, inputs=(0,)):
    return Edge(name, start, end, np.array(rows, dtype=float)[..., None], (name,), inputs)


def test_each_configuration_is_measured_by_itself():
    """Close to a singular configuration one column is huge; what is small beside it elsewhere is no zero."""
    x, y = np.eye(6)[3], np.eye(6)[4]
    table = [slide("P1", [1e10 * x, x], "base", "cart"), slide("P2", [y, y], "cart", "table")]
    assert by_jacobian(table, "base", "table").depends == ((True, False), (False, True))


@pytest.mark.parametrize(
    "actuated",
    [[], ["P1"], ["P1", "P2"], ["P1", "P2", "P3", "R1"], ["R1", "R2", "R3"]],
    ids=["none", "one", "two", "too many", "dependent"],
)
def test_inputs_that_do_not_determine_the_platform_have_no_jacobian(actuated):
    linkage = place(parse_chains(TRIPTERON), actuated=actuated)
    given = edges(linkage, configurations(linkage))
    assert by_jacobian(given, "base", "platform") is None
    if actuated:
        assert jacobian(given, "base", "platform") is None


# ---- by the rules ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "inputs"),
    [
        ("tripteron", ["P1", "P2", "P3"]),
        ("3-CRR", ["C1.1", "C2.1", "C3.1"]),
        ("3-RRC", ["R1", "R3", "R5"]),
        ("the paper's", ["P1", "P2", "P3"]),
    ],
)
def test_the_rules_give_the_pattern_of_the_jacobian(name, inputs):
    linkage, values = placed(name)
    found = by_jacobian(edges(linkage, values), "base", "platform")
    assert list(found.inputs) == inputs
    assert by_rules(parse_chains(MECHANISMS[name]), inputs) == found
    assert judged(by_rules(parse_chains(MECHANISMS[name]), inputs), found) == JudgedPattern(found)


def test_a_component_of_a_joint_is_locked_and_the_other_stays():
    cartesian = parse_chains(["C[x] R[x] R[x]", "C[y] R[y] R[y]", "U[z,x] P[y] P[z] P[x]"])
    translations = by_rules(cartesian, ["C1.1", "C2.1"])
    assert translations.depends[:2] == ((True, False), (False, True))
    rotation = by_rules(cartesian, ["C1.2", "C2.1"])
    assert rotation.depends[0] == (True, True)  # the C still slides along x whatever is locked
    assert rotation.depends[1] == (False, True)
    leg = parse_chains(["P[x] P[y] P[z]", "U[x,y] P[z] U[y,x]"])
    # U1.1 is locked anywhere, and the leg moves across an axis anywhere across x
    first = by_rules(leg, ["P1", "U1.1"])
    assert (first.outputs, first.depends) == (("x", "y", "z"), ((True, False), (True, True), (True, True)))
    # U1.2 is locked anywhere too, so the slide behind it points anywhere
    second = by_rules(leg, ["P1", "U1.2"])
    assert (second.outputs, second.depends) == (("x", "y", "z"), ((True, False), (True, True), (True, True)))


def test_a_branch_without_joints_left_holds_its_loop():
    chains = parse_chains(["{P[x] | P[x]} P[y] P[z]", "P[x] P[y] P[z]"])
    found = by_rules(chains, ["P1", "P3", "P4"])
    assert found.depends == ((True, False, False), (False, True, False), (False, False, True))


def test_a_limb_without_joints_left_is_not_decided():
    found = by_rules(parse_chains(["P[x]", "P[x] R[y] R[y] P[z]"]), ["P1", "P2"])
    assert isinstance(found, Refusal)
    assert "no joint left when every input but P2 is locked" in found.reason


def test_what_the_theory_promises_must_hold():
    rules = Decoupling(("x", "y"), ("P1", "P2"), ((True, False), (True, True)))
    assert judged(rules, rules) == JudgedPattern(rules)
    assert judged(Refusal("because"), rules) == JudgedPattern(rules, "because")
    fewer = dataclasses.replace(rules, depends=((True, False), (False, True)))
    assert judged(rules, fewer) == JudgedPattern(fewer, "the dimensions decouple more than the topology promises")
    more = dataclasses.replace(rules, depends=((True, True), (True, True)))
    refused = judged(rules, more)
    assert refused.decoupling is None
    assert "the rules say that x does not depend on P2, the twists say that it does" in refused.refusal
    other = Decoupling(("x", "y", "rz"), ("P1", "P2"), ((True, False), (True, True), (True, False)))
    assert "rz does not depend on P1" in judged(rules, other).refusal


def three(text):
    """Three limbs with axes a (radial) and t (tangential), turned about z."""
    turns = ((1.0, 0.0), (-0.5, 0.8660254037844386), (-0.5, -0.8660254037844386))
    return [text.replace("a", f"{c},{s},0").replace("t", f"{-s},{c},0") for c, s in turns]


LOCKED_AWAY_FROM_HOME = {
    "an axis turned back before the one that is locked": (
        ["R[x] R[x] P(4R)[z] R[x]", "C[x] R[x] R[x]", "P[y] R[y] P(4R)[x] R[y]"],
        ["2.3", "3.4", "2.2"],
    ),
    "3-RER": (three("R[t] R[a] R[a] R[a] R[t]"), None),
    "3-RER of a wrist": (three("R[a]@O R[t] R[t] R[t] R[a]@Q"), None),
    "3-RRPRR": (three("R[t] R[0,0,1] P[a] R[0,0,1] R[t]"), None),
}


@pytest.mark.parametrize("name", LOCKED_AWAY_FROM_HOME)
def test_a_locked_joint_keeps_the_angle_that_it_has_and_not_that_at_home(name):
    texts, actuate = LOCKED_AWAY_FROM_HOME[name]
    found = assur.topology(texts, actuate=actuate, mode="translation")
    assert (found.actuation.verdict, found.decoupling_refusal) == ("valid", "")
    assert found.decoupling is not None


def test_a_disagreement_on_decoupling_leaves_everything_else(monkeypatch):
    wrong = Decoupling(("x", "y", "z"), ("P1", "P2", "P3"), ((True, False, False),) * 3)
    monkeypatch.setattr(analysis, "decoupled_by_rules", lambda *_: wrong)
    found = assur.topology(PAPER)
    assert (str(found.poc), found.dof, found.xi, found.coupling_degree) == ("t³ r⁰", 3, (3, 5), 1)
    assert found.decoupling is None
    assert "the rules say that x does not depend on P2, the twists say that it does" in found.decoupling_refusal
    assert answers(found).decoupling is None
    assert answers(found).decoupling_refusal == found.decoupling_refusal
