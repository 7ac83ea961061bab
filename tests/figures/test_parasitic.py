"""The maps of parasitic motion against the formula of the 3-RPS, and who has none."""

import numpy as np
import pytest

import assur
from assur.figures import catalogue as figures
from assur.figures.parasitic import PARASITIC, maps
from assur.workspace.region import workspace

TILT = 0.35
BOX = {"z": (220.0, 280.0), "theta": (-TILT, TILT), "psi": (-TILT, TILT)}


@pytest.fixture(scope="module")
def context():
    record = assur.load("three_rps")
    return figures.Context(record, workspace(record, box=BOX, resolution=8))


def test_the_map_shows_what_the_formula_says(context):
    found = maps(context)
    assert (found.plane.names, found.plane.held) == (("theta", "psi"), {"z": 250.0})
    across, up = np.meshgrid(found.plane.xs, found.plane.ys)
    expected = np.arctan2(np.sin(across) * np.sin(up), np.cos(across) + np.cos(up))
    np.testing.assert_allclose(found.values["phi"], expected, atol=1e-12)


def test_each_coordinate_has_a_map_whose_colours_are_as_wide_as_its_values(context):
    drawing = figures.drawing(context.record, "parasitic", context)
    found = maps(context)
    assert list(found.values) == ["x", "y", "phi"]
    drawn = [axes for axes in drawing.figure.axes if axes.get_xlabel()]
    assert len(drawn) == 3
    for axes, (name, values) in zip(drawn, found.values.items(), strict=True):
        (image,) = [mesh for mesh in axes.collections if mesh.get_array() is not None]
        most = np.max(np.abs(values)) * (180 / np.pi if name == "phi" else 1.0)
        assert image.get_clim() == pytest.approx((-most, most))
    assert drawing.data["largest"]["phi"]["value"] == found.largest["phi"].value


def test_the_caption_says_where_it_is_largest(context):
    caption = PARASITIC.caption(context)
    degrees = np.degrees(abs(maps(context).largest["phi"].value))
    assert f"{round(degrees, 4):g}°" in caption  # an angle is written to four decimals
    assert "20.0535°" in caption


@pytest.mark.parametrize("name", ["fivebar", "planar_3rrr", "zeng2019"])
def test_where_nothing_else_moves_there_is_no_map(name):
    record = assur.load(name)
    assert "parasitic" not in figures.names(record)
    assert figures.left_out(record)["parasitic"] == "nothing moves that the pose leaves out"
