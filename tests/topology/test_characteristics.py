"""The table of characteristics: what its rows say is what the facts are."""

import pytest

from assur.derived_topology import topology
from assur.topology.characteristics import characteristics
from catalogue import topology_of


def rows_of(name):
    return dict(characteristics(topology_of(name)))


def test_the_papers_mechanism_in_one_table():
    assert rows_of("zeng2019") == {
        "POC set": "t³ r⁰: dim 3",
        "motion": "3T",
        "parasitic": "none",
        "DOF": "F = 3 = (6 + 5) - (3 + 5)",
        "loops": "2: ξ1 = 3, Δ1 = +1; ξ2 = 5, Δ2 = -1",
        "coupling": "κ = 1; full freedom: one Assur chain has all drives",
        "Assur chains": "(1) loops 1, 2, κ = 1",
        "redundant": "4 with parallelograms as one joint, 10 of all joints",
        "relaxed": "B1 to S, C2 to S, B3a to S, D3a to S, B3b to C, D3b to C: leaves 0 of 10",
        "passive": "B1, C1, B2, C2, R3, R4, Pa1, Pa2",
        "idle": "none",
        "drives": "P1, P2, P3: valid; admissible, near the base first: "
        "(P1, P2, P3), (P1, P2, Pa1), (P1, P3, B1) and 75 more",
        "decoupling": "partial: y by P1 P2",
        "conditions": "P1 ∥ P2 ∥ R3 ∥ R4; B1 ∥ C1 ∥ B2 ∥ C2; P1 ⊥ B1",
    }


@pytest.mark.parametrize(
    ("name", "row", "said"),
    [
        ("three_rps", "parasitic", "1: "),
        ("three_rps", "limbs alike", "all 3 limbs"),
        ("tripteron", "decoupling", "full: "),
        ("gough_stewart", "conditions", "none"),
        ("fivebar", "motion", "1T1R; 2T by "),
    ],
)
def test_rows_of_other_mechanisms(name, row, said):
    assert rows_of(name)[row].startswith(said)


def test_what_says_nothing_is_left_out():
    assert not {"relaxed", "conditions"} & {row for row, text in rows_of("three_rps").items() if not text}
    assert "relaxed" not in rows_of("gough_stewart")


def test_a_shaky_mechanism_has_no_row_that_nothing_is_known_of():
    rows = dict(characteristics(topology(["C[z] C[1,0,2]", "C[x] C[1,0,2]"])))
    assert not {"parasitic", "conditions", "relaxed", "Assur chains"} & set(rows)
    assert rows["passive"] == "C2, C3"
