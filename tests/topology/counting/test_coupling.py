"""The coupling degree: printed and tabulated values, orders, and Assur chains."""

import dataclasses

import numpy as np
import pytest

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.structure import linkage
from assur.model.registry import load_record
from assur.topology.counting.coupling import coupling, coupling_of
from assur.topology.counting.mobility import motions
from assur.topology.counting.solution_plan import solution_plan
from coupled_mechanisms import (
    crr,
    delta_4r,
    delta_4s,
    driven,
    five_bar,
    gough,
    gough_sps,
    h4,
    linear_delta_4s,
    orthoglide,
    planar_rpr,
    planar_rrr,
    rps,
    rrc,
    tricept,
    tripteron,
    upu,
    zeng,
    zeng_with_one_five_dof_limb,
)
from twist_chains import X, Y, Z, chain, generic_edges, slide, turn, turns

# ---- printed and tabulated values ----------------------------------------------------------------------------

ROWS = [
    (zeng, [3, 5], [1, -1], 1),
    (delta_4r, [5, 4], [1, -1], 1),
    (orthoglide, [5, 4], [1, -1], 1),
    (delta_4s, [6, 6], [2, -2], 2),
    (linear_delta_4s, [6, 6], [2, -2], 2),
    (upu, [6, 6], [2, -2], 2),
    (tripteron, [5, 4], [1, -1], 1),
    (crr, [5, 4], [1, -1], 1),
    (rrc, [5, 4], [1, -1], 1),
    (planar_rrr, [3, 3], [1, -1], 1),
    (planar_rpr, [3, 3], [1, -1], 1),
    (five_bar, [3], [0], 0),
    (rps, [6, 6], [2, -2], 2),
    (gough, [6] * 5, [4, -1, -1, -1, -1], 4),
    (tricept, [6, 6, 6], [2, -1, -1], 2),
    (h4, [6, 6, 6], [2, 0, -2], 2),
]


@pytest.mark.parametrize(("build", "xi", "delta", "kappa"), ROWS, ids=[row[0].__name__ for row in ROWS])
@pytest.mark.parametrize("seed", [1, 2])
def test_tabulated_mechanism(build, xi, delta, kappa, seed):
    found = coupling(build(np.random.default_rng(seed)))
    assert [loop.xi for loop in found.loops] == xi
    assert [loop.delta for loop in found.loops] == delta
    assert found.coupling_degree == kappa
    assert [chain.loops for chain in found.assur_chains] == [tuple(range(len(xi)))]


def test_the_loops_of_the_paper():
    """LOOP 1 is the 2P4R mechanism, LOOP 2 runs R3 ∥ R4 - P(4R) - P(4R) - P3; f = 6 + 5, I = 2 + 1."""
    first, second = coupling(zeng(np.random.default_rng(0))).loops
    assert first.joints == ("AJ1", "AJ2", "AJ3", "BJ3", "BJ2", "BJ1")
    assert second.joints == ("CJ1", "CJ2", "DJ3", "DJ2", "DJ1")
    assert [(loop.freedoms, loop.inputs, loop.redundant_constraints) for loop in (first, second)] == [
        (6, 2, 3),
        (5, 1, 1),
    ]


@pytest.mark.parametrize(("collapsed", "xi", "kappa"), [(True, [3, 5], 1), (False, [3, 3, 3, 5], 2)])
def test_the_mechanism_of_the_paper_with_its_dimensions(collapsed, xi, kappa):
    """κ = 1 belongs to the graph with parallelograms as one joint each; with all 17 joints it is 2."""
    edges = generic_edges(linkage(load_record("zeng2019")), collapsed=collapsed)
    found = coupling(edges)
    assert sorted(loop.xi for loop in found.loops) == xi
    assert (found.remainder, found.coupling_degree) == (0, kappa)


def test_collapsing_the_inner_loop_hides_the_coupling():
    found = coupling(zeng_with_one_five_dof_limb(np.random.default_rng(0)))
    assert [(loop.xi, loop.delta) for loop in found.loops] == [(5, 0)]
    assert found.coupling_degree == 0


# ---- orders -------------------------------------------------------------------------------------------------


def names(edges, *starts):
    return [edge.name for edge in edges if edge.name.startswith(starts)]


def test_another_order_halves_the_coupling_degree():
    """Two UPS legs first give κ = 4; the leg that guides the platform among the first two gives 2."""
    edges = tricept(np.random.default_rng(3))
    as_named = coupling_of(edges, [names(edges, "L1", "L2"), names(edges, "L3"), names(edges, "L4")])
    assert ([loop.delta for loop in as_named.loops], as_named.coupling_degree) == ([4, -1, -3], 4)
    assert coupling(edges).coupling_degree == 2


def test_separate_inner_loops_first_double_the_coupling_degree():
    edges = h4(np.random.default_rng(3))
    worse = coupling_of(edges, [names(edges, "A", "B"), names(edges, "C", "D"), names(edges, "E", "F")])
    assert ([loop.delta for loop in worse.loops], worse.coupling_degree) == ([2, 2, -4], 4)


def test_the_order_of_the_paper_is_among_the_best():
    edges = zeng(np.random.default_rng(3))
    best = coupling(edges)
    assert coupling_of(edges, [loop.joints for loop in best.loops]) == best


def test_an_order_may_start_with_the_outer_loop():
    """The outer loop first, through base, one arm of the inner loop and platform; the other arm closes the inner."""
    edges = zeng(np.random.default_rng(3))
    found = coupling_of(edges, [names(edges, "A", "C", "D"), names(edges, "B")])
    assert [loop.delta for loop in found.loops] == [1, -1]
    assert found.loops[0].joints == ("AJ1", "AJ2", "AJ3", "CJ1", "CJ2", "DJ3", "DJ2", "DJ1")


@pytest.mark.parametrize(
    ("order", "error", "text"),
    [
        ([["AJ1", "nothing"]], UnknownNameError, "unknown joint 'nothing'"),
        ([["AJ1", "AJ2"]], UsageError, "part of a chain"),
        ([["AJ1", "AJ2", "AJ3"]], UsageError, "does not add exactly one loop"),
        ([["AJ1", "AJ2", "AJ3", "BJ1", "BJ2", "BJ3"]], UsageError, "in no loop of the order"),
        ([[f"{a}J{i}" for a in "ABD" for i in (1, 2, 3)] + ["CJ1", "CJ2"]], UsageError, "loop 1 of the order"),
    ],
)
def test_an_order_that_is_none(order, error, text):
    with pytest.raises(error, match=text):
        coupling_of(zeng(np.random.default_rng(3)), order)


# ---- several Assur chains, serial arms, single loops, internal freedoms ------------------------------------------


def test_two_five_bars_in_series_are_two_chains():
    rng = np.random.default_rng(4)
    more = driven("C", "p", "q", turns(rng, Z, 3)) + driven("D", "p", "q", turns(rng, Z, 2))
    found = coupling(five_bar(rng) + more)
    assert [(item.loops, item.coupling_degree) for item in found.assur_chains] == [((0,), 0), ((1,), 0)]
    assert found.coupling_degree == 0


def test_the_chain_with_the_largest_coupling_degree_counts():
    """A five-bar (0) whose coupler carries a planar 3-RRR (1)."""
    rng = np.random.default_rng(4)
    more = [edge for n in "CDE" for edge in driven(n, "p", "q", turns(rng, Z, 3))]
    found = coupling(five_bar(rng) + more)
    assert [(item.loops, item.coupling_degree) for item in found.assur_chains] == [((0,), 0), ((1, 2), 1)]
    assert found.coupling_degree == 1


def test_an_assur_chain_stands_on_the_one_before_it():
    """A six-bar linkage: a four-bar driven by its crank, and two more bars on its coupler and the base."""
    rng = np.random.default_rng(4)
    four_bar = driven("A", "base", "coupler", turns(rng, Z, 2)) + driven("B", "base", "coupler", turns(rng, Z, 2), ())
    edges = four_bar + driven("C", "base", "coupler", turns(rng, Z, 3), ())
    found = coupling(edges)
    assert [item.coupling_degree for item in found.assur_chains] == [0, 0]
    assert [loop.joints for loop in found.loops] == [("AJ1", "AJ2", "BJ2", "BJ1"), ("CJ1", "CJ2", "CJ3")]


def test_an_arm_in_no_loop_takes_no_part():
    rng = np.random.default_rng(4)
    arm = driven("Z", "p", "tip", turns(rng, X, 2), (0, 1))
    foot = driven("Y", "ground", "base", [[slide(X)]])
    found = coupling(foot + five_bar(rng) + arm)
    assert found == coupling(five_bar(np.random.default_rng(4)))


def test_a_serial_chain_has_no_loops():
    found = coupling(driven("A", "base", "p", turns(np.random.default_rng(0), Z, 3)))
    assert (found.loops, found.assur_chains, found.coupling_degree) == ((), (), 0)


def test_a_single_loop_with_all_inputs_is_not_coupled():
    rng = np.random.default_rng(4)
    ring = driven("A", "base", "base", [[turn(rng.normal(size=3), rng.normal(size=3))] for _ in range(8)], (0, 1))
    found = coupling(ring)
    assert [(loop.xi, loop.delta, len(loop.joints)) for loop in found.loops] == [(6, 0, 8)]
    assert found.coupling_degree == 0


@pytest.mark.parametrize(("inputs", "remainder"), [((), 2), ((0,), 0), ((0, 1), -2)])
def test_too_few_or_too_many_inputs_have_no_coupling_degree(inputs, remainder):
    rng = np.random.default_rng(4)
    edges = driven("A", "base", "p", turns(rng, Z, 3), inputs) + driven("B", "base", "p", turns(rng, Z, 2), inputs)
    found = coupling(edges)
    assert found.remainder == remainder
    assert found.coupling_degree == (None if remainder else 0)
    assert len(found.assur_chains) == (0 if remainder else 1)


def test_spins_of_the_legs_are_left_out():
    edges = gough_sps(np.random.default_rng(4))
    internal = motions(edges, "base", "p").internal
    assert coupling(edges).remainder == 6
    reduced = coupling(edges, internal)
    assert ([loop.delta for loop in reduced.loops], reduced.coupling_degree) == ([4, -1, -1, -1, -1], 4)
    assert [loop.internal for loop in reduced.loops] == [2, 1, 1, 1, 1]


@pytest.mark.parametrize(("joints", "by_loop"), [(["AJ1", "CJ1"], [1, 0]), (["CJ1", "CJ2"], [0, 1])])
def test_an_internal_freedom_counts_with_the_first_loop_that_it_moves(joints, by_loop):
    edges = zeng(np.random.default_rng(3))
    order = [names(edges, "A", "B"), names(edges, "C", "D")]
    columns = np.array([edge.name for edge in edges for _ in range(edge.freedoms)])
    internal = np.isin(columns, joints)[None, :, None] / np.sqrt(2)
    assert [loop.internal for loop in coupling_of(edges, order, internal).loops] == by_loop


def loose_inner_loop(inputs):
    """A planar loop of two arms, carried on by a fourth R that is parallel, beside a limb whose joints are driven."""
    rng = np.random.default_rng(6)
    return [
        *chain("A", "base", "m", turns(rng, Y, 3)),
        *chain("B", "base", "m", turns(rng, Y, 3)),
        *chain("C", "m", "p", turns(rng, Y, 1)),
        *driven("D", "base", "p", turns(rng, Y, 3), inputs),
    ]


def test_what_may_have_any_value_is_neither_assumed_nor_searched():
    """With D driven the platform is known. The link m keeps one freedom, to which any value may be given.

    So each loop is solved in turn: D with C and one arm, then the other arm. Were the freedom counted with the loop
    that closes all its joints, the first would need a virtual variable, and the second an equation for it.
    """
    edges = loose_inner_loop((0, 1, 2))
    internal = motions(edges, "base", "p").internal
    assert internal.shape[-1] == 1
    found = coupling(edges, internal)
    assert [(loop.internal, loop.delta) for loop in found.loops] == [(1, 0), (0, 0)]
    assert (found.remainder, found.coupling_degree) == (0, 0)
    inner_first = coupling_of(edges, [names(edges, "A", "B"), names(edges, "C", "D")], internal)
    assert [(loop.internal, loop.delta) for loop in inner_first.loops] == [(1, 2), (0, -2)]
    plan = solution_plan(found, edges, "base", "p")
    assert (plan.search, plan.free) == (0, 0)


# ---- limits -------------------------------------------------------------------------------------------------


def test_more_sets_than_the_limit_are_refused():
    with pytest.raises(UsageError, match="more than 20 sets of loops among 6 chains") as caught:
        coupling(gough(np.random.default_rng(1)), limit=20)
    assert "give the order" in caught.value.hint


def test_configurations_are_taken_together():
    """A configuration where the mechanism is singular does not lower the ranks."""
    good, other = planar_rrr(np.random.default_rng(1)), planar_rrr(np.random.default_rng(2))
    edges = [
        dataclasses.replace(first, twists=np.concatenate([0 * first.twists + slide(X)[:, None], first.twists]))
        for first in good
    ]
    assert coupling(edges) == coupling(other)
