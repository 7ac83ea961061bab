from assur.report.units import extent_unit
from assur.workspace.region import unit


def test_units_are_those_of_the_workspace(findings):
    record = findings.record
    assert extent_unit(record, ("x", "y", "z")) == unit(record, ("x", "y", "z")).replace("^3", "³") == "mm³"
