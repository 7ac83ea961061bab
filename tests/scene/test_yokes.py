"""The forks of universal joints: rigid parts of the right links that hold their pins and let one another turn."""

import numpy as np
import pytest
from manifold3d import Manifold, OpType

import assur
from assur.joint_graph.frames import frames
from assur.joints.universal import UNIVERSAL
from assur.kinematics.home import home_values
from assur.scene.bodies import bodies, home_skeleton, solid
from assur.scene.companion import companion
from assur.scene.parts import parts
from assur.scene.sizes import thickness
from assur.scene.yokes import ARM, ASIDE, HUB, yokes

NAMES = ("three_upu", "gough_stewart", "three_p2us")
TILT = 40.0
"""Degrees by which each of the two axes is turned, both ways."""


def universal(record):
    return [joint for joint in record.joints.values() if joint.type is UNIVERSAL]


def of_joint(record, joint, *roles):
    made = parts(home_skeleton(record), companion(record))
    return [item for item in made if item.joint == joint and item.role in roles]


def test_a_mechanism_without_universal_joints_has_none(every):
    assert len(yokes(every.skeleton)) == 2 * len(universal(every.record))


@pytest.mark.parametrize("name", NAMES)
def test_two_pins_cross_each_in_the_fork_or_at_the_end_of_its_link(name):
    record = assur.load(name)
    here, size = home_skeleton(record), thickness(record)
    for joint in universal(record):
        pins = [item for item in of_joint(record, joint.name, "pin") if item.name.endswith("pin")]
        assert [item.link for item in pins] == [joint.parent, joint.child]
        mark = next(item for item in here.marks if item.joint is joint)
        for pin, axis in zip(pins, mark.axes, strict=True):
            placed = pin.shape.moved(*here.frames[pin.link])
            way = placed.end - placed.start
            np.testing.assert_allclose(np.abs(way @ axis), np.linalg.norm(way), rtol=1e-9)
            np.testing.assert_allclose((placed.start + placed.end) / 2, mark.at, atol=1e-9 * here.size)
            arms = [item for item in of_joint(record, joint.name, "arm", "stand") if item.link == pin.link]
            held = [item for item in arms if (solid(item.shape) ^ solid(pin.shape)).volume() > 0.3 * size**3]
            yoke = next(item for item in yokes(here) if (item.joint, item.link) == (joint.name, pin.link))
            if yoke.forked:
                assert len(held) == 2, (joint.name, pin.link)
            else:
                own = next(body for body in bodies(record) if body.link == pin.link)
                touching = [
                    item for item in own.fused if (solid(item.shape) ^ solid(pin.shape)).volume() > 0.3 * size**3
                ]
                assert touching, (joint.name, pin.link)


@pytest.mark.parametrize("name", NAMES)
def test_nothing_of_a_link_but_its_pin_runs_through_the_cross(name):
    record = assur.load(name)
    here, size = home_skeleton(record), thickness(record)
    made = {body.link: body for body in bodies(record)}
    for joint in universal(record):
        mark = next(item for item in here.marks if item.joint is joint)
        for link in (joint.parent, joint.child):
            rotation, origin = here.frames[link]
            hub = Manifold.sphere(HUB * size).translate(rotation.T @ (mark.at - origin))
            whole = Manifold.batch_boolean([solid(item.shape) for item in made[link].fused], OpType.Add)
            assert (whole ^ hub).volume() < 1e-6 * hub.volume(), (joint.name, link)


@pytest.mark.parametrize("name", NAMES)
def test_forks_turn_about_both_axes_without_meeting(name):
    """Both forks and the pins of the other one, with each axis turned from where home has it to 40 deg either way."""
    record = assur.load(name)
    here = home_skeleton(record)
    for joint in universal(record)[:2]:
        first = [item for item in of_joint(record, joint.name, "arm", "bridge") if item.link == joint.parent]
        second = [item for item in of_joint(record, joint.name, "arm", "bridge") if item.link == joint.child]
        if not first or not second:
            continue
        way = [
            next(item for item in yokes(here) if (item.joint, item.link) == (joint.name, link)).way
            for link in (joint.parent, joint.child)
        ]
        if float(way[0] @ way[1]) > -0.5:
            continue  # home itself is tilted by more than a fork allows
        indices = [item.index for item in record.coordinates if item.joint == joint.name]
        for change in ((TILT, 0), (-TILT, 0), (0, TILT), (0, -TILT)):
            values = home_values(record).copy()
            values[indices] += np.radians(change) / 2
            placed = frames(record, values)
            one, other = (
                Manifold.batch_boolean([solid(item.shape.moved(*placed[item.link])) for item in group], OpType.Add)
                for group in (first, second)
            )
            assert (one ^ other).volume() == pytest.approx(0.0, abs=1e-9 * one.volume()), (joint.name, change)


def test_a_leg_lies_where_it_did_and_begins_at_the_bridge():
    record = assur.load("three_upu")
    here, size = home_skeleton(record), thickness(record)
    tube = next(item for item in parts(here, companion(record)) if item.name == "leg1.P tube")
    placed = tube.shape.moved(*here.frames[tube.link])
    base, top = here.points["leg1.A"], here.points["leg1.B"]
    along = (top - base) / np.linalg.norm(top - base)
    np.testing.assert_allclose(placed.start, base + ARM * size * along, atol=1e-9 * here.size)
    off = placed.end - base - (placed.end - base) @ along * along
    np.testing.assert_allclose(off, 0.0, atol=1e-9 * here.size)


def test_a_link_along_its_pin_holds_it_at_one_end():
    """The slider of a 2-US pair lies on the line of both first axes."""
    record = assur.load("three_p2us")
    here, size = home_skeleton(record), thickness(record)
    yoke = next(item for item in yokes(here) if (item.joint, item.link) == ("leg1.B1", "leg1.slider"))
    assert not yoke.forked
    assert list(yoke.shapes(size)) == []
    np.testing.assert_allclose(np.linalg.norm(yoke.root(size) - yoke.at), ASIDE * size, rtol=1e-12)
    bar = next(item for item in parts(here, companion(record)) if item.name == "bar leg1.B1 leg1.B2")
    placed = bar.shape.moved(*here.frames[bar.link])
    ends = np.array([placed.start, placed.end])
    assert np.min(np.linalg.norm(ends - yoke.at, axis=1)) == pytest.approx(ASIDE * size)
