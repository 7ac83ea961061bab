"""`assur crosscheck`: its answer, its exit codes, and what it says without the engine."""

import sys

import pytest

from assur.crosscheck import crosscheck


@pytest.mark.sim
def test_it_says_that_both_agree(assur_cli):
    run = assur_cli("crosscheck", "fivebar", "--engine", "mujoco", "--samples", "2")
    assert run.code == 0, run.err
    assert "agree" in run.out
    assert "frames of links" in run.out


@pytest.mark.sim
def test_json_has_every_difference_with_its_tolerance(assur_cli):
    found = assur_cli("crosscheck", "fivebar", "--samples", "2", "--json").json
    assert found["holds"] is True
    assert found["modes"]["inverse"]
    assert {item["kind"] for item in found["differences"]} == set(crosscheck.TOLERANCES) - {"self-motions"}
    assert all(item["holds"] and item["largest"] <= item["tolerance"] for item in found["differences"])


@pytest.mark.sim
def test_a_difference_above_its_tolerance_is_exit_code_1(assur_cli, monkeypatch):
    monkeypatch.setitem(crosscheck.TOLERANCES, "loops", 1e-30)
    run = assur_cli("crosscheck", "fivebar", "--samples", "2")
    assert run.code == 1
    assert "DIFFER" in run.out


def test_without_the_engine_it_says_how_to_install_it(assur_cli, monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    run = assur_cli("crosscheck", "fivebar")
    assert run.code == 2
    assert "pip install '.[sim]'" in run.err


@pytest.mark.parametrize("words", [("--samples", "0"), ("--samples", "x"), ("--seed", "-1"), ("--engine", "bullet")])
def test_wrong_options_are_refused(assur_cli, words):
    run = assur_cli("crosscheck", "fivebar", *words)
    assert run.code == 2
    assert words[1] in run.err
