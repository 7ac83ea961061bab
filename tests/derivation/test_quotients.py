"""Quotients by python-flint against SymPy's own, at random formulas."""

import random

import pytest
import sympy

from assur.derivation.quotients import cancelled, primitive

A, B, C = sympy.symbols("a b c")
PARTS = (A, B, C, A + 2 * B, A - C, sympy.sqrt(3) * A + B, sympy.cos(C) * A - 1, sympy.Rational(2, 3) * B)


def formula(field, size=4):
    parts = [field.choice(PARTS) for _ in range(size)]
    return parts[0] * parts[1] / parts[2] + parts[3] / (parts[1] * parts[2])


@pytest.mark.parametrize("seed", range(12))
def test_a_formula_keeps_its_value_and_has_one_denominator(seed):
    own = formula(random.Random(seed))
    short = cancelled(own)
    numbers = {A: 0.31, B: 1.7, C: -0.9}
    assert complex(short.subs(numbers)) == pytest.approx(complex(own.subs(numbers)), rel=1e-12)
    over, under = sympy.fraction(sympy.cancel(sympy.together(own)))
    mine = sympy.fraction(sympy.together(short))
    assert len(sympy.Add.make_args(sympy.expand(mine[1]))) <= len(sympy.Add.make_args(sympy.expand(under)))
    assert sympy.expand(mine[0] * under - over * mine[1]) == 0


def test_a_row_loses_what_all_of_it_shares():
    assert primitive([A * B / C, A**2 / 3, sympy.Integer(0)]) == [3 * B, A * C, 0]


def test_roots_of_numbers_are_squared():
    assert cancelled((sympy.sqrt(3) * A + 1) * (sympy.sqrt(3) * A - 1)) == 3 * A**2 - 1
