"""Random mechanisms against an oracle that shares no code with the library: finite motion, measured."""

import numpy as np
import pytest

import assur
from assur.errors import AssurError
from assur.topology.notation import parse_chains
from assur.topology.screws.placing import place
from assur.topology.screws.second_order import finite_motion, second_order
from mobility_oracle import finite_outcomes, least_sum_of_degrees, outcomes, random_mechanism

QUICK, ALL, TOGETHER = 8, 1000, 250
REFUSED = 0.03
"""Share of mechanisms that may be refused, which ends `assur topology` with another exit code than 0."""

BRANCH_POINT = ["R[x] R[y] P[z] R[y] R[x]", "P[x] R[1,0,2] R[1,0,2] R[1,0,2] R[y]", "R[y] R[y] R[y] R[1,0,2] R[1,0,2]"]


def mechanism(number):
    return random_mechanism(np.random.default_rng([77, number]))


def places(texts, inputs):
    """Inputs as the oracle knows them: which joint as written, and which of its components."""
    names = [joint.name for chain in parse_chains(texts) for joint in chain.joints]
    return [
        (names.index(name), int(component or 1) - 1) for name, _, component in (item.partition(".") for item in inputs)
    ]


def clear(followed):
    """Outcomes of which finite steps tell every rank, the usual one first."""
    return [outcome for outcome, _ in followed.most_common() if None not in outcome]


def compared(number):
    """Whether a mechanism was refused, with the reason; whatever is answered must have been met."""
    texts = mechanism(number)
    met = outcomes(texts, number)
    # what one walk alone met may be a singular configuration of a mode that others met
    real = {(item.freedoms, item.t, item.r, item.dim) for item, count in met.items() if item.real and count > 1}
    try:
        found = assur.topology(texts)
    except AssurError as error:  # what ends `assur topology` with another code than 0
        refusal = error.message
    else:
        refusal = ""
    if refusal:
        assert not real, (number, texts, dict(met), refusal)
        return refusal
    if found.is_shaky:
        followed = finite_outcomes(texts, number)
        usual = (clear(followed) or [outcome for outcome, _ in followed.most_common()])[0]
        said = (found.dof, found.poc.t, found.poc.r, found.poc.dim)
        assert not real, (number, texts, dict(met), found.notes)
        assert all(told in (None, other) for told, other in zip(usual, said, strict=True)), (number, texts, followed)
        return ""
    modes = [(mode.dof, mode.t, mode.r, mode.dim) for mode in found.modes if mode.real]
    assert modes[0] == (found.dof, found.poc.t, found.poc.r, found.poc.dim)
    # where the oracle never met a regular configuration it says nothing
    assert not real or modes[0] in real or real <= set(modes), (number, texts, dict(met), modes)
    assert len(modes) > 1 or real <= set(modes), (number, texts, dict(met), modes)
    assert not found.decoupling_refusal.startswith("the rules say"), (number, texts, found.decoupling_refusal)
    if len(modes) == 1 and real == set(modes):
        # no coupling degree where the inputs leave the platform a freedom
        answered = np.inf if found.coupling_degree is None else sum(abs(loop.delta) for loop in found.loops)
        least = least_sum_of_degrees(texts, places(texts, found.inputs), number)
        assert least in (answered, None), (number, texts, found.inputs, found.delta, least)
    return ""


def share_refused(numbers, record):
    reasons = {number: compared(number) for number in numbers}
    refused = {number: reason for number, reason in reasons.items() if reason}
    record("refused", f"{len(refused)} of {len(reasons)}")
    print(f"refused: {len(refused)} of {len(reasons)}", *refused.items(), sep="\n  ")  # noqa: T201  # shown with -rP
    return len(refused)


@pytest.mark.parametrize("start", range(0, QUICK, 4))
def test_what_is_said_of_random_mechanisms_is_what_they_do(start, record_property):
    assert share_refused(range(start, start + 4), record_property) <= 1


@pytest.mark.deep
@pytest.mark.parametrize("start", range(0, ALL, TOGETHER))
def test_what_is_said_of_a_thousand_random_mechanisms_is_what_they_do(start, record_property):
    assert share_refused(range(start, start + TOGETHER), record_property) < REFUSED * TOGETHER


@pytest.mark.parametrize(
    ("texts", "actuate", "least"),
    [
        # a limb that idles while the platform rests: an inner loop first would take a virtual variable for nothing
        (["{P[x] R[y] R[y] | P[x] R[y] R[y]} R[y] R[z]", "P[z] R[y] R[y] R[z]"], ["2.1", "2.2", "2.3"], 0),
        (["R[y] R[y] S", "{P[y] R[x] R[x] | U[x,y] P[z] S} P[y]", "R[1,0,2] R[z] P[z] R[1,0,2]"], None, 2),
        # nothing idles
        (["P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]"], None, 2),
        # the inputs leave the platform a freedom: no coupling degree
        (["P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]"], ["1.1", "2.1"], np.inf),
        (["{P[x] R[y] R[y] | P[x] R[y] R[y]} R[y] R[z]", "P[z] R[y] R[y] R[z]"], ["1.1", "2.1"], np.inf),
    ],
    ids=["idle limb", "idle limbs", "none idle", "too few", "too few with an inner loop"],
)
def test_the_least_coupled_order_leaves_internal_freedoms_out_of_the_first_loop_that_they_move(texts, actuate, least):
    found = assur.topology(texts, actuate=actuate)
    assert least_sum_of_degrees(texts, places(texts, found.inputs)) == least
    assert found.coupling_degree == (None if least == np.inf else least / 2)
    assert bool(found.coupling_refusal) == (found.coupling_degree is None)


def test_a_branch_point_is_told_from_a_shaky_linkage():
    """The platform turns about y in the plane across it, or moves in space where every configuration is singular.

    The orientations are R(u, a) R(y, b) = R(y, c) R(u, d), u along [1, 0, 2], by the second and the third limb: turns
    about y or about u alone. By the first, R(x, e) R(y, f) R(x, g), no turn about u starts at home.
    """
    found = assur.topology(BRANCH_POINT)
    assert (found.dof, str(found.poc)) == (3, "t²(⊥[0, 1, 0]) r¹(∥[0, 1, 0])")
    assert [(mode.dof, mode.t, mode.r, mode.real) for mode in found.modes] == [(3, 2, 1, True), (3, 3, 0, False)]
    assert any("home is a branch point, where 2 operation modes meet" in note for note in found.notes)
    met = outcomes(BRANCH_POINT, count=24)
    assert {(item.freedoms, item.t, item.r) for item in met if item.real} == {(3, 2, 1)}
    assert {item.t for item in met if not item.real} == {3}


@pytest.mark.parametrize(
    ("texts", "modes"),
    [
        (["R[1,0,2] R[1,0,2] R[1,0,2] R[1,0,2]", "C[z] U[z,x] R[z]"], {(3, 2, 1), (3, 2, 0)}),
        (["R[x] R[x] R[y] C[x]", "R[y] R[y] R[z] C[y]", "R[x] R[x] R[y] C[x]"], {(3, 3, 3), (3, 3, 0)}),
        (["R[0.6,0.8,0] R[-0.5,0.8,1.1] R[-0.5,0.8,1.1] R[-0.5,0.8,1.1] R[0.6,0.8,0]"] * 3, {(4, 3, 1), (3, 2, 1)}),
    ],
)
def test_all_operation_modes_that_meet_at_home_are_named(texts, modes):
    found = assur.topology(texts)
    assert {(mode.dof, mode.t, mode.r) for mode in found.modes if mode.real} == modes
    assert {(item.freedoms, item.t, item.r) for item in outcomes(texts) if item.real} <= modes


def test_modes_of_the_same_numbers_are_not_mixed():
    """The orientations are R(x, a) R(y, b) = R(y, c) R(x, d): turns about x alone, or about y alone, with t³ each."""
    found = assur.topology(["R[x] R[x] C[y] P[y] R[y]", "R[y] R[y] C[x] P[x] R[x]", "R[x] R[x] C[y] P[y] R[y]"])
    assert [(mode.dof, mode.t, mode.r, mode.real) for mode in found.modes] == [(7, 3, 1, True)] * 2
    assert sorted(mode.poc for mode in found.modes) == ["t³ r¹(∥[0, 1, 0])", "t³ r¹(∥[1, 0, 0])"]
    assert str(found.poc) == found.modes[0].poc


def test_a_mechanism_that_only_seems_to_move_is_said_not_to():
    texts = ["S R[z] R[z]", "R[x] R[x] P[x] P(4R)[y]", "U[0.6,0.8,0; 0,1,0] R[0.6,0.8,0]"]
    found = assur.topology(texts)
    assert (found.dof, found.poc.dim, found.is_shaky, found.inputs) == (0, 0, True, ())
    assert "shaky: 1 instantaneous freedom for F = 0" in found.coupling_refusal
    assert not any(item.real for item in outcomes(texts))
    assert set(finite_outcomes(texts)) == {(0, 0, 0, 0)}


def test_of_a_shaky_mechanism_the_finite_motion_is_said():
    """R[z] and R[x] of the platform are about two axes across: C[z] C[1,0,2] and C[x] C[1,0,2] turn it neither way."""
    texts = ["C[z] C[1,0,2]", "C[x] C[1,0,2]"]
    found = assur.topology(texts)
    assert (found.dof, found.poc.t, found.poc.r, found.poc.dim) == (2, 2, 0, 2)
    assert [mode.real for mode in found.modes] == [False]
    assert (found.coupling_degree, found.decoupling, found.actuation.verdict) == (None, None, "valid")
    assert set(clear(finite_outcomes(texts))) == {(2, 2, 0, 2)}
    assert {item.freedoms for item in outcomes(texts)} == {3}


@pytest.mark.deep
def test_a_shaky_mechanism_with_inner_loops_moves_as_finite_steps_do():
    bar = "{R[x] R[x] R[x] | R[x] R[x] R[x]} P[x] P[0.6,0.8,0] R[0.6,0.8,0]"
    texts = [bar, bar.replace("x", "y"), bar]
    found = assur.topology(texts)
    assert (found.dof, found.poc.t, found.poc.r, found.poc.dim) == (7, 3, 1, 4)
    assert {item.freedoms for item in outcomes(texts)} == {8}
    assert clear(finite_outcomes(texts))[0] == (7, 3, 1, 4)


def test_of_freedoms_that_are_blocked_together_nothing_is_claimed():
    """Whether two forms have zeros in common depends on dimensions: with others this one moves with F = 3."""
    bar = "{R[z] R[z] R[z] | R[z] R[z] R[z]} R[0.6,0.8,0] R[z]"
    other = "{P[y] R[z] R[z] | P[y] R[z] R[z]} H[1,0,2] R[x] C[z]"
    placed = place(parse_chains([bar, other, "P(4R)[1,0,2] R[y] U[1,0,2; 0,1,0]", "R[x] R[z] P[z] H[x] R[z]"]))
    order = second_order(placed, np.zeros(sum(len(joint.screws) for joint in placed.joints.values())))
    assert (order.instantaneous, order.freedoms, order.proved) == (4, 2, False)
    assert finite_motion(placed) is None
