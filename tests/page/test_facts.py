from assur.derived_topology import topology
from assur.errors import UsageError
from assur.mechanism import load
from assur.page.facts import errata, facts


def test_facts_are_those_of_the_topology_engine():
    found = {item["title"]: item["text"] for item in facts(load("zeng2019"))}
    wanted = topology("zeng2019")
    assert found["POC set of the platform"] == str(wanted.poc) == "t³ r⁰"
    assert found["Degrees of freedom F"] == str(wanted.dof) == "3"
    assert found["Coupling degree κ"] == "1"
    assert found["Loops"] == "loop 1: ξ = 3, Δ = +1; loop 2: ξ = 5, Δ = −1"
    assert found["Decoupling"] == "partly decoupled"
    assert all(found.values())


def test_errata_are_those_of_the_source(tmp_path):
    found = errata(load("zeng2019"))
    assert [item["id"] for item in found][:3] == ["E1", "E2", "E3"]
    assert all("printed" in item["text"] for item in found)
    assert errata(load("fivebar")) == []


def test_a_users_own_file_has_none(drafted):
    assert errata(load(drafted)) == []


def test_what_cannot_be_derived_says_why(monkeypatch):
    def refuse(record):
        raise UsageError("the rules refuse")

    monkeypatch.setattr("assur.page.facts.topology", refuse)
    assert facts(load("fivebar")) == [{"title": "Topology", "text": "not derived: the rules refuse"}]
