"""The planar joint in notation and in the rules, against P P R and against the rank of twists."""

import pytest

from assur.topology.analysis import analyse
from assur.topology.notation import NotationError, parse_chain, parse_chains
from assur.topology.screws.placing import place
from assur.topology.symbolic.locking import locked
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.union import serial

SAME = {"E[z]": "P[x] P[y] R[z]", "E[x]": "P[y] P[z] R[x]", "E[y]": "P[z] P[x] R[y]"}
LIMBS = ["{z}", "R[z] {y} R[z]", "R[x] {x} R[x]", "{z} S", "S {z}", "{x} {y}", "R[x] {z}", "{z} R[x] R[x]"]


def single(text: str) -> str:
    """A limb with a P, a P and an R in the place of each planar joint."""
    for planar, joints in SAME.items():
        text = text.replace(planar, joints)
    return text


@pytest.mark.parametrize("text", [text.replace("{", "E[").replace("}", "]") for text in LIMBS])
def test_a_limb_has_the_set_of_single_joints(text):
    one, other = (serial(parse_chain(item)) for item in (text, single(text)))
    assert isinstance(one, Motion)
    assert [(span.dim, span.turning) for span in (one.translations, one.rotations)] == [
        (span.dim, span.turning) for span in (other.translations, other.rotations)
    ]
    assert (one.poc.t, one.poc.r, one.poc.dim, one.freedoms) == (
        other.poc.t,
        other.poc.r,
        other.poc.dim,
        other.freedoms,
    )


@pytest.mark.parametrize("limb", ["R[z] E[y] R[z]", "E[z] R[y]", "R[x] E[z] S"])
def test_three_limbs_have_the_freedoms_of_single_joints(limb):
    one, other = (analysed([item] * 3) for item in (limb, single(limb)))
    assert (one.poc.t, one.poc.r, one.poc.dim) == (other.poc.t, other.poc.r, other.poc.dim)
    assert (one.dof, one.xi, one.coupling_degree) == (other.dof, other.xi, other.coupling_degree)


def analysed(limbs):
    chains = parse_chains(limbs)
    driven = [chain.joints[0].name for chain in chains]
    return analyse(place(chains, actuated=driven), chains, inputs_by="given")


def test_letters_that_look_like_it_are_read_as_it():
    assert [parse_chain(f"{letter}[z]").elements[0].type.letter for letter in "EЕΕ𝐸"] == ["E"] * 4


def test_a_second_direction_is_refused():
    with pytest.raises(NotationError, match="2 directions for E"):
        parse_chain("E[x,y]")


def test_a_locked_slide_leaves_the_other_and_the_turn():
    one = locked(parse_chain("R[z] E[y] R[z]").elements, ["E1.1"])
    other = locked(parse_chain("R[z] P[z] P[x] R[y] R[z]").elements, ["P1"])
    assert [item.name for item in one] == ["R1", "E1.2", "E1.3", "R2"]
    for first, second in zip(one, other, strict=True):
        assert first.type is second.type
        assert first.axes[0] == pytest.approx(second.axes[0], abs=1e-15)
