"""Mobility: the formula, internal freedoms by name, idle joints, kinematic redundancy, and graphs that hang apart."""

import numpy as np
import pytest

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.structure import linkage
from assur.model.registry import load_record
from assur.topology.counting.mobility import InternalFreedom, mobility, motions
from assur.topology.screws.edges import Edge, along, closure, rank
from twist_chains import X, Y, Z, ball, chain, slide, turn, turns


def at_home(name):
    """The joint graph of a mechanism at its home, straight from its screws."""
    graph = linkage(load_record(name))
    shift = np.eye(6)
    shift[3:, :3] = -np.cross(graph.point, np.eye(3)).T
    size = np.array([1, 1, 1, *[graph.length] * 3])
    inputs = {joint: (index,) for joint, index in graph.inputs}
    edges = [
        Edge(
            item.name,
            item.parent,
            item.child,
            (shift @ item.screws.T / size[:, None])[None],
            (item.name,),
            inputs.get(item.name, ()),
        )
        for item in graph.joints.values()
    ]
    return edges, graph.base, graph.platform


# ---- the formula ---------------------------------------------------------------------------------------------


def test_the_joint_graph_of_the_paper_at_home():
    """E13: 17 joints, 14 links, 4 loops, rank 14 of 24, F = 3, 10 redundant constraints."""
    found = mobility(*at_home("zeng2019"))
    assert (found.joints, found.links, found.loops, found.rank) == (17, 14, 4, 14)
    assert (found.dof, found.platform, found.redundant_constraints) == (3, 3, 10)
    assert (found.internal, found.idle, found.idle_components) == ((), (), ())


def test_a_planar_five_bar():
    rng = np.random.default_rng(0)
    found = mobility(
        chain("A", "base", "p", turns(rng, Z, 3), (0,)) + chain("B", "base", "p", turns(rng, Z, 2), (0,)),
        "base",
        "p",
    )
    assert (found.dof, found.rank, found.loops, found.redundant_constraints, found.platform) == (2, 3, 1, 3, 2)
    assert (found.controlled, found.platform) == (2, 2)


def test_a_serial_chain_has_all_its_freedoms():
    found = mobility(chain("A", "base", "p", turns(np.random.default_rng(0), Z, 4), (0, 1, 2, 3)), "base", "p")
    assert (found.dof, found.rank, found.loops, found.redundant_constraints) == (4, 0, 0, 0)
    assert (found.platform, found.internal_freedoms, found.controlled) == (3, 0, 4)


def test_a_structure_does_not_move():
    rng = np.random.default_rng(0)
    bars = [edge for name in "ABC" for edge in chain(name, "base", "p", turns(rng, Z, 2))]
    found = mobility(bars, "base", "p")
    assert (found.dof, found.platform, found.idle) == (0, 0, tuple(edge.name for edge in bars))


# ---- internal freedoms ---------------------------------------------------------------------------------------


def legs(rng, count, first=ball):
    found = []
    for index in range(count):
        low, high = rng.normal(size=(2, 3))
        found += chain(f"L{index + 1}", "base", "p", [first(low), [slide(high - low)], ball(high)], (1,))
    return found


def test_each_leg_with_two_ball_joints_spins():
    found = mobility(legs(np.random.default_rng(1), 6), "base", "p")
    assert (found.dof, found.platform, found.internal_freedoms, found.controlled) == (12, 6, 6, 6)
    assert found.internal == tuple(InternalFreedom((f"L{i}J1", f"L{i}J3"), 1) for i in range(1, 7))


def test_a_cylindrical_joint_slides_and_spins_with_a_ball_on_its_axis():
    """S-C-S: the spin is shared by all three, one freedom between one end's S and the C, one between the two S."""
    rng = np.random.default_rng(1)
    low, high = rng.normal(size=(2, 3))
    rod = chain("L", "base", "p", [ball(low), [slide(high - low), turn(high - low, low)], ball(high)], (1,))
    found = mobility(rod + legs(rng, 5, lambda at: [turn(X, at), turn(Y, at)]), "base", "p")
    assert found.internal == (InternalFreedom(("LJ1", "LJ2", "LJ3"), 2),)
    assert (found.dof, found.controlled) == (8, 6)


def test_a_loop_between_two_ball_joints_spins_as_a_whole():
    """A rod that is a parallelogram: every bar spins with it, but the joints that move are the two balls."""
    rng = np.random.default_rng(2)
    low, high = rng.normal(size=(2, 3))
    middle = rng.normal(size=3)
    rod = [
        *chain("A", "base", "m", [ball(low)]),
        *chain("B", "m", "n", turns(rng, middle, 2)),
        *chain("C", "m", "n", turns(rng, middle, 2)),
        *chain("D", "n", "p", [ball(high)]),
    ]
    found = mobility(rod + legs(rng, 6, lambda at: [turn(X, at), turn(Y, at)]), "base", "p")
    assert found.internal == (InternalFreedom(("AJ1", "DJ1"), 1),)


def test_an_input_that_moves_with_the_platform_at_rest_is_not_internal():
    """A planar limb with one joint too many, with and without an input of its own."""
    rng = np.random.default_rng(2)
    plain = [edge for name in "AB" for edge in chain(name, "base", "p", turns(rng, Z, 3), (0,))]
    spare = turns(rng, Z, 4)
    driven = mobility(plain + chain("C", "base", "p", spare, (0, 1)), "base", "p")
    assert (driven.dof, driven.platform, driven.internal_freedoms, driven.controlled) == (4, 3, 0, 4)
    loose = mobility(plain + chain("C", "base", "p", spare), "base", "p")
    assert loose.internal == (InternalFreedom(("CJ1", "CJ2", "CJ3", "CJ4"), 1),)
    assert (loose.controlled, loose.platform) == (3, 3)


def test_every_part_of_a_mechanism_without_inputs_that_rests_the_platform_is_internal():
    rng = np.random.default_rng(2)
    bars = chain("A", "base", "p", turns(rng, Z, 5)) + chain("B", "base", "p", turns(rng, Z, 3))
    found = mobility(bars, "base", "p")
    assert (found.dof, found.platform, found.internal_freedoms) == (5, 3, 2)
    assert found.internal == (InternalFreedom(("AJ1", "AJ2", "AJ3", "AJ4", "AJ5"), 2),)


@pytest.mark.parametrize("seed", range(8))
def test_useful_and_internal_motions_are_all_motions(seed):
    """The two bases together are orthonormal, close every loop, and the internal ones rest the platform."""
    edges = legs(np.random.default_rng(seed), 4)
    found = motions(edges, "base", "p")
    both = np.concatenate([found.useful, found.internal], axis=-1)[0]
    np.testing.assert_allclose(both.T @ both, np.eye(both.shape[1]), atol=1e-12)
    np.testing.assert_allclose(closure(edges)[0] @ both, 0.0, atol=1e-9)
    np.testing.assert_allclose(along(edges, "base", "p")[0] @ found.internal[0], 0.0, atol=1e-9)
    assert both.shape[1] == sum(edge.freedoms for edge in edges) - rank(closure(edges))
    assert (found.useful.shape[-1], found.internal.shape[-1]) == (6, 4)


# ---- idle joints ---------------------------------------------------------------------------------------------


def test_a_joint_that_planar_motion_leaves_at_rest():
    """A four-bar whose loop holds a joint about an axis in its plane, and a C where an R would do."""
    rng = np.random.default_rng(3)
    point = rng.normal(size=3)
    joints = [*turns(rng, Z, 3), [turn(X, point)], [slide(Z), turn(Z, rng.normal(size=3))]]
    links = chain("A", "base", "base", joints, (0,))
    found = mobility(links, "base", links[1].child)
    assert (found.dof, found.rank) == (1, 5)
    assert found.idle == ("AJ4",)
    assert found.idle_components == ("AJ5.1",)


# ---- graphs that are none --------------------------------------------------------------------------------------


def test_links_that_hang_apart_are_refused():
    rng = np.random.default_rng(0)
    edges = chain("A", "base", "p", turns(rng, Z, 2)) + chain("B", "floor", "lamp", turns(rng, Z, 1))
    with pytest.raises(UsageError, match="no joints connect the links floor, lamp with the base 'base'"):
        mobility(edges, "base", "p")


def test_unknown_links_are_refused():
    edges = chain("A", "base", "p", turns(np.random.default_rng(0), Z, 2))
    with pytest.raises(UnknownNameError, match="unknown link 'platform'"):
        mobility(edges, "base", "platform")
