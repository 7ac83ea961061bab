import pytest

from assur.synthesis.answers import explanation_answer
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


def test_one_that_is_listed_is_listed_there_and_of_long_searches_its_family_alone_is_told(monkeypatch):
    limbs, asked = limbs_of("three_crr"), question("3T", max_joints=3, symmetric=True)
    found = explanation(limbs, asked)
    assert found.dropped_by == ""
    assert found.design in found.synthesis.designs
    assert found.design.names == ("three_crr",)
    assert found.reason.startswith(f"rank {found.synthesis.designs.index(found.design) + 1}, in family ")
    monkeypatch.setattr("assur.synthesis.synthesis.PATIENCE", 0.0)
    few = explanation(limbs, asked)
    assert len(few.synthesis.families) < len(found.synthesis.families)
    assert [chain.text for chain in few.design.chains] == [chain.text for chain in found.design.chains]
    assert few.reason.startswith("in a family of ")
    answer = explanation_answer(few, asked, limbs)
    assert (answer.dropped_by, answer.rank, answer.family, answer.names) == (None, None, None, ("three_crr",))
