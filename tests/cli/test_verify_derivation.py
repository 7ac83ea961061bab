"""`assur verify` of a derivation: what is proved in a sentence and as data, and what is refused."""

import json
import re

import pytest

from assur.model.registry import load_record


def test_the_command_says_what_is_proved_with_its_exit_code(tmp_path, assur_cli):
    document = assur_cli("derive", "fivebar", "--problem", "direct", "--prove", "--json").json
    file = tmp_path / "d.json"
    file.write_text(json.dumps(document))
    run = assur_cli("verify", str(file), "--mechanism", "fivebar", "--json")
    assert (run.code, run.json["verified"], run.json["problems"][0]["branches"]) == (0, True, 2)
    assert "direct: derivation verified: 2 branches, complete where N1 != 0" in assur_cli("verify", str(file)).out
    assert assur_cli("verify", str(file), "--mechanism", "zeng2019").code == 1
    document["problems"][0]["sets"][0]["formulas"]["cos_rod2"] = "C1/l2 - cos_rod1"
    file.write_text(json.dumps(document))
    refused = assur_cli("verify", str(file), "--json")
    assert (refused.code, refused.json["verified"]) == (1, False)
    del document["problems"][0]["proof"]
    file.write_text(json.dumps(document))
    assert assur_cli("verify", str(file)).code == 3


@pytest.mark.deep
def test_a_problem_without_identities_is_said(tmp_path, assur_cli):
    run = assur_cli("derive", "fivebar", "--prove", "--json")
    document = run.json
    direct, inverse = document["problems"]
    assert (run.code, "proof" in direct, "proof" in inverse) == (0, True, True)
    del direct["proof"]
    file = tmp_path / "d.json"
    file.write_text(json.dumps(document))
    verified = assur_cli("verify", str(file), "--json")
    assert (verified.code, verified.json["not_proved"]) == (5, ["direct"])
    assert [(own["problem"], own["branches"]) for own in verified.json["problems"]] == [("inverse", 4)]


def test_a_relation_of_dimensions_is_a_hypothesis_that_is_held_against_the_file(tmp_path, assur_cli):
    """Planes of a planar pair of limbs are one where the dimensions say so, by their numbers or by a formula."""
    file, proof = tmp_path / "own.toml", tmp_path / "d.json"
    assert assur_cli("new", str(file), "--chain", "R[x] R[x] R[x]", "--chain", "R[x] R[x]").code == 0
    numbers = {own.name: own.value for own in load_record(file).parameters.values()}
    _write_values(file, numbers)
    run = assur_cli("derive", str(file), "--problem", "direct", "--prove", "--json")
    document = run.json
    (problem,) = document["problems"]
    (relation,) = problem["relations"]
    assert (run.code, relation["stated"]) == (0, False)
    name, formula = relation["dimension"], relation["formula"]
    proof.write_text(json.dumps(document))
    said = " ".join(assur_cli("verify", str(proof), "--mechanism", str(file)).out.split())
    assert f"with {name} = {formula}, which the file's numbers have and no formula of it states" in said
    for relations in ({}, {name: f"{formula} + l1"}, {name: f"2*{name} - ({formula})"}):
        problem["proof"]["relations"] = relations
        proof.write_text(json.dumps(document))
        assert assur_cli("verify", str(proof), "--mechanism", str(file)).code == 1
    _write_values(file, {name: f'"{formula}"'})
    problem["proof"]["relations"] = {name: formula}
    proof.write_text(json.dumps(document))
    verified = assur_cli("verify", str(proof), "--mechanism", str(file), "--json")
    assert (verified.code, verified.json["problems"][0]["unstated"]) == (0, [])
    again = assur_cli("derive", str(file), "--problem", "direct", "--json")
    assert [own["stated"] for own in again.json["problems"][0]["relations"]] == [True]


def _write_values(file, values):
    """Write other values of parameters into a file, numbers or formulas."""
    text = file.read_text()
    for name, value in values.items():
        text, count = re.subn(rf"^({name} *= \{{ value = )[^,]*,", rf"\g<1>{value},", text, flags=re.MULTILINE)
        assert count == 1
    file.write_text(text)
