"""Modes of what is shown: one of them is current, and each is an assembly at the same inputs or the same pose."""

import numpy as np
import pytest

import assur
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import characteristic_length, closure_error
from assur.kinematics.pose import pose_of
from assur.view.modes import modes
from assur.view.state import start, with_values

QUICK = sorted(set(assur.names()) - {"gough_stewart", "three_rrrp4r"})


@pytest.mark.parametrize("problem", ["direct", "inverse"])
@pytest.mark.parametrize("name", QUICK)
def test_one_is_current_and_all_are_assemblies(name, problem):
    here = start(assur.load(name))
    found = modes(here, problem)
    assert sum(item.current for item in found.choices) == 1
    assert len(found.others) == len(found.choices) - 1
    size = characteristic_length(here.record)
    same = inputs_of if problem == "direct" else pose_of
    for item in found.choices:
        assert closure_error(here.record, item.values) < 1e-8 * size
        change = same(here.record, item.values) - same(here.record, here.values)
        assert np.max(np.abs((change + np.pi) % (2 * np.pi) - np.pi)) < 1e-6 * max(size, 1.0)


def test_a_choice_that_is_taken_is_the_current_one_then():
    here = start(assur.load("zeng2019"))
    for item in modes(here, "inverse").others:
        there = modes(with_values(here, item.values), "inverse")
        assert there.current.label == item.label


def test_without_closed_form_there_are_no_factors(tmp_path):
    from assur.cli.main import main

    path = tmp_path / "five.toml"
    assert main(["new", str(path), "--from", "fivebar", "--json"]) == 0
    found = modes(start(assur.load(path)), "direct")
    assert found.current.factors == {}
    assert len(found.choices) == 2
