"""Strokes between centred joints."""

import numpy as np
import pytest

from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance
from assur.kinematics.closing_blocks.distinguishing import ModeSign
from assur.kinematics.closing_blocks.strokes import stroke_signs
from assur.model.registry import load_record


@pytest.fixture(scope="module")
def tripod():
    record = load_record("three_upu")
    return ScrewColumns(record, assemblies_by_chance(record))


def test_a_stroke_of_a_driven_slide_follows_from_its_input_alone(tripod):
    """So solutions of one direct problem have the same one: a line through all assemblies, whatever else moves."""
    strokes = {sign.slide: sign for sign in stroke_signs(tripod)}
    driven = {entry.coordinate.joint: entry.coordinate.index for entry in tripod.record.inputs}
    assert {*strokes} == {*driven}
    for slide, sign in strokes.items():
        value, share = tripod.values[:, driven[slide]], sign.shares(tripod)
        assert np.ptp(share) > 0.1
        assert np.max(np.abs(np.polyval(np.polyfit(value, share, 1), value) - share)) < 1e-9


def test_strokes_of_driven_slides_alone_are_read_off_inputs(tripod):
    strokes = tuple(stroke_signs(tripod))
    assert ModeSign(strokes).read_off_inputs(tripod.record)
    assert not ModeSign(strokes).read_off_inputs(load_record("planar_3rpr"))
