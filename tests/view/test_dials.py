"""Dials of every mechanism: they hold home, and what is read is what the pose says."""

import math

import numpy as np
import pytest

import assur
from assur.kinematics.border import inputs_of
from assur.kinematics.pose import pose_of
from assur.model.pose import has_quaternion
from assur.view.dials import Dial, dials, inputs, pose_with, read
from catalogue import each


@pytest.mark.parametrize("name", each())
def test_home_lies_on_every_dial_and_reads_back(name):
    record = assur.load(name)
    home = record.home_values
    for found, here in ((dials(record), read(record, home)), (inputs(record), inputs_of(record, home))):
        for dial, value in zip(found, here, strict=True):
            low, high = dial.ends
            assert low <= dial.shown(value) <= high
            assert dial.inside(dial.shown(value)) == pytest.approx(value, rel=1e-12, abs=1e-12)
    named = dict(zip((item.name for item in dials(record)), read(record, home), strict=True))
    gap = pose_with(record, named) - pose_of(record, home)
    sign = np.sign(gap @ gap - 1) if has_quaternion(record.platform.pose) else -1  # q and -q are one orientation
    assert np.max(np.abs(gap)) < 1e-9 or sign > 0


def test_ends_are_round_numbers_outside_the_range_and_strokes_as_they_are():
    assert Dial("x", -167.157866, 632.7, False, "mm").ends == (-167.2, 632.7)
    assert Dial("x", -167.157866, 632.7, False, "mm", limits=True).ends == (-167.157866, 632.7)
    assert Dial("phi", -math.pi, math.pi, True, "deg").ends == (-180.0, 180.0)


def test_a_step_is_at_most_a_thousandth_of_the_range():
    for span in (1e-3, 0.5, 1.0, 799.0, 3e4):
        dial = Dial("x", 0.0, span, False, "mm")
        assert span / 1e4 <= dial.step * (1 + 1e-9)
        assert dial.step <= span / 1e3 * (1 + 1e-9)
