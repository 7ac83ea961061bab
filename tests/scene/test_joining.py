"""Webs and posts touch what they join, and keep out of the way of joints."""

import numpy as np

from assur.scene.bodies import corners, solid
from assur.scene.parts import parts, unit


def of_role(every, role):
    return [item for item in parts(every.skeleton, every.companion) if item.role == role]


def test_a_web_joins_two_plates_of_its_link(every):
    bars = of_role(every, "bar")
    for item in of_role(every, "web"):
        touched = [bar for bar in bars if bar.link == item.link and (solid(bar.shape) ^ solid(item.shape)).volume() > 0]
        assert len(touched) >= 2, item.name


def test_a_post_joins_a_bar_of_the_platform_to_its_plate(every):
    for item in of_role(every, "post"):
        others = [other for other in parts(every.skeleton, every.companion) if other.link == item.link]
        roles = {other.role for other in others if (solid(other.shape) ^ solid(item.shape)).volume() > 0}
        assert {"plate", "bar"} <= roles


def test_a_stand_reaches_from_its_joint_to_the_plate_or_the_carriage(every):
    plates = [*of_role(every, "plate"), *of_role(every, "carriage")]
    for item in of_role(every, "stand"):
        own = [plate for plate in plates if plate.link == item.link]
        assert any((solid(plate.shape) ^ solid(item.shape)).volume() > 0 for plate in own), item.name
        rotation, origin = every.skeleton.frames[item.link]
        gap = np.linalg.norm(corners(item.shape) @ rotation.T + origin - every.skeleton.points[item.joint], axis=1)
        assert gap.min() < 3 * unit(every.skeleton)
