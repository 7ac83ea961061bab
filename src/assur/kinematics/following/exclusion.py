"""Exclusion: what proves that solutions are not of home's mode, though no path was followed to them.

Two things never change in a mode. The signs that the file names it by, which is what names mean; and whatever stands
still about home: an analytic function of the configuration that is constant there is so on every regular path. So a
platform that home's mode never turns over is in another mode where it is.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem
from assur.kinematics.naming import declared_signs
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
MERGED = 1e-6
"""A quantity that names a mode has no sign below this, in rad or characteristic lengths."""


def of_other_signs(record: MechanismRecord, problem: Problem, joints: FloatArray) -> BoolArray:
    """Which joint values (N, n) bear a sign that is the opposite of home's; false for all where modes have none."""
    home, others = (declared_signs(record, problem, values, MERGED) for values in (home_values(record), joints))
    return np.asarray(np.any(others * home < 0, axis=1))
