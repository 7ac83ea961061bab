"""Postures: one of them is the configuration itself, and each is an assembly at the same inputs or the same pose."""

import numpy as np
import pytest

import assur
from assur.joint_graph.geometry import characteristic_length
from assur.joints.spherical import SPHERICAL
from assur.kinematics import postures as module
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import assemble, closure_error
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct
from assur.kinematics.postures import postures, unwound

QUICK = sorted(set(assur.names()) - {"gough_stewart", "three_rrrp4r"})


class _Answer:
    """An answer with other joint values (K, n)."""

    def __init__(self, answer, joints):
        self.answer, self.joints = answer, joints

    def __getattr__(self, name):
        return getattr(self.answer, name)


def _away(record):
    """An assembly a little beside home."""
    home = np.array(record.home_values)
    size = np.where([item.kind == "length" for item in record.coordinates], characteristic_length(record), 1.0)
    found = assemble(record, home + 0.003 * size * np.sin(1.0 + np.arange(len(home))), near=True)
    assert bool(found.closed)
    return found.values


@pytest.mark.parametrize("problem", ["direct", "inverse"])
@pytest.mark.parametrize("name", QUICK)
def test_one_is_the_configuration_itself_and_all_are_assemblies(name, problem):
    record = assur.load(name)
    here = _away(record)
    found = postures(record, here, problem)
    assert np.array_equal(found.current.values, here)
    assert len(found.others) == len(found.listed) - 1
    size = characteristic_length(record)
    same = inputs_of if problem == "direct" else pose_of
    for item in found.listed:
        assert closure_error(record, item.values) < 1e-8 * size
        change = same(record, item.values) - same(record, here)
        assert np.max(np.abs((change + np.pi) % (2 * np.pi) - np.pi)) < 1e-6 * max(size, 1.0)
        assert str(found.answer.labels[item.candidate]) == item.label


@pytest.mark.parametrize("name", ["zeng2019", "delta_4s", "fivebar"])
def test_of_every_other_posture_that_one_is_the_current(name):
    record = assur.load(name)
    for item in postures(record, record.home_values, "inverse").others:
        there = postures(record, item.values, "inverse")
        assert there.current.label == item.label


def test_of_several_that_are_near_the_nearest_is_the_current(monkeypatch):
    record = assur.load("fivebar")
    known = {item.label: item.values for item in postures(record, record.home_values, "inverse").listed}
    monkeypatch.setattr(module, "SAME", 100.0)
    assert {label: postures(record, row, "inverse").current.label for label, row in known.items()} == {
        label: label for label in known
    }


def test_a_configuration_that_no_solution_is_is_none_of_them(monkeypatch):
    record = assur.load("fivebar")
    monkeypatch.setattr(module, "SAME", -1.0)
    found = postures(record, record.home_values, "direct")
    assert found.current is None
    assert [item.label for item in found.others] == ["+", "-"]


@pytest.mark.parametrize("problem", ["direct", "inverse"])
@pytest.mark.parametrize("name", ["fivebar", "zeng2019", "delta_4s"])
def test_what_is_given_stays_where_the_answer_has_few_digits(monkeypatch, name, problem):
    """As near a singularity, where inputs to ten digits are a pose to five, and the other way about."""
    record = assur.load(name)
    size, solve = characteristic_length(record), getattr(module, problem)

    def rough(*asked):
        found = solve(*asked)
        off = 1e-7 * np.sin(1.0 + np.arange(found.joints.shape[-1]))
        off[list(record.input_indices) if problem == "direct" else []] = 0.0
        return _Answer(found, found.joints + off * size)

    monkeypatch.setattr(module, problem, rough)
    given = inputs_of if problem == "direct" else pose_of
    for item in postures(record, record.home_values, problem).listed:
        assert closure_error(record, item.values) < 1e-11 * size
        assert given(record, item.values) == pytest.approx(given(record, record.home_values), abs=1e-11 * size)


def test_a_solution_whose_loops_do_not_close_is_not_listed(monkeypatch):
    """A slide that is ten times as far out as any leg is long."""
    record = assur.load("zeng2019")
    known = postures(record, record.home_values, "direct")

    def wrong(*asked):
        found = direct(*asked)
        joints = found.joints.copy()
        joints[known.listed[1].candidate, record.input_indices[0]] = 10.0 * characteristic_length(record)
        return _Answer(found, joints)

    monkeypatch.setattr(module, "direct", wrong)
    found = postures(record, known.listed[2].values, "direct")
    kept = [known.listed[k].label for k in (0, 2, 3)]
    assert [item.label for item in found.listed] == kept
    assert (found.current.label, [item.label for item in found.others]) == (kept[1], [kept[0], kept[2]])


def test_whole_turns_are_taken_off_angles_but_not_off_rotation_vectors():
    record = assur.load("gough_stewart")
    home = np.array(record.home_values)
    spherical = [record.joints[item.joint].type is SPHERICAL for item in record.coordinates]
    lengths = [item.kind == "length" for item in record.coordinates]
    moved = unwound(record, home + 4 * np.pi, home)
    assert np.array_equal(np.abs(moved - home) > 1, np.array(spherical) | np.array(lengths))
