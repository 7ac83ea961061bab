"""A folder whose closed form is wrong: no command answers from it, each says what is at fault, with exit code 3."""

import shutil
from pathlib import Path

import pytest

from assur.model.registry import load_record

BUILT_IN = Path(load_record("fivebar").file).parents[1]
RADICAND = ("m3 = p.l6 * p.l6 - v * v", "m3 = 1.2 * p.l6 * p.l6 - v * v")
FACTORS = ('"w": core.w,\n        "v": core.v,', '"w": core.w * core.w + 1,\n        "v": core.v * core.v + 1,')


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The folder of a mechanism, the paper's if none is named, copied, with one text of its closed form exchanged."""
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "cache"))

    def result(before="", after="", name="zeng2019"):
        target = tmp_path / "bad"
        shutil.copytree(BUILT_IN / name, target, dirs_exist_ok=True)
        path = target / "closed_form.py"
        text = path.read_text(encoding="utf-8")
        assert before in text
        path.write_text(text.replace(before, after) if before else text, encoding="utf-8")
        return str(target)

    return result


def test_check_names_margin_line_pose_and_gap(assur_cli, folder):
    found = assur_cli("check", folder(*RADICAND), "--json")
    assert found.code == 3
    (fault,) = found.json["faults"]
    assert (fault["line"], fault["path"]) == (26, "margin M3")
    assert "x = " in fault["found"]
    assert "a gap of " in fault["found"]


def test_check_names_factors_that_do_not_vanish(assur_cli, folder):
    found = assur_cli("check", folder(*FACTORS), "--json")
    assert found.code == 3
    assert {fault["path"] for fault in found.json["faults"]} == {"factor w", "factor v"}


LONGER = ("meeting = 4 * p.l2 * p.l2 - square", "meeting = 5 * p.l2 * p.l2 - square", "fivebar")
"""Rods of the five-bar that reach further where its poses are computed than they do."""
QUESTIONS = {
    "inverse": ("0", "200"),
    "direct": ("120", "60"),
    "inverse --certify": ("0", "200"),
    "workspace --certify": (),
    "workspace --prove": ("x=-5:5,y=195:205",),
    "aspects": (),
    "certify": ("-o", "proof.json"),
    "report": ("-o", "report.html"),
    "singularity": ("--pose", "0", "200"),
    "sweep": ("--along", "x=5", "--along", "y=5", "-o", "grid"),
    "show": (),
}


@pytest.mark.parametrize(
    ("question", "wrong"),
    [*((question, LONGER) for question in QUESTIONS), ("show", FACTORS), ("certify", FACTORS)],
)
def test_nothing_is_answered_or_proved(assur_cli, folder, monkeypatch, tmp_path, question, wrong):
    monkeypatch.chdir(tmp_path)
    command, *option = question.split()
    values = QUESTIONS[question]
    words = (*values, *option) if command == "inverse" else (*option, *values)
    found = assur_cli(command, folder(*wrong), *words)
    assert found.code == 3
    assert "closed_form.py" in found.err
    assert not (tmp_path / "proof.json").exists()
    assert not (tmp_path / "report.html").exists()


def test_verify_refuses_what_a_wrong_form_would_prove(assur_cli, folder, tmp_path):
    """A certificate of the right form, and the form that is wrong when it is verified."""
    proof = str(tmp_path / "proof.json")
    assert assur_cli("certify", folder(), "-o", proof, "--most", "40").code in (0, 5)
    assert assur_cli("verify", proof, "--mechanism", folder()).code == 0
    found = assur_cli("verify", proof, "--mechanism", folder(*RADICAND))
    assert found.code == 3
    assert "margin M3" in found.err


def test_a_right_form_of_ones_own_is_said_to_agree(assur_cli, folder):
    found = assur_cli("check", folder())
    assert (found.code, found.out.splitlines()[2]) == (
        0,
        "a closed form stands beside it, and agrees with the joint graph",
    )
    assert assur_cli("inverse", folder(), "0", "0", "400", "--set", "l2=300").code == 0
