"""The areas of sections by solids, with their errors, against bounds that intervals prove."""

import numpy as np
import pytest

import assur
from assur.workspace.certified.criteria import criteria
from assur.workspace.certified.paving import pave
from assur.workspace.domain import Box
from assur.workspace.region import workspace

GAP = 1e-3
PLACES = {
    "zeng2019": (330.0, 350.0, 400.0, 450.0),
    "orthoglide": (23.7, 179.2, 207.0552),
    "delta_4s": (-1.2, -0.672),
    "three_upu": (140.2, 225.0),
    "three_rps": (-0.6, 0.19),
    "three_crr": (206.7, 311.6),
}
"""Cuts, among them such at which one cut alone at two resolutions agrees by chance with one that is wrong."""


def proved(record, found, value):
    """Bounds of the area of a cut across the last coordinate."""
    last, box = found.box.names[-1], found.box
    rest = Box(box.names[:-1], box.low[:-1], box.high[:-1])
    paving = pave(criteria(record, found.mode, None, {**found.slice.held, last: value}), rest, GAP)
    return paving.low, paving.high


@pytest.mark.parametrize(
    ("name", "resolution"),
    [
        *((name, 32) for name in PLACES if name != "orthoglide"),
        *(
            pytest.param(*case, marks=pytest.mark.deep)
            for case in (("zeng2019", 64), ("orthoglide", 32), ("orthoglide", 64))
        ),
    ],
)
def test_the_error_of_an_area_reaches_the_proved_bounds(name, resolution):
    """The bounds are up to a thousandth apart, so that the area with its error has to meet them."""
    record = assur.load(name)
    found = workspace(record, resolution=resolution, sections=PLACES[name])
    for item in found.sections:
        low, high = proved(record, found, item.value)
        assert item.area - item.area_error <= high
        assert item.area + item.area_error >= low
        assert item.area_error <= 0.05 * item.area + 1e-2 * np.prod(np.subtract(found.box.high, found.box.low)[:2])
