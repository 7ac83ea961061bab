"""The report of any mechanism: without closed form, reference data or a search, with other dimensions, as text."""

import dataclasses
import re

import numpy as np
import pytest

import assur
from assur.kinematics.border import inputs_of
from assur.report.findings import Findings
from assur.report.render import page_html
from assur.report.report import SECTIONS, numbers_of, report_html, report_page
from assur.report.sections.reach import AGAINST, reach
from catalogue import each


def test_without_closed_form_and_reference_data(bare, read):
    assert read(bare).faults == []
    assert "only 1 of 2 can be chosen" in bare  # its pose has one coordinate too many, which a search does not answer
    assert "has no reference data to audit" in bare
    assert "does not apply" not in bare
    shown = re.findall(r"<h2>(.*?)<a", bare)
    assert shown == [title for title, _ in SECTIONS if title in shown]
    told = bare.partition("Sections that this report does not have")[2].partition("</dl>")[0]
    assert re.findall(r"<dt>(.*?)</dt>", told) == [title for title, _ in SECTIONS if title not in shown]
    assert "Audit of the source" not in shown


def test_without_closed_form_it_says_what_is_not_proved(fivebar_graph, without_right):
    found = Findings(fivebar_graph, resolution=12, illustrated=False)
    page = report_page(found)
    assert without_right(page) == []
    html = page_html(page)
    assert "No bounds are proved: fivebar has no closed form." in html
    assert "No region free of singularities is proved: fivebar has no closed form." in html
    told = {item.name: item for item in numbers_of(page)}
    assert told["workspace area"].known_by == "estimate: difference of two resolutions"
    count = told["real direct solutions"]
    assert (count.value, count.low, count.high) == (2, 2, None)
    assert "one by one" in count.known_by


def test_a_quaternion_has_no_cube_and_the_report_says_so():
    found = Findings(assur.load("gough_stewart"), resolution=8, illustrated=False)
    assert found.cube == "the orientation of its pose is a quaternion, about which no cube is looked for"


@pytest.mark.parametrize("name", ["planar_3rrr", "delta_4s"])
def test_an_estimate_by_solids_agrees_with_the_proved_bounds(name):
    found = Findings(assur.load(name), resolution=24, illustrated=False)
    section = reach(found)
    (_, solids) = section.results[:2]
    assert "proved bounds" in solids.note
    assert AGAINST not in str(section.results)


@pytest.mark.slow
def test_a_file_without_closed_form_has_its_solutions_from_the_joint_graph(delta, read):
    page = read(report_html(delta, figures=False))
    assert page.faults == []
    text = " ".join(page.words["p"].split())
    assert "found on the joint graph itself" in text
    assert {"Dexterity", "Singularities"} <= set(re.findall(r"\w+", page.words["h2"]))
    answer = delta.direct(inputs_of(delta, delta.home_values))
    assert f"Direct problem: {answer.right}." in text
    assert answer.complete
    rows = page.tables["Solutions of the direct problem"][1:]
    assert len(rows) == len(answer) > 1
    for (_, cells), item in zip(rows, answer, strict=True):
        assert np.allclose([float(cell.replace("−", "-")) for cell in cells[1:4]], item.pose, atol=1e-3)
    assert "The verdict" in page.words["h4"] or "The verdict" in page.words["h3"]
    assert "does not apply" not in text


# the paper's mechanism has its whole report in the tests beside this one
@pytest.mark.slow
@pytest.mark.parametrize("name", each(quick=["planar_3rrr", "gough_stewart"]))
def test_every_mechanism_has_its_report(name, read):
    found = report_html(assur.load(name), figures=False, resolution=8)
    page = read(found)
    assert page.faults == []
    assert re.findall(r"<h2>(.*?)<a", found) == [title for title, _ in SECTIONS]
    assert not re.search(r"<merror>|\bnan\b|\bNone\b|Infinity", found)
    text = " ".join(page.words["p"].split())
    assert "Direct problem: " in text
    assert "has no closed form" not in text
    assert len(page.tables["Solutions of the inverse problem"]) > 1
    assert len(page.tables["Factors and their geometric meaning"]) > 1


def test_with_other_dimensions(read):
    found = report_html(assur.load("fivebar", l1=120), figures=False, resolution=12)
    assert read(found).faults == []
    assert "set for this report" in found
    assert "--set l1=120" in found
    assert "reference data of fivebar are for l1 = 100" in found


def test_a_plane_mechanism_with_derived_reference_data(read):
    found = report_html(assur.load("fivebar"), figures=False, resolution=12)
    assert read(found).faults == []
    assert "workspace area" in found
    assert "x reference" in found
    assert " printed</th>" not in found


def test_what_a_user_writes_is_only_text(fourbar, read):
    nasty = '<script>alert("x")</script>'
    record = dataclasses.replace(
        fourbar,
        title=nasty,
        source=f'"><img src=x onerror=alert(1)> {nasty}',
        links={name: dataclasses.replace(link, meaning=nasty) for name, link in fourbar.links.items()},
    )
    found = report_html(record, figures=False)
    assert found.count("<script") == 2  # of the page itself
    assert "<img" not in found
    assert "&lt;script&gt;" in found
    assert read(found).faults == []
