"""The first camera: all of the mechanism is in the picture, and no smaller than it needs to be."""

import numpy as np
import pytest

import assur
from assur.view.drawing import cloud, drawing
from assur.view.stage import OPENING, ROOM, framed


@pytest.mark.parametrize("name", assur.names())
def test_all_of_a_mechanism_is_in_a_square_picture_and_fills_it(name):
    """By a pinhole camera of our own: where rays to every vertex meet the picture, in halves of its side."""
    record = assur.load(name)
    points = cloud(drawing(record, record.home_values), record, record.home_values)
    camera = framed(points)
    eye, aim, up = (np.array(item) for item in (camera.position, camera.look_at, camera.up))
    ahead = (aim - eye) / np.linalg.norm(aim - eye)
    aside = np.cross(ahead, up) / np.linalg.norm(np.cross(ahead, up))
    rays = points - eye
    picture = np.stack([rays @ aside, rays @ np.cross(aside, ahead)], axis=1) / (rays @ ahead)[:, None]
    reach = np.max(np.abs(picture)) / np.tan(OPENING / 2)
    assert np.min(rays @ ahead) > 0
    assert reach == pytest.approx(ROOM, abs=1e-9)
