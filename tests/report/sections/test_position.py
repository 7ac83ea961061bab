"""Names of modes in the report: the file's quantities, and the signs of the joint graph with their letters."""

from assur.kinematics.naming import described_signs
from assur.model.registry import load_record
from assur.report.findings import Findings
from assur.report.sections.position import position
from assur.report.sections.solutions import solutions
from assur.results.kinds import Table


def tables(name):
    found = position(Findings(load_record(name), resolution=8, illustrated=False))
    return {part.title: part for part in found.results if isinstance(part, Table)}


def test_one_table_says_what_each_sign_of_the_joint_graph_means():
    """Working modes of the planar 3-RPR are named by its joint graph, assembly modes by a quantity of its file."""
    record = load_record("planar_3rpr")
    shown = tables("planar_3rpr")["Signs of the joint graph"]
    signs = described_signs(record, "inverse")
    assert shown.columns == ("mode", "letter", "sign", "+ where")
    assert [(row[0], *row[2:]) for row in shown.rows] == [("working", sign.name, sign.meaning) for sign in signs]
    assert all(sign.letter[0] in row[1].mathml for sign, row in zip(signs, shown.rows, strict=True))
    assert len(tables("planar_3rpr")["Names of modes"].rows) == 1


def test_what_the_table_says_is_not_said_again_beside_solutions():
    findings = Findings(load_record("planar_3rpr"), resolution=8, illustrated=False)
    assert " is + where" not in solutions(findings, "inverse")[0].caption


def test_modes_that_the_file_names_need_no_such_table():
    assert {*tables("fivebar")} == {"Names of modes"}
