"""Chains that are loops and nothing else become limbs, hybrids are drafted, and what is driven goes along."""

from pathlib import Path

import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.validation.check import faults
from assur.model.file.reader import read_text
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.limbs_apart import limbs_apart
from assur.topology.notation import parse_chains

PATH = Path("my.toml")
LOOP = "{P[y] R[x] R[x] | P[y] R[x] R[x]}"
HYBRIDS = [
    (LOOP, "P[y] U[x,y] S"),
    ("{P[y] R[x] R[x] | P[y] R[x] R[x] | P[z] R[x] R[x]}", "U P S"),
    (f"{{{LOOP} R[y] | S P S}}", "U P S"),
    (f"{LOOP} R[y]", "P[y] U[x,y] S"),
    (f"{LOOP} R[y]", "U P S", "U P S"),
    ("{P[z] R[y] R[y] | P[z] R[y] R[y]} R[z]", "P[x] R[y] R[y] R[z]"),
    ("{P[x] R[y] R[y] | P[x] R[y] R[y]} R[z]", "{P[x] R[y] R[y] | P[x] R[y] R[y]} R[z]"),
    ("{R[x] R[x] R[x] | R[x] R[x] R[x]} U[y,z]", "R[z] R[z] S", "U P S"),
    ("{R[z] R[z] | R[z] R[z] R[z]} P[z]", "U P S"),
    ("{R[x] R[x] | P[y] R[x] R[x]} P(4R)[y]", "R[z] R[z] C[z]"),
]


@pytest.mark.parametrize(
    "texts", [*HYBRIDS[:1], *(pytest.param(texts, marks=pytest.mark.deep) for texts in HYBRIDS[1:])]
)
def test_a_hybrid_is_drafted_sound(texts):
    found = drafted(parse_chains(texts), PATH)
    record = read_text(found.text, PATH)
    assert faults(record) == ()
    freedoms = found.topology.dof - found.topology.internal_freedoms
    assert len(record.inputs) == freedoms == assur.topology(record).dof - assur.topology(record).internal_freedoms


def test_its_branches_are_limbs_driven_as_they_were_numbered():
    chains, driven = limbs_apart(parse_chains([LOOP, "P[y] U[x,y] S"]), ["1.1", "1.5", "2.1"])
    assert [chain.text for chain in chains] == ["P[y] R[x] R[x]", "P[y] R[x] R[x]", "P[y] U[x,y] S"]
    assert driven == ("1.1", "2.2", "3.1")
    together = drafted(parse_chains([LOOP, "P[y] U[x,y] S"]), PATH, actuate=["1.1", "1.4", "2.1"]).text
    apart = drafted(parse_chains(["P[y] R[x] R[x]"] * 2 + ["P[y] U[x,y] S"]), PATH, actuate=["1.1", "2.1", "3.1"]).text
    assert together == apart


def test_loops_with_something_behind_them_stay():
    chains = parse_chains([f"{LOOP} R[y]", "U P S"])
    assert limbs_apart(chains, None) == (chains, None)


def test_a_loop_whose_platform_may_turn_by_itself_is_refused_with_a_reason():
    with pytest.raises(UsageError, match="limbs move by themselves"):
        drafted(parse_chains([f"{LOOP} R[x]", "P[y] U[x,y] S"]), PATH)
