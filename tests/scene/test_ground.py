"""The ground: rails where sliders run, stands under joints, forks where no plate can be."""

import numpy as np
import pytest

import assur
from assur.joints.universal import UNIVERSAL
from assur.kinematics.home import home_values
from assur.scene.companion import companion
from assur.scene.ground import across, upright
from assur.scene.parts import machine, parts
from assur.scene.skeleton import Skeleton, skeleton
from assur.synthesis.drafting.drafting import drafted
from assur.topology.notation import parse_chains
from drawn_drafts import draft


def of_base(every):
    return [item for item in parts(every.skeleton, every.companion) if item.link == every.record.base]


def test_what_stands_on_the_base_is_held_or_the_plate_would_hide_what_is_below(every):
    here: Skeleton = every.skeleton
    made = of_base(every)
    plate = [item for item in made if item.name == "base plate"]
    for mark in here.marks:
        if not mark.grounded or mark.slides:
            continue
        own = {item.role for item in made if item.joint == mark.joint.name}
        if plate:
            assert own & {"stand", "pillar", "motor"}, mark.joint.name
        elif mark.joint.type is UNIVERSAL:
            assert {"arm", "bridge"} <= own, mark.joint.name


def test_upright_axes_have_pillars(every):
    stands = {item.joint for item in of_base(every) if item.role == "stand"}
    pillars = {item.joint for item in of_base(every) if item.role in ("pillar", "motor")} - stands
    for mark in every.skeleton.marks:
        if mark.joint.name in stands | pillars:
            assert (mark.joint.name in pillars) == upright(mark)


def test_sliders_that_carry_planes_stand_on_rails_though_no_rod_moves(tmp_path):
    chains = parse_chains([f"P[{axis}] E[{axis}]" for axis in "xyz"])
    (tmp_path / "planes.toml").write_text(drafted(chains, tmp_path / "planes.toml").text, encoding="utf-8")
    record = assur.load(tmp_path / "planes.toml")
    names = companion(record)
    at_home = skeleton(record, names, home_values(record))
    assert {rod.link for rod in at_home.rods} <= {record.base}
    rails = [part for part in parts(at_home, names) if part.role == "rail"]
    assert len(rails) == 3


def test_across_is_across():
    for axis in (*np.eye(3), np.array([0.6, 0.0, 0.8])):
        side, up = across(axis)
        np.testing.assert_allclose([side @ axis, up @ axis, side @ up], 0.0, atol=1e-12)
        np.testing.assert_allclose([np.linalg.norm(side), np.linalg.norm(up)], 1.0)


def test_what_an_upright_joint_stands_on_reaches_a_plate_that_rails_have_lowered():
    record = draft("a hybrid")
    made = {part.name: part.shape for part in machine(record) if part.link == record.base}
    motor, column = made["b1.I motor"], made["b1.I column"]
    plate = made["base plate"]
    assert column.start[2] == pytest.approx(plate.outline[0, 2] + plate.along[2])
    assert column.end == pytest.approx(motor.start)
