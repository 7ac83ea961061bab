import dataclasses
import functools
import io

import pytest

import assur
from assur.cli import demo_documents
from assur.cli.claims import Ledger
from assur.cli.demonstration import MECHANISM
from assur.cli.options import PLAIN
from assur.figures import catalogue
from assur.report import findings, report


@pytest.fixture
def short(monkeypatch):
    """The demonstration without its slow parts."""
    for name in ("demo_analysis.singularities", "demo_analysis.workspace", "demo_documents.audit"):
        monkeypatch.setattr(f"assur.cli.{name}", lambda *_: None)
    for name in ("figures", "report", "page"):
        monkeypatch.setattr(f"assur.cli.demo_documents.{name}", lambda *_: [])


def test_its_mechanism_is_there():
    assert MECHANISM in assur.names()


@pytest.fixture
def small(monkeypatch):
    """The demonstration with all of its parts, but few nodes, two figures and a report of two sections."""
    monkeypatch.setattr(findings, "Findings", functools.partial(findings.Findings, resolution=16, illustrated=False))
    monkeypatch.setattr(catalogue, "ENTRIES", catalogue.ENTRIES[:2])
    monkeypatch.setattr(report, "ANALYSES", ())
    monkeypatch.setattr(report, "SECTIONS", report.SECTIONS[:2])


def told(run, folder):
    """What is said of every part, and that its files are there."""
    assert run.code == 0
    assert all(": still at work after 20 s" in line for line in run.err.splitlines())
    assert "\N{BALLOT X}" not in run.out
    assert "\x1b" not in run.out
    assert max(map(len, run.out.splitlines())) <= 80
    total = run.out.count("\N{CHECK MARK}")
    assert f"{total} claims checked, all hold" in run.out
    solved = ("Topology", "Direct", "Inverse", "Velocity", "Singular", "Workspace")
    for part in (*solved, "Audit", "Figures", "Report", "Page"):
        assert f"\n{part}" in run.out
    for name in ("report.html", "page.html"):
        assert (folder / name).is_file()
        assert f"{name}: " in run.out


def test_every_part_of_it(assur_cli, small, tmp_path):
    told(assur_cli("demo", "-o", str(tmp_path)), tmp_path)
    assert sorted(path.name for path in (tmp_path / "figures").glob("*.png")) == ["model.png", "structure.png"]


@pytest.mark.deep
def test_all_of_it(assur_process, tmp_path):
    told(assur_process("demo", "-o", str(tmp_path / "out")), tmp_path / "out")
    assert len(list((tmp_path / "out" / "figures").glob("*.png"))) >= 9


def test_each_claim_is_in_the_json_with_what_was_found(assur_cli, short, tmp_path):
    run = assur_cli("demo", "-o", str(tmp_path), "--json")
    assert (run.code, run.err) == (0, "")
    assert run.json.keys() == {"mechanism", "claims", "failed", "files", "seconds"}
    assert all(claim.keys() == {"section", "claim", "holds", "found"} for claim in run.json["claims"])
    assert len(run.json["claims"]) >= 8
    assert run.json["failed"] == 0


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("assur.cli.demo_position.BACK", 0.0, "gives the inputs back"),
        ("assur.cli.demo_analysis.ROUNDING", -1.0, "derivative of the inverse problem"),
    ],
)
def test_a_claim_that_fails_exits_1_and_is_named(assur_cli, short, tmp_path, monkeypatch, name, value, words):
    monkeypatch.setattr(name, value)
    run = assur_cli("demo", "-o", str(tmp_path))
    assert run.code == 1
    assert "\N{BALLOT X}" in run.out
    assert " FAIL; " in run.out
    assert words in " ".join(run.out.rpartition(" FAIL; ")[2].split())
    data = assur_cli("demo", "-o", str(tmp_path), "--json")
    assert (data.code, data.json["failed"] > 0) == (1, True)


def test_a_wrong_jacobian_is_found(assur_cli, short, tmp_path, monkeypatch):
    from assur.kinematics.rates.velocity import velocity_map

    def wrong(record, poses, mode=None):
        here = velocity_map(record, poses, mode)
        return dataclasses.replace(here, jp=here.jp * 1.00001)

    monkeypatch.setattr("assur.kinematics.rates.velocity.velocity_map", wrong)
    run = assur_cli("demo", "-o", str(tmp_path), "--json")
    failed = {claim["claim"] for claim in run.json["claims"] if not claim["holds"]}
    assert run.code == 1
    assert "Jq^-1 Jp is the derivative of the inverse problem" in failed


def test_a_folder_that_cannot_be_made_is_refused_before_the_work(assur_cli, tmp_path):
    path = tmp_path / "file"
    path.write_text("old")
    run = assur_cli("demo", "-o", str(path))
    assert (run.code, run.out) == (2, "")
    assert path.read_text() == "old"


def test_a_silent_ledger_prints_nothing(capsys):
    ledger = Ledger(silent=True)
    ledger.section("a")
    ledger.show(["b"])
    ledger.claim("c", False, "d")
    assert capsys.readouterr().out == ""
    assert (ledger.failed, ledger.claims[0].section) == (1, "a")


@pytest.mark.parametrize(
    ("encoding", "marks"), [("utf-8", ["\N{CHECK MARK}", "\N{BALLOT X}"]), ("ascii", ["ok", "FAILS"])]
)
def test_marks_are_words_where_the_output_has_no_signs(monkeypatch, encoding, marks):
    stream = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    monkeypatch.setattr("sys.stdout", stream)
    ledger = Ledger(silent=False)
    ledger.claim("this", True, "1")
    ledger.claim("that", False, "2")
    stream.flush()
    text = stream.buffer.getvalue().decode(encoding)
    assert [line.split()[0] for line in text.splitlines()] == marks


def test_a_gap_in_a_loop_is_found(assur_cli, short, tmp_path, monkeypatch):
    monkeypatch.setattr(
        "assur.kinematics.answers.solution_set.closure_error", lambda _, values: 1e-3 + 0 * values[:, 0]
    )
    run = assur_cli("demo", "-o", str(tmp_path), "--json")
    failed = [claim["claim"] for claim in run.json["claims"] if not claim["holds"]]
    assert run.code == 1
    assert failed.count("every solution closes every loop of the joint graph") == 2
    assert run.json["files"] == []  # what stands on solutions is left out


@pytest.mark.parametrize(
    ("name", "value", "claim"), [("MOST", 1e3, "under 1 MB"), ("ROUNDING", -1.0, "the poses of the closed form")]
)
def test_a_page_that_is_too_large_or_stands_elsewhere_is_found(monkeypatch, tmp_path, name, value, claim):
    ledger, record = Ledger(silent=True), assur.load("fivebar")
    demo_documents.page(ledger, record, tmp_path / "page.html", PLAIN)
    assert (len(ledger.claims), ledger.failed) == (2, 0)
    monkeypatch.setattr(demo_documents, name, value)
    demo_documents.page(ledger, record, tmp_path / "page.html", PLAIN)
    assert [claim in item.claim for item in ledger.claims if not item.holds] == [True]


def test_the_lines_after_it_can_be_typed(assur_cli, short, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run = assur_cli("demo", "-o", "out")
    typed = run.out.strip().splitlines()[-1].split()
    assert typed[0] == "assur"
    for _ in range(3):  # new, check, page: each says the next
        run = assur_cli(*typed[1:])
        assert run.code == 0
        typed = run.out.strip().splitlines()[-1].removeprefix("next: ").split()
    assert (tmp_path / "page.html").is_file()
