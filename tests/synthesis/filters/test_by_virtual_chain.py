import pytest

from assur.synthesis.explanation import explanation
from assur.synthesis.known_mechanisms import limbs_driven_by
from assur.synthesis.question import question
from assur.topology.notation import parse_chains

ABOUT_O = [f"R[{u}]@O R[{v}]@O R[{w}]@O" for u, v, w in ("xyz", "yzx", "zxy")]

BY_VIRTUAL_CHAIN = {
    "rods": ("3T:PPP", ["R[x] P(4S)[x]"] * 3, {}, "words", "have no P(4S); they are made of R, P, U, S"),
    "length": ("3T:PPP", ["P[x] R[x] R[x] R[x]"] * 3, {"max_joints": 3}, "words", "4 joints one behind the other"),
    "freedoms": ("3T:PPP", ["R[x] U[x,y] S"] * 3, {}, "words", "have 3 to 5 freedoms"),
    "drive": (
        "3T:PPP",
        ["R[x] P[x] R[x] R[x]"] * 3,
        {"actuators": "leg"},
        "words",
        "its drive is R1, and asked for is the first P between",
    ),
    "idle": ("3T:PPP", ["P[x] P[y] P[z] R[x]"] * 3, {}, "limb", "one of its joints rests in all of P[x] P[y] P[z]"),
    "limb": ("3T:PPP", ["R[x] R[x] R[x]"] * 3, {}, "limb", "it does not follow P[x] P[y] P[z]"),
    "needless point": ("3T:PPP", ["P[x] R[x]@O R[x] R[x]"] * 3, {}, "words", "runs through O only where it must"),
    "motion": ("3T:PPP", ["P[x] U[x,y] R[y]"] * 3, {}, "limb", "it does not follow"),
    "together": ("1T1R:PR", ["R[z] R[z] R[z]"] * 2, {}, "motion", "leave the platform more than P[x] R[z]@O"),
    "kinds": ("3R:S", ABOUT_O, {"joints": "RU", "coupling": (0, 0)}, "coupling", "and 0 is asked for"),
    "best row": ("1T1R", ["P[x] R[z]@O"] * 2, {}, "actuation", "as PR, its drives, locked"),
}


@pytest.mark.parametrize(
    ("row", "chains", "words", "dropped_by", "reason"), BY_VIRTUAL_CHAIN.values(), ids=BY_VIRTUAL_CHAIN
)
def test_the_filter_that_drops_a_follower_of_a_virtual_chain_is_named(row, chains, words, dropped_by, reason):
    found = explanation(limbs_driven_by(parse_chains(chains)), question(row, **words))
    assert (found.dropped_by, found.design) == (dropped_by, None), found.reason
    assert reason in found.reason


def test_limbs_with_inner_loops_do_not_follow_virtual_chains():
    limbs = limbs_driven_by(parse_chains(["{P[x] | P[x]} P[y] P[z]"] * 3), ["1.1", "2.1", "3.1"])
    assert "have no inner loops" in explanation(limbs, question("3T:PPP")).reason
