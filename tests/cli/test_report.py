import pytest

from assur.cli.self_contained import outside_needs
from assur.report.findings import Findings


def test_one_file_that_needs_nothing_else(assur_cli, tmp_path, monkeypatch):
    """Without its figures, which the demonstration draws."""
    monkeypatch.setattr(
        "assur.report.findings.Findings", lambda record, **_: Findings(record, resolution=16, illustrated=False)
    )
    path, paper = tmp_path / "r.html", tmp_path / "paper"
    run = assur_cli("report", "fivebar", "-o", str(path), "--latex", str(paper), "--json")
    assert (run.code, run.err) == (0, "")
    told = run.json
    numbers, latex = told.pop("numbers"), told.pop("latex")
    assert told == {"mechanism": "fivebar", "file": str(path), "bytes": path.stat().st_size}
    area = next(item for item in numbers if item["name"] == "workspace area")
    assert area["known_by"] == "proved by interval arithmetic"
    assert 0 < area["low"] < area["high"] < 1.001 * area["low"]
    text = path.read_text()
    assert "fivebar" in text
    assert outside_needs(text) == []
    assert sorted(item.name for item in tmp_path.iterdir()) == ["paper", "r.html"]
    assert set(latex) == {str(item) for item in paper.rglob("*.*")}
    assert latex[-1] == str(paper / "report.tex")


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("r.txt", "its ending is none of .html, .htm\nhint: rename it"),
        ("nowhere/r.html", "the folder {folder}/nowhere does not exist\nhint: mkdir -p {folder}/nowhere"),
    ],
)
def test_a_path_that_cannot_be_written_is_refused_before_the_work(assur_cli, tmp_path, monkeypatch, name, reason):
    monkeypatch.setattr("assur.report.report.report_page", lambda *_: pytest.fail("the work has begun"))
    run = assur_cli("report", "zeng2019", "-o", str(tmp_path / name))
    assert (run.code, run.out) == (2, "")
    assert run.err == f"error: cannot write {tmp_path / name}: {reason.format(folder=tmp_path)}\n"
    assert list(tmp_path.iterdir()) == []


def test_a_folder_for_latex_that_cannot_be_made_is_refused_before_the_work(assur_cli, tmp_path, monkeypatch):
    monkeypatch.setattr("assur.report.report.report_page", lambda *_: pytest.fail("the work has begun"))
    (tmp_path / "file").write_text("old")
    run = assur_cli("report", "zeng2019", "-o", str(tmp_path / "r.html"), "--latex", str(tmp_path / "file"))
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith(f"error: cannot make the folder {tmp_path / 'file'}: ")
    assert [item.name for item in tmp_path.iterdir()] == ["file"]
