"""Circles that the linear equations make one: a hinged parallelogram between bodies that keep their orientations."""

from pathlib import Path

import numpy as np
import pytest

import assur
from assur.kinematics.loops.alike import alike_merged
from assur.kinematics.loops.circles import system
from assur.kinematics.loops.orientations import turnings
from assur.kinematics.loops.parallelograms import parallelograms
from assur.kinematics.loops.solving import CurveError, solve


def test_cranks_of_a_par4_are_one_circle_and_without_that_a_curve() -> None:
    mechanism = assur.load(Path(__file__).parent / "par4.toml")
    locked = dict.fromkeys(mechanism.input_indices, 0.3)
    (turning,) = turnings(mechanism, locked, None, parallel=tuple(parallelograms(mechanism)))
    equations = system(mechanism, turning, locked, {})
    with pytest.raises(CurveError):
        solve(equations)
    merged = alike_merged(equations)
    assert len(merged.groups) == len(equations.groups) - 1
    assert merged.turnings["cpl1"].circle == merged.turnings["cpl2"].circle
    assert solve(merged).looked == 8


def test_circles_that_are_two_stay_two() -> None:
    mechanism = assur.load("planar_3rrr")
    locked = dict.fromkeys(mechanism.input_indices, 0.3)
    (turning,) = turnings(mechanism, locked, None, parallel=())
    equations = system(mechanism, turning, locked, {})
    assert alike_merged(equations) is equations
    assert np.array_equal(alike_merged(equations).matrix, equations.matrix)
