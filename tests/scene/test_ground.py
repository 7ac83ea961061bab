"""The ground: rails where sliders run, stands under joints, forks where no plate can be."""

import numpy as np

from assur.joints.universal import UNIVERSAL
from assur.scene.ground import across, upright
from assur.scene.parts import parts
from assur.scene.skeleton import Skeleton


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
            assert own & {"stand", "pillar"}, mark.joint.name
        elif mark.joint.type is UNIVERSAL:
            assert {"arm", "bridge"} <= own, mark.joint.name


def test_upright_axes_have_pillars(every):
    roles = {item.joint: item.role for item in of_base(every) if item.role in ("pillar", "stand")}
    for mark in every.skeleton.marks:
        if mark.joint.name in roles:
            assert (roles[mark.joint.name] == "pillar") == upright(mark)


def test_across_is_across():
    for axis in (*np.eye(3), np.array([0.6, 0.0, 0.8])):
        side, up = across(axis)
        np.testing.assert_allclose([side @ axis, up @ axis, side @ up], 0.0, atol=1e-12)
        np.testing.assert_allclose([np.linalg.norm(side), np.linalg.norm(up)], 1.0)
