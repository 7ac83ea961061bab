"""Tables of solutions in the report: limits that they exceed, and what tells solutions of one pose apart."""

import dataclasses

from assur.model.registry import load_record
from assur.report.findings import Findings
from assur.report.sections.solutions import solutions


def tables(record, problem):
    return solutions(Findings(record, resolution=8, illustrated=False), problem)


def test_limits_that_a_solution_exceeds_stand_in_its_row():
    """The legs of the report's configuration are 380, 390 and 400 mm long; strokes end at 200 mm."""
    record = load_record("three_rps")
    inputs = tuple(dataclasses.replace(item, stroke=(100.0, 200.0)) for item in record.inputs)
    shown = tables(dataclasses.replace(record, inputs=inputs), "direct")[0]
    assert shown.columns[-1] == "limits"
    outside = "stroke of rho1: by 180 mm; stroke of rho2: by 190 mm; stroke of rho3: by 200 mm"
    assert {row[-1] for row in shown.rows} == {outside}
    assert "No limits are stated" not in shown.caption


def test_solutions_within_the_limits_say_so():
    record = load_record("three_rps")
    inputs = tuple(dataclasses.replace(item, stroke=(100.0, 500.0)) for item in record.inputs)
    assert {row[-1] for row in tables(dataclasses.replace(record, inputs=inputs), "direct")[0].rows} == {"within"}


def test_where_none_are_stated_the_caption_says_so():
    (shown,) = tables(load_record("fivebar"), "direct")
    assert "limits" not in shown.columns
    assert "No limits are stated." in shown.caption


def test_what_the_pose_leaves_out_stands_beside_every_solution():
    shown, rest = tables(load_record("three_rps"), "direct")
    assert [row[0] for row in rest.rows] == [row[0] for row in shown.rows]
    assert [title.partition(" ")[0] for title in rest.columns] == ["mode", "x", "y", "phi"]
