import pytest

from assur.synthesis.explanation import explanation
from assur.synthesis.known_mechanisms import limbs_of
from assur.synthesis.question import question


@pytest.mark.parametrize(
    ("name", "words"),
    [
        pytest.param("agile_eye", {"motion": "3R"}, marks=pytest.mark.deep),
        pytest.param("four_ruu", {"motion": "3T1R:PPPR"}, marks=pytest.mark.deep),
        ("three_rps", {"motion": "1T2R", "parasitic": True, "actuators": "leg"}),
    ],
)
def test_one_that_is_listed_is_told_with_its_rank_also_where_limbs_have_places(name, words):
    found = explanation(limbs_of(name), question(symmetric=True, **words))
    assert found.dropped_by == "", found.reason
    assert found.design.names == (name,)
    assert found.design is found.synthesis.designs[int(found.reason.split()[1].rstrip(",")) - 1]


def test_the_tripteron_is_not_among_mechanisms_of_two_limbs():
    found = explanation(limbs_of("tripteron"), question("3T", 2))
    assert found.dropped_by == "limbs"
    assert "2 of them have fewer than the 3 freedoms of 3T: only limbs with an inner loop have two" in found.reason


def test_one_that_is_listed_is_listed_there():
    found = explanation(limbs_of("three_crr"), question("3T", max_joints=3, symmetric=True))
    assert found.dropped_by == ""
    assert found.design in found.synthesis.designs
    assert found.design.names == ("three_crr",)
    assert found.reason.startswith(f"rank {found.synthesis.designs.index(found.design) + 1}, in family ")
