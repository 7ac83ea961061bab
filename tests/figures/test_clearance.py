"""The picture of the closest pair: both links in their colours, and the gap as long as the clearance says."""

import io
from functools import cache

import numpy as np
import pytest
from matplotlib.text import Text
from PIL import Image

import assur
from assur.figures import clearance
from assur.figures.clearance import PAIR, drawn
from assur.figures.encode import encoded
from assur.figures.style import RED, styled
from assur.scene.collisions import collisions
from assur.scene.mesh import rgb
from assur.scene.sizes import with_thickness


@cache
def made(name, thick=None, **dimensions):
    """The picture of the closest pair of a mechanism at home, and the pair."""
    record = assur.load(name, **dimensions)
    record = record if thick is None else with_thickness(record, thick)
    item = collisions(record, record.home_values[None]).pairs[0]
    with styled():
        return drawn(record, item), item


def pixels(figure):
    with styled():
        return np.asarray(Image.open(io.BytesIO(encoded(figure, "png", 100))).convert("RGB"), dtype=float) / 255


def hues(image, colour):
    """How many pixels have a colour, lit or not: its direction among colours."""
    wanted = rgb(colour) - rgb(colour).mean()
    found = image - image.mean(axis=2, keepdims=True)
    size = np.linalg.norm(found, axis=2)
    cosine = found @ wanted / np.maximum(size * np.linalg.norm(wanted), 1e-9)
    return int(np.sum((cosine > 0.97) & (size > 0.15)))


@pytest.mark.parametrize("name", ["fivebar", "zeng2019", pytest.param("three_upu", marks=pytest.mark.deep)])
def test_the_gap_is_between_the_two_links_and_as_long_as_it_is_said(name):
    picture, item = made(name)
    gap = picture.data["ends"]
    assert np.linalg.norm(gap[1] - gap[0]) == pytest.approx(item.clearance, rel=1e-3)
    words = " ".join(text.get_text() for text in picture.figure.findobj(Text))
    assert f"{item.clearance:.4g} {assur.load(name).unit}" in words
    assert all(link in words for link in item.links)
    image = pixels(picture.figure)
    for colour in PAIR:
        assert hues(image, colour) > 100
    assert hues(image[:, image.shape[1] // 2 :], RED) > 10


def test_links_that_meet_have_a_ring_where_they_do():
    picture, item = made("fivebar", 10.0, g=3.0)  # the feet of both cranks are nearer than their pins are thick
    assert item.clearance == 0.0
    words = " ".join(text.get_text() for text in picture.figure.findobj(Text))
    assert "meet" in words
    assert "as near as" not in words


def test_the_gap_is_seen_from_where_it_is_drawn(monkeypatch):
    """A camera that looks along the gap is not taken, although it is the usual one."""
    cameras = []
    original = clearance._camera

    def kept(*arguments):
        cameras.append((original(*arguments), arguments[2]))
        return cameras[-1][0]

    monkeypatch.setattr(clearance, "_camera", kept)
    record = assur.load("zeng2019")
    item = collisions(record, record.home_values[None]).pairs[0]
    gap = clearance.ends(record, item)
    way = (gap[1] - gap[0]) / np.linalg.norm(gap[1] - gap[0])
    along = clearance.orthographic(np.degrees(np.arctan2(way[1], way[0])), np.degrees(np.arcsin(way[2])))
    monkeypatch.setattr(clearance, "model_camera", lambda _: along)
    with styled():
        drawn(record, item)
    ((camera, ends),) = cameras
    seen = np.linalg.norm(camera.project(ends[1] - ends[0])) / np.linalg.norm(ends[1] - ends[0])
    assert seen >= clearance.TRUE
