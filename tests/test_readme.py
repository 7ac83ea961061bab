"""The README says what is so: its Python runs, its printed output is real, its counts are the audit's."""

from __future__ import annotations

import doctest
import re
import shlex
from pathlib import Path

from audits import audited

README = Path(__file__).parents[1] / "README.md"
OUTPUT = re.compile(r"<!-- output: (assur .*?) -->\n```text\n(.*?)```", re.S)


def printed(command, capsys):
    from assur.cli.main import main

    command, _, count = command.partition(" | head -n ")
    main(shlex.split(command)[1:])
    lines = capsys.readouterr().out.splitlines()[: int(count) if count else None]
    return "\n".join(line.rstrip() for line in lines).strip("\n") + "\n"


def rounded(text):
    """Gaps of rounding size are not the same on every processor."""
    return re.sub(r"\d\.\de-1\d", "rounding", text)


def test_the_python_of_the_readme_runs():
    failures, count = doctest.testfile(str(README), module_relative=False)
    assert count >= 4
    assert failures == 0


def test_output_shown_is_the_real_one(capsys, tmp_path, monkeypatch):
    """One command after the other in one folder, as a reader would: some write a file that others read."""
    monkeypatch.chdir(tmp_path)
    for command, shown in OUTPUT.findall(README.read_text(encoding="utf-8")):
        assert rounded(printed(command, capsys)) == rounded(shown), command


def test_there_is_output():
    assert len(OUTPUT.findall(README.read_text(encoding="utf-8"))) >= 2


def test_counts_are_those_of_the_audit():
    found = audited("zeng2019")
    text = " ".join(README.read_text(encoding="utf-8").split())
    assert f"of the {len(found.rows)} printed numbers, equations and statements" in text
    assert f"{found.wrong + found.missing} are wrong or missing" in text


def test_pictures_and_links_exist():
    text = README.read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)]+)\)", text):
        assert (README.parent / target).is_file(), target
