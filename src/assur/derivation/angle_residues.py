"""Eliminants modulo a prime: at a witness they are polynomials in t with residues as coefficients."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy
from flint import fmpz_mod_ctx, fmpz_mod_poly, fmpz_mod_poly_ctx

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.witness import Element, ModularWitness, NoResidueRootError

WHOLE = sympy.Symbol("1 + t^2")
"""Stands for 1 in homogeneous polynomials."""


def residues(
    eliminant: AngleEliminant, witness: ModularWitness, backward: bool = False
) -> dict[sympy.Symbol, fmpz_mod_poly]:
    """Each entry and each step as a polynomial in t, with the powers of 1 + t^2 that it has; and what follows of them.

    Errors:
        NoResidueRootError: what is known is no residue, but one times the root of -1.
    """
    ring = fmpz_mod_poly_ctx(fmpz_mod_ctx(witness.field.p))
    cosine, sine = eliminant.direction.unknowns
    known: dict[sympy.Symbol, Any] = {cosine: ring([1, 0, -1]), sine: ring([0, 2]), WHOLE: ring([1, 0, 1])}
    for own in (*eliminant.program(WHOLE), *(eliminant.backward_program(WHOLE) if backward else ())):
        known[own.symbol] = ring([0]) + _value(own.formula, known, witness)
    return known


def polynomial(eliminant: AngleEliminant, witness: ModularWitness) -> tuple[fmpz_mod_poly, int]:
    """The eliminant without the powers of 1 + t^2, and how many these are. Errors: NoResidueRootError."""
    known = residues(eliminant, witness)
    own, circle, spare = known[eliminant.steps[-1].symbol], known[WHOLE], 0
    while own != 0 and own % circle == 0:
        own, spare = own // circle, spare + 1
    return own, spare


def _value(formula: sympy.Expr, known: Mapping[sympy.Symbol, Any], witness: ModularWitness) -> Any:
    if formula in known:
        return known[formula]
    if not formula.free_symbols & known.keys():
        real, imaginary = witness.value(formula)
        if imaginary:
            raise NoResidueRootError("a coefficient that is no residue")
        return real
    parts = [_value(part, known, witness) for part in formula.args] if not formula.is_Pow else []
    if formula.is_Add:
        return sum(parts[1:], parts[0])
    if formula.is_Mul:
        product = parts[0]
        for part in parts[1:]:
            product = product * part
        return product
    return _value(formula.base, known, witness) ** int(formula.exp)


def some_root(eliminant: AngleEliminant, witness: ModularWitness) -> tuple[Element, Element]:
    """Cosine and sine at a root, the smallest residue. Errors: NoResidueRootError, where there is none."""
    own, _ = polynomial(eliminant, witness)
    p = witness.field.p
    roots = sorted(int(root) for root, _ in own.roots()) if own != 0 else []
    for t in roots:
        size = pow(1 + t * t, -1, p)
        return ((1 - t * t) * size % p, 0), (2 * t * size % p, 0)
    raise NoResidueRootError("a polynomial without a root")


def cycle_type(eliminant: AngleEliminant, witness: ModularWitness) -> tuple[int, ...] | None:
    """Degrees of the factors, falling; None where two are alike or the degree is less. Errors: NoResidueRootError."""
    own, _ = polynomial(eliminant, witness)
    if own.degree() < eliminant.degree or own.gcd(own.derivative()).degree() > 0:
        return None
    return tuple(sorted((int(factor.degree()) for factor, _ in own.factor()[1]), reverse=True))
