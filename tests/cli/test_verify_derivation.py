"""`assur verify` of a derivation: what is proved in a sentence and as data, and what is refused."""

import json

import pytest


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
