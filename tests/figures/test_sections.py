import re

import numpy as np
import pytest

from assur.figures.catalogue import spec
from assur.workspace.fields import at_points

pytestmark = pytest.mark.parametrize("context", ["zeng2019"], indirect=True)
"""The one whose file names sections."""


def shoelace(polygons):
    total = 0.0
    for polygon in polygons:
        x, y = np.asarray(polygon).T
        total += float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) / 2
    return total


def test_the_sections_are_those_of_the_file(context, data):
    name = context.record.platform.pose[-1]
    assert [item[name] for item in data("sections")["sections"]] == list(context.record.sections)


def test_areas_are_those_of_the_polygons_and_of_the_workspace(context, data):
    for item, section in zip(data("sections")["sections"], context.workspace.sections, strict=True):
        assert item["area"] == section.area
        assert shoelace(item["polygons"]) == pytest.approx(item["area"], rel=1e-9)


def test_areas_by_counting_poses_at_which_no_margin_is_negative(context, data):
    """A second route: midpoints of 500 x 500 cells, which miss at most the cells of the border."""
    names = context.record.platform.pose
    box = context.workspace.box
    for item in data("sections")["sections"]:
        axes = [np.linspace(*box.intervals[names.index(name)], 501) for name in item["plane"]]
        middles = [(axis[1:] + axis[:-1]) / 2 for axis in axes]
        grid = np.full((500, 500, 3), item[names[-1]])
        grid[..., names.index(item["plane"][0])] = middles[0][:, None]
        grid[..., names.index(item["plane"][1])] = middles[1]
        points = grid.reshape(-1, 3)
        inside = np.all([at_points(field, 3, points) >= 0 for field in context.workspace.margins.values()], axis=0)
        cell = np.prod([axis[1] - axis[0] for axis in axes])
        assert item["area"] == pytest.approx(inside.sum() * cell, abs=2 * 500 * cell)


def test_the_areas_that_are_printed_hold_the_proved_bounds(context, data):
    """Of the number and its error as text, against the certificate of the same workspace."""
    caption = spec(context.record, "sections", context).caption
    printed = re.findall(r"([\d ]+(?:\.\d+)?) ± ([\d ]+(?:\.\d+)?)", caption)
    assert len(printed) == len(context.workspace.sections) == len(context.bounds.sections)
    for (value, error), item in zip(printed, context.bounds.sections, strict=True):
        middle, half = (float(text.replace(" ", "")) for text in (value, error))
        assert middle - half <= item.area[0] <= middle <= item.area[1] <= middle + half
    assert "with bounds that are proved" in caption
