"""The figure of aspects shows the boxes of the result, in colours that stay apart and with labels."""

import dataclasses

import numpy as np
import pytest
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from assur.errors import UsageError
from assur.figures.aspect_parts import traced
from assur.figures.aspects import caption, drawn, no_aspects, shown
from assur.figures.context import Context
from assur.figures.singular import symbol_of
from assur.figures.style import styled
from assur.model.registry import load_record
from assur.workspace.aspects.aspects import aspects
from assur.workspace.region import workspace


def figure(name, path=None, **options):
    record = load_record(name)
    found = aspects(record, **options)
    with styled():
        return found, drawn(Context(record), found, found.path(*path) if path else None)


def area(rectangles):
    return float(np.sum(np.prod(rectangles[:, 2] - rectangles[:, 0], axis=1)))


def enclosed(path):
    """By the shoelace formula: outlines turn one way, holes the other."""
    parts = [polygon.T for polygon in path.to_polygons()]
    return float(sum(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]) for x, y in parts) / 2.0)


def test_each_aspect_is_drawn_to_traced_lines_between_what_is_proved_and_what_may_be():
    found, drawing = figure("zeng2019", finest=4.0)
    for item, data in zip(found.aspects, drawing.data["aspects"], strict=True):
        assert data["label"] == item.label
        assert area(data["rectangles"][0]) * 500.0 == pytest.approx(item.volume[0], rel=1e-9)
    axes = drawing.figure.axes[0]
    whole, *parts = [part for part in axes.patches if isinstance(part, PathPatch)]
    assert len(parts) == len(found.aspects) == len({part.get_facecolor() for part in parts})
    for part, item, data in zip(parts, found.aspects, drawing.data["aspects"], strict=True):
        assert area(data["rectangles"][0]) < enclosed(part.get_path()) < item.volume[1] / 500.0
    assert sum(enclosed(part.get_path()) for part in parts) == pytest.approx(enclosed(whole.get_path()), rel=1e-4)
    assert [text.get_text().replace(" ", "").replace("−", "-") for text in axes.texts] == [
        item.label for item in found.aspects
    ]
    assert axes.get_xlim() == pytest.approx((-110.0, 90.0))
    lines = Path.make_compound_path(*(Path(line, closed=True) for line in axes.collections[0].get_segments()))
    proved = sum(area(data["rectangles"][0]) for data in drawing.data["aspects"])
    assert proved < enclosed(lines) < proved + area(drawing.data["undecided"][0])
    assert "undecided" not in [text.get_text() for text in drawing.figure.legends[0].get_texts()]


@pytest.mark.deep
def test_a_part_of_other_sign_in_which_nothing_is_proved_is_grey():
    """Boxes of 9 mm find no third aspect of the five-bar in the box of 600 mm, those of 2 mm do: where it was grey."""
    record, box = load_record("fivebar"), {"x": (-300, 300), "y": (-300, 300)}
    coarse, fine = (traced(Context(record), aspects(record, "-+", box, finest=size), None) for size in (9.0, 2.0))
    assert [part.aspects for part in coarse.parts] == [(0,), (1,)]
    assert [part.aspects for part in fine.parts] == [(0,), (1,), (2,)]
    assert coarse.open
    assert not fine.open
    assert coarse.area - sum(part.area for part in coarse.parts) == pytest.approx(fine.parts[2].area, rel=1e-6)


def test_space_is_cut_and_each_cut_shows_what_lies_in_it():
    found, drawing = figure("linear_delta_4r", finest=40.0)
    assert drawing.data["cuts"] == list(load_record("linear_delta_4r").sections)
    assert len(drawing.figure.axes) == len(drawing.data["cuts"]) == 3
    boxes = found.aspects[0].boxes
    for value, rectangles in zip(drawing.data["cuts"], drawing.data["aspects"][0]["rectangles"], strict=True):
        within = (boxes.low[2] <= value) & (value < boxes.high[2])
        sizes = np.prod((boxes.high - boxes.low)[:2], axis=0)
        assert area(rectangles) == pytest.approx(float(np.sum(sizes[within])), rel=1e-12)


def test_a_path_is_drawn_in_a_plane():
    found, drawing = figure("fivebar", ([0, 200], [50, 150]), finest=9.0)
    line = drawing.figure.axes[0].lines[0].get_xydata()
    assert np.array_equal(line, drawing.data["path"])
    assert len(found.aspects) == 1


def test_the_caption_names_the_signs():
    record = load_record("fivebar")
    text = caption(Context(record), aspects(record, finest=20.0))
    (factor,) = [item for item in record.closed_form.factor_list if item.name == "sin_rods"]
    assert f"named by the signs of {symbol_of(factor)}." in text
    assert "is undecided and lies along the lines" in text


def test_the_caption_says_how_much_of_the_workspace_is_proved_and_how_much_is_not():
    """Shares are of what solids say that the workspace is, not of the box, of which this one fills a twelfth."""
    record = load_record("planar_3rrr")
    context = Context(record)
    found, whole = context.aspects, workspace(record, resolution=48).volume
    proved = sum(item.volume[0] for item in found.aspects)
    assert found.search.open < 0.1
    assert 1 - proved / whole > 0.6
    assert 1 - proved / whole <= found.undecided_share < 0.8
    text = caption(context, found)
    assert f"or {100 - float(shown(100 * found.undecided_share)):.4g} % of the workspace" in text
    assert f"at most {shown(100 * found.undecided_share)} %" in text


def test_the_caption_says_where_nothing_is_proved():
    record = load_record("fivebar")
    assert "No part is proved" in caption(Context(record), aspects(record, finest=2000.0))


def test_the_share_that_is_undecided_is_rounded_up():
    assert [shown(value) for value in (35.71, 0.0123, 100.0, 0.0)] == ["36", "0.013", "100", "0"]


def test_the_catalogue_has_it_where_a_closed_form_proves_it():
    record = load_record("fivebar")
    assert no_aspects(Context(record)) == ""
    assert "closed form" in no_aspects(Context(dataclasses.replace(record, closed_form=None)))
    assert "no interval" in no_aspects(Context(dataclasses.replace(record, box={})))


def test_many_aspects_do_not_fill_the_legend():
    """A dozen of labels: the largest are named, the others counted."""
    record = load_record("fivebar")
    found = aspects(record, "-+", {"x": (-300, 300), "y": (-300, 300)}, finest=9.0)
    many = dataclasses.replace(found, aspects=found.aspects * 6)
    with styled():
        texts = [text.get_text() for text in drawn(Context(record), many).figure.legends[0].get_texts()]
    assert len(many) == 12
    assert texts[10:] == ["and 2 smaller ones", "undecided"]


def test_one_coordinate_is_no_picture():
    with pytest.raises(UsageError, match="a picture needs two"):
        figure("fivebar", held={"x": 0.0})
