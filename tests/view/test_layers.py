"""Layers: what the page packs comes out again."""

import numpy as np
import pytest

import assur
from assur.page.quantised import quantised
from assur.view.layers import layers, unpacked


def test_what_was_packed_comes_out_to_half_a_step():
    rng = np.random.default_rng(3)
    vertices, faces = rng.normal(size=(50, 3)) * [1.0, 100.0, 1e-3], rng.integers(0, 50, size=(30, 3))
    said = {"kind": "workspace", "label": "x", "colour": "#4477aa", "opacity": 0.5}
    found = unpacked({**said, **quantised(vertices, faces)})
    step = np.ptp(vertices, axis=0) / 65535
    assert np.all(np.abs(found.vertices - vertices) <= 0.51 * step)
    assert np.array_equal(found.faces, faces)
    assert not found.lines


def test_the_workspace_of_a_planar_mechanism_lies_in_its_box():
    record = assur.load("fivebar")
    found = layers(record)
    solid = next(item for item in found if item.kind == "workspace")
    for axis, name in enumerate(("x", "y")):
        low, high = record.box[name]
        assert low - 1 <= np.min(solid.vertices[:, axis])
        assert np.max(solid.vertices[:, axis]) <= high + 1
    assert np.ptp(solid.vertices[:, 2]) == pytest.approx(0.0, abs=1e-9)
