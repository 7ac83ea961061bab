from functools import cache

import numpy as np
import pytest

from assur.joint_graph.geometry import characteristic_length
from assur.joints.spherical import SPHERICAL
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import closure_error
from assur.kinematics.naming import mode_names
from assur.kinematics.pose import pose_of
from assur.mechanism import load
from assur.page import branches as page
from assur.page.branches import modes
from catalogue import each


@cache
def found_of(name):
    return page.branches(load(name))


@pytest.mark.parametrize("name", each())
def test_every_ghost_is_an_assembly_at_homes_inputs_or_at_homes_pose(name):
    record = load(name)
    home, length = record.home_values, characteristic_length(record)
    found = found_of(name)
    assert [item["values"] for item in (found["assembly"][0], found["working"][0])] == [home.tolist()] * 2
    for kind in ("assembly", "working"):
        assert [item.get("home", False) for item in found[kind]] == [True] + [False] * (len(found[kind]) - 1)
        values = np.array([item["values"] for item in found[kind]])
        assert np.max(closure_error(record, values)) < 1e-11 * length
        assert len({item["label"] for item in found[kind]}) == len(values)
        assert len(np.unique(values.round(6), axis=0)) == len(values)
    inputs = inputs_of(record, np.array([item["values"] for item in found["assembly"]]))
    assert np.allclose(inputs, inputs_of(record, home), rtol=0, atol=1e-9 * length)
    poses = pose_of(record, np.array([item["values"] for item in found["working"]]))
    assert np.allclose(poses, pose_of(record, home), rtol=0, atol=1e-9 * length)


@pytest.mark.parametrize("name", each())
def test_angles_are_within_half_a_turn_of_homes(name):
    record = load(name)
    turns = [item.kind == "angle" and record.joints[item.joint].type is not SPHERICAL for item in record.coordinates]
    for item in found_of(name)["assembly"]:
        assert np.all(np.abs(np.array(item["values"]) - record.home_values)[turns] <= np.pi + 1e-9)


def test_their_number_is_that_of_the_solutions():
    found = found_of("zeng2019")
    assert [len(found["assembly"]), len(found["working"])] == [4, 8]
    assert found["assembly"][0]["label"] == "+++"
    assert found["working"][0]["label"] == "++-++"


@pytest.mark.parametrize("name", ["fivebar", "delta_4s", "three_crr", "orthoglide", "zeng2019"])
def test_every_other_working_mode_has_its_own_assembly_modes_itself_first(name):
    record = load(name)
    home, length = record.home_values, characteristic_length(record)
    working = found_of(name)["working"]
    assert len(working) > 1
    assert "assembly" not in working[0]  # home's own stand beside
    for item in working[1:]:
        values = np.array([pose["values"] for pose in item["assembly"]])
        assert values[0].tolist() == item["values"]
        inputs = inputs_of(record, values)
        assert np.allclose(inputs, inputs[0], rtol=0, atol=1e-9 * length)
        assert np.max(closure_error(record, values)) < 1e-11 * length
        if item["status"] != "regular":
            assert len(values) == 1
            continue
        solutions = record.direct(inputs[0])
        labels = [str(label) for label in solutions.labels[solutions.exists]]
        assert sorted(pose["label"] for pose in item["assembly"]) == sorted(labels)
        assert [pose["label"] for pose in item["assembly"]] == [mode_names(record, row)[1] for row in values]
    assert pose_of(record, values[0]) == pytest.approx(pose_of(record, home), abs=1e-9 * length)


def test_where_the_inputs_do_not_hold_the_platform_a_working_mode_stands_alone():
    found = {item["label"]: item for item in found_of("zeng2019")["working"]}
    alone = [label for label, item in found.items() if len(item.get("assembly", [0, 0])) == 1]
    assert alone
    assert {found[label]["status"] for label in alone} == {"self_motion"}


def test_a_home_that_no_solution_is_stands_first_under_its_own_name(monkeypatch):
    monkeypatch.setattr("assur.kinematics.postures.SAME", -1.0)
    record = load("fivebar")
    found = page.branches(record)["assembly"]
    assert [item["label"] for item in found] == ["home", "+", "-"]
    assert found[0]["values"] == record.home_values.tolist()


def test_a_home_that_no_solution_is_has_its_own_status(monkeypatch):
    """Where the inputs do not hold the platform, as at another working mode at home's pose."""
    record = load("zeng2019")
    loose = next(item for item in found_of("zeng2019")["working"] if item["status"] == "self_motion")
    monkeypatch.setattr("assur.kinematics.postures.SAME", -1.0)
    monkeypatch.setattr(page, "home_values", lambda _: np.array(loose["values"]))
    first = page.branches(record)["assembly"][0]
    assert (first["label"], first["status"], first["values"]) == ("home", "self_motion", loose["values"])


def test_modes_are_rows_of_signs():
    found = modes(load("zeng2019"))
    assert len(found["working"]["all"]) == 2 ** len(found["working"]["names"]) == 32
    assert found["working"]["default"] == "++-++"
    assert [text.partition(" = ")[0].partition(" is ")[0] for text in found["working"]["said"]] == [
        f"{name} ({name})" for name in found["working"]["names"]
    ]
    platform = modes(load("gough_stewart"))["working"]
    assert (platform["names"], platform["all"], platform["default"]) == ([], [[]], "")
    assert platform["said"][0] == "leg1 (s1) is +: B1 lies ahead of A1 along P1"


def test_of_many_working_modes_the_first_have_their_assembly_modes_and_the_others_say_that_they_stand_alone(
    monkeypatch,
):
    monkeypatch.setattr(page, "WITH_ASSEMBLIES", 3)
    working = page.branches(load("planar_3rrr"))["working"]
    assert len(working) == 8
    assert [item.get("lone", False) for item in working] == [False] * 3 + [True] * 5
    for item in working[3:]:
        assert [pose["values"] for pose in item["assembly"]] == [item["values"]]
