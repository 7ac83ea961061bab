"""The section of forces says the numbers of the interface, and is left out where the file has no masses."""

from dataclasses import replace

import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.pose import pose_of
from assur.model.machine_data import MachineData
from assur.report.findings import Findings
from assur.report.sections.forces import forces
from assur.results.kinds import Scalar, Table
from assur.results.typeset_text import short


def test_numbers_are_those_of_the_interface():
    findings = Findings(assur.load("zeng2019"), illustrated=False)
    section = forces(findings)
    answer = findings.record.forces(pose_of(findings.record, findings.drawn_joints))
    tables = {item.title: item for item in section.results if isinstance(item, Table)}
    scalars = {item.name: item for item in section.results if isinstance(item, Scalar)}
    assert [row[1] for row in tables["Actuators at rest"].rows] == [short(float(x), 4) for x in answer.forces[0]]
    assert scalars["stresses that balance themselves"].value == 10
    assert scalars["total mass"].value == pytest.approx(sum(float(row[1]) for row in tables["Masses"].rows), rel=1e-3)
    starred = {row[0] for row in tables["Joints at rest"].rows if any("*" in str(cell) for cell in row[1:4])}
    assert starred == {item.name for item in findings.record.joints.values()} - {"P3", "D1", "D2"}


def test_without_masses_there_is_no_section():
    bare = replace(assur.load("fivebar"), machine=MachineData())
    with pytest.raises(UsageError, match="no mass of crank1"):
        forces(Findings(bare, illustrated=False))
