"""Relations of dimensions: what must hold of a file's numbers, or else no loop closes, as e1 = e2 + a - b.

Such an equation has no unknown and nothing that is given. The file's numbers satisfy it, other numbers do not. It is
taken as known: one of its dimensions follows from the others, everywhere where formulas are told from zero.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy

from assur.derivation.definitions import Definition
from assur.derivation.linear import ONE, VANISHED, Form, never_zero, rank, solved, tidy
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.symbols import GivenSymbols
from assur.derivation.witness import ModularWitness


def dimension_relations(
    symbols: GivenSymbols, forms: Sequence[Form], unknowns: Sequence[sympy.Symbol]
) -> tuple[Definition, ...]:
    """Dimensions that follow from others, as the equations would contradict each other else; the witness keeps to them.

    Args:
        symbols: what is given, with its witness.
        forms: linear equations.
        unknowns: of these.

    Errors:
        NotDerivedError: equations that contradict each other for almost all that is given.

    Example: the planes of a five-bar across x are one plane, where its dimensions say so.

    >>> from assur.derivation.witness import ModularWitness
    >>> from assur.model.registry import load_record
    >>> symbols = GivenSymbols(load_record("fivebar"), "direct", ModularWitness())
    >>> dimension_relations(symbols, [], [])
    ()
    """
    witness, relations = symbols.witness, list[Definition]()
    left: list[Form] = list(forms)
    while rank(left, [*unknowns, ONE], witness) > rank(left, unknowns, witness):
        short = [form for form in left if form.keys() == {ONE}]
        _, alone = ({}, short) if short else solved(left, unknowns, witness)
        relation = _relation(symbols, min((form[ONE] for form in alone), key=sympy.count_ops))
        relations.append(relation)
        witness.define(relation.symbol, relation.formula)
        witness.draw_again()
        left = [{key: part for key, part in form.items() if not witness.is_zero(part)} for form in left]
        left = [form for form in left if form]
    return tuple(relations)


def _relation(symbols: GivenSymbols, gap: sympy.Expr) -> Definition:
    """A dimension as what the others say that it is. Errors: NotDerivedError."""
    above, _ = sympy.fraction(sympy.together(gap))
    above = sympy.expand(above)
    home = {symbol: symbols.record.parameters[name].inside for name, symbol in symbols.parameters.items()}
    own = above.free_symbols & {*home}
    if above.free_symbols - own:
        raise NotDerivedError(f"the loops close only where {sympy.factor_terms(gap)} = 0, which what is given decides")
    size = max((abs(float(term.evalf(30, subs=home))) for term in sympy.Add.make_args(above)), default=0.0)
    if abs(float(above.evalf(30, subs=home))) > VANISHED * size:
        raise NotDerivedError(f"the loops close only where {sympy.factor_terms(gap)} = 0, and it is not")
    choices = [(symbol, above.coeff(symbol)) for symbol in sorted(own, key=str) if _linear(above, symbol)]
    choices = [choice for choice in choices if choice[1].is_number or never_zero(choice[1])]
    if not choices:
        raise NotDerivedError(f"the loops close only where {above} = 0, which no dimension alone says")
    symbol, factor = min(choices, key=lambda choice: (not choice[1].is_number, sympy.count_ops(choice[1])))
    return Definition(symbol, tidy(-(above - factor * symbol) / factor))


def _linear(formula: sympy.Expr, symbol: sympy.Symbol) -> bool:
    return bool(sympy.expand(formula.diff(symbol)).has(symbol)) is False and not any(
        symbol in function.free_symbols for function in formula.atoms(sympy.Function)
    )


def is_stated(symbols: GivenSymbols, relation: Definition) -> bool:
    """Whether formulas of the file's parameters say a relation; else its numbers alone do.

    >>> from assur.derivation.witness import ModularWitness
    >>> from assur.model.registry import load_record
    >>> symbols = GivenSymbols(load_record("fivebar"), "direct", ModularWitness())
    >>> is_stated(symbols, Definition(symbols.parameters["l1"], symbols.parameters["l2"]))
    False
    """
    gap, formulas = relation.symbol - relation.formula, symbols.stated
    for _ in formulas:
        gap = gap.subs(formulas)
    return ModularWitness().is_zero(gap)
