import numpy as np
import pytest
from matplotlib.text import Text

import assur
from assur.figures import catalogue as figures
from assur.figures.catalogue import ENTRIES
from assur.figures.coordinates import axis_title, symbol
from assur.kinematics.modes import all_modes
from assur.kinematics.status import scale
from assur.model.pose import is_angle
from assur.workspace.fields import at_points, closed_form_fields
from assur.workspace.region import workspace
from assur.workspace.slices import coordinates
from catalogue import each


def test_the_numbers_are_those_of_the_workspace(context, data):
    found = data("workspace")
    assert found["volume"] == context.workspace.volume
    assert found["mode"] == context.workspace.mode
    assert found["parallel_singular"]["share"] == context.workspace.share


def test_the_drawn_surface_encloses_the_volume(data):
    found = data("workspace")
    corners = found["vertices"][found["faces"]]
    if corners.shape[-1] == 3:
        volume = np.sum(np.linalg.det(corners)) / 6
    else:
        first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        volume = np.sum(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / 2
    assert volume == pytest.approx(found["volume"], rel=1e-6)


def test_the_loci_are_zeros_of_their_factors(context, data):
    fields = closed_form_fields(context.record, context.workspace.mode)[1]
    for item in data("workspace")["loci"]:
        if len(item["vertices"]):
            values = at_points(fields[item["factor"]], len(context.record.platform.pose), item["vertices"])
            factor = next(one for one in context.record.closed_form.factor_list if one.name == item["factor"])
            size = scale(context.record, factor.scale)
            if any(map(is_angle, context.workspace.box.names)):  # whose cells are 15 degrees here
                size = 40 * np.ptp(context.workspace.region.factor_inside(item["factor"]))
            assert np.max(np.abs(values)) < 2e-3 * size


@pytest.mark.parametrize("name", each())
def test_the_workspace_of_every_mechanism_is_drawn_and_says_what_is_held(name):
    record = assur.load(name)
    found = workspace(record, resolution=8)
    given = figures.Context(record, found)
    drawn = figures.drawing(record, "workspace", given)
    assert tuple(drawn.data["coordinates"]) == found.box.names
    texts = " ".join(text.get_text() for axes in drawn.figure.axes for text in axes.findobj(Text))
    for coordinate in found.box.names:
        assert axis_title(given, coordinate) in texts
    caption = next(entry for entry in ENTRIES if entry.name == "workspace").caption(given)
    assert ("held" in caption) == (len(found.box.names) < len(coordinates(record)))
    for held in found.slice.held:
        assert symbol(held) in caption


def test_a_mode_without_any_pose_and_one_that_is_singular_everywhere_are_drawn(context):
    """An empty box corner, and the last working mode, whatever it is."""
    record = context.record
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    far = np.stack([high + 5 * (high - low), high + 6 * (high - low)], axis=1)
    modes = all_modes(record, "inverse")
    for found in (workspace(record, box=far, resolution=8), workspace(record, modes[-1], resolution=12)):
        given = figures.Context(record, found)
        for name in ("workspace", "projections", "sections", "dexterity"):
            if name in figures.names(record, given):
                assert figures.encoded(figures.draw(record, name, given), "png", 40)
