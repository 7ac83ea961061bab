import csv
import re
import subprocess

import pytest

import assur
from assur.figures.labels import formula_text
from assur.report.findings import Findings
from assur.report.paper import DOCUMENT, LONGEST, table_csv, table_tex, write_paper
from assur.report.render import Page, page_html
from assur.report.sections.description import description
from assur.report.sections.position import position
from assur.report.sections.velocity import velocity
from assur.results.kinds import Section, Table


@pytest.fixture(scope="module")
def short():
    """A paper of two sections of the five-bar, with their figures."""
    findings = Findings(assur.load("fivebar"), resolution=12, illustrated=True)
    sections = (description(findings), position(findings), velocity(findings))
    return findings, Page("Five-bar: 50 % & more", "assur", "", sections)


@pytest.fixture(scope="module")
def folder(short, tmp_path_factory):
    folder = tmp_path_factory.mktemp("paper")
    write_paper(*short, folder)
    return folder


def compiled(folder):
    done = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", DOCUMENT],
        cwd=folder,
        capture_output=True,
        timeout=120,
        check=False,
    )
    said = done.stdout.decode("utf-8", "replace")
    assert done.returncode == 0, said[-2000:]
    return said


def test_what_the_document_includes_is_there_and_nothing_else(folder):
    document = (folder / DOCUMENT).read_text()
    inputs = set(re.findall(r"\\input\{([^}]+)\}", document))
    assert len(inputs) > 4
    files = {str(path.relative_to(folder).with_suffix("")) for path in folder.rglob("*.*")} - {"report"}
    assert inputs == files
    assert {path.suffix for path in (folder / "figures").iterdir()} == {".pdf", ".tex"}
    assert {path.suffix for path in (folder / "tables").iterdir()} == {".csv", ".tex"}


def test_it_has_nomenclature_numbered_equations_and_what_is_cited(folder):
    document = (folder / DOCUMENT).read_text()
    record = assur.load("fivebar")
    for name in (*record.parameters, *record.platform.pose):
        assert rf"\item[{formula_text(name)}]" in document
    assert "U+" not in document + "".join(path.read_text() for path in (folder / "tables").glob("*.tex"))
    assert r"\bibitem{assur}" in document
    assert r"Five-bar: 50 \% \& more" in document


@pytest.mark.latex
def test_pdflatex_sets_the_short_one(folder):
    said = compiled(folder)
    assert not [line for line in said.splitlines() if line.startswith("Overfull \\hbox")]
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.latex
def test_pdflatex_sets_a_whole_report_without_figures(findings, page, tmp_path):
    paths = write_paper(findings, page, tmp_path)
    assert paths[-1].name == DOCUMENT
    document = paths[-1].read_text()
    numbers = re.findall(r'id="equation-(\d+)"', page_html(page))
    assert document.count(r"\begin{equation}") == len(numbers) == int(numbers[-1]) > 100
    compiled(tmp_path)
    log = (tmp_path / "report.log").read_text("latin-1")
    assert not re.search(r"LaTeX Warning: (Reference|Citation|Float too large)", log)
    assert "U+" not in document + "".join(path.read_text() for path in (tmp_path / "tables").glob("*.tex"))


@pytest.mark.latex
@pytest.mark.deep
@pytest.mark.parametrize("name", ["zeng2019", "delta_4s", "three_rps"])
def test_pdflatex_sets_whole_reports_with_figures(name, tmp_path):
    from assur.report.report import report_page

    findings = Findings(assur.load(name), resolution=16, illustrated=True)
    write_paper(findings, report_page(findings), tmp_path)
    compiled(tmp_path)


def test_a_table_has_every_row_in_its_csv_and_the_first_in_print():
    rows = tuple((float(k), f"{k} % of_all", None) for k in range(LONGEST + 5))
    table = Table("t", ("k", "words, and more", "none"), rows)
    read = list(csv.reader(table_csv(table).splitlines()))
    assert read[0] == list(table.columns)
    assert [[float(row[0]), row[1], row[2]] for row in read[1:]] == [[row[0], row[1], ""] for row in rows]
    lines = [line for line in table_tex(table).splitlines() if "of" in line]
    assert len(lines) == LONGEST
    assert lines[2] == r"2 & 2 \% of\_all & -- \\"


def test_a_long_table_says_where_its_other_rows_are(short, tmp_path):
    table = Table("Many", ("a",), tuple((float(k),) for k in range(LONGEST + 3)))
    write_paper(short[0], Page("t", "", "", (Section("S", results=[table]),)), tmp_path)
    assert "3 further rows are in the file tables/00-many.csv." in (tmp_path / DOCUMENT).read_text()
