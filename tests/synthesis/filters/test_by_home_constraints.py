import pytest

from assur.synthesis.explanation import explanation
from assur.synthesis.known_mechanisms import limbs_driven_by
from assur.synthesis.question import question
from assur.topology.notation import parse_chains

RPS = [f"R[{x},{y},0] P[z] S" for x, y in ((0, 1), (-(3**0.5), -1), (3**0.5, -1))]
LEGS = ["1.2", "2.2", "3.2"]

AT_HOME = {
    "rods": (["R[x] P(4S)[x]"] * 3, [], {}, "words", "have no P(4S); they are made of R, P, C, U, S"),
    "length": (["P[x] R[x] R[x] R[x]"] * 3, [], {}, "words", "4 joints one behind the other, and 3 at most"),
    "drive": (RPS, LEGS, {}, "words", "its drive is P1, and asked for is the first joint"),
    "drives": (RPS, ["1.1", "1.2", "2.1"], {}, "words", "it has 2 drives, and a series has one"),
    "freedoms": (["R[x] R[x]"] * 3, [], {}, "words", "two or three joints along x, y and z, 3 to 6 freedoms"),
    "limb": (["R[x] R[x] R[x]"] * 3, [], {}, "limb", "at home it resists a freedom of 1T2R"),
    "motion": (["U[x,y] P[z] S"] * 3, LEGS, {"actuators": "leg"}, "motion", "leave another motion than 1T2R at home"),
    "side by side": (
        ["R[x] P[z] S"] * 3,
        LEGS,
        {"actuators": "leg"},
        "arrangement",
        "where they stand otherwise, as R[x]",
    ),
    "coupling": (RPS, LEGS, {"actuators": "leg", "coupling": (0, 1)}, "coupling", "κ = 2, and 0..1 is asked for"),
    "kinds": (
        RPS,
        LEGS,
        {"actuators": "leg", "joints": "RPU"},
        "words",
        "it has S, and limbs of R, P, U are asked for",
    ),
}


@pytest.mark.parametrize(("chains", "driven", "words", "dropped_by", "reason"), AT_HOME.values(), ids=AT_HOME)
def test_the_filter_that_drops_a_parasitic_mechanism_is_named(chains, driven, words, dropped_by, reason):
    found = explanation(limbs_driven_by(parse_chains(chains), driven), question("1T2R", parasitic=True, **words))
    assert (found.dropped_by, found.design) == (dropped_by, None), found.reason
    assert reason in found.reason
