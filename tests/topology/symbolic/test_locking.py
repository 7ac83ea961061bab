import math

import pytest

from assur.topology.notation import parse_chain, parse_chains
from assur.topology.symbolic.intersection import parallel
from assur.topology.symbolic.locking import ANYWHERE, locked
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.union import serial


def _left(text, names):
    return locked(parse_chain(text).elements, names)


@pytest.mark.parametrize(
    ("text", "names", "left"),
    [
        ("P[x] R[x] R[x]", {"P1"}, [("R", "R1"), ("R", "R2")]),
        ("C[x] R[x]", {"C1.1"}, [("R", "C1"), ("R", "R1")]),
        ("C[x] R[x]", {"C1.2"}, [("P", "C1"), ("R", "R1")]),
        ("C[x] R[x]", {"C1"}, [("R", "R1")]),
        ("C[x]@A R[x]", {"C1.1", "C1.2"}, [("R", "R1")]),
        ("U[x,y] R[x]", {"U1.1"}, [("R", "U1"), ("R", "R1")]),
        ("R[x] S", {"S1"}, [("R", "R1")]),
        ("R[x]", {"R1"}, []),
    ],
)
def test_what_is_left(text, names, left):
    assert [(item.type.letter, item.name) for item in _left(text, names)] == left


def test_of_a_universal_joint_the_other_axis_is_left():
    assert _left("U[x,y]", {"U1.1"})[0].axes == ((0.0, 1.0, 0.0),)
    assert _left("U[x,y]", {"U1.2"})[0].axes == ((1.0, 0.0, 0.0),)


def test_a_slide_between_parallel_axes_is_locked_in_any_direction():
    first, second = _left("R[z] P[x] R[z] P[x]", {"R1"})[0], _left("R[z] P[x] R[z] P[x]", {"R1"})[2]
    assert first.axes[0] == pytest.approx((math.cos(ANYWHERE), math.sin(ANYWHERE), 0.0))
    assert second.axes[0] == (1.0, 0.0, 0.0)


@pytest.mark.parametrize("behind", ["S", "R[x] R[z]", "U[x,z]", "C[y] U[y,z]"])
def test_a_ball_joint_or_a_parallel_axis_further_on_turns_back(behind):
    slide = next(item for item in _left(f"R[z] P[x] {behind}", {"R1"}) if item.name == "P1")
    assert slide.axes[0] == pytest.approx((math.cos(ANYWHERE), math.sin(ANYWHERE), 0.0))


def test_what_stands_behind_the_parallel_axis_of_a_universal_joint_is_as_written():
    universal, slide = _left("R[z] U[z,x] P[x]", {"R1"})
    assert (universal.axes[1], slide.axes[0]) == ((1.0, 0.0, 0.0), (1.0, 0.0, 0.0))


@pytest.mark.parametrize("text", ["R[z] P[x]", "R[z] P[x] R[y]", "R[z] R[z] P[x]"])
def test_without_an_axis_that_turns_back_the_end_link_has_not_turned(text):
    last = {"R2"} if text.count("R[z]") == 2 else {"R1"}
    slide = next(item for item in _left(text, last) if item.name == "P1")
    assert slide.axes == ((1.0, 0.0, 0.0),)


def test_what_stands_before_a_locked_axis_is_turned_by_the_parallel_one_that_turns_it_back():
    parallelogram = _left("R[y] P(4R)[x] R[y]", {"R2"})[1]
    assert parallelogram.axis == pytest.approx((math.cos(ANYWHERE), 0.0, -math.sin(ANYWHERE)))


def test_limbs_are_not_displaced_alike():
    one, other = (locked(parse_chain("R[z] P[x] R[z]").elements, {"R1"}, limb)[0].axes[0] for limb in (0, 1))
    assert math.acos(sum(a * b for a, b in zip(one, other, strict=True))) > 0.1


def test_behind_a_ball_joint_axes_are_turned_from_the_end_link():
    first, second = (item for item in _left("R[z] P[x] S P[x] R[z]", {"R1"}) if item.name.startswith("P"))
    assert first.axes[0] == pytest.approx((math.cos(ANYWHERE), math.sin(ANYWHERE), 0.0))
    assert second.axes[0][2] == pytest.approx(0.0)
    assert abs(second.axes[0][0]) < 0.99


def test_axes_that_met_are_apart_where_a_locked_joint_stands_between():
    first, second = _left("R[x]@A R[y] R[z]@A", {"R2"})
    assert first.point != second.point
    first, second = _left("R[x]@A R[y]@A R[z]@A", {"R2"})
    assert first.point == second.point


@pytest.mark.parametrize("text", ["R[x] R[y] R[x] R[y]", "R[x] R[y] R[z] R[1,1,0]", "R[x] R[y] R[1,1,0]"])
def test_a_limb_with_several_ways_back_to_its_orientation_is_refused(text):
    refusal = locked(parse_chain(text).elements, {"R1"})
    assert isinstance(refusal, Refusal)
    assert "several ways" in refusal.reason


def test_a_joint_locked_inside_a_planar_loop_leaves_its_branches_displaced():
    loop = _left("{R[z] P[x] R[z] | R[z] R[z] R[z]} R[z]", {"R1"})[0]
    assert abs(loop.branches[0][0].axes[0][0]) < 0.99  # the slide is turned by the locked axis before it
    apart = locked(parse_chain("{R[z] P[x] R[x] | R[z] P[x] R[x]}").elements, {"R1"})
    assert isinstance(apart, Refusal)


def test_parallelograms_and_loops_behind_a_locked_axis_turn_too():
    left = _left("R[z] P(4R)[x] R[z]", {"R1"})
    assert left[0].axis == pytest.approx((math.cos(ANYWHERE), math.sin(ANYWHERE), 0.0))
    loop = _left("R[z] {P[x] | P[x] P[y]} R[z]", {"R1"})[0]
    assert all(branch[0].axes[0] == pytest.approx(left[0].axis) for branch in loop.branches)


def test_a_loop_with_a_branch_that_is_locked_does_not_move():
    assert [item.name for item in _left("{P[y] | P[y] R[x] R[x]} R[y]", {"P1"})] == ["R3"]
    loop, _ = _left("{P[y] R[x] | P[y] R[x] R[x]} R[y]", {"P1"})
    assert [[item.name for item in branch] for branch in loop.branches] == [["R1"], ["P2", "R2", "R3"]]


def test_a_four_bar_is_left_of_a_planar_mechanism_whose_inputs_are_locked():
    chains = parse_chains(["R[x] R[x] R[x]", "R[x] R[x] R[x]"])
    motion = parallel([serial(locked(chain.elements, {"R1", "R4"})) for chain in chains])
    assert (motion.dim, motion.poc.r, motion.translations.dim) == (1, 1, 0)


def test_the_papers_partial_decoupling():
    """y depends on the two coaxial inputs, x and z on all three."""
    chains = parse_chains(["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[x] P(4R)[y]"])
    moved = {}
    for free in ("P1", "P2", "P3"):
        limbs = [serial(locked(chain.elements, {"P1", "P2", "P3"} - {free}), "translation") for chain in chains]
        moved[free] = parallel(limbs, "translation").translations
    assert moved["P3"].complement.contains((0.0, 1.0, 0.0))
    assert not any(moved[name].complement.contains((0.0, 1.0, 0.0)) for name in ("P1", "P2"))
