"""The largest parasitic motion, with and without a closed form."""

from dataclasses import replace

import pytest

import assur
from assur.kinematics.parasitic import parasitic
from assur.workspace.parasitic import largest_parasitic
from assur.workspace.region import workspace

RECORD = assur.load("three_rps")
TILT = 0.35
BOX = {"z": (220.0, 280.0), "theta": (-TILT, TILT), "psi": (-TILT, TILT)}


def test_both_routes_find_the_corner_at_which_it_is_largest():
    expected = {name: abs(float(value)) for name, value in parasitic(RECORD, [250.0, TILT, TILT]).items()}
    for record in (RECORD, replace(RECORD, closed_form=None)):
        found = largest_parasitic(record, workspace(record, box=BOX, resolution=6))
        assert abs(found["phi"].value) == pytest.approx(expected["phi"], rel=1e-6)
        assert abs(found["y"].value) == pytest.approx(expected["y"], rel=1e-6)
        assert abs(found["x"].value) >= expected["x"]
        assert abs(found["phi"].at["theta"]) == pytest.approx(TILT)
        assert abs(found["phi"].at["psi"]) == pytest.approx(TILT)


def test_it_is_that_value_at_the_place_that_is_named():
    found = largest_parasitic(RECORD, workspace(RECORD, box=BOX, resolution=6))
    for name, item in found.items():
        there = parasitic(RECORD, [item.at["z"], item.at["theta"], item.at["psi"]])
        assert float(there[name]) == pytest.approx(item.value, abs=1e-12)


def test_what_stands_still_is_not_named():
    record = assur.load("planar_3rrr")
    assert largest_parasitic(record, workspace(record, resolution=6)) == {}


def test_an_empty_region_has_none():
    found = workspace(RECORD, box=BOX, strokes={item.name: (1.0, 2.0) for item in RECORD.inputs}, resolution=6)
    assert found.volume == 0.0
    assert largest_parasitic(RECORD, found) == {}
