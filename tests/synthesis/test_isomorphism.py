import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.errors import UsageError
from assur.numerics.rotations import from_vector
from assur.synthesis.isomorphism import limb_key, mechanism_key
from assur.synthesis.positions import turned
from assur.synthesis.required import MOTIONS
from assur.topology.notation import parse_chain

SPACE, PLANE = MOTIONS["3T"], MOTIONS["2T1R"]


def key(text, motion=SPACE, driven=()):
    return limb_key(parse_chain(text), motion, driven)


SAME = {
    "names of axes": ("C[x] R[x] R[x]", "C[z] R[z] R[z]"),
    "sense": ("P[x] R[y] R[y] P(4R)[x]", "P[-x] R[y] R[-y] P(4R)[-x]"),
    "directions": ("R[y] R[y] P(4R)[x] R[y]", "R[0.6,0.8,0] R[0.6,0.8,0] P(4R)[-0.8,0.6,0] R[0.6,0.8,0]"),
    "order of P": ("R[x] P[y] P[x] R[x]", "R[x] P[x] P[y] R[x]"),
    "order of P and P(4R)": ("R[x] P[y] P(4R)[z] R[x]", "R[x] P(4R)[z] P[y] R[x]"),
    "a direction that turns": ("R[x] R[x] P[y] R[x]", "R[x] R[x] P[z] R[x]"),
    "a direction that turns against another": ("P[y] R[x] P[y] R[x]", "P[y] R[x] P[z] R[x]"),
    "U at 3-UPU": ("U[y,x] P[z] U[x,y]", "U[x,y] P[x] U[y,x]"),
    "names of points": ("R[x]@A R[y]@A P[x]", "R[x]@B R[y]@B P[x]"),
}

DIFFERENT = {
    "reversed": ("P[x] R[x] R[x] R[x]", "R[x] R[x] R[x] P[x]"),
    "parallel or perpendicular P": ("P[x] R[x] R[x] R[x]", "P[y] R[x] R[x] R[x]"),
    "C or R and P": ("C[x] R[x] R[x]", "P[x] R[x] R[x] R[x]"),
    "U or two R": ("U[x,y] P[x] U[y,x]", "R[x] R[y] P[x] U[y,x]"),
    "P(4R) or P": ("R[x] R[x] P(4R)[y] R[x]", "R[x] R[x] P[y] R[x]"),
    "hinges": ("R[x] R[x] P(4R)[x] R[x]", "R[x] R[x] P(4R)[y] R[x]"),
    "base against platform, which does not turn": ("R[x] R[x] R[y] R[y] P[x]", "R[x] R[x] R[y] R[y] P[z]"),
    "through a point": ("R[x]@A R[y]@A P[x]", "R[x] R[y] P[x]"),
    "oblique": ("P[1,1,0] R[x] R[x] P[y]", "P[x] R[x] R[x] P[y]"),
    "oblique in one plane or not": ("P[1,1,0] P[1,0,1] P[0,1,-1]", "P[1,1,0] P[1,0,1] P[0,1,1]"),
}


@pytest.mark.parametrize("pair", SAME.values(), ids=SAME)
def test_what_makes_no_difference(pair):
    assert key(pair[0]) == key(pair[1])


@pytest.mark.parametrize("pair", DIFFERENT.values(), ids=DIFFERENT)
def test_what_does(pair):
    assert key(pair[0]) != key(pair[1])


def test_the_driven_joint_counts():
    assert key("P[x] P[y] R[x] R[x]", driven=(0,)) != key("P[x] P[y] R[x] R[x]", driven=(1,))
    assert key("P[x] P[y] R[x] R[x]", driven=(0,)) == key("P[y] P[x] R[x] R[x]", driven=(1,))


def test_a_direction_that_the_motion_singles_out_counts():
    assert key("R[x] R[x] P[y]") == key("R[z] R[z] P[y]")
    assert key("R[x] R[x] P[y]", PLANE) != key("R[z] R[z] P[y]", PLANE)
    assert key("P[x] R[z] P[x]", PLANE) == key("P[x] R[z] P[y]", PLANE), "the second P turns with the platform"


def test_behind_a_ball_joint_only_the_platform_is_known():
    assert key("P[x] S P[x] P[y]") != key("P[x] S P[z] P[y]"), "a platform that does not turn knows the base"
    assert key("P[x] R[y] S P[x]") == key("P[x] R[y] S P[-x]")


@given(
    text=st.sampled_from([text for pair in DIFFERENT.values() for text in pair]),
    vector=st.tuples(*[st.floats(-3, 3)] * 3),
)
def test_turning_a_whole_limb_makes_no_difference(text, vector):
    chain = parse_chain(text)
    assert limb_key(turned(chain, from_vector(np.array(vector))), SPACE) == limb_key(chain, SPACE)


def test_order_of_limbs_makes_no_difference():
    first, second = key("C[x] R[x] R[x]"), key("P[x] P[y] P[z]")
    assert mechanism_key([first, second]) == mechanism_key([second, first])
    assert mechanism_key([first, first]) != mechanism_key([first, second])


LOOP = "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]"

SAME_LOOPS = {
    "order of branches": ("{P[y] R[x] | R[x] R[x] R[x]} R[x]", "{R[x] R[x] R[x] | P[y] R[x]} R[x]"),
    "names of axes": (LOOP, "{P[z] R[y] R[y] | P[z] R[y] R[y]} R[-z] R[-z]"),
    "order of P behind it": (
        "{P[y] R[x] | P[y] R[x] R[x]} P[x] P[y] R[x]",
        "{P[y] R[x] | P[y] R[x] R[x]} P[y] P[x] R[x]",
    ),
}

DIFFERENT_LOOPS = {
    "axes behind it": (LOOP, "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[z] R[z]"),
    "rails at a right angle": (LOOP, "{P[y] R[x] R[x] | P[z] R[x] R[x]} R[y] R[y]"),
    "where the loop ends": ("{P[y] R[x] R[x] | P[y] R[x] R[x]} P[x]", "{P[y] R[x] | P[y] R[x] R[x]} R[x] P[x]"),
    "a series": (LOOP, "P[y] R[x] R[x] R[y] R[y]"),
}


@pytest.mark.parametrize("pair", SAME_LOOPS.values(), ids=SAME_LOOPS)
def test_what_makes_no_difference_to_a_limb_with_an_inner_loop(pair):
    assert key(pair[0]) == key(pair[1])


@pytest.mark.parametrize("pair", DIFFERENT_LOOPS.values(), ids=DIFFERENT_LOOPS)
def test_what_does_to_a_limb_with_an_inner_loop(pair):
    assert key(pair[0]) != key(pair[1])


def test_the_driven_joints_of_branches_count():
    assert key(LOOP, driven=(0, 3)) != key(LOOP, driven=(0, 4))
    assert key(LOOP, driven=(0, 4)) == key(LOOP, driven=(1, 3))


def test_an_inner_loop_that_does_not_stand_first_is_refused():
    with pytest.raises(UsageError, match="does not stand first"):
        key("R[y] {P[y] R[x] R[x] | P[y] R[x] R[x]}")
