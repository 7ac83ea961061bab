import pytest

import assur
from assur.model.registry import topology_names
from assur.results.json_text import plain
from assur.topology.answers import answers, mark_text, refusals
from assur.topology.poc import Mark, PocSet
from catalogue import topology_of

NAMES = sorted({*assur.names(), *topology_names()})
CONTRACT = {
    "poc": {"t", "r", "dim", "text", "directions"},
    "limbs": {"text", "t", "r", "dim", "dependent"},
    "loops": {"xi", "delta"},
    "assur_chains": {"loops", "coupling_degree"},
    "redundant_constraints": {"collapsed", "joint_graph"},
}


@pytest.mark.parametrize("name", NAMES)
def test_the_contract_of_keys_and_kinds(name):
    found = plain(answers(topology_of(name)))
    for key, inner in CONTRACT.items():
        for item in found[key] if isinstance(found[key], list) else [found[key]]:
            assert inner <= item.keys(), key
    for key in ("dof", "coupling_degree"):
        assert isinstance(found[key], int)
    assert found["routes_agree"] in (True, None)
    assert found["redundant_constraints"].keys() == CONTRACT["redundant_constraints"]
    for item in (found["poc"], *found["limbs"]):
        assert item["t"] + item["r"] == item["dim"] + item["dependent"]
        for mark in item["directions"]:
            assert mark.keys() == {"part", "mark", "axes"}
            assert mark["mark"] in (item.get("poc_text") or item["text"])


@pytest.mark.parametrize("name", NAMES)
def test_the_sums_of_the_theory(name):
    found = plain(answers(topology_of(name)))
    loops = found["loops"]
    assert sorted(index for chain in found["assur_chains"] for index in chain["loops"]) == list(range(len(loops)))
    for chain in found["assur_chains"]:
        deltas = [loops[index]["delta"] for index in chain["loops"]]
        assert sum(deltas) == 0
        assert 2 * chain["coupling_degree"] == sum(map(abs, deltas))
    assert found["coupling_degree"] == max((chain["coupling_degree"] for chain in found["assur_chains"]), default=0)
    assert sum(6 - loop["xi"] for loop in loops) == found["redundant_constraints"]["collapsed"]
    assert found["redundant_constraints"]["joint_graph"] >= found["redundant_constraints"]["collapsed"]
    assert len(found["decoupling"]) == len(found["outputs"])
    assert all(len(row) == len(found["inputs"]) for row in found["decoupling"])


def test_refusals_name_what_the_rules_do_not_decide():
    for name in NAMES:
        found = topology_of(name)
        said = refusals(found)
        assert bool(said) == (found.routes_agree is None)
        assert all(item.reason for item in said)


@pytest.mark.parametrize(
    ("mark", "text"),
    [
        (Mark(), ""),
        (Mark("parallel", ("R1",)), "∥R1"),
        (Mark("plane", ("R1", "R4")), "∥◇(R1, R4)"),
        (Mark("arm", ("R2",)), "⊥(R2, ρ)"),
        (Mark("moving"), "moving"),
    ],
)
def test_a_mark_alone_is_what_the_set_says_of_it(mark, text):
    assert mark_text(mark) == text
    assert f"({text})" in str(PocSet(2, 0, 2, mark)) or not text
