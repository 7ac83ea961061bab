"""One rule for every command that proves an answer: 0 where it is yes, 4 where it is no, 5 where it is undecided."""

import re
from pathlib import Path

import pytest

from assur.cli import exit_codes, progress
from assur.cli.application import HELP, application
from assur.errors import UsageError

CONVENTIONS = Path(__file__).parents[2] / "CONVENTIONS.md"

INSIDE = ("--box", "x=-20:0", "--box", "y=0:10", "--box", "z=400:420")
OUTSIDE = ("--box", "x=-20:0", "--box", "y=0:10", "--box", "z=900:920")
ACROSS = ("--box", "x=-20:0", "--box", "y=0:10", "--box", "z=400:700")
PATH = ("certify", "fivebar", "--kind", "path", "--mode=-+", "-o", "FILE")

QUESTIONS = [
    # every solution, or that there is none
    ("direct zeng2019 162.6907 -143.3209 -24.6776 --certify", 0),
    ("direct zeng2019 900 -143.3209 -24.6776 --certify", 4),
    ("direct zeng2019 70 -70 0 --certify", 5),
    ("inverse zeng2019 -15.4714 9.6849 456.3315 --certify", 0),
    ("inverse zeng2019 -15.4714 9.6849 900 --certify", 4),
    # a box of poses
    ("workspace zeng2019 --prove x=-20:0,y=0:10,z=400:420", 0),
    ("workspace zeng2019 --prove x=-20:0,y=0:10,z=900:920", 4),
    ("workspace zeng2019 --prove x=-20:0,y=0:10,z=400:700", 4),
    (" ".join(("certify zeng2019 -o FILE --kind box", *INSIDE)), 0),
    (" ".join(("certify zeng2019 -o FILE --kind box", *OUTSIDE)), 4),
    (" ".join(("certify zeng2019 -o FILE --kind box --most 60", *ACROSS)), 4),
    ("certify zeng2019 -o FILE --kind box --most 1", 5),
    # the largest shape about a point
    ("workspace fivebar --mode=-+ --largest cube --around x=0,y=200", 0),
    ("workspace zeng2019 --largest cube --around x=0,y=0,z=900", 4),
    # a place, a path
    ("aspects fivebar --mode=-+ --from 0,200", 0),
    ("aspects fivebar --mode=-+ --from 0,900 --box y=0:1000", 4),
    ("aspects fivebar --mode=-+ --from -60,150 --to 60,220", 0),
    (" ".join((*PATH, "--from -60,150 --to 60,220")), 0),
    # formulas: square roots, one polynomial, or a set of links that resists
    ("derive fivebar", 0),
    ("derive planar_3rpr", 0),
    ("derive gough_stewart", 5),
    # bounds are an answer and no question
    ("certify zeng2019 -o FILE --most 1", 0),
]
NO_QUESTION = {
    "verify",
    "follow",
    "audit",
    "sweep",
    "demo",
    "crosscheck",
    "report",
    "page",
    "doctor",
    "show",
    "check",
    "errors",
}
"""They mention proofs, and ask for none: of `verify` see test_verify.py."""


HOUR = 3600.0
"""Nothing says before that it is still at work: how busy a machine is decides no test."""


@pytest.mark.parametrize(("words", "code"), QUESTIONS)
def test_the_answer_of_a_proof_is_its_exit_code(assur_cli, tmp_path, monkeypatch, words, code):
    monkeypatch.setattr(progress, "LONG", HOUR)
    file = str(tmp_path / "c.json")
    run = assur_cli(*words.replace("FILE", file).split())
    assert (run.code, run.err) == (code, "")


def test_every_command_that_proves_is_asked():
    asked = {words.split()[0] for words, _ in QUESTIONS}
    proving = set()
    for name in application():
        text = "" if name.startswith("-") else application()[name].help
        if re.search(r"\bpro(ve|of)", text.lower()):  # --improve is another word
            proving.add(name)
    assert proving - NO_QUESTION == asked - NO_QUESTION


@pytest.mark.parametrize(("words", "code"), [(INSIDE, 0), (OUTSIDE, 4)])
def test_a_proof_that_holds_is_verified_whatever_it_answers(assur_cli, tmp_path, words, code):
    file = str(tmp_path / "c.json")
    assert assur_cli("certify", "zeng2019", "-o", file, "--kind", "box", *words).code == code
    assert assur_cli("verify", file).code == 0


def test_the_page_on_conventions_and_the_help_name_every_code():
    numbers = {value for name, value in vars(exit_codes).items() if name.isupper() and isinstance(value, int)}
    codes = {*exit_codes.MEANINGS}
    assert codes == numbers - {exit_codes.BROKEN_PIPE}  # which the shell knows
    assert UsageError.exit_code == exit_codes.USAGE
    table = CONVENTIONS.read_text(encoding="utf-8").partition("| exit code | means |")[2].partition("\n\n")[0]
    assert {int(code) for code in re.findall(r"^\| (\d+) \|", table, re.MULTILINE)} == codes
    assert {
        int(code) for code in re.findall(r"\b\d+\b", HELP.partition("Exit codes:")[2].partition("\n\n")[0])
    } == codes
