"""Shorthand: letters for what a formula says twice or what makes it too long to be read.

The letters that a closed form names are often not enough: where three spheres meet, the formula of a coordinate
fills pages. Here a part that several formulas share, and the largest part of one that is too long, gets a letter
of its own, defined on the line before it is used.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

from assur.report.formulas.latex import name_mathml
from assur.report.formulas.trace import Letter, Traced

STEMS = ("k", "c", "f", "g", "j", "n", "m")
"""The first of these that nothing else is called by is the letter of shorthand; it gets numbers."""

SHARED = 4
"""A shared part with at least so many letters is worth one of its own."""

LONG = 13
"""A formula with more letters than these is too long."""


@dataclass(eq=False)
class Shorthand:
    """Formulas made short, one after another.

    Attributes:
        stem: the letter of shorthand.
        uses: how often every part stands in the formulas, by its values.
        pending: what the formulas made short since the last `taken` need defined before them.
    """

    stem: str
    uses: Counter[bytes]
    pending: list[tuple[Letter, Traced]] = field(default_factory=list)
    _known: dict[bytes, tuple[Traced, int]] = field(default_factory=dict)
    _count: int = 0

    def short(self, term: Traced) -> Traced:
        """A formula itself: its parts are abbreviated, never the whole of it."""
        if term.letter is not None or not term.parts:
            return term
        return self._made(term)[0]

    def taken(self) -> list[tuple[Letter, Traced]]:
        """The definitions that are pending, in the order in which they need one another."""
        definitions, self.pending = self.pending, []
        return definitions

    def _part(self, term: Traced) -> tuple[Traced, int]:
        """A part as it is written, and how many letters it takes."""
        if term.letter is not None or not term.parts:
            return term, 1 if term.letter is not None else 0
        key = term.values.tobytes()
        if key not in self._known:
            written, size = self._made(term)
            if size >= SHARED and self.uses[key] > 1 and term.operator != "neg":
                written, size = self._lettered(written), 1
            self._known[key] = written, size
        return self._known[key]

    def _made(self, term: Traced) -> tuple[Traced, int]:
        parts = [self._part(part) for part in term.parts]
        while sum(size for _, size in parts) > LONG:
            largest = max(range(len(parts)), key=lambda k: parts[k][1])
            if parts[largest][1] <= 1:
                break
            long = parts[largest][0]
            short = self._lettered(long)
            parts = [(short, 1) if part is long else (part, size) for part, size in parts]
        written = Traced(term.book, term.operator, tuple(part for part, _ in parts), term.values)
        return written, sum(size for _, size in parts)

    def _lettered(self, term: Traced) -> Traced:
        self._count += 1
        name = f"{self.stem}{self._count}"
        letter = Letter(name, name_mathml(name))
        self.pending.append((letter, term))
        lettered = Traced(term.book, "letter", (), term.values, letter)
        self._known[term.values.tobytes()] = lettered, 1
        return lettered


def shorthand(terms: Iterable[Traced], taken: Iterable[str]) -> Shorthand:
    """The shorthand of formulas, all of which are given, beside the names that are taken.

    >>> import numpy as np
    >>> from assur.report.formulas.normal import text
    >>> from assur.report.formulas.trace import Book, leaf
    >>> a, b, c = (leaf(Book(), Letter(name, ""), np.linspace(k, k + 1, 8)) for k, name in enumerate("abc", 1))
    >>> shared = a * b + b * c + c
    >>> both = [shared * shared + 1, a / shared]
    >>> brief = shorthand(both, "abc")
    >>> [text(brief.short(term)) for term in both], [text(term) for _, term in brief.taken()]
    (['k1^2 + 1', 'a/k1'], ['a b + b c + c'])
    """
    uses: Counter[bytes] = Counter()
    pending = list(terms)
    while pending:
        term = pending.pop()
        if term.letter is not None:
            continue
        key = term.values.tobytes()
        uses[key] += 1
        if uses[key] == 1:
            pending += term.parts
    names = set(taken)
    free = [stem for stem in STEMS if not any(name.rstrip("0123456789") == stem for name in names)]
    return Shorthand(free[0] if free else "K", uses)
