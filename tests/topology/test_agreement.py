"""Rules against twists: what is confirmed, what is refused, and what the twists say alone."""

import dataclasses

import numpy as np
import pytest

from assur.topology.agreement import RoutesDisagreeError, agreed, by_twists
from assur.topology.notation import parse_chain
from assur.topology.poc import Mark, PocSet
from assur.topology.screws.configurations import configurations
from assur.topology.screws.placing import place
from assur.topology.screws.twists import edges, motion_space
from assur.topology.symbolic.union import serial

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
OBLIQUE = (0.6, 0.8, 0.0)
CHAINS = [
    "R[x] R[x] R[x]",
    "P[0.6,0.8,0] R[z]",
    "R[x] R[x] R[y]",
    "P[x] R[x] R[x] R[x]",
    "U[x,y] P[z] S",
    "R[x] R[y]",
    "S",
]


def space(text):
    linkage = place([parse_chain(text)])
    return motion_space(edges(linkage, configurations(linkage, 3)), "base", "platform")


PLANAR = PocSet(2, 1, 3, Mark("perpendicular", ("R1",), (Y, Z)), Mark("parallel", ("R1",), (X,)))


@pytest.mark.parametrize("text", CHAINS)
def test_the_rules_are_confirmed(text):
    rules = serial(parse_chain(text)).poc
    assert agreed("a chain", rules, space(text)) == rules


@pytest.mark.parametrize("change", [{"t": 3}, {"t": 1}, {"r": 0}, {"r": 2}, {"dim": 2}, {"dim": 4}])
@pytest.mark.parametrize("text", CHAINS)
def test_a_wrong_number_is_refused_with_the_name_of_the_chain_and_both_answers(text, change):
    right = serial(parse_chain(text)).poc
    rules = dataclasses.replace(right, **change)
    if rules == right:
        return
    with pytest.raises(RoutesDisagreeError) as error:
        agreed("limb 2, R[x]", rules, space(text))
    said = f"the rules say t{rules.t} r{rules.r} with dim {rules.dim}"
    assert error.value.message == f"limb 2, R[x]: {said}, the twists t{right.t} r{right.r} with dim {right.dim}"
    assert error.value.exit_code == 5
    assert error.value.hint


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"t_mark": Mark("perpendicular", ("R2",), (X, Z))}, r"t\(perpendicular R2\)"),
        ({"t_mark": Mark("plane", ("P1", "P2"), (Y, X))}, r"t\(plane P1, P2\)"),
        ({"t_mark": Mark("parallel", ("P1",), (Y,))}, r"t\(parallel P1\)"),  # in the plane, but not the plane
        ({"r_mark": Mark("parallel", ("R2",), (OBLIQUE,))}, r"r\(parallel R2\)"),
        ({"r_mark": Mark("parallel", ("R2",), ((1.0, 2e-6, 0.0),))}, r"r\(parallel R2\)"),
        ({"r_mark": Mark("plane", ("R2", "R3"), (X, Y))}, r"r\(plane R2, R3\)"),
    ],
)
def test_a_wrong_direction_is_refused(change, said):
    with pytest.raises(RoutesDisagreeError, match=f"limb 1: the rules say {said}, the twists do not"):
        agreed("limb 1", dataclasses.replace(PLANAR, **change), space("R[x] R[x] R[x]"))


def test_a_direction_that_does_not_stay_is_no_fixed_one():
    turning = PocSet(2, 2, 3, Mark("moving"), Mark("plane", ("R1", "R3"), (X, Y)))
    with pytest.raises(RoutesDisagreeError, match=r"r\(plane R1, R3\)"):
        agreed("limb 1", turning, space("R[x] R[x] R[y]"))
    agreed("limb 1", dataclasses.replace(turning, r_mark=Mark("plane", ("R1", "R3"))), space("R[x] R[x] R[y]"))


def test_a_direction_that_stays_and_has_no_name_is_set_by_location():
    unnamed = dataclasses.replace(PLANAR, t_mark=Mark("moving"), r_mark=Mark("moving"))
    found = agreed("limb 1", unnamed, space("R[x] R[x] R[x]"))
    assert found == dataclasses.replace(PLANAR, t_mark=Mark("located"), r_mark=Mark("located"))
    turning = PocSet(1, 2, 2, Mark("moving"), Mark("moving"))
    assert agreed("limb 1", turning, space("R[x] R[y]")) == turning


def test_another_basis_of_the_same_plane_is_the_same_mark():
    half = np.sqrt(0.5)
    turned = Mark("perpendicular", ("R1",), ((0.0, half, half), (0.0, half, -half)))
    backwards = Mark("parallel", ("R1",), ((-1.0, 0.0, 0.0),))
    agreed("limb 1", dataclasses.replace(PLANAR, t_mark=turned, r_mark=backwards), space("R[x] R[x] R[x]"))


@pytest.mark.parametrize(
    ("text", "t", "r"),
    [
        ("R[x] R[x] R[x]", "perpendicular to x", "x"),
        ("P[0.6,0.8,0] R[z]", "0.6,0.8,0", "z"),
        ("R[x] P[y]", "perpendicular to x", "x"),
        ("R[z] P[x] R[y] R[y]", "none", "moving"),
        ("R[x] R[x]", "moving", "x"),
        ("R[x] R[y]", "moving", "moving"),
        ("S", "none", "none"),
        ("P[x] P[y] P[z]", "none", "none"),
        ("P[y] P(4R)[x]", "perpendicular to x", "none"),
    ],
)
def test_what_the_twists_say_alone(text, t, r):
    named = {"x": X, "y": Y, "z": Z, "0.6,0.8,0": OBLIQUE}
    found = by_twists(space(text))
    assert (found.t, found.r, found.dim) == tuple(
        np.linalg.matrix_rank(part, tol=1e-6).max() for part in (space(text)[:, 3:], space(text)[:, :3], space(text))
    )
    for mark, said in ((found.t_mark, t), (found.r_mark, r)):
        assert mark.names == ()
        if said in ("none", "moving"):
            assert (mark.relation, mark.axes) == (said, ())
            continue
        assert mark.relation == "fixed"
        axes = np.array(mark.axes)
        if said.startswith("perpendicular"):
            assert axes.shape == (2, 3)
            np.testing.assert_allclose(np.abs(np.cross(*axes)), named[said[-1]], atol=1e-6)
        else:
            np.testing.assert_allclose(np.abs(axes), [named[said]], atol=1e-6)
