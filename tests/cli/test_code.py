"""Python in a mechanism's folder runs with leave only; without it the joint graph answers, and says so."""

import io
import json
import shutil
import sys
from pathlib import Path

import pytest

import assur
from assur.cli.main import main
from assur.errors import CodeNotRunWarning, UsageError
from assur.model.consent import leave, may_run

ROOT = Path(assur.__file__).parent / "mechanisms"
GIVEN = ("162.6907", "-143.3209", "-24.6776")


@pytest.fixture
def hostile(tmp_path, monkeypatch):
    """A copy of a built-in folder whose closed form and evidence leave a mark where they run."""
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("ASSUR_RUN_CODE", raising=False)
    folder = tmp_path / "hostile"
    shutil.copytree(ROOT / "zeng2019", folder)
    mark = f"__import__('pathlib').Path({str(tmp_path / 'ran')!r}).touch()\n"
    for path in (folder / "closed_form.py", *(folder / "reference/evidence").glob("*.py")):
        path.write_text(path.read_text(encoding="utf-8") + mark, encoding="utf-8")
    return folder


def ran(folder):
    return (folder.parent / "ran").exists()


@pytest.mark.parametrize(
    "words",
    [
        ("check",),
        ("show",),
        ("topology",),
        ("direct", *GIVEN),
        ("inverse", "-15", "9", "456"),
        ("singularity", "--pose", "-15", "9", "456"),
        ("export", "--format", "mjcf", "-o", "out.xml"),
        ("certify", "-o", "cert.json"),
        ("audit",),
    ],
)
def test_no_command_runs_it_unasked(words, hostile, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    code = main([words[0], str(hostile), *words[1:]])
    told = capsys.readouterr()
    assert not ran(hostile)
    assert "closed_form.py" in told.err
    assert "not run: the joint graph answers alone" in told.err
    assert code in (0, 2, 3, 5)


def test_without_leave_the_joint_graph_answers_and_says_so(hostile, capsys):
    assert main(["direct", str(hostile), *GIVEN, "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert len(answer["solutions"]) == 4
    assert answer["right"].startswith("its loops in turn")
    (code,) = answer["code_not_run"]
    assert code["file"].endswith("closed_form.py")
    assert "__import__" in code["reason"]
    assert code["line"] == len((hostile / "closed_form.py").read_text(encoding="utf-8").splitlines())


@pytest.mark.parametrize(("option", "variable"), [(["--run-code"], None), ([], "always")])
def test_with_leave_it_runs(option, variable, hostile, capsys, monkeypatch):
    if variable:
        monkeypatch.setenv("ASSUR_RUN_CODE", variable)
    assert main(["direct", str(hostile), *GIVEN, "--json", *option]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert ran(hostile)
    assert "code_not_run" not in answer
    assert answer["right"].startswith("closed form")


def test_what_goes_wrong_in_code_that_was_let_run_names_its_line(hostile, capsys):
    path = hostile / "closed_form.py"
    text = path.read_text(encoding="utf-8").replace("m3 = p.l6 * p.l6 - v * v\n", "m3 = p.l6**2 - abs(v).real**2.5\n")
    path.write_text(text, encoding="utf-8")
    line = text[: text.index("m3 = ")].count("\n") + 1
    assert main(["direct", str(hostile), *GIVEN, "--certify", "--run-code"]) == 3
    assert f"closed_form.py:{line}: " in capsys.readouterr().err


def test_never_beats_the_option(hostile, capsys, monkeypatch):
    monkeypatch.setenv("ASSUR_RUN_CODE", "never")
    assert main(["direct", str(hostile), *GIVEN, "--run-code"]) == 0
    assert not ran(hostile)
    assert "ASSUR_RUN_CODE=never forbids it" in capsys.readouterr().err


def test_another_word_is_refused(hostile, capsys, monkeypatch):
    monkeypatch.setenv("ASSUR_RUN_CODE", "yes")
    assert main(["show", str(hostile)]) == 2
    assert "always, never, ask" in capsys.readouterr().err


class Terminal(io.StringIO):
    """What a person types, and what they read."""

    def isatty(self):
        return True


def test_at_a_terminal_it_is_asked_once_for_each_content(hostile, monkeypatch, capsys):
    def at_terminal(words, typed):
        monkeypatch.setattr(sys, "stdin", Terminal(typed))
        monkeypatch.setattr(sys, "stderr", Terminal())
        assert main([*words]) == 0
        return sys.stderr.getvalue().count("Run it? [y/N]")

    words = ["show", str(hostile)]
    assert at_terminal(words, "\n") == 1
    assert not ran(hostile)
    assert at_terminal(words, "y\n") == 1
    assert ran(hostile)
    assert at_terminal(words, "") == 0  # agreed to before
    path = hostile / "closed_form.py"
    path.write_text(path.read_text(encoding="utf-8") + "# another content\n", encoding="utf-8")
    assert at_terminal(words, "n\n") == 1
    assert at_terminal([*words, "--json"], "y\n") == 0  # a program reads the answer


def test_in_python_a_warning_says_so(hostile):
    with pytest.warns(CodeNotRunWarning, match="not run: the joint graph answers alone"):
        mechanism = assur.load(hostile)
    assert mechanism.closed_form is None
    assert not ran(hostile)


def test_evidence_that_was_not_run_says_nothing(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "own"
    shutil.copytree(ROOT / "fivebar", folder)
    (folder / "reference/evidence").mkdir(exist_ok=True)
    (folder / "reference/evidence/mine.py").write_text(
        f"__import__('pathlib').Path({str(tmp_path / 'ran')!r}).touch()\ndef f(r):\n    return 1\n", encoding="utf-8"
    )
    (folder / "reference/errata.toml").write_text(
        '[E1]\nwhere = "p. 1"\nprinted = "1"\nfinding = "wrong"\nevidence = "mine.f"\n', encoding="utf-8"
    )
    assert main(["audit", str(folder)]) == 0
    said = capsys.readouterr()
    assert "not run" in said.out
    assert "evidence is Python" in said.err
    assert not (tmp_path / "ran").exists()


def test_verify_runs_no_code_even_with_leave(hostile, tmp_path, monkeypatch, capsys):
    certificate = tmp_path / "cert.json"
    assert main(["certify", "zeng2019", "-o", str(certificate), "--gap", "0.2"]) in (0, 5)
    monkeypatch.setenv("ASSUR_RUN_CODE", "always")
    code = main(["verify", str(certificate), "--mechanism", str(hostile)])
    said = capsys.readouterr()
    assert not ran(hostile)
    assert code == 5
    assert "holds for its own formulas" in said.out
    assert "verified" not in said.out
    assert "this command runs no code of others" in said.err


def test_a_fifo_or_text_that_is_no_utf8_is_told(tmp_path):
    folder = tmp_path / "own"
    shutil.copytree(ROOT / "fivebar", folder)
    (folder / "closed_form.py").write_bytes(b"x = '\xff'\n")
    with pytest.raises(assur.MechanismFileError, match="0xff"):
        assur.load(folder)


def test_the_answer_is_kept_for_the_content_at_its_place_with_the_python_beside_it(tmp_path, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "cache"))
    folder, other = tmp_path / "a", tmp_path / "b"
    for place in (folder, other):
        place.mkdir()
        (place / "closed_form.py").write_bytes(b"1")
    asked = []

    def agree(code):
        asked.append(code.file)
        return True

    def asked_at(place, content=b"1"):
        asked.clear()
        with leave(ask=agree):
            assert may_run(place / "closed_form.py", content, "", "")
            assert may_run(place / "closed_form.py", content, "", "")
        return len(asked)

    assert [asked_at(folder), asked_at(folder), asked_at(folder, b"2")] == [1, 0, 1]
    assert asked_at(other) == 1  # what it reads beside it may be another
    (folder / "helper.py").write_bytes(b"x = 1")
    assert [asked_at(folder), asked_at(folder)] == [1, 0]
    (folder / "helper.py").write_bytes(b"x = 2")
    assert asked_at(folder) == 1
    monkeypatch.setenv("ASSUR_RUN_CODE", "perhaps")
    with pytest.raises(UsageError, match="perhaps"):
        may_run(Path("a.py"), b"1", "", "")


def test_a_link_to_a_built_in_file_makes_nothing_beside_it_built_in(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "mechanism.toml").symlink_to(ROOT / "fivebar" / "mechanism.toml")
    text = (ROOT / "fivebar" / "closed_form.py").read_text(encoding="utf-8")
    assert text.count("ns.sqrt(meeting / square) / 2") == 1
    wrong = text.replace("ns.sqrt(meeting / square) / 2", "ns.sqrt(meeting / square) / 3")
    (folder / "closed_form.py").write_text(wrong, encoding="utf-8")
    assert main(["workspace", str(folder), "--prove", "x=-10:10,y=100:110"]) == 3
    assert "does not close" in capsys.readouterr().err


def test_other_content_is_not_built_in_wherever_its_path_leads(monkeypatch):
    monkeypatch.setenv("ASSUR_RUN_CODE", "never")
    path = ROOT / "fivebar" / "closed_form.py"
    assert may_run(path, path.read_bytes(), "", "")
    with pytest.warns(CodeNotRunWarning):
        assert not may_run(path, b"what was read before the folder became a link", "", "")
