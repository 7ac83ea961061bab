"""Branches of a derived direct problem in numbers."""

import itertools

import numpy as np
import sympy

from assur.derivation.closed_form_formulas import ClosedFormFormulas
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
    given = {}
    for own, value in zip(record.inputs, inputs, strict=True):
        given |= (
            {sympy.Symbol(own.name, real=True): float(value)} if own.coordinate.kind == "length"
            else dict(zip(circle_of(own.name), (float(np.cos(value)), float(np.sin(value))), strict=True))
        )  # fmt: skip
    return np.array([[values(part) for part in solution.point] for values in real_branches(solution, given)])


def derived_inputs(record, pose):
    """Printed inputs (n,), angles in rad, of each real branch of the inverse problem at a pose of lengths (m,)."""
    solution = analytic_solution(record, "inverse")
    given = {
        sympy.Symbol(name, real=True): float(value) for name, value in zip(record.platform.pose, pose, strict=True)
    }
    lengths = solution.loops.lengths
    if all(own.coordinate.index in lengths for own in record.inputs):
        formulas = [own.printed(lengths[own.coordinate.index]) for own in record.inputs]
    else:
        formulas = ClosedFormFormulas(solution, solution, {}).input_pairs
    for values in real_branches(solution, given):
        yield [
            np.arctan2(values(part[1]), values(part[0])) if isinstance(part, tuple) else values(part)
            for part in formulas
        ]


def real_branches(solution, given):
    """What works out formulas, at each branch whose values are real."""
    record = solution.symbols.record
    given = given | {symbol: record.parameters[name].inside for name, symbol in solution.symbols.parameters.items()}
    for signs in itertools.product((1, -1), repeat=len(solution.roots)):
        turned = {root.symbol: sign for root, sign in zip(solution.roots, signs, strict=True)}
        values = dict(given)
        for own in solution.definitions:
            values[own.symbol] = turned.get(own.symbol, 1) * complex(sympy.N(own.formula, 20, subs=values))
        if all(abs(complex(value).imag) < 1e-9 for value in values.values()):
            yield lambda part, known=values: complex(sympy.N(part, 20, subs=known)).real
