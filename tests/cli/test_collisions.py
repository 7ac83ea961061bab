"""`assur collisions`: what it says, its exit codes, and what is refused."""

from __future__ import annotations


def test_links_that_keep_apart_are_exit_code_0(assur_cli):
    run = assur_cli("collisions", "fivebar", "--samples", "20")
    assert run.code == 0, run.err
    assert "no links meet" in run.out
    assert "known at 20 poses of the workspace, mode" in run.out
    assert "between them links may come nearer" in " ".join(run.out.split())


def test_links_that_meet_are_exit_code_1(assur_cli):
    run = assur_cli("collisions", "zeng2019", "--samples", "30", "--json")
    assert run.code == 1
    first = run.json["pairs"][0]
    assert first["clearance"] == 0
    assert 0 < first["meeting"] <= run.json["poses"]
    assert run.json["known"] == "sampled"
    assert len(first["pose"]) == 3


def test_along_a_motion(assur_cli):
    run = assur_cli("collisions", "fivebar", "--over", "motion", "--samples", "12", "--json")
    assert run.code == 0
    assert (run.json["over"], run.json["poses"], run.json["mode"]) == ("motion", 12, None)
    clearances = [item["clearance"] for item in run.json["pairs"]]
    assert clearances == sorted(clearances)


def test_what_makes_no_sense_is_refused(assur_cli):
    for words, said in (
        (("--samples", "0"), "at least 1"),
        (("--seed", "-1"), "not negative"),
        (("--over", "motion", "--mode", "++"), "a motion begins at home"),
        (("--over", "nothing"), "workspace"),
    ):
        run = assur_cli("collisions", "fivebar", *words)
        assert run.code == 2, words
        assert said in run.err
