"""A link is one piece, free of what runs in it, and as large as its parts less its bores."""

import numpy as np
import pytest
from manifold3d import Manifold, OpType

from assur.errors import UsageError
from assur.joints.prismatic import PRISMATIC
from assur.joints.universal import UNIVERSAL
from assur.scene.bodies import PLAY, bodies, fused, grown, solid
from assur.scene.parts import parts, unit
from assur.scene.shapes import Ball, Bar, Cuboid, Cylinder
from assur.scene.yokes import ASIDE, PIN, THIN

MOVING_PIECES = 1
BETWEEN = ASIDE - 0.5 * THIN - PIN
"""From a pin of a cross to the arms that hold the other one, in thicknesses."""


def test_every_part_is_in_one_body_once(every):
    made = bodies(every.record)
    listed = [(body.link, item.name) for body in made for item in (*body.fused, *body.pins)]
    assert sorted(listed) == sorted((item.link, item.name) for item in parts(every.skeleton, every.companion))


def test_every_moving_link_is_one_closed_piece(every):
    for body in bodies(every.record):
        if body.fused and body.link != every.record.base:
            whole = fused(body)
            assert len(whole.decompose()) == MOVING_PIECES, body.link
            assert whole.volume() > 0


def test_pins_fill_their_bores_and_nothing_else(every):
    """A link and its pins do not share room: volumes add up."""
    for body in bodies(every.record):
        pins = Manifold.batch_boolean([solid(item.shape) for item in body.pins], OpType.Add) if body.pins else None
        if pins is not None and body.fused:
            both = fused(body) ^ pins
            assert both.volume() < 1e-6 * pins.volume()


def test_hinged_links_leave_room_for_the_pin_of_their_neighbour(every):
    here, made = every.skeleton, {body.link: body for body in bodies(every.record)}
    play = PLAY * unit(here)
    for body in made.values():
        for item in body.pins:
            joint = every.record.joints[item.joint]
            other = joint.child if joint.parent == body.link else joint.parent
            if other not in made or not made[other].fused:
                continue
            pin = item.shape.moved(*here.frames[body.link])
            rotation, origin = here.frames[other]
            there = solid(pin.moved(rotation.T, -rotation.T @ origin))
            assert (fused(made[other]) ^ there).volume() < 1e-6 * there.volume()
            reach = BETWEEN * unit(here) + play if joint.type is UNIVERSAL else 10 * play
            assert fused(made[other]).min_gap(there, reach) <= reach


def test_a_slider_runs_on_its_rail(every):
    if not any(joint.type is PRISMATIC and every.record.base == joint.parent for joint in every.record.joints.values()):
        return
    here, made = every.skeleton, {body.link: body for body in bodies(every.record)}
    rails = [item for item in made[every.record.base].fused if item.role == "rail"]
    sliders = [body for body in made.values() if any(item.role == "carriage" for item in body.fused)]
    assert rails
    assert sliders
    for body in sliders:
        rotation, origin = here.frames[body.link]
        for rail in rails:
            there = solid(rail.shape.moved(*here.frames[rail.link]).moved(rotation.T, -rotation.T @ origin))
            assert (fused(body) ^ there).volume() < 1e-6 * there.volume()


@pytest.mark.parametrize(
    "shape", [Ball(np.ones(3), 2.0), Cylinder(np.zeros(3), np.array([0.0, 0, 4]), 1.0), Cuboid(np.zeros(3), np.eye(3))]
)
def test_what_is_grown_holds_the_shape_with_play_on_every_side(shape):
    low, high = (np.array(solid(item).bounding_box()).reshape(2, 3) for item in (shape, grown(shape, 0.25)))
    np.testing.assert_allclose(high - low, [[-0.25] * 3, [0.25] * 3], atol=0.01)


def test_a_shape_that_nothing_runs_in_is_not_grown():
    with pytest.raises(UsageError, match="no play is known for a bar"):
        grown(Bar(np.zeros(3), np.ones(3), np.array([0.0, 0, 1]), 1.0, 0.5), 0.1)
