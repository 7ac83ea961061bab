"""Quadrics of directions whose components are linear in a few unknowns, modulo the circle that is taken as known."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy

from assur.derivation.linear import ONE, Form, tidy, value_of
from assur.derivation.trigonometric import reduced
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness

ZERO = sympy.Integer(0)


def reduced_quadric(
    direction: UnknownDirection,
    values: Mapping[sympy.Symbol, Form],
    base: UnknownDirection,
    unknowns: Sequence[sympy.Symbol],
    witness: ModularWitness,
) -> Form:
    """The quadric modulo the circle of the base, with a symbol for each product of two unknowns."""
    return reduced_form(quadric_form(direction, values, unknowns), base, witness)


def quadric_form(
    direction: UnknownDirection, values: Mapping[sympy.Symbol, Form], unknowns: Sequence[sympy.Symbol]
) -> Form:
    """The quadric, with a symbol for each product of two unknowns."""
    total: Form = {ONE: -direction.square}
    for own in direction.unknowns:
        inner = [key for key in unknowns if key in values[own]]
        rest = value_of({key: part for key, part in values[own].items() if key not in inner})
        for k, a in enumerate(inner):
            for b in inner[k:]:
                share = values[own][a] * values[own][b] * (1 if a == b else 2)
                total[product_symbol(a, b)] = total.get(product_symbol(a, b), ZERO) + share
            total[a] = total.get(a, ZERO) + 2 * values[own][a] * rest
        total[ONE] += rest**2
    return total


def product_symbol(a: sympy.Symbol, b: sympy.Symbol) -> sympy.Symbol:
    """The symbol of a product of two unknowns."""
    return sympy.Symbol("*".join(sorted((a.name, b.name))), real=True)


def reduced_form(form: Form, base: UnknownDirection, witness: ModularWitness) -> Form:
    """Coefficients modulo the circle of the base, without those that vanish."""
    plain = {key: reduced(tidy(part), base.unknowns, witness) for key, part in form.items()}
    return {key: part for key, part in plain.items() if part != 0}
