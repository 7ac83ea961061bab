import dataclasses

import numpy as np
import pytest

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import inputs_of
from assur.kinematics.pose import pose_of
from assur.kinematics.turns import counted
from assur.mechanism import load
from assur.page.graph import coordinates
from assur.page.ranges import input_ranges, pose_ranges, whole_turn
from catalogue import each
from screw_mechanisms import FIVEBAR, loaded


@pytest.mark.parametrize("name", each())
def test_home_lies_on_every_slider(name):
    record = load(name)
    for ranges, home in (
        (input_ranges(record), inputs_of(record, record.home_values)),
        (pose_ranges(record), pose_of(record, record.home_values)),
    ):
        low, high = np.array(ranges).T
        assert np.all(low < high)
        assert np.all((low <= home) & (home <= high))


@pytest.mark.parametrize("name", each())
def test_a_stroke_is_what_its_slider_covers(name):
    record = load(name)
    for item, (low, high) in zip(record.inputs, input_ranges(record), strict=True):
        if item.stroke is not None:
            assert (low, high) == item.stroke


def test_without_a_stroke_it_covers_what_the_workspace_needs():
    record = load("zeng2019")
    low, high = np.array(input_ranges(record)).T
    grid = np.stack(np.meshgrid(*(np.linspace(*record.box[n], 12) for n in "xyz"), indexing="ij"), axis=-1)
    found = record.inverse(grid.reshape(-1, 3), "++-++")
    needed = found.inputs[found.exists]
    inside = np.mean((low <= needed) & (needed <= high))
    assert inside > 0.99
    assert np.all(high - low < 1.2 * np.ptp(needed, axis=0))


@pytest.mark.parametrize("name", each())
def test_an_angle_without_a_stroke_has_a_whole_turn_with_round_ends_and_home_well_inside(name):
    record = load(name)
    home = inputs_of(record, record.home_values)
    for item, (low, high), here in zip(record.inputs, input_ranges(record), home, strict=True):
        if item.coordinate.kind == "angle" and item.stroke is None:
            assert np.degrees([low, high]) % 180 == pytest.approx(0, abs=1e-9)
            assert high - low == pytest.approx(2 * np.pi)
            assert min(here - low, high - here) >= np.pi / 4


@pytest.mark.parametrize("degrees", [-300.0, -180.0, 0.0, 134.0, 136.0, 179.0, 181.0, 360.0, 725.0])
def test_a_turn_lies_around_zero_where_home_is_well_inside(degrees):
    low, high = np.degrees(whole_turn(np.radians(degrees)))
    assert min(degrees - low, high - degrees) >= 45 - 1e-9
    assert ((low, high) == pytest.approx((-180, 180))) == (abs(degrees) <= 135)


@pytest.mark.parametrize("name", each())
def test_a_length_without_a_stroke_has_round_ends(name):
    record = load(name)
    for item, ends in zip(record.inputs, input_ranges(record), strict=True):
        if item.coordinate.kind == "length" and item.stroke is None:
            step = 10.0 ** np.floor(np.log10((ends[1] - ends[0]) / 25))
            assert np.allclose(np.array(ends) / step, np.round(np.array(ends) / step), rtol=0, atol=1e-6)


def test_without_a_box_lengths_lie_around_home(drafted):
    record = load(drafted)
    record = dataclasses.replace(record, box={})
    home = pose_of(record, record.home_values)
    low, high = np.array(pose_ranges(record)).T
    length = characteristic_length(record)
    assert np.all((home - low >= length) & (high - home >= length))
    assert np.all((home - low < 1.2 * length) & (high - home < 1.2 * length))


def test_the_slider_of_a_screw_covers_turns(tmp_path):
    """130 mm, the longest link, is 13 turns of 10 mm, and 26 of 5 mm."""
    record = loaded(tmp_path, FIVEBAR)
    assert np.allclose(input_ranges(record), 2 * np.pi * np.array([[-13.0, 13.0], [-26.0, 26.0]]))
    assert [item["counted"] for item in coordinates(record)] == [bool(item) for item in counted(record)]


def test_the_page_weighs_screws_by_their_leads(tmp_path):
    """A turn of the first screw is 10 mm: a rad of it is a share of 10 mm / 2 pi of the longest link, 130 mm."""
    record = loaded(tmp_path, FIVEBAR)
    sizes = {item["label"]: item["size"] / (2 * np.pi) for item in coordinates(record)}
    assert [sizes[name] for name in ("M1", "S1", "M2", "S2")] == pytest.approx([13.0, 13.0, 26.0, 26.0])
