"""The README says what is so: its Python runs, its printed output is real, its counts are the audit's."""

import doctest
import re
from pathlib import Path

from audits import audited
from shown import OUTPUT, printed, rounded

README = Path(__file__).parents[1] / "README.md"


def test_the_python_of_the_readme_runs():
    failures, count = doctest.testfile(str(README), module_relative=False)
    assert count >= 4
    assert failures == 0


def test_output_shown_is_the_real_one(capsys, tmp_path, monkeypatch):
    """One command after the other in one folder, as a reader would: some write a file that others read."""
    monkeypatch.chdir(tmp_path)
    for command, shown in OUTPUT.findall(README.read_text(encoding="utf-8")):
        assert rounded(printed(command, capsys)) == rounded(shown), command


def test_there_is_output_and_its_command_can_be_read():
    """The comment with the command is not seen by a reader: it stands in the text, too."""
    text = README.read_text(encoding="utf-8")
    shown = [command.partition(" | head")[0].partition(" | sed")[0] for command, _ in OUTPUT.findall(text)]
    assert len(shown) >= 6
    seen = re.sub(r"<!--.*?-->", "", text)
    assert [command for command in shown if command.removesuffix(" --certify") not in seen] == []


def test_it_is_read_in_five_minutes():
    assert len(README.read_text(encoding="utf-8").splitlines()) < 200


def test_counts_are_those_of_the_audit():
    audit = audited("zeng2019")
    text = " ".join(README.read_text(encoding="utf-8").split())
    assert f"of the {len(audit.rows)} printed numbers, equations and statements" in text
    assert f"{audit.wrong + audit.missing} are wrong or missing" in text


def test_pictures_and_links_exist():
    text = README.read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)]+)\)", text):
        assert (README.parent / target).is_file(), target
