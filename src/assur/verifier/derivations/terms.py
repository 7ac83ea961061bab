"""Terms: formulas kept as they are written, a number type of the joint graph; and quotients of polynomials for them.

A term is zero where its numerator is, after squares that are known are put for the squares of symbols: cosine and sine
of one angle, roots. That shows an identity exactly. It never makes zero of what is not.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from assur.verifier.field import NoExactError, short_square
from assur.verifier.formula import PI, AngleSum

TRIED = 1000
"""Prime factors up to this are looked for under roots of rationals; what is left counts as one."""
COSINES = ((1,), (Fraction(3, 8), Fraction(1, 8)), (Fraction(3, 4),), (Fraction(1, 2),), (Fraction(1, 4),),
           (Fraction(3, 8), Fraction(-1, 8)), ())  # fmt: skip
"""Of multiples of 15 deg up to 90 deg: what stands under roots whose sum it is, negative of one that is taken away."""


@dataclass(frozen=True, eq=False)
class Term:
    """A number, a symbol, or a sum, a product or a quotient of terms."""

    kind: str
    parts: tuple[Any, ...]

    def __add__(self, other: Any) -> Term:
        return Term("+", (self, term(other)))

    def __neg__(self) -> Term:
        return term(-1) * self

    def __sub__(self, other: Any) -> Term:
        return self + term(-1) * term(other)

    def __rsub__(self, other: Any) -> Term:
        return term(other) - self

    def __mul__(self, other: Any) -> Term:
        return Term("*", (self, term(other)))

    def __truediv__(self, other: Any) -> Term:
        return Term("/", (self, term(other)))

    def __rtruediv__(self, other: Any) -> Term:
        return term(other) / self

    __radd__, __rmul__ = __add__, __mul__


def term(number: Any) -> Term:
    """A term, an integer or a rational as one."""
    return number if isinstance(number, Term) else Term("number", (Fraction(number),))


def symbol(name: str) -> Term:
    """A symbol."""
    return Term("symbol", (name,))


def divisors(terms: Iterable[Term]) -> Iterator[Term]:
    """Everything that is divided by."""
    for own in _all(terms):
        if own.kind == "/":
            yield own.parts[1]


def _all(terms: Iterable[Term]) -> Iterator[Term]:
    """Terms, and all of their parts, each once."""
    waiting, seen = list(terms), set[int]()
    while waiting:
        own = waiting.pop()
        if id(own) not in seen:
            seen.add(id(own))
            yield own
            waiting.extend(part for part in own.parts if isinstance(part, Term))


@dataclass
class WrittenNumbers:
    """The number type: roots of primes, of terms, and cosines and sines of angles with names are symbols.

    Attributes:
        squares: symbol -> what its square is.

    >>> numbers = WrittenNumbers()
    >>> six = numbers.root(Fraction(6)) - numbers.root(Fraction(2)) * numbers.root(Fraction(3))
    >>> Quotients([six], numbers.squares).zero(six)
    True
    """

    squares: dict[str, Term] = field(default_factory=dict)
    _roots: list[tuple[Term, Term]] = field(default_factory=list)

    def number(self, value: Fraction) -> Term:
        """A rational; of the digits of a root of a short one this root."""
        square = short_square(value)
        return term(value) if square is None else self.root(square) * (1 if value > 0 else -1)

    def radians(self, angle: AngleSum) -> Term:
        """No term is an angle."""
        raise NoExactError(f"an angle as a plain number, of {', '.join(angle.shares)}")

    def root(self, value: Any) -> Term:
        """The root that is not negative."""
        if isinstance(value, Term):
            plain = Quotients([value], self.squares).constant(value)
            if plain is None:
                return self._root(value)
            value = plain
        rest, outer, result = abs(Fraction(value).numerator * Fraction(value).denominator), 1, term(1)
        for small in range(2, TRIED):
            while rest and rest % (small * small) == 0:
                rest, outer = rest // (small * small), outer * small
            if rest and rest % small == 0:
                rest, result = rest // small, result * self._named(f"sqrt({small})", term(small))
        whole = math.isqrt(rest)
        result = result * (whole if whole * whole == rest else self._named(f"sqrt({rest})", term(rest)))
        result = result * (self._named("sqrt(-1)", term(-1)) if Fraction(value) < 0 else 1)
        return result * Fraction(outer, Fraction(value).denominator)

    def _root(self, value: Term) -> Term:
        """Of a term: that of one that it is a rational multiple of, if there is one."""
        for known, own in self._roots:
            share = Quotients([value, known], self.squares).constant(value / known)
            if share is not None and share > 0:
                return own * self.root(share)
        own = self._named(f"sqrt[{len(self._roots) + 1}]", value)
        self._roots.append((value, own))
        return own

    def _named(self, name: str, square: Term) -> Term:
        self.squares.setdefault(name, square)
        return symbol(name)

    def circle(self, angle: AngleSum) -> tuple[Term, Term]:
        """Cosine and sine."""
        cosine, sine = term(1), term(0)
        for name, share in angle.shares.items():
            if share:
                c, s = self._part(name, share)
                cosine, sine = cosine * c - sine * s, sine * c + cosine * s
        return cosine, sine

    def _part(self, name: str, share: Any) -> tuple[Term, Term]:
        if not isinstance(share, (int, Fraction)):
            raise NoExactError("an angle times a number")
        if name == PI and (Fraction(share) * 12).denominator == 1:
            count = int(Fraction(share) * 12)
            return self._cosine(count), self._cosine(count - 6)
        unit = Fraction(1, Fraction(share).denominator)
        c, s = self.angle(name if unit == 1 else f"{name}*{unit}")
        count = abs(Fraction(share).numerator)
        cosine, sine = term(1), term(0)
        for _ in range(count):
            cosine, sine = cosine * c - sine * s, sine * c + cosine * s
        return cosine, sine if share > 0 else -sine

    def angle(self, name: str) -> tuple[Term, Term]:
        """Cosine and sine of an angle that has a name."""
        cosine = symbol(f"cos({name})")
        return cosine, self._named(f"sin({name})", 1 - cosine * cosine)

    def _cosine(self, count: int) -> Term:
        """Of a multiple of 15 deg."""
        count = min(count % 24, -count % 24)
        own = sum((self.root(abs(part)) * (1 if part > 0 else -1) for part in COSINES[min(count, 12 - count)]), term(0))
        return own if count <= 6 else -own


class Quotients:
    """Quotients of polynomials in the symbols of some terms.

    Args:
        terms: whose symbols are needed.
        squares: symbol -> what its square is.
        values: symbol -> a term that stands for it.
    """

    def __init__(
        self, terms: Iterable[Term], squares: Mapping[str, Term], values: Mapping[str, Term] | None = None
    ) -> None:
        self._values = values or {}
        needed = [*dict.fromkeys(symbols_of(terms))]
        for name in needed:
            inner = symbols_of(own for own in (self._values.get(name), squares.get(name)) if own is not None)
            needed += [other for other in dict.fromkeys(inner) if other not in needed]
        self.names = sorted(name for name in needed if name not in self._values)
        self.ring = fmpq_mpoly_ctx.get(tuple(f"g{k}" for k in range(max(1, len(self.names)))), Ordering.lex)
        self._known: dict[int, tuple[fmpq_mpoly, fmpq_mpoly]] = {}
        self._kept: list[Term] = []
        self._places = {name: k for k, name in enumerate(self.names)}
        self._squares: dict[int, tuple[fmpq_mpoly, fmpq_mpoly]] = {}
        for name in self.names:
            if name in squares:
                self._squares[self._places[name]] = self.fraction(squares[name])

    def zero(self, own: Term) -> bool:
        """Whether a term vanishes."""
        return bool(self.fraction(own)[0] == 0)

    def degree(self, own: Term, cosine: str, sine: str) -> int:
        """The least degree of a term in cosine and sine of an angle, of which the square of the sine is known.

        In the tangent of half the angle it is a polynomial of twice that degree, over as high a power of 1 + t^2.

        Errors:
            NoExactError: it vanishes, or is divided by what turns.
        """
        over, under = self.fraction(own)
        places = [self._places[name] for name in (cosine, sine) if name in self._places]
        if over == 0 or any(under.degrees()[place] for place in places):
            raise NoExactError(f"no polynomial in {cosine} and {sine}")
        return max(sum(int(powers[place]) for place in places) for powers in over.to_dict())

    def constant(self, own: Term) -> Fraction | None:
        """The rational that a term is."""
        over, under = self.fraction(own)
        if not (over.is_constant() and under.is_constant()):
            return None
        value = (over.coeffs() or [fmpq(0)])[0] / under.coeffs()[0]
        return Fraction(int(value.p), int(value.q))

    def fraction(self, own: Term) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        """Numerator and denominator, without common factors."""
        waiting = [own]
        while waiting:
            last = waiting[-1]
            inner = [part for part in self._inner(last) if id(part) not in self._known]
            if id(last) in self._known or inner:
                waiting.extend(inner) if id(last) not in self._known else waiting.pop()
                continue
            self._kept.append(last)  # so that no other term takes its place in memory
            self._known[id(last)] = self._reduced(*self._worked_out(last))
        return self._known[id(own)]

    def _inner(self, own: Term) -> Iterator[Term]:
        if own.kind == "symbol" and own.parts[0] in self._values:
            yield self._values[own.parts[0]]
        yield from (part for part in own.parts if isinstance(part, Term))

    def _worked_out(self, own: Term) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        one = self.ring.constant(1)
        if own.kind == "number":
            return self.ring.constant(fmpq(own.parts[0].numerator, own.parts[0].denominator)), one
        if own.kind == "symbol":
            (name,) = own.parts
            if name in self._values:
                return self._known[id(self._values[name])]
            return self.ring.gen(self._places[name]), one
        (a, b), (c, d) = (self._known[id(part)] for part in own.parts)
        if own.kind == "+":
            shared = b.gcd(d)
            return a * (d / shared) + c * (b / shared), b * (d / shared)
        if own.kind == "/":
            if c == 0:
                raise NoExactError("a division by what is zero")
            c, d = d, c
        first, second = a.gcd(d), c.gcd(b)
        if a == 0 or c == 0:
            return self.ring.constant(0), one
        return (a / first) * (c / second), (b / second) * (d / first)

    def _reduced(self, over: fmpq_mpoly, under: fmpq_mpoly) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        (over, below), (under, above) = self._lowered(over), self._lowered(under)
        if under == 0:
            raise NoExactError("a division by what is zero")
        over, under = over * above, under * below
        shared = over.gcd(under)
        return over / shared, under / shared

    def _lowered(self, own: fmpq_mpoly) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        """A polynomial without squares that are known, and what it is to be divided by."""
        below = self.ring.constant(1)
        while True:
            degrees = own.degrees()
            place = next((k for k in self._squares if degrees[k] > 1), None)
            if place is None:
                return own, below
            over, under = self._squares[place]
            most = degrees[place] // 2
            parts: dict[int, dict[tuple[int, ...], fmpq]] = {}
            for powers, factor in own.to_dict().items():
                half, left = divmod(int(powers[place]), 2)
                key = (*powers[:place], left, *powers[place + 1 :])
                part = parts.setdefault(half, {})
                part[key] = part.get(key, fmpq(0)) + factor
            own = self.ring.constant(0)
            for half, part in parts.items():
                own = own + self.ring.from_dict(part) * over**half * under ** (most - half)
            below = below * under**most

    def never_zero(self, own: Term, allowed: Sequence[Term], positive: frozenset[str]) -> bool:
        """Whether a term is a product of powers of terms that do not vanish, and of sums of what is positive."""
        return self._free(self.fraction(own)[0], [self.fraction(part)[0] for part in allowed], positive)

    def _free(self, rest: fmpq_mpoly, allowed: Sequence[fmpq_mpoly], positive: frozenset[str]) -> bool:
        if rest == 0:
            return False
        for part in allowed:
            while not (shared := rest.gcd(part)).is_constant():
                rest = rest / shared
        return all(self._sure(factor, allowed, positive) for factor, _ in rest.factor()[1])

    def _sure(self, factor: fmpq_mpoly, allowed: Sequence[fmpq_mpoly], positive: frozenset[str]) -> bool:
        terms = factor.to_dict()
        used = [k for k, degree in enumerate(factor.degrees()) if degree]
        if len(terms) == 1 and len(used) == 1 and used[0] in self._squares:  # a root does not vanish, its square not
            return self._free(self._squares[used[0]][0], allowed, positive)
        odd = {self.names[k] for powers in terms for k, power in enumerate(powers) if power % 2}
        if len({coefficient > 0 for coefficient in terms.values()}) > 1 or not odd <= positive:
            return False
        alone = [{self.names[k] for k, power in enumerate(powers) if power} for powers in terms]
        zeros = {name for names in alone if len(names - positive) == 1 for name in names - positive}
        return any(names <= positive for names in alone) or any(self._needs(part, zeros) for part in allowed)

    def _needs(self, part: fmpq_mpoly, zeros: set[str]) -> bool:
        """Whether what does not vanish would, if some symbols did: then one of them does not, nor a sum of squares."""
        place = next((k for k in self._squares if part == self.ring.gen(k)), None)
        own = part if place is None else self._squares[place][0]
        return bool(zeros) and all(
            zeros & {self.names[k] for k, power in enumerate(powers) if power} for powers in own.to_dict()
        )


def symbols_of(terms: Iterable[Term]) -> Iterator[str]:
    """Names of all symbols."""
    return (own.parts[0] for own in _all(terms) if own.kind == "symbol")
