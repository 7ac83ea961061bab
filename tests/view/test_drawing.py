"""What is drawn: the same solids as every other picture has, at the same places."""

import numpy as np
import pytest

import assur
from assur.numerics import rotations
from assur.scene.companion import companion
from assur.scene.parts import parts
from assur.scene.skeleton import skeleton
from assur.view.drawing import FULL, SolidDrawing, cloud, drawing, places
from catalogue import each


@pytest.mark.parametrize("name", each())
def test_solids_stand_where_the_scene_has_them(name):
    record = assur.load(name)
    home = record.home_values
    found = drawing(record, home)
    shape = skeleton(record, companion(record), home)
    solids = parts(shape, companion(record))
    meshes = [(item.shape.mesh(item.colour).corners.reshape(-1, 3), *shape.frames[item.link]) for item in solids]
    wanted = found.scale * np.concatenate([points @ turn.T + origin for points, turn, origin in meshes])
    got = np.concatenate(
        [cloud(SolidDrawing((item,), (), found.scale), record, home)[item.faces.ravel()] for item in found.solids]
    )
    assert len(got) == len(wanted)
    for axis in range(3):  # the order differs
        assert np.sort(got[:, axis]) == pytest.approx(np.sort(wanted[:, axis]), abs=1e-6 * FULL)
    assert found.scale * np.max(np.ptp(shape.cloud, axis=0)) == pytest.approx(FULL)


def test_vertices_are_shared_within_a_smooth_face_and_not_across_edges():
    record = assur.load("fivebar")
    for solid in drawing(record, record.home_values).solids:
        assert len(solid.vertices) < 3 * len(solid.faces)


def test_letters_are_those_of_the_file_and_stand_apart():
    record = assur.load("zeng2019")
    found = drawing(record, record.home_values)
    stand = places(record, record.home_values, found.scale)
    names = [item.name for item in found.letters]
    assert {"A1", "B1", "C1"} <= set(names) or "A1" in names
    spots = [rotations.from_quaternion(stand[item.link][0]) @ item.at + stand[item.link][1] for item in found.letters]
    for name, spot in zip(names, spots, strict=True):
        assert spot == pytest.approx(found.scale * record.point(name, record.home_values), abs=1e-9)
    gaps = [np.linalg.norm(a - b) for k, a in enumerate(spots) for b in spots[:k]]
    assert min(gaps) > 0.02 * FULL


def test_places_of_several_configurations_at_once():
    record = assur.load("fivebar")
    several = record.inverse([0.0, 200.0]).joints
    stand = places(record, several, 2.0)
    for k, row in enumerate(several):
        one = places(record, row, 2.0)
        for link in record.links:
            assert stand[link][0][k] == pytest.approx(one[link][0])
            assert stand[link][1][k] == pytest.approx(one[link][1])
