from dataclasses import replace

import pytest

from assur.audit.documents import documents
from assur.results.json_text import plain
from audits import audited

ROW = {"source", "quantity", "printed", "computed", "verdict", "erratum"}


@pytest.fixture
def found():
    return audited("zeng2019")


@pytest.fixture
def quick(monkeypatch, found):
    """The audit has been done already."""
    monkeypatch.setattr("assur.cli.auditing.audit", lambda _: found)


def test_shape_and_rows_are_those_of_the_audit(assur_cli, quick, found):
    run = assur_cli("audit", "zeng2019", "--json")
    assert (run.code, run.err) == (0, "")
    assert run.json == plain(found)
    assert all(row.keys() >= ROW for row in run.json["rows"])
    assert {row["verdict"] for row in run.json["rows"]} <= {"ok", "wrong", "missing"}
    assert run.json["ok"] + run.json["wrong"] + run.json["missing"] == len(run.json["rows"])


def test_a_paper_that_is_wrong_is_no_failure_of_ours(assur_cli, quick):
    run = assur_cli("audit", "zeng2019")
    assert run.code == 0
    assert "wrong E3" in run.out
    assert max(map(len, run.out.splitlines())) <= 80


def test_evidence_that_does_not_hold_exits_1(assur_cli, monkeypatch, found):
    first, *rest = found.errata
    broken = replace(first, evidence=replace(first.evidence, holds=False))
    monkeypatch.setattr("assur.cli.auditing.audit", lambda _: replace(found, errata=(broken, *rest)))
    run = assur_cli("audit", "zeng2019")
    assert run.code == 1
    assert "A claim of ours does not hold." in run.out
    assert assur_cli("audit", "zeng2019", "--json").code == 1


def test_documents_are_written(assur_cli, quick, found, tmp_path):
    folder = tmp_path / "a" / "b"
    run = assur_cli("audit", "zeng2019", "--documents", str(folder), "--json")
    assert run.code == 0
    assert {path.name: path.read_text() for path in folder.iterdir()} == dict(documents(found))


def test_other_dimensions_than_the_papers_are_refused(assur_cli):
    run = assur_cli("audit", "zeng2019", "--set", "l2=300")
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith("error: l2 = 300, and the reference data of zeng2019 are for l2 = 280\n")


def test_a_file_as_folder_is_refused_before_the_work(assur_cli, tmp_path):
    path = tmp_path / "file"
    path.write_text("old")
    run = assur_cli("audit", "zeng2019", "--documents", str(path))
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith(f"error: cannot make the folder {path}: ")
    assert path.read_text() == "old"
