import pytest

from assur.synthesis.explanation import explanation
from assur.synthesis.known_mechanisms import limbs_driven_by
from assur.synthesis.question import question
from assur.topology.notation import parse_chains

CRR = "C[x] R[x] R[x]"
LOOP = "{P[y] R[x] R[x] | P[y] R[x] R[x]}"

DROPPED = {
    "limbs": ([CRR] * 4, {}, "limbs", "4 limbs, and 3 are asked for"),
    "drives": ([f"{LOOP} R[y] R[y]"] * 2, {"limbs": 2}, "drives", "4 drives, and 3T has 3 freedoms"),
    "joint": (["H[x] R[x] R[x]"] * 3, {}, "words", "limb 1, H[x] R[x] R[x]: limbs have no H"),
    "rods": (["R[x] P(4U)[x]"] * 3, {}, "words", "limbs have no P(4U)"),
    "length": (
        [CRR, CRR, "R[x] R[x] R[x] R[y] R[y]"],
        {"max_joints": 4},
        "words",
        "limb 3, R[x] R[x] R[x] R[y] R[y]: it has 5 joints",
    ),
    "length of a loop": ([f"{LOOP} R[y] R[y]", "P[x] P[y] P[z]"], {"limbs": 2, "max_joints": 4}, "words", "5 joints"),
    "loop": (["{P[y] H[x] | P[y] R[x]} P[z]", "P[x] P[y] P[z]"], {"limbs": 2}, "words", "no H"),
    "unknown loop": (
        ["{P[y] R[x] | P[y] R[x]} P[x]", "P[x] P[y] P[z]"],
        {"limbs": 2},
        "words",
        "none of the catalogue",
    ),
    "loop among series": ([f"{LOOP} R[y]"] + ["U P S"] * 2, {}, "drives", "4 drives"),
    "drive": (["U[x,y] P[x] U[y,x]"] * 3, {}, "words", "its drive is P1, and asked for is the first joint"),
    "oblique": (["P[1,1,0] R[x] R[x] R[x]"] * 3, {}, "words", "axes are parallel or perpendicular"),
    "motion of a limb": (["R[x] R[x] R[x]"] * 3, {}, "limb", "its end cannot make all of 3T"),
    "idle": (["P[x] P[y] P[z] R[x]"] * 3, {}, "words", "stands still in all of 3T"),
    "motion": (["P[x] U[x,y] S"] * 3, {}, "motion", "leave the platform t³ r³"),
    "coupling": ([CRR] * 3, {"coupling": (0, 0)}, "coupling", "κ = 1, and 0 is asked for"),
    "passive": (["C[x] P[y] R[x]"] * 3, {"passive_slides": False}, "words", "nothing drives it along its P or C"),
    "passive C": (["R[x] C[x] R[x]"] * 3, {"passive_slides": False}, "words", "nothing drives it along its P or C"),
    "kinds": ([CRR] * 3, {"joints": "RPU"}, "words", "it has C, and limbs of R, P, U are asked for"),
    "known": (
        [CRR] * 3,
        {"max_joints": 3, "symmetric": True, "novelty": "new"},
        "novelty",
        "the catalogue has a mechanism",
    ),
    "new": (
        ["C[x] R[x] P[y]"] * 3,
        {"max_joints": 3, "symmetric": True, "novelty": "known"},
        "novelty",
        "has no mechanism",
    ),
    "equal": ([CRR, CRR, "P[x] P[y] P[z]"], {"symmetric": True}, "symmetry", "not equal"),
}


@pytest.mark.parametrize(("chains", "words", "dropped_by", "reason"), DROPPED.values(), ids=DROPPED)
def test_the_filter_that_drops_a_mechanism_is_named(chains, words, dropped_by, reason):
    found = explanation(limbs_driven_by(parse_chains(chains)), question("3T", **words))
    assert found.dropped_by == dropped_by
    assert found.design is found.synthesis is None
    assert reason in found.reason
