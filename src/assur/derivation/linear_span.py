"""Sums of multiples of linear equations: what follows of them, and by which multipliers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress

import sympy

from assur.derivation.linear import ONE, Form, divided, never_zero, projected, rank, replaced, solved, tidy, value_of
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.trigonometric import shorter
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness

ZERO = sympy.Integer(0)
Multipliers = dict[str, sympy.Expr]
"""Name of an equation -> by what it is multiplied."""


class NoIdentityError(ArithmeticError):
    """What is no sum of multiples of the equations that are known here."""


class LinearSpan:
    """Sums of multiples of linear equations.

    Args:
        rows: name of an equation -> its form, that vanishes; one that follows of those before it is used where these
            alone divide by what may vanish, but for those that a length along a vector that turns is projected by.
        unknowns: whose coefficients are compared one by one; all else is known.
        witness: tells what vanishes.
        lengths: unknowns along unit vectors, whose equations are projected on these first: then nothing is divided.

    >>> x, y = sympy.symbols("x y")
    >>> span = LinearSpan({"e1": {x: ONE, y: ONE}, "e2": {y: ONE, ONE: -ONE}}, [x, y], ModularWitness())
    >>> span.multipliers({x: ONE, ONE: ONE})
    {'e1': 1, 'e2': -1}
    """

    def __init__(
        self,
        rows: Mapping[str, Form],
        unknowns: Sequence[sympy.Symbol],
        witness: ModularWitness,
        lengths: Sequence[sympy.Symbol] = (),
    ) -> None:
        self._witness, self._unknowns, self._lengths = witness, unknowns, lengths
        self._every, self._rows = dict(rows), dict[str, Form]()
        for name, form in rows.items():
            turned = any(form[own].free_symbols for own in lengths if own in form)
            if turned or not self._spanned(form, self._rows):
                self._rows[name] = form

    def multipliers(self, target: Form) -> Multipliers:
        """Of each equation in a form. Errors: NoIdentityError."""
        if (same := self._one_of_them(target)) is not None:
            return same
        ways: list[Multipliers] = []
        for rows in self._ways(target) if self._spanned(target, self._rows) else ():
            with suppress(NoIdentityError, NotDerivedError):  # a length that these do not say alone
                ways.append(self._shares(target, rows))
                if not _divides(ways[-1]):
                    return ways[-1]
        if not ways:
            raise NoIdentityError(f"{value_of(target)} does not follow of {', '.join(self._rows)}")
        return self._together(ways) or ways[0]

    def _ways(self, target: Form) -> Iterator[dict[str, Form]]:
        """Equations of which a form follows: few, then all of them where lengths are projected, then few others."""
        first = self._fewest(target, self._rows)
        yield first
        if self._lengths and len(first) < len(self._rows):
            yield self._rows
        turned = {name: self._every[name] for name in reversed(self._every)}
        for rows in (self._fewest(target, self._every), self._fewest(target, turned)):
            if rows.keys() != first.keys():
                yield rows

    def _fewest(self, target: Form, rows: Mapping[str, Form]) -> dict[str, Form]:
        """Some of the rows, without the first ones where the others do."""
        kept = dict(rows)
        for name in rows:
            fewer = {other: form for other, form in kept.items() if other != name}
            if self._spanned(target, fewer):
                kept = fewer
        return kept

    def _together(self, ways: Sequence[Multipliers]) -> Multipliers | None:
        """Ways that divide by components of one direction, by the square of its length; None where that may vanish."""
        below = [sympy.lcm_list([sympy.fraction(sympy.together(own))[1] for own in shares.values()]) for shares in ways]
        square = shorter({ONE: sum((own**2 for own in below), ZERO)}, self._witness.circles, self._witness)[ONE]
        if not never_zero(square):
            return None
        parts = (times(shares, own**2 / square) for shares, own in zip(ways, below, strict=True))
        return {name: tidy(share) for name, share in total_of(*parts).items()}

    def _one_of_them(self, target: Form) -> Multipliers | None:
        """Of a form that is an equation by any names of its coefficients, or that with its sign turned."""
        for name, form in self._rows.items():
            for sense in (ONE, -ONE):
                keys = form.keys() | target.keys()
                if all(self._witness.is_zero(target.get(key, ZERO) - sense * form.get(key, ZERO)) for key in keys):
                    return {name: sense}
        return None

    def _shares(self, target: Form, rows: Mapping[str, Form]) -> Multipliers:
        """Multipliers of some of the equations, of which a form follows."""
        tags = {sympy.Dummy(name): name for name in rows}
        tagged = [{**form, tag: -ONE} for tag, form in zip(tags, rows.values(), strict=True)]
        lengths, left = projected(
            tagged, [own for own in self._lengths if any(own in form for form in tagged)], self._witness
        )
        values, _ = solved(map(divided, left) if lengths else left, self._unknowns, self._witness)
        values = {length: replaced(form, values, self._witness) for length, form in lengths.items()} | values
        rest = replaced(target, values, self._witness)
        known = value_of({key: part for key, part in rest.items() if key not in tags})
        if not self._witness.is_zero(known):
            raise NoIdentityError(f"{value_of(target)} does not follow of {', '.join(rows)}")
        return {name: _plain(rest[tag]) for tag, name in tags.items() if tag in rest}

    def _spanned(self, target: Form, rows: Mapping[str, Form]) -> bool:
        """Whether the coefficients of unknowns are those of a sum of multiples of rows."""
        keys, forms = (*self._lengths, *self._unknowns), [*rows.values()]
        return rank([*forms, target], keys, self._witness) == rank(forms, keys, self._witness)


def _divides(shares: Multipliers) -> bool:
    """Whether a multiplier is divided by what may vanish."""
    return not all(never_zero(sympy.fraction(sympy.together(share))[1]) for share in shares.values())


def _plain(share: sympy.Expr) -> sympy.Expr:
    """A quotient without roots below, where more cancels so.

    >>> x, y = sympy.symbols("x y")
    >>> _plain((sympy.sqrt(3) * x + y) / (3 * x + sympy.sqrt(3) * y))
    sqrt(3)/3
    """
    over, under = map(sympy.expand, sympy.fraction(share))
    for root in sorted(under.atoms(sympy.Pow), key=str):
        if root.exp == sympy.Rational(1, 2) and under.is_Add:
            other = under.subs(root, -root)
            over, under = sympy.expand(over * other), sympy.expand(under * other)
    return min(share, tidy(over / under), key=lambda own: int(sympy.count_ops(own)))


def unit(direction: UnknownDirection) -> str:
    """The name of the equation that a direction's quadric is.

    >>> unit(UnknownDirection("circle", "crank", sympy.symbols("c s"), ("crank",)))
    'unit crank'
    """
    return f"unit {direction.name}"


def total_of(*parts: Multipliers) -> Multipliers:
    """The multipliers of a sum."""
    total: Multipliers = {}
    for part in parts:
        for name, share in part.items():
            total[name] = total.get(name, ZERO) + share
    return total


def times(shares: Multipliers, factor: sympy.Expr) -> Multipliers:
    """The multipliers of a multiple."""
    return {name: share * factor for name, share in shares.items()}
