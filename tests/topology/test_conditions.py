"""The conditions that a motion needs, told from what happens to be drawn so."""

import pytest

import assur
from assur.derived_topology import topology
from assur.topology.conditions import needed_conditions
from assur.topology.notation import parse_chains

LEFT, RIGHT = "-0.5,0.8660254037844386,0", "0.5,0.8660254037844386,0"


@pytest.mark.parametrize(
    ("texts", "needed"),
    [
        # any two of four parallel axes more or less, and a slide across them
        (["R[z] R[z] R[z]", "P[x] R[z] R[z]"], ("R1 ∥ R2 ∥ R3 ∥ R4 ∥ R5", "R1 ⊥ P1")),
        # each slide across its own axis, and these in a plane; that all slides are parallel is nothing
        (
            ["R[y] P[z] S", f"R[{LEFT}] P[z] S", f"R[{RIGHT}] P[z] S"],
            ("R1 ⊥ P1", "R2 ⊥ P2", "R3 ⊥ P3", "R1, R2, R3 in a plane"),
        ),
        (["R[x]@O R[y]@O R[z]@O", "R[y]@O R[z]@O R[x]@O"], ("R1, R2, R3, R4, R5, R6 meet",)),
        # limbs of six freedoms resist nothing, however they are drawn
        (["U[x,y] P[z] S"] * 6, ()),
    ],
)
def test_what_the_motion_needs(texts, needed):
    found = topology(texts).conditions
    assert {frozenset(said.replace(" ⊥ ", " ").split()) for said in found} == {
        frozenset(said.replace(" ⊥ ", " ").split()) for said in needed
    }


def test_of_a_hybrid_limb_only_what_its_loop_needs():
    """The other limb of the paper's mechanism translates whichever way its joints point."""
    assert topology("zeng2019").conditions == ("P1 ∥ P2 ∥ R3 ∥ R4", "B1 ∥ C1 ∥ B2 ∥ C2", "P1 ⊥ B1")


def test_parallel_axes_that_need_not_be_are_not_named():
    """An axis more that is parallel by chance: the limb has all six freedoms without it."""
    chains = ["R[z] R[z] R[z]", "R[z] R[z] R[z]", "R[z] P[x] P[y] R[x] R[y] R[z]"]
    assert topology(chains).conditions == ("R1 ∥ R2 ∥ R3 ∥ R4 ∥ R5 ∥ R6",)


def test_nothing_is_told_where_dimensions_decide():
    assert needed_conditions(parse_chains(["R[z] R[z]", "R[z] R[z]"]), (2, (2, 1, 2))) is None
    assert needed_conditions((), (1, (1, 0, 1))) is None


def test_a_wrong_direction_breaks_a_condition_that_is_named():
    """The other way round: what is named, turned a little, moves otherwise."""
    found = assur.topology(["R[z] R[z] R[z]", "P[x] R[z] R[z]"])
    for broken in (["R[z] R[z] R[0.1,0,1]", "P[x] R[z] R[z]"], ["R[z] R[z] R[z]", "P[1,0,0.1] R[z] R[z]"]):
        assert assur.topology(broken).poc != found.poc
