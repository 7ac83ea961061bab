"""Exact solids of every shape against volumes known by formula; and what is said where Open CASCADE is missing."""

import sys

import numpy as np
import pytest

from assur.errors import UsageError
from assur.export.cad import kernel
from assur.scene.shapes import Ball, Bar, Cuboid, Cylinder, Slab
from tight_box import bounds

SHAPES = (
    (Cylinder(np.array([0.0, 1, 2]), np.array([3.0, 1, 6]), 0.4), np.pi * 0.16 * 5),
    (Cylinder(np.ones(3), np.ones(3), 0.4), 4 / 3 * np.pi * 0.064),
    (Ball(np.array([1.0, 2, 3]), 0.7), 4 / 3 * np.pi * 0.343),
    (Cuboid(np.array([1.0, 0, 0]), np.diag([1.0, 2.0, 3.0])), 48.0),
    (Bar(np.zeros(3), np.array([2.0, 0, 0]), np.array([0.0, 0, 1]), 0.3, 0.1), 0.1 * (2 * 0.6 + np.pi * 0.09)),
    (Slab(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([0.0, 0, 0.5])), 0.25),
)


@pytest.mark.cad
@pytest.mark.parametrize(("shape", "wanted"), SHAPES)
def test_volume_bounds_and_validity(shape, wanted):
    made = kernel.solid(shape)
    assert kernel.valid(made)
    assert kernel.volume(made) == pytest.approx(wanted, rel=1e-9)
    corners = shape.mesh("#000000").corners.reshape(-1, 3)
    np.testing.assert_allclose(bounds(made), [corners.min(axis=0), corners.max(axis=0)], atol=0.01)


@pytest.mark.cad
def test_a_bore_is_taken_away_and_pieces_are_counted():
    plate = kernel.solid(Cuboid(np.zeros(3), np.diag([4.0, 1.0, 0.5])))
    bore = kernel.solid(Cylinder(np.array([0.0, 0, -1]), np.array([0.0, 0, 1]), 0.5))
    made = kernel.fused([plate], [bore])
    assert kernel.volume(made) == pytest.approx(16 - np.pi * 0.25, rel=1e-9)
    cut = kernel.fused([plate], [kernel.solid(Cuboid(np.zeros(3), np.diag([0.5, 2.0, 2.0])))])
    assert len(kernel.solids_of(cut)) == 2


def test_without_open_cascade_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "OCP", None)
    with pytest.raises(UsageError, match="not installed") as caught:
        kernel.needed()
    assert caught.value.hint == "pip install '.[cad]' in assur's folder"
