"""Formulas of a derivation, read as terms of what is known so far, and what of them vanishes or cannot vanish."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Any

from assur.verifier.derivations.terms import Quotients, Term, WrittenNumbers, divisors, symbols_of, term
from assur.verifier.formula import plain, value
from assur.verifier.reading import RefusedError, require

LONGEST = 1_000_000
"""Letters of a formula."""
Multiples = Mapping[str, str]


class KnownFormulas:
    """What is known of a problem.

    Args:
        known: names that formulas may have in them -> numbers.
        positive: names of what is positive.

    Attributes:
        numbers: the number type, which knows squares.
        values: symbol -> what it stands for, whatever is looked at.
        names: symbol -> a formula that it is a name of.
        earlier: unknown that is solved for -> its formula.
        allowed: what does not vanish.
    """

    def __init__(self, numbers: WrittenNumbers, known: Mapping[str, Any], positive: frozenset[str]) -> None:
        self.numbers, self.known, self.positive = numbers, dict(known), positive
        self.values: dict[str, Term] = {}
        self.names: dict[str, Term] = {}
        self.earlier: dict[str, Term] = {}
        self.allowed: list[Term] = []

    def read(self, text: Any) -> Any:
        """A formula of what is known so far; what it is divided by must not vanish."""
        try:
            own = value(text, self.known, self.numbers, LONGEST)
        except KeyError as error:
            raise RefusedError(f"{error} is not known where {str(text)[:60]!r} needs it") from error
        return plain(own, self.numbers)

    def checked(self, text: Any) -> Term:
        """The same, where what it is divided by is looked at."""
        own = term(self.read(text))
        self.divided(own, repr(str(text)[:80]))
        return own

    def divided(self, own: Term, what: str) -> None:
        """Errors: RefusedError, where a term is divided by what may vanish."""
        for divisor in divisors([own]):
            require(self.nonzero(divisor), f"{what} is divided by what may vanish")

    def zero(self, own: Any) -> bool:
        """Whether a number vanishes, by known squares, then by what names stand for, then by what is solved."""
        if not isinstance(own, Term):
            return bool(own == 0)
        return any(self.quotients([own], level).zero(own) for level in self.levels())

    def levels(self) -> Iterator[dict[str, Term]]:
        """Symbols and what they stand for: by itself, with names of what names say, with all, with what is solved."""
        yield self.values
        if composed := {name: own for name, own in self.names.items() if {*symbols_of([own])} <= self.names.keys()}:
            yield {**composed, **self.values}
        if self.names:
            yield {**self.names, **self.values}
        if self.earlier:
            yield {**self.names, **self.values, **self.earlier}

    def turning_names(self, circle: Collection[str]) -> dict[str, Term]:
        """Values, and names of formulas that have some symbols in them, directly or by other such names."""
        turning = dict[str, Term]()
        for name, own in self.names.items():  # in the order of their definition
            if any(other in circle or other in turning for other in symbols_of([own])):
                turning[name] = own
        return {**turning, **self.values}

    def quotients(self, terms: Iterable[Term], level: Mapping[str, Term]) -> Quotients:
        """Quotients of polynomials for some terms."""
        return Quotients(terms, self.numbers.squares, level)

    def nonzero(self, own: Term) -> bool:
        """Whether a term cannot vanish where what is allowed does not."""
        said = {name: self.names[name] for name in symbols_of([own]) if name in self.names}
        for level in ({**said, **self.values}, *self.levels()):
            field = self.quotients([own, *self.allowed], level)
            positive = self.positive | {name for name in field.names if name.startswith("sqrt(") and "-" not in name}
            if field.never_zero(own, self.allowed, positive):
                return True
        return False

    def total(self, shares: Multiples, equations: Mapping[str, Term]) -> Term:
        """A sum of multiples of equations."""
        total = term(0)
        for name, share in shares.items():
            total = total + self.checked(share) * equations[name]
        return total
