"""The plan of the direct problem: which search is left, why, and a second count of what special constraints leave."""

import dataclasses
from functools import lru_cache
from itertools import pairwise

import numpy as np
import pytest

import assur
from assur.model.registry import topology_names
from assur.results.answers.solution_order import AssurPlan, PlanStep
from assur.topology.answers import answers
from assur.topology.counting.coupling import coupling, coupling_of
from assur.topology.counting.inputs import default_inputs, numbered_inputs
from assur.topology.counting.mobility import motions
from assur.topology.counting.solution_plan import SolutionPlan, solution_plan
from assur.topology.notation import parse_chains
from assur.topology.screws.configurations import configurations
from assur.topology.screws.linkage import part
from assur.topology.screws.placing import place
from assur.topology.screws.twists import edges, generic_values
from catalogue import topology_of
from twist_chains import closure_jacobian, poses

NAMES = sorted({*assur.names(), *topology_names()})
HYBRID = "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]"
SLIDES = "P[y] P(4R)[x] P(4R)[y]"
AROUND = ("0,1,0", "-0.8660254037844386,-0.5,0", "0.8660254037844386,-0.5,0")
DELTA_4S = tuple(f"R[{u}] P(4S)[{u}]" for u in AROUND)
DELTA_4R = tuple(f"R[{u}] R[{u}] P(4R)[1,0.2,0.3] R[{u}]" for u in AROUND)
SEARCHES = {
    "zeng2019": (1, 0, "the platform does not rotate"),
    "fivebar": (0, 0, ""),
    "tripteron": (1, 0, "by P3, R7, R8, R9 alone O' stays in a known plane"),
    "three_crr": (1, 0, "by C3, R5, R6 alone O' stays in a known plane"),
    "tsai_platform": (1, 1, ""),
    "linear_delta_4r": (1, 1, ""),
    "orthoglide": (1, 1, ""),
    "three_rrc": (1, 1, ""),
    "planar_3rrr": (1, 1, ""),
    "delta_4s": (2, 1, "the platform does not rotate"),
    "three_upu": (2, 1, "the platform does not rotate"),
    "h4_robot": (2, 1, "the platform rotates about one fixed direction only"),
    "three_rps": (2, 2, ""),
    "three_ups_up": (2, 2, ""),
    "gough_stewart": (4, 4, ""),
    "six_sps": (4, 4, ""),
}


@lru_cache
def planned(*texts, actuate=(), order=None):
    """A linkage, its order of loops (the least coupled one by default), and the plan."""
    chains = parse_chains(texts)
    names = numbered_inputs(chains, actuate) if actuate else default_inputs(chains)
    linkage = place(chains, actuated=names)
    given = edges(linkage, generic_values(linkage))
    internal = motions(given, "base", "platform").internal
    loops = coupling_of(given, order, internal) if order else coupling(given, internal)
    return linkage, loops, solution_plan(loops, given, "base", "platform")


# ---- what is left to be searched ------------------------------------------------------------------------------


@pytest.mark.parametrize("name", SEARCHES)
def test_the_search_that_is_left(name):
    (only,) = topology_of(name).plan.parts
    assert (only.coupling_degree, only.search, only.reason) == SEARCHES[name]
    assert topology_of(name).plan.search == only.search


@pytest.mark.parametrize("name", NAMES)
def test_laws_of_every_plan(name):
    found = topology_of(name)
    plan = found.plan
    assert [item.coupling_degree for item in plan.parts] == [item.coupling_degree for item in found.assur_chains]
    assert [step.loop for item in plan.parts for step in item.steps] == list(range(len(found.loops)))
    for item in plan.parts:
        assert sum(step.virtual for step in item.steps) == item.coupling_degree
        assert sum(step.equations for step in item.steps) == item.coupling_degree
        assert 0 <= item.search <= item.coupling_degree
        assert (item.search < item.coupling_degree) == bool(item.reason)
        assert item.search <= sum(step.left for step in item.steps)
        if not item.reason:  # the rank of the loops with inputs locked is the running sum of Eq. (5)
            assert [step.left for step in item.steps] == [step.virtual for step in item.steps]
        for step in item.steps:
            assert step.joints == found.loops[step.loop].joints
            assert step.delta == found.loops[step.loop].delta == step.virtual - step.equations


def test_a_known_orientation_may_be_of_no_help():
    """It gives the angle of the first loop, but the platform can still move until the third loop's rod stops it."""
    _, loops, plan = planned(HYBRID, SLIDES, "U P S", actuate=("1.1", "1.4", "3.2"))
    assert [loop.delta for loop in loops.loops] == [1, 0, -1]
    (only,) = plan.parts
    assert (only.search, only.reason, [step.left for step in only.steps]) == (1, "", [1, 0, 0])


def test_spins_of_rods_are_no_virtual_variables():
    """Two rods with ball joints at both ends, a third one, then a limb that keeps the platform from turning."""
    order = (("S1", "P1", "S2", "S4", "P2", "S3"), ("S5", "P3", "S6"), ("P6", "P5", "P4"))
    texts = ("S P[z] S", "S P[x] S", "S P[y] S", "P[x] P[y] P[z]")
    _, loops, plan = planned(*texts, actuate=("1.2", "2.2", "3.2"), order=order)
    assert [loop.delta for loop in loops.loops] == [4, -1, -3]
    (only,) = plan.parts
    assert (only.coupling_degree, only.search) == (4, 1)
    assert [step.left for step in only.steps] == [1, 0, 0]
    assert only.reason == "the platform does not rotate"


def test_what_a_passive_limb_knows_is_used_in_the_loops_before_it():
    """Two rods and a planar passive limb: the platform is known to stay parallel to the plane, and in it."""
    order = (("U1", "P1", "S1", "S2", "P2", "U2"), ("U3", "P3", "S3"), ("R3", "R2", "R1"))
    texts = ("U P S", "U P S", "U P S", "R[z] R[z] R[z]")
    _, _, plan = planned(*texts, actuate=("1.2", "2.2", "3.2"), order=order)
    (only,) = plan.parts
    assert (only.coupling_degree, only.search) == (4, 1)
    assert only.reason == "the platform rotates about one fixed direction only and O' stays in a known plane"


def test_assur_chains_one_after_the_other():
    """A planar 3-RRR on the platform of another one: each has its own search, in one dimension at a time."""
    three = "{R[z] R[z] R[z] | R[z] R[z] R[z] | R[z] R[z] R[z]}"
    _, loops, plan = planned(f"{three} {three}", actuate=("1.1", "1.4", "1.7", "1.10", "1.13", "1.16"))
    assert [loop.delta for loop in loops.loops] == [1, -1, 1, -1]
    assert [(item.coupling_degree, item.search) for item in plan.parts] == [(1, 1), (1, 1)]
    assert plan.search == 1
    assert [line.partition(":")[0] for line in plan.words] == ["Assur chain 1"] * 3 + ["Assur chain 2"] * 3
    assert plan.words[-1] == "Assur chain 2: κ = 1: at most a search in 1 dimension."


def test_a_second_assur_chain_of_no_coupling():
    planar = ("R[z] R[z] R[z]",) * 3
    _, _, plan = planned(*planar, actuate=("1.1", "1.2", "2.1"))
    assert plan.words == (
        "Assur chain 1: loop 1 (R1, R2, R3, R6, R5, R4), Δ = 0, is solved by itself.",
        "Assur chain 1: κ = 0: no search.",
        "Assur chain 2: loop 2 (R7, R8, R9), Δ = 0, is solved from what is known by then.",
        "Assur chain 2: κ = 0: no search.",
    )
    assert plan.search == 0


def test_a_loop_in_the_middle_of_a_limb_is_reached_from_both_sides():
    """A driven slide below the loop and two hinges above it: the orientation of the platform holds it all the same."""
    inner = "P[z] {P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]"
    order = (("P2", "R1", "R2", "R4", "R3", "P3"), ("P1", "R5", "R6", "Pa2", "Pa1", "P4"))
    _, loops, plan = planned(inner, SLIDES, actuate=("1.1", "1.2", "1.5", "2.1"), order=order)
    assert [loop.delta for loop in loops.loops] == [1, -1]
    (only,) = plan.parts
    assert (only.search, only.reason) == (0, "the platform does not rotate")


def test_two_loops_that_hang_on_nothing_yet():
    """Loops inside two limbs, solved before any loop through the base."""
    inner = "R[z] {R[z] R[z] R[z] | R[z] R[z]} R[z]"
    order = (("R2", "R3", "R4", "R6", "R5"), ("R9", "R10", "R11", "R13", "R12"), ("R1", "R7", "R14", "R8"))
    _, loops, plan = planned(inner, inner, actuate=("1.2", "1.3", "2.2", "2.3", "1.1"), order=order)
    assert [loop.delta for loop in loops.loops] == [0, 0, 0]
    assert [item.search for item in plan.parts] == [0, 0, 0]


def test_a_search_ends_where_nothing_is_left_although_the_assur_chain_goes_on():
    """Planar: one variable until the third limb, none then, and another one inside the fourth limb."""
    rod, looped = "R[z] P[x] R[z]", "{R[z] R[z] | R[z] P[x] R[z]} R[z] R[z]"
    order = (
        ("R1", "P1", "R2", "R4", "P2", "R3"),
        ("R5", "P3", "R6"),
        ("R7", "R8", "R11", "R12"),
        ("R9", "P4", "R10"),
        ("P6", "P5"),
    )
    _, loops, plan = planned(rod, rod, rod, looped, "P[x] P[y]", actuate=("1.2", "3.2", "4.4"), order=order)
    assert [loop.delta for loop in loops.loops] == [2, -1, 1, -1, -1]
    (only,) = plan.parts
    assert (only.coupling_degree, only.search, only.reason) == (3, 1, "the platform does not rotate")
    assert [step.left for step in only.steps] == [1, 0, 1, 0, 0]


def test_a_loop_beyond_the_platform_is_planned_without_it():
    """What is known of the platform says nothing about a four-bar that it carries."""
    chains = parse_chains(["P[x] {R[z] R[z] | R[z] R[z]} P[y]"])
    placed = place(chains, actuated=["P1", "R1"])
    linkage = dataclasses.replace(placed, platform=placed.joints["P1"].child)
    given = edges(linkage, generic_values(linkage))
    plan = solution_plan(coupling(given), given, linkage.base, linkage.platform)
    assert [item.search for item in plan.parts] == [0]


@pytest.mark.parametrize(
    ("actuate", "free"), [(("1.1",), 2), (("1.1", "2.1"), 1), (("1.2", "1.3", "1.4"), 1)], ids=["1", "2", "dependent"]
)
def test_inputs_that_determine_no_solution_have_no_plan(actuate, free):
    _, _, plan = planned(*(f"P[{u}] R[{u}] R[{u}] R[{u}]" for u in "xyz"), actuate=actuate)
    assert (plan.parts, plan.free, plan.search) == ((), free, None)
    left = "1 freedom" if free == 1 else f"{free} freedoms"
    assert plan.words == (f"These inputs determine no solution: with all inputs locked the mechanism has {left} left.",)


def test_a_joint_beyond_the_loops_that_nothing_drives_leaves_no_coupling_degree():
    texts = ["{P[x] R[y] R[y] | P[x] R[y] R[y]} R[x]"]
    loose = assur.topology(texts, actuate=["1.1", "1.2", "1.4"])
    assert (loose.delta, loose.coupling_degree, loose.plan.free) == ((0,), None, 1)
    assert answers(loose).coupling_refusal == "with all inputs locked the mechanism has 1 freedom left"
    driven = assur.topology(texts, actuate=["1.1", "1.2", "1.4", "1.7"])
    assert (driven.delta, driven.coupling_degree, driven.coupling_refusal) == ((0,), 0, "")


def test_without_loops_there_is_nothing_to_solve():
    _, _, plan = planned("R[z] R[z]", actuate=("1.1", "1.2"))
    assert plan == SolutionPlan(())
    assert (plan.search, plan.words) == (0, ())


# ---- a second count -------------------------------------------------------------------------------------------


def held(linkage):
    """The same linkage with its inputs locked: links that an input joins are one."""
    locked = {joint for joint, _ in linkage.inputs}
    into = {linkage.joints[name].child: linkage.joints[name].parent for name in locked}
    joints = {
        name: dataclasses.replace(
            joint, parent=into.get(joint.parent, joint.parent), child=into.get(joint.child, joint.child)
        )
        for name, joint in linkage.joints.items()
        if name not in locked
    }
    return dataclasses.replace(linkage, joints=joints, inputs=(), groups={})


def freedoms_with_orientation_held(linkage, way):
    """Of loops by themselves after a finite displacement, as far as the platform does not turn; `way` leads to it."""
    (values,) = configurations(linkage, 1, hold="orientation")
    moved = 1e-6 * np.concatenate([np.eye(len(values)), -np.eye(len(values))])
    turned = poses(linkage, values + moved)["platform"][0].reshape(2, len(values), 9)
    matrix = np.concatenate([closure_jacobian(linkage, values[None])[0], ((turned[0] - turned[1]) / 2e-6).T])
    _, singular, axes = np.linalg.svd(matrix)
    free = axes[int(np.sum(singular > 1e-6)) :]
    outside = [column for name in way for column in range(len(values))[linkage.slices[name]]]
    return int(np.linalg.matrix_rank(np.delete(free, outside, axis=1), tol=1e-6))


def most_at_a_time(unknowns):
    """The largest number of variables that must be assumed before they can all be found."""
    rises = np.maximum(np.diff([0, *unknowns]), 0)
    ends = [0, *(index + 1 for index, number in enumerate(unknowns) if not number)]
    return max(int(sum(rises[start:end])) for start, end in pairwise(ends))


@pytest.mark.parametrize(
    ("texts", "actuate", "ways", "spins", "left"),
    [
        ((HYBRID, SLIDES), ("1.1", "1.4", "2.1"), [["R5", "R6"], []], [0, 0], [0, 0]),
        ((HYBRID, SLIDES, "U P S"), ("1.1", "1.4", "3.2"), [["R5", "R6"], [], []], [0, 0, 0], [0, 1, 0]),
        (DELTA_4S, ("1.1", "2.1", "3.1"), [[], []], [4, 6], [1, 0]),
        (DELTA_4R, ("1.1", "2.1", "3.1"), [[], []], [0, 0], [1, 0]),
    ],
    ids=["the paper's", "with a rod", "Delta 4S", "Delta 4R"],
)
def test_the_loops_by_themselves_are_as_free_as_the_plan_says(texts, actuate, ways, spins, left):
    """Displaced without the rest of the mechanism, parallelograms by their real joints, with all rods' spins."""
    linkage, loops, plan = planned(*texts, actuate=actuate)
    taken: list[str] = []
    counts = []
    for loop, way, spin in zip(loops.loops, ways, spins, strict=True):
        taken += loop.joints
        loose = held(part(linkage, [*taken, *way], "platform"))
        counts.append(freedoms_with_orientation_held(loose, way) - spin)
    assert counts == left
    assert plan.search == most_at_a_time(counts)


# ---- in words -------------------------------------------------------------------------------------------------


def test_the_papers_plan_in_words():
    assert topology_of("zeng2019").plan.words == (
        "loop 1 (P1, B1, C1, C2, B2, P2), Δ = +1, takes 1 virtual variable.",
        "loop 2 (P3, Pa1, Pa2, R4, R3), Δ = -1, gives 1 equation for what was assumed.",
        "κ = 1, but the platform does not rotate, which gives the virtual variable: no search is needed.",
    )


def plan_of(*steps, search, reason=""):
    """A plan of one Assur chain; steps as (Δ, left)."""
    made = [
        PlanStep(index, (f"J{index}",), delta, max(delta, 0), max(-delta, 0), left)
        for index, (delta, left) in enumerate(steps)
    ]
    return SolutionPlan((AssurPlan(tuple(made), sum(abs(delta) for delta, _ in steps) // 2, search, reason),))


@pytest.mark.parametrize(
    ("plan", "lines"),
    [
        (
            plan_of((2, 2), (0, 0), (-2, 0), search=2),
            (
                "loop 1 (J0), Δ = +2, takes 2 virtual variables.",
                "loop 2 (J1), Δ = 0, is solved in terms of what was assumed.",
                "loop 3 (J2), Δ = -2, gives 2 equations for what was assumed.",
                "κ = 2: at most a search in 2 dimensions.",
            ),
        ),
        (
            plan_of((2, 0), (0, 1), (-2, 0), search=1, reason="it is so"),
            (
                "loop 1 (J0), Δ = +2, takes 2 virtual variables.",
                "loop 2 (J1), Δ = 0, is solved in terms of what was assumed, "
                "and 1 of its own must be assumed once special constraints are used.",
                "loop 3 (J2), Δ = -2, gives 2 equations for what was assumed.",
                "κ = 2, but it is so, which leaves 1 virtual variable: at most a search in 1 dimension.",
            ),
        ),
        (
            plan_of((2, 0), (-2, 0), search=0, reason="it is so"),
            (
                "loop 1 (J0), Δ = +2, takes 2 virtual variables.",
                "loop 2 (J1), Δ = -2, gives 2 equations for what was assumed.",
                "κ = 2, but it is so, which gives all 2 virtual variables: no search is needed.",
            ),
        ),
        (plan_of((0, 0), search=0), ("loop 1 (J0), Δ = 0, is solved by itself.", "κ = 0: no search.")),
    ],
)
def test_sentences(plan, lines):
    assert plan.words == lines
