"""Where a mode ends: at folds, and where a sign changes by itself."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics.following.ending import Mode
from assur.kinematics.named_signs import named_signs
from assur.model.formula import parse

RECORD = assur.load("fivebar")
START, END = np.array([[0.0, 270.0]]), np.array([[0.0, 300.0]])
JOINTS = RECORD.inverse(START, mode="-+").joints[:, 0]


def test_at_a_fold_the_end_is_exact_and_the_joints_are_a_little_before():
    share, joints = Mode(RECORD, named_signs(RECORD, "inverse", JOINTS[0]), lambda points: points).ends(
        JOINTS, START, END
    )
    exact = (np.sqrt(294.0**2 - 70.0**2) - 270.0) / 30.0
    assert share[0] == pytest.approx(exact, abs=1e-5)
    assert np.all(named_signs(RECORD, "inverse", joints) == named_signs(RECORD, "inverse", JOINTS))


def test_where_a_sign_changes_by_itself_the_way_is_halved():
    """Where a point passes y = 280 nothing turns back; the mode's name alone ends there."""
    modes = replace(RECORD.modes, working={"low": parse("280 - P.y")}, default_working="+")
    record = replace(RECORD, modes=modes)
    share, _ = Mode(record, named_signs(record, "inverse", JOINTS[0]), lambda points: points).ends(JOINTS, START, END)
    assert share[0] == pytest.approx(1 / 3, abs=2**-4)
