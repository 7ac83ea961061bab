"""The quadratic equations hold for points on circles, rods, sliders, directions and triangles."""

import numpy as np
import pytest

from assur.kinematics.loops.unknowns import UnknownGroup

TURN, LIFT, SLID = np.exp(0.7j), 0.4, 1.7
PLACES = np.array([[0.3, -0.2, 0.9], [1.1, 0.4, -0.5]])
SIDES = tuple(float(side @ side) for side in (*PLACES, PLACES[0] - PLACES[1]))
CIRCLE = [TURN, 1 / TURN]
ROD = [np.cos(LIFT) * TURN, np.cos(LIFT) / TURN, np.sin(LIFT)]

CASES = {
    "circle": (UnknownGroup("circle", 1, 1), CIRCLE, 1),
    "slider": (UnknownGroup("slider", 3, 1, "P"), [*CIRCLE, SLID * TURN, SLID / TURN], 1),
    "rod": (UnknownGroup("rod", 3, 1), [*CIRCLE, *ROD], 1),
    "rod alone": (UnknownGroup("rod", 1, -1, alone=True), ROD, 2),
    "ball": (UnknownGroup("ball", 1, 1, alone=True), list(PLACES[0] / np.linalg.norm(PLACES[0])), 2),
    "triangle": (UnknownGroup("triangle", 1, 1, alone=True, sides=SIDES), list(PLACES.ravel()), 3),
}


@pytest.mark.parametrize("name", CASES)
def test_quadratic_equations_hold_and_their_derivatives_are_independent(name: str) -> None:
    group, unknowns, freedoms = CASES[name]
    row = np.array([1.0, *unknowns])
    assert group.columns[-1] == len(row) - 1
    assert group.freedoms == freedoms
    slopes = []
    for equation in group.quadratic:
        assert abs(sum(factor * row[a] * row[b] for factor, a, b in equation)) < 1e-12
        slope = np.zeros(len(row), dtype=complex)
        for factor, a, b in equation:
            slope[a] += factor * row[b]
            slope[b] += factor * row[a]
        slopes.append(slope[list(group.columns)])
    assert np.linalg.matrix_rank(slopes) == len(group.quadratic)
