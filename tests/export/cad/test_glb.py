"""A GLB file read back by hand: chunks, bounds of accessors, names, and frames of the joint graph."""

import numpy as np
import pytest

import assur
from assur.export.cad.glb import glb
from assur.joint_graph.frames import frames
from assur.numerics import rotations
from assur.scene.bodies import home_skeleton
from assur.scene.companion import companion
from assur.scene.motion import closed_motion
from assur.scene.parts import parts, placed
from glb_file import read


@pytest.fixture(scope="module", params=["fivebar", "zeng2019"])
def made(request):
    record = assur.load(request.param)
    values = closed_motion(record, 12)
    return record, values, *read(glb(record, values, 3.0))


def test_accessors_state_their_bounds(made):
    _, _, document, values = made
    for item, rows in zip(document["accessors"], values, strict=True):
        np.testing.assert_array_equal(item["min"], rows.min(axis=0))
        np.testing.assert_array_equal(item["max"], rows.max(axis=0))


def test_every_part_is_a_mesh_of_its_link(made):
    record, _, document, _ = made
    nodes = document["nodes"]
    links = {nodes[k]["name"]: nodes[k] for k in nodes[0]["children"]}
    assert set(links) == set(record.links)
    for item in parts(home_skeleton(record), companion(record)):
        assert item.name in [nodes[k]["name"] for k in links[item.link].get("children", [])]


def test_standing_it_is_the_model_of_the_figures_in_metres_and_y_upwards(made):
    record, _, document, values = made
    here = home_skeleton(record)
    wanted = placed(parts(here, companion(record)), here).corners.reshape(-1, 3)
    points = []
    nodes = document["nodes"]
    for k in nodes[0]["children"]:
        link = nodes[k]
        turn = rotations.from_quaternion(np.roll(link["rotation"], 1))
        for child in link.get("children", []):
            primitive = document["meshes"][nodes[child]["mesh"]]["primitives"][0]
            corners = values[primitive["attributes"]["POSITION"]]
            assert values[primitive["indices"]].max() == len(corners) - 1
            points.append(corners @ turn.T + link["translation"])
    root = rotations.from_quaternion(np.roll(nodes[0]["rotation"], 1)) * nodes[0]["scale"][0]
    found = np.concatenate(points) @ root.T
    metres = 1e-3 * np.column_stack([wanted[:, 0], wanted[:, 2], -wanted[:, 1]])
    np.testing.assert_allclose(found.min(axis=0), metres.min(axis=0), atol=1e-6)
    np.testing.assert_allclose(found.max(axis=0), metres.max(axis=0), atol=1e-6)


def test_frames_of_the_animation_are_those_of_the_joint_graph(made):
    record, joints, document, values = made
    animation, nodes = document["animations"][0], document["nodes"]
    found = {}
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        times = values[sampler["input"]][:, 0]
        np.testing.assert_allclose(times, np.linspace(0, 3.0, len(joints)), atol=1e-6)
        found[nodes[channel["target"]["node"]]["name"], channel["target"]["path"]] = values[sampler["output"]]
    size = home_skeleton(record).size
    for link, (rotation, origin) in frames(record, joints).items():
        still = next(node for node in nodes if node["name"] == link)
        turns = found.get((link, "rotation"), np.repeat([still["rotation"]], len(joints), axis=0))
        shifts = found.get((link, "translation"), np.repeat([still["translation"]], len(joints), axis=0))
        np.testing.assert_allclose(rotations.from_quaternion(np.roll(turns, 1, axis=1)), rotation, atol=1e-6)
        np.testing.assert_allclose(shifts, origin, atol=1e-6 * size)
        assert np.all(np.sum(turns[1:] * turns[:-1], axis=1) > 0)
    assert (record.platform.link, "translation") in found


def test_a_link_that_goes_round_keeps_the_sense_of_its_quaternion():
    """Half a turn on, the quaternion of a rotation comes with the other sign; a viewer would turn back all the way."""
    record = assur.load("fivebar")
    values = np.repeat(record.home_values[None], 25, axis=0)
    column = record.inputs[0].coordinate.index
    values[:, column] += np.linspace(0.0, 2 * np.pi, 25)
    document, rows = read(glb(record, values))
    plain = [rotations.to_quaternion(turns) for turns, _ in frames(record, values).values()]
    assert any(np.any(np.sum(turn[1:] * turn[:-1], axis=1) < 0) for turn in plain)  # it does come so
    channels, samplers = (document["animations"][0][name] for name in ("channels", "samplers"))
    turned = [rows[samplers[item["sampler"]]["output"]] for item in channels if item["target"]["path"] == "rotation"]
    assert turned
    for turn in turned:
        np.testing.assert_array_less(np.cos(np.pi / 12), np.sum(turn[1:] * turn[:-1], axis=1))


def test_one_configuration_has_no_animation():
    record = assur.load("fivebar")
    assert "animations" not in read(glb(record, record.home_values[None]))[0]
