"""What is called all is held against assemblies that are met from home and by chance."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics import assemblies
from assur.kinematics.border import inputs_of
from assur.kinematics.home import home_values
from assur.kinematics.loops.loops import solve_by_loops
from assur.kinematics.monodromy import assemblies_by_monodromy
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.model.registry import load_record


@pytest.mark.parametrize("left", [0, 1])
def test_a_proof_that_leaves_assemblies_out_is_none(left, monkeypatch):
    """As if an error in a proof left all of them out, or all but one: the answer is that of a search then."""
    record = load_record("planar_3rrr").without_closed_form
    inputs = inputs_of(record, home_values(record))
    whole = solve_by_loops(record, inputs)
    assert not assemblies._missed(record, "direct", inputs, whole)
    home = np.argmin(np.max(np.abs(whole.joints - home_values(record)), axis=1))  # which is met always
    part = replace(whole, joints=np.delete(whole.joints, home, axis=0)[:left])
    assert assemblies._missed(record, "direct", inputs, part)
    monkeypatch.setattr(assemblies, "_known", lambda *_: part)
    monkeypatch.setattr(assemblies_by_monodromy, "solved_by_monodromy", lambda *_: None)
    answer = assemblies.assemblies(record, "direct", inputs, "", "auto", crossed=False)
    assert not answer.complete
    assert "an assembly that was met by chance is none of these" in answer.right
    assert len(answer.joints) == len(whole.joints)


@pytest.mark.deep
@pytest.mark.parametrize("problem", ["direct", "inverse"])
@pytest.mark.parametrize("name", assur.names())
def test_both_problems_of_every_mechanism_of_the_catalogue_are_complete_without_a_search(name, problem):
    """As the page on kinematics says; near home, which may be singular."""
    record = load_record(name)
    home = home_values(record)
    given = np.array(inputs_of(record, home) if problem == "direct" else pose_of(record, home)) * 1.001 + 1e-3
    solve = direct if problem == "direct" else inverse
    assert solve(record, given, method="loops").complete
