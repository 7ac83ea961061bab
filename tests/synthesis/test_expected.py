import pytest

from assur.synthesis.expected import Counts, Expected, expected
from assur.synthesis.required import MOTIONS
from assur.topology.notation import parse_chain
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.union import serial


def of(name, *texts):
    motion = MOTIONS[name]
    mode = "free" if motion.rotations else "translation"
    return expected([serial(parse_chain(text), mode) for text in texts], motion)


TABLE = {
    "tripteron": ("3T", [f"P[{u}] R[{u}] R[{u}] R[{u}]" for u in "xyz"], (5, 4), 1),
    "3-UPU": ("3T", ["U[x,y] P[x] U[y,x]", "U[y,z] P[y] U[z,y]", "U[z,x] P[z] U[x,z]"], (6, 6), 2),
    "3-RRR": ("2T1R", ["R[z] R[z] R[z]"] * 3, (3, 3), 1),
}


@pytest.mark.parametrize(("name", "limbs", "xi", "degree"), TABLE.values(), ids=TABLE)
def test_rows_of_the_theory(name, limbs, xi, degree):
    """poc-theory, the table of section 5."""
    found = of(name, *limbs)
    assert found.reaches
    assert found.counts.xi((0, 1, 2)) == xi
    assert found.counts.coupling_degree == degree


def test_the_same_set_from_other_limbs_is_not_reached():
    assert not of("3T", *["C[x] R[x] R[x]"] * 3).reaches, "all three turn about x"
    assert not of("3T", "C[x] R[x] R[x]", "U[x,y] P[x] S", "U[x,y] P[x] S").reaches


def test_every_order_is_tried():
    """Three limbs of which one pair shares 3, the others 4: the pair first has Δ = +1, another +2."""
    pairs = {frozenset((0, 1)): 4, frozenset((0, 2)): 4, frozenset((1, 2)): 3, frozenset((0, 1, 2)): 3}
    assert Counts(pairs, (5, 5, 4)).coupling_degree == 1
    assert Counts(pairs, (5, 5, 4)).xi((0, 1, 2)) == (6, 5)
    assert Counts(pairs, (5, 5, 4)).xi((1, 2, 0)) == (6, 5)


def test_an_assur_chain_ends_where_the_degrees_add_up_to_zero():
    """Two limbs that make two freedoms of themselves: κ is the larger of the chains', not their sum."""
    dims = {frozenset(some): size for some, size in [((0, 1), 2), ((0, 2), 4), ((1, 2), 4), ((0, 1, 2), 3)]}
    assert Counts(dims, (4, 4, 6)).coupling_degree == 0


def test_a_refusal_on_all_limbs_is_a_refusal_and_on_some_leaves_the_platform():
    found = of("3T1R", "R[z] U[z,x] C[x]", "C[y] P[x] U[y,z]", "C[x] P[y] U[x,z]", "C[x] P[y] U[x,z]")
    assert isinstance(found, Expected)
    refused = of("3T1R", "R[z] R[z] R[z] R[x] R[x]", "R[x] R[x] R[z] R[z] R[z]")
    assert isinstance(refused, Refusal)
