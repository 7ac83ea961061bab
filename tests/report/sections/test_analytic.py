"""The analytic solution in a report: a section a problem, every formula as mathematics; none where none is derived."""

import pytest

from assur.derivation.solution import analytic_solution
from assur.model.registry import load_record
from assur.report.sections import analytic
from assur.report.sections.analytic import analytic_solutions
from assur.results.kinds import Facts, Formulas, PrintedFormula, Section


def test_both_problems_have_their_reasons_and_their_sets():
    (section,) = analytic_solutions(load_record("zeng2019"))
    direct, inverse, velocities = section.results
    assert "det Jp, the determinant of the left side, vanishes where" in velocities.caption
    assert "link 12 and parallelogram $" in velocities.caption
    assert direct.text.startswith("There are 8 branches; each closes every loop")
    assert inverse.text.startswith("There are 32 branches")
    reasons, *sets = direct.results
    assert isinstance(reasons, Facts)
    assert "link11 hangs on base" in reasons.items[0][1]
    assert [own.title for own in sets] == [
        "Set 1: link 9 and link 10", "Set 2: link 4a", "Set 3: link 12 and link 7a", "The pose"
    ]  # fmt: skip
    assert r"$H_{1} \ne 0$" in sets[0].caption


def test_every_formula_is_mathematics():
    for name in ("zeng2019", "delta_4s"):
        (section,) = analytic_solutions(load_record(name))
        lines = [
            line
            for part in section.results[:2]
            for own in part.results
            if isinstance(own, Formulas)
            for line in own.lines
        ]
        assert len(lines) > 40
        assert not [line.mathml for line in lines if "merror" in line.mathml]


def test_what_is_not_derived_has_no_section():
    assert [*analytic_solutions(load_record("three_upu"))] == []


@pytest.mark.parametrize("name", ["gough_stewart", pytest.param("three_rrrp4r", marks=pytest.mark.deep)])
def test_where_one_problem_is_derived_the_section_is_of_that_one(name):
    (section,) = analytic_solutions(load_record(name))
    assert section.results[0].title == "The inverse problem by formulas"


def test_a_second_report_reads_what_the_first_one_derived(tmp_path, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path))
    parts = [Facts("Links", (("1", "link 2"),)), Formulas("Set 1", (PrintedFormula("<math>x</math>"),), "where")]
    calls = []

    def derived(record):
        calls.append(dict(record.overrides))
        yield Section("Analytic solution", "of 2 branches", [Section("Direct", "", parts)])

    monkeypatch.setattr(analytic, "_sections", derived)
    (section,) = derived(load_record("fivebar"))
    assert [[*analytic_solutions(load_record("fivebar"))] for _ in range(2)] == [[section]] * 2
    assert [*analytic_solutions(load_record("fivebar", l1=0.5))] == [section]
    assert calls == [{}, {}, {"l1": 0.5}]


def test_a_report_says_what_it_did_not_wait_for(monkeypatch):
    """Given up is not the same as not derived; and only what a report asks for is given up."""
    record = load_record("fivebar", l1=0.51)
    monkeypatch.setattr(analytic, "SECONDS", 0)
    (section,) = analytic._sections(record)
    assert "direct and the inverse problem is not known" in section.text
    assert section.results == []
    assert analytic_solution(record, "direct").branches == 2
