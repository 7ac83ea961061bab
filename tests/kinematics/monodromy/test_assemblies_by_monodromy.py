"""All assemblies by loops of complex inputs: as many as eliminations count, from one; parts of them have no trace."""

import re

import numpy as np
import pytest

from assur.cli.main import main
from assur.errors import Interrupted
from assur.joint_graph.state import state_of
from assur.kinematics import assemblies
from assur.kinematics.border import inputs_of
from assur.kinematics.configurations import distinct
from assur.kinematics.home import home_values
from assur.kinematics.loops.loops import LoopSolutions, solve_by_loops
from assur.kinematics.monodromy import assemblies_by_monodromy as module
from assur.kinematics.monodromy.assemblies_by_monodromy import assemblies_by_monodromy, solved_by_monodromy
from assur.kinematics.monodromy.complex_loops import ComplexLoops
from assur.kinematics.platforms.inverse import inverse_by_limbs
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct
from assur.model.registry import load_record
from catalogue import each

COUNTS = {"fivebar": 2, "planar_3rpr": 6, "planar_3rrr": 6, "three_rps": 8}


@pytest.mark.parametrize("name", each(COUNTS, ["fivebar", "planar_3rpr"]))
def test_from_one_assembly_all_others(name):
    """Counts are those of the loops' eliminations; three_rps has as many again, mirrored, which no loop leads to."""
    record = load_record(name)
    home = home_values(record)
    change = 0.03 * np.arange(1, len(record.inputs) + 1)
    inputs = inputs_of(record, home) * (1 + change)
    known = solve_by_loops(record, inputs)
    assert known.complete
    held = known.joints[0][list(record.input_indices)]
    solutions = assemblies_by_monodromy(record, "direct", held, known.joints[:1])
    assert solutions.complete
    assert solutions.complex == COUNTS[name]
    together = np.concatenate([known.joints, solutions.joints])
    assert len(distinct(record, together)) == len(known.joints)
    assert len(solutions.joints) == len(known.joints)


@pytest.mark.parametrize("name", each(["fivebar", "planar_3rrr"], ["fivebar"]))
def test_at_a_pose_all_working_modes(name):
    """Those of the limbs, each alone; angles of the pose are known by their tangents, so that others come in too."""
    record = load_record(name)
    pose = pose_of(record, home_values(record)) + 0.05 * np.arange(1, len(record.platform.pose) + 1)
    expected = inverse_by_limbs(record, pose)
    assert expected.complete
    solutions = solved_by_monodromy(record, "inverse", pose, expected.joints[:1])
    assert solutions is not None
    assert len(solutions.joints) == len(expected.joints)
    assert len(distinct(record, np.concatenate([solutions.joints, expected.joints]))) == len(expected.joints)
    assert "loops of complex poses" in solutions.right


def test_a_part_of_all_has_no_trace():
    record = load_record("planar_3rpr")
    inputs = inputs_of(record, home_values(record))
    joints = solve_by_loops(record, inputs).joints
    loops = ComplexLoops(record, "direct", inputs, np.array([0.5 + 0.3j, -0.2 + 0.6j, 0.4 - 0.5j]))
    rng = np.random.default_rng(0)
    state = state_of(record, joints.T).astype(complex)
    zero = np.zeros(len(joints), dtype=complex)
    base = 0.6 + 0.7j
    led = module._led(loops, state, zero, zero + base)
    for _ in range(4):
        led = module._round_loops(loops, led, base, rng)
    assert led.shape[1] == 6
    assert module._trace_degree(loops, led, base, rng, thorough=True) is not None
    for count in (1, 3, 5):
        assert module._trace_degree(loops, led[:, :count], base, rng, thorough=True) is None


@pytest.mark.deep
@pytest.mark.parametrize(("name", "count", "degree"), [("planar_3rpr", 6, 5), ("planar_3rrr", 6, 18)])
@pytest.mark.parametrize("seed", range(4))
def test_the_degree_of_the_trace_does_not_hang_on_chance(name, count, degree, seed):
    record = load_record(name)
    home = home_values(record)
    solutions = assemblies_by_monodromy(record, "direct", inputs_of(record, home), home[None], seed)
    assert (solutions.complex, solutions.degree) == (count, degree)


@pytest.mark.deep
@pytest.mark.parametrize("seed", [0, 3, 7])
def test_assemblies_that_few_loops_lead_to_are_not_left_out_unsaid(seed, tmp_path):
    """Of a six-bar's eighteen: round some places loops lead to 12, 16 or 17 of them only, whose sum looks smooth."""
    path = tmp_path / "own.toml"
    main(["new", str(path), "--chain", "{R[z] R[z] | R[z] R[z]} R[z]", "--chain", "R[z] R[z]"])
    record = load_record(path)
    home = home_values(record)
    solutions = assemblies_by_monodromy(record, "inverse", pose_of(record, home), home[None], seed)
    assert (solutions.complex, solutions.degree) == (18, 1) or not solutions.complete


@pytest.fixture
def unrecognised(monkeypatch):
    """As if neither loops nor limbs said anything."""
    nothing = LoopSolutions(np.zeros((0, 9)), False, "not proved", 0)
    monkeypatch.setattr(assemblies, "solve_by_loops", lambda *_, **__: nothing)
    monkeypatch.setattr(assemblies, "direct_by_conditions", lambda *_, **__: nothing)


def _assembled(record, inputs):
    """The direct problem on the joint graph, past the closed form."""
    return assemblies.assemblies(record, "direct", inputs, "", "auto", crossed=False)


def test_the_answer_says_by_what_right(unrecognised):
    record = load_record("planar_3rrr")
    inputs = inputs_of(record, home_values(record)) + np.array([0.05, -0.02, 0.03])
    answer = _assembled(record, inputs)
    assert answer.complete
    assert answer.right.startswith("6 complex assemblies, to which loops of complex inputs lead")
    expected = solve_by_loops(record, inputs).joints
    assert len(answer.joints) == len(expected) == len(distinct(record, np.concatenate([expected, answer.joints])))


def test_ctrl_c_leaves_what_the_search_met(unrecognised, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(module, "solved_by_monodromy", interrupted)
    record = load_record("planar_3rrr")
    with pytest.raises(Interrupted) as stop:
        _assembled(record, inputs_of(record, home_values(record)))
    assert len(stop.value.answer) == 2
    assert not stop.value.answer.complete


def test_a_search_alone_says_how_many_starts_converged():
    record = load_record("planar_3rrr")
    answer = direct(record, inputs_of(record, home_values(record)), method="search")
    assert not answer.complete
    assert re.fullmatch(
        r"not proved: a search from 192 starts, \d+ of which converged, number \d+ to the last new one", answer.right
    )


def test_of_too_many_nothing_is_said():
    record = load_record("gough_stewart")
    inputs = inputs_of(record, home_values(record))
    assert solved_by_monodromy(record, "direct", inputs, np.tile(home_values(record), (40, 1))) is None
    assert not direct(record, inputs, method="search").complete


@pytest.mark.parametrize(("longest", "complete"), [(module.LONGEST, True), (0, False)])
def test_a_trace_that_takes_too_long_is_not_asked_on_line_after_line(monkeypatch, longest, complete):
    """Two places tell no degree: those of a trace of any degree are too many, so that all stays unproved."""
    lines_gone = []
    monkeypatch.setattr(module, "LONGEST", longest)
    monkeypatch.setattr(module, "FEW_PLACES", 2)
    monkeypatch.setattr(module, "ComplexLoops", lambda *a: lines_gone.append(a) or ComplexLoops(*a))
    record = load_record("fivebar")
    home = home_values(record)
    solutions = assemblies_by_monodromy(record, "direct", home[list(record.input_indices)], home[None])
    assert (solutions.complex, solutions.complete) == (2, complete)
    assert len(lines_gone) == 1
