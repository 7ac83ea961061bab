"""The section of accuracy says the numbers of the interface; sums and proofs where the file has tolerances."""

from dataclasses import replace

import assur
from assur.kinematics.pose import pose_of
from assur.model.machine_data import Tolerance
from assur.report.findings import Findings
from assur.report.sections.accuracy import accuracy
from assur.results.kinds import Scalar, Table
from assur.results.typeset_text import short


def test_sensitivities_of_dimensions_come_before_those_of_their_copies():
    findings = Findings(assur.load("orthoglide"), illustrated=False)
    whole, copies = accuracy(findings).results
    rows = {row[0]: row for row in (*whole.rows, *copies.rows)}
    own = findings.record.errors(pose_of(findings.record, findings.drawn_joints))
    assert rows["L"][2:5] == tuple(short(float(value), 4) for value in own.sensitivity["L"][:3])
    assert "leg1.rod_a.L*" in rows
    assert "*: alone it does not assemble" in copies.caption
    assert rows["q1"][1] == "mm"


def test_tolerances_are_summed_and_bounds_proved():
    record = assur.load("fivebar")
    machine = replace(record.machine, tolerances={"l1": Tolerance(0.05, 0.01)})
    findings = Findings(replace(record, machine=machine), illustrated=False)
    *tables, x, y = accuracy(findings).results
    assert isinstance(x, Scalar)
    assert isinstance(tables[-1], Table)
    worst = tables[-1].rows[0]
    place = pose_of(record, findings.drawn_joints)
    for bounds, centre, own in zip((x, y), place, worst[1:3], strict=True):
        assert bounds.low <= centre - 0.99 * float(own)
        assert centre + 0.99 * float(own) <= bounds.high
