"""What is said of a solution that exceeds a limit, or that leaves a loop open."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.kinematics.answers.excess import open_loop
from assur.kinematics.position import inverse
from assur.kinematics.status import Status
from wrong_formulas import with_wrong_joints

BUILT_IN = Path(assur.__file__).parent / "mechanisms"
LIMITED = """
format = 1
name = "limited"
title = "planar 3-RPR, similar triangles"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "platform", pose = ["x", "y", "phi"] }
[links]
base = {}
platform = {}
[limbs.leg]
repeat = { about = "z", count = 3 }
[limbs.leg.links]
cyl = {}
rod = {}
[limbs.leg.joints]
A = { type = "revolute", parent = "base", child = "cyl", at = [200, 0, 0], axis = "z", limits = [-15, 30] }
P = { type = "prismatic", parent = "cyl", child = "rod", axis = "-x" }
B = { type = "revolute", parent = "rod", child = "platform", child_at = [80, 0, 0], axis = "z" }
[limbs.leg.inputs]
P = { name = "l", STROKE }
[limbs.leg.home]
A = 0
P = 120
B = 0
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("excess")


def limited(folder, stroke=""):
    path = folder / "limited.toml"
    path.write_text(LIMITED.replace(", STROKE", f", {stroke}" if stroke else ""), encoding="utf-8")
    return assur.load(path)


@pytest.fixture(scope="module")
def wrong():
    """A mechanism whose formulas give a joint value that is wrong by 20 mm."""
    return with_wrong_joints(assur.load("zeng2019"), "P3", 20.0)


def test_a_passive_joint_beyond_its_limits_is_named_with_the_angle(folder):
    """By the law of cosines in the triangle of 200 mm, 80 mm and a leg of 150 mm."""
    record = limited(folder)
    found = list(record.direct([150.0, 150.0, 150.0]))
    angle = np.degrees(np.arccos((200**2 + 150**2 - 80**2) / (2 * 200 * 150)))
    assert [item.within_limits for item in found] == [True, False]
    said = [(item.limit, item.joint) for item in found[1].excesses]
    assert said == [(f"limit of leg{k}.A", f"leg{k}.A") for k in (1, 2, 3)]
    assert np.allclose([np.degrees(item.by) for item in found[1].excesses], angle - 15)
    assert np.allclose([np.degrees(item.value) for item in found[1].excesses], -angle)


def test_strokes_are_judged_too_and_batches_alike(folder):
    record = limited(folder, "stroke = [100, 140]")
    batch = record.direct([[150.0, 150.0, 150.0], [130.0, 130.0, 130.0], [130.0, 130.0, 150.0]])
    for row, given in enumerate(batch.given):
        single = record.direct(given)
        kept = [item.within_limits for item in single]
        assert batch.within_limits[row][batch.exists[row]].tolist() == kept
    over = [item for item in next(iter(record.direct([130.0, 130.0, 150.0]))).excesses if item.joint == "l3"]
    assert [(item.limit, item.by, item.angular) for item in over] == [("stroke of l3", 10.0, False)]


def test_a_value_on_a_bound_is_within(folder):
    record = limited(folder, "stroke = [100, 150]")
    assert next(iter(record.direct([150.0, 150.0, 150.0]))).within_limits


def test_where_no_limits_are_stated_nothing_is_within_them():
    found = next(iter(assur.load("fivebar").direct(np.radians([127.0, 53.0]))))
    assert (found.within_limits, found.excesses) == (None, ())


@pytest.mark.parametrize(("degrees", "by"), [(400.0, 0.0), (800.0, 80.0), (-760.0, 40.0)])
def test_a_stroke_beyond_a_turn_counts_the_turns_of_a_given_input(folder, degrees, by):
    text = (BUILT_IN / "fivebar" / "mechanism.toml").read_text(encoding="utf-8")
    entry = next(item for item in text[text.index("[inputs]") :].splitlines() if item.startswith("A1 = "))
    path = folder / "turned.toml"
    path.write_text(text.replace(entry, entry.replace(" }", ", stroke = [-720, 720] }")), encoding="utf-8")
    record = assur.load(path)
    found = list(record.direct(np.radians([degrees, 53.0]), method="loops"))
    assert found
    for item in found:
        assert [round(np.degrees(each.by), 6) for each in item.excesses] == ([by] if by else [])
    assert all(item.within_limits for item in record.inverse(found[0].pose))


def test_what_leaves_a_loop_open_is_never_regular(wrong):
    found = wrong.inverse([0.0, 0.0, 400.0])
    assert len(found) == 8
    assert set(found.status[found.exists].tolist()) == {int(Status.not_closed)}
    assert (Status(int(found.overall_status)), found.complete) == (Status.not_closed, False)
    for item in found:
        assert (item.open_loop.joint, "P3" in item.open_loop.loop) == ("E3a", True)
        assert item.open_loop.gap == pytest.approx(20.0)


def test_formulas_that_answer_another_question_are_no_solutions_either():
    """Every loop is closed, but the platform stands elsewhere than it was asked to."""
    record = assur.load("zeng2019")
    form = record.closed_form

    def elsewhere(ns, p, pose, sign):
        return form.inverse(ns, p, (pose[0] + 1.0, *pose[1:]), sign)

    record = dataclasses.replace(record, closed_form=dataclasses.replace(form, inverse=elsewhere))
    found = list(inverse(record, [0.0, 0.0, 400.0]))
    assert found
    for item in found:
        assert (item.status, item.open_loop) == (Status.not_closed, None)
        assert item.residual == pytest.approx(1.0)


def test_batches_judge_the_gap_as_single_problems_do(wrong):
    poses = [[0.0, 0.0, 400.0], [-15.4714, 9.6849, 456.3315], [0.0, 0.0, 300.0], [0.0, 0.0, 900.0]]
    batch = wrong.inverse(poses)
    for row, pose in enumerate(poses):
        assert batch.status[row].tolist() == wrong.inverse(pose).status.tolist()
    assert set(batch.status[batch.exists].tolist()) == {int(Status.not_closed)}
    assert Status.regular in batch.formula_status[batch.exists].tolist()


def test_its_verdict_is_none(wrong):
    assert wrong.singularity([0.0, 0.0, 400.0]).kind == "not_closed"


def test_a_closed_assembly_has_no_open_loop():
    record = assur.load("fivebar")
    assert open_loop(record, record.home_values) is None
