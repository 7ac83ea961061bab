"""The largest parasitic motion, with and without a closed form."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
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
        assert found["phi"] == pytest.approx(expected["phi"], rel=1e-6)
        assert found["y"] == pytest.approx(expected["y"], rel=1e-6)
        assert found["x"] >= expected["x"]


def test_an_empty_region_has_none():
    found = workspace(RECORD, box=BOX, strokes={item.name: (1.0, 2.0) for item in RECORD.inputs}, resolution=6)
    assert found.volume == 0.0
    assert all(np.isnan(value) for value in largest_parasitic(RECORD, found).values())
