"""Zero is told by values modulo a prime: roots agree among each other, and what has none is drawn anew."""

import sympy

from assur.derivation.witness import ModularWitness

A, B, COSINE, SINE = sympy.symbols("a b c s")


def test_roots_of_rationals_agree_among_each_other():
    witness = ModularWitness(2)
    assert witness.is_zero(sympy.Pow(6, sympy.Rational(1, 2), evaluate=False) - sympy.sqrt(2) * sympy.sqrt(3))
    assert witness.is_zero(2 * sympy.cos(sympy.pi / 6) - sympy.sqrt(3))
    assert not witness.is_zero(sympy.sqrt(2) + sympy.sqrt(3) - sympy.sqrt(5))


def test_a_point_of_the_unit_circle_is_one_and_nothing_else():
    witness = ModularWitness(3)
    witness.on_circle(COSINE, SINE)
    assert witness.is_zero(COSINE**2 + SINE**2 - 1)
    assert not witness.is_zero(COSINE**2 - SINE**2)
    assert witness.is_zero(sympy.cos(2 * A) - 1 + 2 * sympy.sin(A) ** 2)


def test_what_has_no_root_is_drawn_anew_until_it_has():
    witness = ModularWitness(4)
    inner, outer, last = sympy.symbols("r1 r2 r3")
    witness.define(inner, sympy.sqrt(A))
    witness.define(outer, sympy.sqrt(B + inner))
    witness.define(last, sympy.sqrt(A + outer))
    assert witness.is_zero(inner**2 - A)
    assert witness.is_zero(last**2 - A - outer)
    assert witness.is_zero(outer**2 - B - inner)


def test_the_rank_is_that_of_formulas_and_not_of_numbers():
    witness = ModularWitness(5)
    assert witness.rank([[A, B], [A * B, B**2]]) == 1
    assert witness.rank([[A, B], [B, A]]) == 2
