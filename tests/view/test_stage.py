"""The first picture: all of the mechanism is in it, no smaller than it needs to be, and what it costs."""

from unittest.mock import MagicMock

import numpy as np
import pytest

import assur
from assur.view.drawing import cloud, drawing
from assur.view.stage import GHOSTS, NARROW, OPENING, ROOM, Stage, framed
from catalogue import each


@pytest.mark.parametrize("name", each())
def test_all_of_a_mechanism_is_in_a_narrow_picture_and_fills_it(name):
    """By a pinhole camera of our own: where rays to every vertex meet the picture, in halves of its sides."""
    record = assur.load(name)
    points = cloud(drawing(record, record.home_values), record, record.home_values)
    viewpoint = framed(points)
    eye, aim, up = (np.array(item) for item in (viewpoint.position, viewpoint.look_at, viewpoint.up))
    ahead = (aim - eye) / np.linalg.norm(aim - eye)
    aside = np.cross(ahead, up) / np.linalg.norm(np.cross(ahead, up))
    rays = points - eye
    picture = np.stack([rays @ aside, rays @ np.cross(aside, ahead)], axis=1) / (rays @ ahead)[:, None]
    reach = np.max(np.abs(picture) / [NARROW, 1.0]) / np.tan(OPENING / 2)
    assert np.min(rays @ ahead) > 0
    assert reach == pytest.approx(ROOM, abs=1e-9)


def test_neither_shadows_nor_surroundings_are_drawn():
    """They are most of the work of a first picture that a processor draws; viser has both where it is told nothing."""
    server = MagicMock()
    Stage(server, [].append)
    assert server.scene.configure_environment_map.call_args.kwargs == {"hdri": None}
    assert server.scene.configure_default_lights.call_args.kwargs["cast_shadow"] is False


@pytest.mark.parametrize("name", each())
def test_a_link_is_one_mesh_for_each_of_its_colours(name):
    server = MagicMock()
    record = assur.load(name)
    Stage(server, [].append).build(record, record.home_values)
    made = [(call.args[0].split("/")[2], call.kwargs["color"]) for call in server.scene.add_mesh_simple.call_args_list]
    assert len(set(made)) == len(made)
    assert {link for link, _ in made} <= set(record.links)


def test_ghosts_are_few_and_each_of_their_links_is_one_mesh():
    server = MagicMock()
    record = assur.load("zeng2019")
    stage = Stage(server, [].append)
    stage.build(record, record.home_values)
    stage.ghosts(record, [record.home_values] * (GHOSTS + 3), visible=True)
    calls = server.scene.add_batched_meshes_simple.call_args_list
    shown = {call.args[0]: call for call in calls}
    assert len(shown) == len(calls) == len(record.links) - 1
    solids = [item for item in stage.drawing.solids if item.link == "link11"]
    _, vertices, faces = shown["/ghosts/link11"].args
    corners = np.concatenate([item.vertices[item.faces] for item in solids])
    assert np.array_equal(vertices[faces], corners)
    assert all(len(call.kwargs["batched_positions"]) == GHOSTS for call in calls)
