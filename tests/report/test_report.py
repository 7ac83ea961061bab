"""The report as a whole: one file, well formed, nothing from outside, the same every time, and true."""

import dataclasses
import itertools
import re
from html import escape

import numpy as np
import pytest
from matplotlib.figure import Figure

import assur
from assur.errors import OutputError
from assur.figures import catalogue as figures
from assur.report.findings import Findings
from assur.report.render import page_html
from assur.report.report import SECTIONS, numbers_of, report_html, report_page, write_report
from assur.report.sections.reach import AGAINST
from assur.report.sections.summary import NUMBERS
from assur.results.kinds import Scalar, Section, Table
from assur.workspace.certified.proving import prove_box

OUTSIDE = re.compile(r"url\(|@import|<script\b[^>]*\s[^>]*>|<link|<iframe|<object|\bsrcset=|javascript:", re.IGNORECASE)


# ---- one file ----------------------------------------------------------------------------------------------


def test_tags_are_closed_in_order(document):
    assert document.faults == []
    assert sum(tag == "h1" for tag, _ in document.tags) == 1


def test_nothing_is_loaded_from_outside(html, document):
    assert OUTSIDE.findall(html) == []
    for tag, attributes in document.tags:
        for name in ("src", "href", "action", "data", "poster", "xlink:href"):
            value = attributes.get(name)
            if value and not value.startswith(("#", "data:image/png;base64,")):
                assert (tag, name) == ("a", "href"), value
                assert value.startswith("https://arxiv.org/abs/")


def test_every_link_inside_leads_somewhere_and_ids_are_unique(document):
    ids = [attributes["id"] for _, attributes in document.tags if "id" in attributes]
    assert len(ids) == len(set(ids))
    links = {
        attributes["href"][1:] for _, attributes in document.tags if (attributes.get("href") or "").startswith("#")
    }
    assert links
    assert links <= set(ids)


def test_headings_skip_no_level(document):
    levels = [int(tag[1]) for tag, _ in document.tags if re.fullmatch(r"h[1-6]", tag)]
    assert levels[0] == 1
    assert all(after <= before + 1 for before, after in itertools.pairwise(levels))


def test_tables_and_pictures_say_what_they_are(document):
    tables = sum(tag == "table" for tag, _ in document.tags)
    captions = sum(tag == "caption" for tag, _ in document.tags)
    assert tables == captions > 10
    assert all(attributes.get("scope") for tag, attributes in document.tags if tag == "th")


def test_sections_come_in_order(html):
    found = re.findall(r"<h2>(.*?)<a", html)
    assert found == [title for title, _ in SECTIONS]


def test_every_section_applies_to_the_papers_mechanism(html):
    assert "does not apply" not in html


# ---- true --------------------------------------------------------------------------------------------------


def test_counts_of_the_audit(findings, document):
    audit = findings.audit
    marks = [mark for mark, _ in document.tables["Every row"][1:]]
    assert {name: marks.count(name) for name in ("ok", "wrong", "missing")} == {
        "ok": audit.ok,
        "wrong": audit.wrong,
        "missing": audit.missing,
    }
    assert len(marks) == len(audit.rows) > 80
    assert audit.wrong > 0
    assert len(document.tables["Rows that do not agree"]) - 1 == audit.wrong + audit.missing


def test_every_verdict_stands_in_words(findings, document):
    column = document.tables["Every row"][0][1].index("verdict")
    for row, (mark, cells) in zip(findings.audit.rows, document.tables["Every row"][1:], strict=True):
        assert cells[column].split(",")[0] == row.verdict == mark
        assert row.erratum in cells[column]


def test_every_erratum_stands_there_with_its_evidence(findings, html):
    plain = " ".join(re.sub(r"<a[^>]*>|</a>", "", html).split())
    assert findings.audit.errata
    for item in findings.audit.errata:
        assert f"<h4>{escape(item.id)} · {escape(item.where)}</h4>" in plain
        assert " ".join(escape(item.evidence.text).split()) in plain


@pytest.mark.parametrize("problem", ["direct", "inverse"])
def test_solutions_are_those_of_the_interface(problem, findings, document):
    answer = getattr(findings, problem)
    rows = document.tables[f"Solutions of the {problem} problem"][1:]
    assert [cells[0] for _, cells in rows] == [item.mode for item in answer]
    for (_, cells), item in zip(rows, answer, strict=True):
        shown = [float(text.replace("−", "-")) for text in cells[1:4]]
        values = item.pose if problem == "direct" else item.inputs
        assert np.allclose(shown, values, rtol=0, atol=0.5e-4)


def test_printed_digits_stand_as_printed(findings, document):
    for entry in (*findings.reference.entries["direct"], *findings.reference.entries["inverse"]):
        lines = {cells[0]: cells for _, cells in document.tables[f"{entry.source}, printed and computed"]}
        for row in entry.rows:
            assert [text.replace("−", "-") for text in lines[f"row {row.row}"][1:7:2]] == [
                item.text for item in row.values
            ]


def test_every_number_says_by_what_right_it_is_known(page, results_of, without_right):
    assert len(list(results_of(page, Scalar))) > 25
    assert sum("area" in " ".join(table.columns) for table in results_of(page, Table)) == 3
    assert without_right(page) == []


def test_a_number_without_a_right_is_found(page, without_right):
    bare = dataclasses.replace(
        page, sections=(Section("S", results=[Scalar("volume", 1.0), Table("T", ("area [mm²]",), (("1",),))]),)
    )
    assert without_right(bare) == ["volume", "T"]


def test_the_volume_is_that_of_the_workspace(findings, html, page):
    shown = re.search(r"<dt>volume by solids</dt><dd><span class=\"value\">([^<]*)</span>", html)[1]
    number = float(shown.replace("\u202f", ""))
    assert abs(number - findings.workspace.volume) <= 0.05 * findings.workspace.volume_error
    low, high = (float(text) for text in workspace_bounds_shown(html))
    assert low <= findings.bounds.volume[0] < findings.bounds.volume[1] <= high
    assert low < 22_814_586.4 < high < 1.0002 * low  # 500 mm times the area by quadrature of the two circles
    (told,) = [item for item in numbers_of(page) if item.name == "workspace volume"]
    assert (told.low, told.high) == findings.bounds.volume
    assert told.known_by == "proved by interval arithmetic"


def workspace_bounds_shown(html):
    shown = re.search(r"<dt>workspace volume</dt><dd><span class=\"value\">([^<]*)</span>", html)[1]
    return shown.replace("\u202f", "").split(" to ")


def test_the_papers_four_sections_have_proved_bounds(findings, document):
    rows = document.tables["Sections across z"][1:]
    assert len(rows) == len(findings.record.sections) == 4
    for (_, cells), item in zip(rows, findings.workspace.sections, strict=True):
        low, high = (float(text) for text in cells[2].replace("\u202f", "").split(" to "))
        area, error = (float(text) for text in f"{cells[1]} ± 0".replace("\u202f", "").split(" ± ")[:2])
        assert float(cells[0].split()[0]) == item.value
        assert low - error <= area <= high + error
        assert 0 < high - low < 1e-4 * low
        assert "proved bounds" in cells[3]
        assert AGAINST not in cells[3]


def test_the_solutions_are_proved_and_that_there_is_no_other(findings, page, document):
    text = " ".join(document.words["p"].split())
    assert "Proved: 4 solutions and no other" in text
    assert "Proved: 8 solutions and no other" in text
    told = {item.name: item for item in numbers_of(page)}
    for problem, count in (("direct", 4), ("inverse", 8)):
        item = told[f"real {problem} solutions"]
        assert item.value == item.low == item.high == count == len(findings.proved[problem])


def test_the_largest_cube_is_reached_and_regular(findings, page):
    (told,) = [item for item in numbers_of(page) if item.name.startswith("edge of the largest")]
    assert 0 < told.low <= told.high <= 1.02 * told.low
    centre = findings.solution.pose
    box = {name: (value - 0.49 * told.low, value + 0.49 * told.low) for name, value in zip("xyz", centre, strict=True)}
    assert prove_box(findings.record, box, mode=findings.solution.working_mode).status == "proved"


# ---- the same every time ----------------------------------------------------------------------------------


def test_the_same_bytes_every_time(findings, html, bare, fourbar):
    assert page_html(report_page(findings)) == html
    assert report_html(fourbar, figures=False) == bare
    fresh = [report_html(assur.load("fivebar"), figures=False, resolution=12) for _ in range(2)]
    assert fresh[0] == fresh[1]


def test_no_date_and_no_place_of_this_machine(html, findings):
    assert str(findings.record.file.parent) not in html
    assert re.findall(r"20\d\d-\d\d-\d\d", html) == []


# ---- figures -----------------------------------------------------------------------------------------------


def test_every_figure_is_there(findings, read, monkeypatch):
    """Drawing is tested with the figures; here each is a small empty one."""
    monkeypatch.setattr(figures, "draw", lambda *_: Figure(figsize=(1, 1)))
    drawn = Findings(findings.record, resolution=findings.resolution, illustrated=True)
    for name in ("audit", "workspace", "examples", "proved", "bounds", "cube"):  # as computed before
        drawn.__dict__[name] = getattr(findings, name)
    page = read(page_html(report_page(drawn)))
    shown = {attributes["id"] for tag, attributes in page.tags if tag == "figure" and "id" in attributes}
    names = figures.names(findings.record, drawn)
    assert len(names) > 10
    assert shown == {f"figure-{name}" for name in names}
    pictures = [attributes for tag, attributes in page.tags if tag == "img"]
    assert all(picture["alt"] and picture["src"].startswith("data:image/png;base64,") for picture in pictures)
    assert "$" not in page.words["figcaption"]
    numbers = re.findall(r"Figure (\d+)\. ", page.words["figcaption"])
    assert numbers == [str(k) for k in range(1, len(names) + 1)]
    own = re.findall(r"Compare Figure (\w+) of the source\.", page.words["figcaption"])
    assert sorted(own) == sorted(drawn.companion.numbers.values())


def test_a_column_in_which_nothing_stands_is_left_out(document):
    for rows in document.tables.values():
        for column in zip(*(cells for _, cells in rows[1:]), strict=True):
            assert any(column)


# ---- writing -----------------------------------------------------------------------------------------------


def test_writing_reports_every_step(fourbar, tmp_path):
    steps = []
    path = tmp_path / "report.html"
    write_report(fourbar, path, lambda done, total: steps.append((done, total)), figures=False)
    total = steps[-1][1]
    assert steps == [(done, total) for done in range(1, total + 1)]
    assert path.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")


def test_a_path_that_cannot_be_written_keeps_the_old_file(fourbar, tmp_path, monkeypatch):
    path = tmp_path / "report.html"
    path.write_text("old")
    (tmp_path / "folder").mkdir()
    for bad in (tmp_path / "folder", tmp_path / "nowhere" / "report.html"):
        with pytest.raises(OutputError):
            write_report(fourbar, bad, figures=False)

    def full(self, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    with pytest.raises(OutputError):
        write_report(fourbar, path, figures=False)
    assert path.read_text() == "old"
    assert sorted(item.name for item in tmp_path.iterdir()) == ["folder", "report.html"]


@pytest.mark.browser
def test_the_first_screen_has_the_numbers_and_what_is_proved(browser, html):
    page = browser.new_page(viewport={"width": 1440, "height": 900})
    page.set_content(html)
    tiles = page.locator("#in-brief .scalars > div")
    assert tiles.count() == NUMBERS
    assert page.locator("#in-brief").bounding_box()["y"] < 300
    for name in ("real direct solutions", "workspace volume", "audit of the source"):
        box = page.locator("#in-brief .facts dt", has_text=name).bounding_box()
        assert box["y"] + box["height"] < 900
    known = tiles.nth(1).locator("details")
    assert not known.evaluate("part => part.open")
    known.locator("summary").click()
    assert "these and no other" in known.inner_text()
    page.close()
