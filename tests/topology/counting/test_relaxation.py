"""Relaxation: replacements that remove redundant constraints, and leave motion, inputs and platform as they were."""

import dataclasses
from functools import partial

import numpy as np
import pytest

from assur.joints.cylindrical import CYLINDRICAL
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.joints.universal import UNIVERSAL
from assur.kinematics.structure import linkage
from assur.model.registry import load_record
from assur.topology.counting.coupling import coupling
from assur.topology.counting.mobility import mobility
from assur.topology.counting.relaxation import Replacement, relaxation
from twist_chains import X, Y, Z, generic_edges, slide, turn
from twist_chains import chain as named_chain

chain = partial(named_chain, letter="")


def four_bar():
    points = [(0, 0, 0), (1, 2, 0), (4, 2.5, 0), (5, 0, 0)]
    found = chain("R", "base", "base", [[turn(Z, point)] for point in points], (0,))
    return found, "base", found[1].child


def built(graph, replacements):
    """The linkage with other joints in the place of some, at their own points, parallelograms taken apart."""
    joints = dict(graph.joints)
    for item in replacements:
        old = joints[item.joint]
        axis = old.screws[0, :3] if item.old == "R" else old.screws[0, 3:]
        second = np.cross(axis, (0.3, 0.5, 0.7))
        kind, screws = {
            "C": (CYLINDRICAL, [slide(axis), turn(axis, old.point)]),
            "U": (UNIVERSAL, [turn(axis, old.point), turn(second / np.linalg.norm(second), old.point)]),
            "S": (SPHERICAL, [turn(each, old.point) for each in (X, Y, Z)]),
        }[item.new]
        joints[item.joint] = dataclasses.replace(old, type=kind, screws=np.array(screws))
    return dataclasses.replace(graph, joints=joints, groups={})


def test_a_planar_four_bar_takes_a_cylindrical_and_a_spherical_joint():
    """The textbook remedy: R-S-C-R has no redundant constraint, and moves as R-R-R-R does."""
    found = relaxation(*four_bar())
    assert found.redundant == 3
    assert {(item.joint, item.new, item.removed, item.internal) for item in found.single} == {
        (f"R{i}", *kind) for i in (2, 3, 4) for kind in (("C", 1, 0), ("U", 1, 0), ("S", 2, 0))
    }
    assert [item.new for item in found.together] == ["S", "C"]
    assert found.left == 0


def test_the_driven_joint_stays_as_it_is():
    assert "R1" not in {item.joint for item in relaxation(*four_bar()).single}


def test_a_cylindrical_joint_that_stands_for_a_prismatic_one_may_be_driven():
    """Slider-crank with a driven slider."""
    joints = [[slide(X)], [turn(Z, (1, 0, 0))], [turn(Z, (3, 2, 0))], [turn(Z, (5, 0, 0))]]
    edges = chain("J", "base", "base", joints, (0,))
    found = relaxation(edges, "base", edges[1].child)
    assert Replacement("J1", "P", "C", 1, 0) in found.single
    assert found.left == 0


def test_a_mechanism_without_redundant_constraints_needs_nothing():
    rng = np.random.default_rng(0)
    ring = chain("R", "base", "base", [[turn(*rng.normal(size=(2, 3)))] for _ in range(7)], (0,))
    found = relaxation(ring, "base", ring[2].child)
    assert (found.redundant, found.single, found.together, found.left) == (0, (), (), 0)


def test_two_parallel_guides():
    """A table on two rods: two bushings in the place of two keyed slides leave 3 of 5 redundant constraints."""
    edges = chain("A", "base", "p", [[slide(X)]], (0,)) + chain("B", "base", "p", [[slide(X)]])
    found = relaxation(edges, "base", "p")
    assert (found.redundant, found.left) == (5, 3)
    assert [(item.joint, item.removed) for item in found.together] == [("A1", 1), ("B1", 1)]


def with_a_ball():
    """The four-bar with a ball joint at its second place, one redundant constraint left."""
    edges, _, _ = four_bar()
    ball = np.stack([turn(axis, (1, 2, 0)) for axis in (X, Y, Z)], axis=-1)[None]
    edges[1] = dataclasses.replace(edges[1], twists=ball)
    return edges


def test_a_replacement_that_would_free_the_platform_is_none():
    """A second ball lets the coupler spin between the two; so it is none where the coupler is the platform."""
    edges = with_a_ball()
    found = relaxation(edges, "base", edges[1].child)
    assert found.redundant == 1
    assert {(item.joint, item.new) for item in found.single} == {(f"R{i}", new) for i in (3, 4) for new in "CU"}


def test_a_spin_that_a_replacement_brings_is_said():
    """Seen from the rocker, the coupler's spin is internal; a ball at the rocker's foot would move the rocker."""
    edges = with_a_ball()
    found = relaxation(edges, "base", edges[2].child)
    spun = Replacement("R3", "R", "S", 1, 1)
    assert [item for item in found.single if item.new == "S"] == [spun]
    assert found.together == (Replacement("R3", "R", "C", 1, 0),)


@pytest.mark.parametrize(("collapsed", "redundant", "by_loop"), [(True, 4, [3, 1]), (False, 10, [3, 3, 3, 1])])
def test_redundant_constraints_of_the_paper_loop_by_loop(collapsed, redundant, by_loop):
    graph = linkage(load_record("zeng2019"))
    edges = generic_edges(graph, collapsed=collapsed)
    found = relaxation(edges, graph.base, graph.platform)
    assert sorted(loop.redundant_constraints for loop in coupling(edges).loops) == sorted(by_loop)
    assert found.redundant == redundant == sum(by_loop)
    assert found.left == 0


def test_relaxed_mechanisms_of_the_paper_move_as_it_does_finitely():
    """Second route: the joints are put in, the loops are closed after finite displacements, and counted again."""
    graph = linkage(load_record("zeng2019"))
    found = relaxation(generic_edges(graph, collapsed=False), graph.base, graph.platform)
    choices = [*([item] for item in found.single), list(found.together)]
    assert len(choices) > 30
    for chosen in choices:
        relaxed = built(graph, chosen)
        after = mobility(generic_edges(relaxed, count=2), graph.base, graph.platform)
        left = 10 - sum(item.removed for item in chosen)
        assert (after.dof, after.platform, after.redundant_constraints) == (3, 3, left), chosen


def test_what_is_no_replacement_would_change_the_mechanism_or_remove_nothing():
    """Every replacement of one passive R of the paper's mechanism that is not listed, built and counted."""
    graph = linkage(load_record("zeng2019"))
    found = relaxation(generic_edges(graph, collapsed=False), graph.base, graph.platform)
    listed = {(item.joint, item.new) for item in found.single}
    passive = [name for name, joint in graph.joints.items() if joint.type is REVOLUTE]
    left_out = [(name, new) for name in passive for new in "CUS" if (name, new) not in listed]
    assert left_out
    for name, new in left_out:
        relaxed = built(graph, [Replacement(name, "R", new, 0, 0)])
        after = mobility(generic_edges(relaxed, count=2), graph.base, graph.platform)
        assert after.redundant_constraints == 10 or after.controlled > 3, (name, new)


def test_generalised_joints_stay_as_they_are():
    edges, base, platform = four_bar()
    edges = [dataclasses.replace(edge, joints=("a", "b")) for edge in edges]
    assert relaxation(edges, base, platform).single == ()


def test_the_text_of_a_replacement():
    assert str(Replacement("R2", "R", "S", 2, 0)) == "R2: R to S removes 2"
    assert str(Replacement("R2", "R", "S", 1, 1)) == "R2: R to S removes 1, 1 internal freedom more"


def test_relaxed_joints_leave_the_mobility():
    """What the list says is built, joint by joint, in this test's own way, and counted again."""
    edges, base, platform = four_bar()
    before = mobility(edges, base, platform)
    relaxed = list(edges)
    point, third = np.array([1.0, 2.0, 0.0]), np.array([4.0, 2.5, 0.0])
    relaxed[1] = dataclasses.replace(edges[1], twists=np.stack([turn(axis, point) for axis in (Z, X, Y)], -1)[None])
    relaxed[2] = dataclasses.replace(edges[2], twists=np.stack([turn(Z, third), slide(Z)], -1)[None])
    after = mobility(relaxed, base, platform)
    assert (before.redundant_constraints, after.redundant_constraints) == (3, 0)
    assert (after.dof, after.platform, after.internal) == (before.dof, before.platform, ())
