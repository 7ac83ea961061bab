from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.joints.universal import UNIVERSAL
from assur.scene.companion import Companion
from assur.scene.mesh import rgb
from assur.scene.parts import link_layers, machine, model, parts, placed, unit
from assur.scene.skeleton import link_point, skeleton
from assur.scene.yokes import ASIDE, trimmed, yokes


def test_links_that_are_hinged_together_lie_in_different_layers(every):
    layers = link_layers(every.skeleton)
    for mark in every.skeleton.marks:
        pair = {mark.joint.parent, mark.joint.child}
        forked = mark.joint.type is UNIVERSAL  # its links lie in the forks of a cross
        if not (mark.slides or forked) and every.record.base not in pair:
            parent, child = (layers[link] for link in pair)
            assert parent != child, mark.joint.name


def test_every_joint_is_inside_the_model(every):
    points = model(every.skeleton).corners.reshape(-1, 3)
    low, high = points.min(axis=0), points.max(axis=0)
    for mark in every.skeleton.marks:
        assert np.all(mark.at > low - 1e-9)
        assert np.all(mark.at < high + 1e-9)
        assert np.min(np.linalg.norm(points - mark.at, axis=1)) < 4 * unit(every.skeleton)


def test_bars_are_as_long_as_the_joint_graph_says(every):
    """The farthest point of a link's bars along each bar is one radius beyond its joint, or where it holds a pin."""
    size = unit(every.skeleton)
    stubs = {item.link for item in yokes(every.skeleton) if not item.forked}
    for rod in every.skeleton.rods:
        if rod.size < 4 * size or rod.link == every.record.platform.link:
            continue
        mesh = model(every.skeleton, {rod.link: "#010203"})
        own = mesh.corners[np.all(np.isclose(mesh.colour, rgb("#010203")), axis=1)].reshape(-1, 3)
        along = (rod.points[1] - rod.points[0]) / rod.size
        short = ASIDE * size if rod.link in stubs else 0.0
        assert np.max((own - rod.points[0]) @ along) >= rod.size - short - 1e-6
        rods = [item for item in every.skeleton.rods if item.link == rod.link]
        if len(rods) == 1:
            assert np.max((own - rod.points[0]) @ along) <= rod.size + 1.2 * size


def test_a_leg_of_no_length_is_drawn():
    """The sliders of drafts stand at zero at home: the two ends of what a leg leaves open are one point."""
    record = assur.load("three_upu")
    values = record.home_values.copy()
    sliders = [item.coordinate.index for item in record.inputs]
    values[sliders] = 0.0
    short = skeleton(record, Companion(), values)
    assert any(mark.telescopes and np.array_equal(mark.at, mark.rail) for mark in short.marks)
    found = placed(parts(short, Companion()), short)
    assert np.all(np.isfinite(found.corners))
    np.testing.assert_allclose(np.linalg.norm(found.normals, axis=2), 1.0, atol=1e-9)


def test_a_mechanism_in_one_point_has_a_size():
    record = assur.load("fivebar")
    whole = skeleton(record, Companion(), record.home_values)
    point = replace(whole, rods=(), plates=(), marks=tuple(replace(mark, at=np.zeros(3)) for mark in whole.marks))
    assert unit(point) > 0.0
    mesh = placed(parts(point, Companion()), point)
    assert np.all(np.isfinite(mesh.corners))
    assert np.all(np.ptp(mesh.corners.reshape(-1, 3), axis=0) > 0.0)


def test_parts_go_with_their_links(every):
    """Placed at other joint values, pins, balls and rods are where the skeleton of those has joints and rods."""
    home, record = every.skeleton, every.record
    moved = skeleton(record, every.companion, home.values + 0.05)
    rods = trimmed(moved, yokes(moved), unit(moved)).rods
    near = 1e-9 * max(home.size, 1.0)
    for item in parts(home, every.companion):
        shape = item.shape.moved(*moved.frames[item.link])
        words = item.name.split()
        if words[-1] in ("pin", "ball"):
            middle = shape.centre if words[-1] == "ball" else (shape.start + shape.end) / 2
            there = link_point(record, moved.frames, item.link, words[0])
            np.testing.assert_allclose(middle, there, atol=near)
        elif words[0] == "bar" and len(words) == 3 and shape.kind == "cylinder":
            ends = [rod.points for rod in rods if rod.link == item.link and list(rod.ends) == words[1:]]
            assert any(np.allclose([shape.start, shape.end], points, atol=near) for points in ends)


def test_every_part_is_of_a_link_and_every_joint_has_one(every):
    solids = parts(every.skeleton, every.companion)
    assert {item.link for item in solids} <= set(every.record.links)
    for joint in every.record.joints:
        assert any(item.name.startswith(joint) for item in solids), joint


def bars(name, start):
    found = [item for item in machine(assur.load(name)) if item.link.startswith(start) and item.role == "bar"]
    return [item.shape for item in found]


def test_rods_between_balls_are_broad_but_at_their_ends_and_no_broader_than_the_balls():
    """Those of a Delta robot, whose balls at the platform are so near to one another that all else is drawn thin."""
    first, shaft, last = bars("delta_4s", "leg1.rod1")
    (ball,) = (item.shape for item in machine(assur.load("delta_4s")) if item.name == "leg1.C1 ball")
    assert first.radius == last.radius < shaft.radius <= ball.radius
    assert np.array_equal(first.end, shaft.start)
    assert np.array_equal(shaft.end, last.start)
    assert np.linalg.norm(last.end - first.start) == pytest.approx(1.244)
    assert np.linalg.norm(shaft.end - shaft.start) > 0.7 * 1.244


def test_rods_between_balls_that_have_room_are_one_bar():
    assert len(bars("three_p2us", "leg1.rod1")) == 1
