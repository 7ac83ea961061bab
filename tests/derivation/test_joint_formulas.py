"""Joints' values as formulas: how a rod on a hinge points."""

import numpy as np
import pytest
import sympy

from assur.derivation.joint_formulas import Pointing

SYMBOLS = sympy.symbols("x y z", real=True)


@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize("lean", [sympy.Integer(0), sympy.Rational(3, 5), sympy.Rational(-5, 13)])
def test_both_angles_point_the_rod_along_its_direction(lean, back):
    """The hinge turns the rod's line, which leans along the hinge, and the carrier turns all of it about its axis."""
    level = sympy.sqrt(1 - lean**2)
    pairs = sympy.symbols("a b", real=True), sympy.symbols("c d", real=True)
    own = Pointing(*pairs, *SYMBOLS, back, lean, level, (0, 0, 1))
    sign = -1.0 if back else 1.0
    for first, second in ((0.4, 0.3), (-2.0, 0.9), (2.9, -1.1)):
        inner = np.array([sign * np.cos(second) * float(level), float(lean), np.sin(second) * float(level)])
        turn = np.array([[np.cos(first), -np.sin(first)], [np.sin(first), np.cos(first)]])
        direction = [*(turn @ inner[:2]), inner[2]]
        found = own.at(dict(zip(SYMBOLS, direction, strict=True)))
        numbers = [found[symbol] for pair in pairs for symbol in pair]
        np.testing.assert_allclose(numbers, [np.cos(first), np.sin(first), sign * np.cos(second), np.sin(second)])
