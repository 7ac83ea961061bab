"""The section of stiffness says the numbers of the interface, and is left out where the file has no springs."""

from dataclasses import replace

import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.pose import pose_of
from assur.model.machine_data import MachineData
from assur.report.findings import Findings
from assur.report.sections.stiffness import stiffness
from assur.results.typeset_text import short


def test_numbers_are_those_of_the_interface():
    findings = Findings(assur.load("zeng2019"), illustrated=False)
    tables = {table.title: table for table in stiffness(findings).results[1:]}
    answer = findings.record.stiffness(pose_of(findings.record, findings.drawn_joints))
    principal = [row[0] for row in tables["Principal stiffness"].rows]
    assert principal == [short(float(size) / 1e6, 4) for size in answer.translational[0][0]]
    shares = answer.shares()
    assert dict(tables["What gives way"].rows)["link12"] == f"{shares.links['link12']:.1%}"
    assert dict(tables["Kinds of strain"].rows)["bending"] == f"{shares.kinds['bending']:.1%}"
    for title in ("What gives way", "Kinds of strain"):
        assert sum(float(share.rstrip("%")) for _, share in tables[title].rows) == pytest.approx(100.0, abs=1.0)
    frequencies = [row[1] for row in tables["Slowest natural vibrations"].rows]
    assert frequencies == [short(float(value), 4) for value in answer.vibrations().frequencies]


def test_without_springs_of_the_actuators_there_is_no_section():
    bare = replace(assur.load("fivebar"), machine=MachineData())
    with pytest.raises(UsageError, match="stiffness"):
        stiffness(Findings(bare, illustrated=False))
