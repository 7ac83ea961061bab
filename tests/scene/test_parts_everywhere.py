"""Solids are made once: a figure, the page, the view and exports have the same vertices, moved by the links' frames."""

import numpy as np
import pytest

import assur
from assur.export.cad.glb import glb
from assur.page.content import content
from assur.scene.bodies import bodies
from assur.scene.companion import companion
from assur.scene.parts import machine, model
from assur.scene.skeleton import skeleton
from assur.view.drawing import drawing
from catalogue import REPRESENTATIVES, each
from drawn_drafts import DRAFTS, draft
from glb_file import read


@pytest.fixture(params=each([*assur.names(), *DRAFTS], [*REPRESENTATIVES, "a hybrid"]))
def record(request):
    return draft(request.param) if request.param in DRAFTS else assur.load(request.param)


def corners(part):
    """Corners (n, 3) of a part in its link's frame."""
    return part.shape.mesh(part.colour).corners.reshape(-1, 3)


def assert_one_cloud(found, wanted, near):
    """Points (n, 3) and (m, 3), in any order and as often as may be, are the same."""
    for one, other in ((found, wanted), (wanted, found)):
        places = {key for point in np.round(other / near).astype(int).tolist() for key in neighbours(point)}
        assert all(tuple(point) in places for point in np.round(one / near).astype(int).tolist())


def neighbours(point):
    return ((point[0] + i, point[1] + j, point[2] + k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1))


def test_a_figure_has_it_at_any_configuration(record):
    moved = skeleton(record, companion(record), record.home_values + 0.05)
    wanted = [corners(part) @ moved.frames[part.link][0].T + moved.frames[part.link][1] for part in machine(record)]
    np.testing.assert_allclose(
        model(moved).corners.reshape(-1, 3), np.concatenate(wanted), rtol=0, atol=1e-9 * moved.size
    )


def test_the_page_has_it_to_what_it_rounds(record):
    size = skeleton(record, companion(record), record.home_values).size
    told = content(record, ())["parts"]
    for part, item in zip(machine(record), told, strict=True):
        assert (item["name"], item["link"], item["colour"]) == (part.name, part.link, part.colour)
        assert item["shape"]["kind"] == part.shape.kind
        for name, value in vars(part.shape).items():
            np.testing.assert_allclose(item["shape"][name], value, rtol=0, atol=1e-5 * size)


def test_the_view_has_it_wherever_it_was_opened(record):
    drawn = drawing(record, record.home_values + 0.05)
    for link in record.links:
        wanted = [corners(part) * drawn.scale for part in machine(record) if part.link == link]
        found = [solid.vertices for solid in drawn.solids if solid.link == link]
        assert len(wanted) == 0 or len(found) > 0
        if wanted:
            assert_one_cloud(np.concatenate(found), np.concatenate(wanted), 1e-6)


def test_a_glb_file_has_it_in_whatever_configuration_it_stands(record):
    size = skeleton(record, companion(record), record.home_values).size
    document, values = read(glb(record, record.home_values[None] + 0.05))
    nodes = document["nodes"]
    for link in (nodes[k] for k in nodes[0]["children"]):
        own = [part for part in machine(record) if part.link == link["name"]]
        for part, child in zip(own, link.get("children", []), strict=True):
            primitive = document["meshes"][nodes[child]["mesh"]]["primitives"][0]
            found = values[primitive["attributes"]["POSITION"]] / size
            assert_one_cloud(found, corners(part) / size, 1e-5)


def test_what_is_made_for_print_is_made_of_it(record):
    made = machine(record)
    assert [part for body in bodies(record) for part in (*body.fused, *body.pins)] == [
        part
        for link in record.links
        for part in sorted((part for part in made if part.link == link), key=lambda part: part.role == "pin")
    ]
