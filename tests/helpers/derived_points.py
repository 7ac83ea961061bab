"""Branches of a derived direct problem in numbers."""

import itertools

import numpy as np
import sympy

from assur.derivation.solution import analytic_solution
from assur.derivation.symbols import circle_of
from assur.kinematics.home import home_values


def inputs_near_home(record):
    """Printed inputs (n,), each moved a little: lengths by 5, angles by 0.1 rad."""
    home = home_values(record)
    moved = np.linspace(-1.0, 1.0, len(record.inputs))
    return np.array([
        float(own.printed(home[own.coordinate.index])) + share * (5.0 if own.coordinate.kind == "length" else 0.1)
        for own, share in zip(record.inputs, moved, strict=True)
    ])  # fmt: skip


def derived_points(record, inputs):
    """The platform's point (N, 3) of each real branch of the direct problem."""
    solution = analytic_solution(record, "direct")
    given = {symbol: record.parameters[name].inside for name, symbol in solution.symbols.parameters.items()}
    for own, value in zip(record.inputs, inputs, strict=True):
        given |= (
            {sympy.Symbol(own.name, real=True): float(value)} if own.coordinate.kind == "length"
            else dict(zip(circle_of(own.name), (float(np.cos(value)), float(np.sin(value))), strict=True))
        )  # fmt: skip
    points = []
    for signs in itertools.product((1, -1), repeat=len(solution.roots)):
        turned = {root.symbol: sign for root, sign in zip(solution.roots, signs, strict=True)}
        values = dict(given)
        for own in solution.definitions:
            values[own.symbol] = turned.get(own.symbol, 1) * complex(sympy.N(own.formula, 20, subs=values))
        point = np.array([complex(sympy.N(part, 20, subs=values)) for part in solution.point])
        if np.max(np.abs(point.imag)) < 1e-9:
            points.append(point.real)
    return np.array(points)
