"""Equations and formulas of a solution as a paper writes them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy

from assur.derivation.definitions import Definition
from assur.derivation.elimination import SolvedSet
from assur.derivation.formula_latex import BREAK, COLUMN, FUNCTIONS, FormulaLatex, width, wrapped
from assur.derivation.letters_of_names import joint_letter
from assur.derivation.linear import ONE, Form
from assur.derivation.phrases import GeometricPhrase, direction, listed
from assur.derivation.printed_letters import PrintedLetters
from assur.derivation.rod_vectors import RodVectors
from assur.derivation.solution import AnalyticSolution
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.written_parts import WrittenFormula

ZERO = sympy.Integer(0)
NARROW = 12
"""So wide may be what a letter is multiplied with on the left."""


@dataclass(frozen=True, eq=False)
class WrittenEquations:
    """Writes equations and formulas of one problem.

    Attributes:
        solution: what is written.
        printed: its letters.
        meanings: root -> what holds where its sign is +, in words; empty where nobody said.
    """

    solution: AnalyticSolution
    printed: PrintedLetters
    meanings: Mapping[sympy.Symbol, str]

    @cached_property
    def writer(self) -> FormulaLatex:
        """Writes formulas in these letters."""
        return FormulaLatex(self.printed.letters, self.printed.radicals)

    def line(self, symbol: sympy.Symbol, formula: sympy.Expr) -> WrittenFormula:
        """A definition, without lengths divided out and with the sign of its letter."""
        letter = self.writer.letters[symbol]
        plain = self.writer.displayed(formula)
        above, below = sympy.fraction(sympy.together(plain) if letter.rank == 5 else plain)
        if letter.sense < 0:
            above = sympy.factor_terms(-above)
        parameters = {*self.solution.symbols.parameters.values(), *self.printed.radicals.values()}
        below = self._short(below)
        shown = width(self.writer.text(below)) < NARROW
        if shown and above.is_Add and below != 1 and not below.free_symbols - parameters and letter.rank == 5:
            left = self.writer.text(below * symbol * letter.sense)
            return WrittenFormula(left, self.writer.broken(above, width(left) + 2))
        left = self.writer.text(symbol * letter.sense)
        whole = above if below == 1 else above / below
        return WrittenFormula(left, self.writer.broken(whole, width(left) + 2))

    def _short(self, formula: sympy.Expr) -> sympy.Expr:
        """With cosines and sines of angles among the dimensions put together."""
        return sympy.factor_terms(sympy.trigsimp(formula)) if formula.has(*FUNCTIONS) else formula

    def _condition(self, condition: sympy.Expr) -> str:
        """What must not vanish: of a quotient what is above."""
        above, _ = sympy.fraction(sympy.together(condition))
        short = self._short(above)
        return self.writer.text(-short if self._negative(short) else short)

    def axis(self, axis: Sequence[Any]) -> str:
        """A direction between dollar signs: a letter, or the vector without its length."""
        vector = sympy.Matrix(axis)
        plain = direction(axis)
        if len(plain) == 1:
            return f"${plain}$"
        whole = vector / next(abs(part) for part in vector if part != 0)
        parts = (self.writer.text(sympy.radsimp(sympy.simplify(part))) for part in whole)
        return f"$({', '.join(parts)})$"

    def phrase(self, own: GeometricPhrase) -> str:
        """A meaning with the letters of this solution."""
        return own.written(joint_letter, self.axis)

    def _equation(self, form: Form) -> WrittenFormula:
        """A linear equation: what is unknown on the left, what is known on the right."""
        terms = [(key, coefficient) for key, coefficient in form.items() if key != ONE]
        known = -form.get(ONE, ZERO)
        if known != 0 and self._negative(known) and all(self._negative(own * key) for key, own in terms):
            terms, known = [(key, -own) for key, own in terms], -known
        ahead = [own * key for key, own in terms if known != 0 or not self._negative(own * key)]
        behind = [-own * key for key, own in terms if known == 0 and self._negative(own * key)]
        if not ahead:
            ahead, behind = behind, []
        left = self._terms(ahead)
        right = self._terms(behind) if behind else self.writer.rows(known, min(width(left), COLUMN - 8))
        if isinstance(right, str):
            right = wrapped(right, min(width(left) + 2, COLUMN - 8))
        rows = wrapped(left)
        if len(rows) == 1 and width(left) + max(map(width, right)) < COLUMN:
            return WrittenFormula(left.replace(BREAK, " "), right)
        return WrittenFormula("0", wrapped(self._terms([*ahead, *(-own for own in (*behind, known) if own != 0)]), 3))

    def _negative(self, term: sympy.Expr) -> bool:
        plain = self.writer.displayed(term)
        return bool(plain.could_extract_minus_sign())

    def _terms(self, terms: Iterable[sympy.Expr]) -> str:
        """A sum term by term, each coefficient kept together."""
        texts = [self.writer.marked(term) for term in terms]
        positive = next((k for k, text in enumerate(texts) if not text.startswith("-")), 0)
        texts.insert(0, texts.pop(positive))
        return texts[0] + "".join(
            f"{BREAK}- {text[1:]}" if text.startswith("-") else f"{BREAK}+ {text}" for text in texts[1:]
        )

    def _named_equation(self, form: Form, steps: SetSteps) -> WrittenFormula:
        """An equation with its coefficients under their names."""
        named = {key: steps.names.get(sympy.factor_terms(own), own) for key, own in form.items() if key != ONE}
        known = -form.get(ONE, ZERO)
        return self._equation({**named, ONE: -steps.names.get(sympy.factor_terms(known), known)})

    def _planes(self, vectors: RodVectors) -> Iterator[WrittenFormula]:
        for normal, share in zip(vectors.normals, vectors.shares, strict=True):
            left = rf"{self.printed.vector(normal)} \cdot {self.printed.vector(vectors.unknowns)}"
            yield WrittenFormula(left, (self.writer.text(share),))

    def _of_vectors(self, vectors: RodVectors, steps: SetSteps) -> Iterator[WrittenFormula]:
        skipped = {*vectors.across}
        for own in steps.named:
            if own.symbol == vectors.across[0]:
                first, second = (self.printed.vector(normal) for normal in vectors.normals)
                yield WrittenFormula(self.printed.vector(vectors.across), (rf"{first} \times {second}",))
            if own.symbol == vectors.square:
                across = self.printed.vector(vectors.across)
                yield WrittenFormula(self.writer.text(own.symbol), (rf"{across} \cdot {across}",))
            elif own.symbol == vectors.radicand:
                yield WrittenFormula(self.writer.text(own.symbol), (self._apart(vectors),))
            elif own.symbol not in skipped:
                yield self.line(own.symbol, own.formula)

    def _apart(self, vectors: RodVectors) -> str:
        u, v = (self.printed.vector(normal) for normal in vectors.normals)
        h, k = (self.writer.text(share) for share in vectors.shares)
        return rf"{self.writer.text(vectors.square)} - |{h}\,{v} - {k}\,{u}|^{{2}}"

    def _direction(self, vectors: RodVectors) -> WrittenFormula:
        u, v = (self.printed.vector(normal) for normal in vectors.normals)
        w = self.printed.vector(vectors.across)
        h, k = (self.writer.text(share) for share in vectors.shares)
        root, square = self._terms([ZERO + vectors.root]), self.writer.text(vectors.square)
        root = f"- {root[1:]}" if root.startswith("-") else f"+ {root}"
        text = rf"\frac{{1}}{{{square}}}({h}\,{v} \times {w}{BREAK}+ {k}\,{w} \times {u}{BREAK}{root}\,{w})"
        left = self.printed.vector(vectors.unknowns)
        return WrittenFormula(left, wrapped(text, width(left) + 2))

    def _quadrics(self, others: Sequence[UnknownDirection]) -> str:
        """Why squares add up to 1."""
        units = [f"${self.printed.angle(own)}$" for own in others if own.kind == "rod"]
        if units:
            return f"As {listed(units)} {'is a unit vector' if len(units) == 1 else 'are unit vectors'}"
        angles = (self.printed.angle(own) for own in others)
        sums = [rf"$\cos^{{2}}{own} + \sin^{{2}}{own} = 1$" for own in angles]
        return f"As {listed(sums)}"


class SetSteps:
    """The definitions of a set by what they are for."""

    def __init__(self, part: SolvedSet) -> None:
        unknowns = {symbol for own in part.directions for symbol in own.unknowns}
        used = {symbol for form in part.equations for own in form.values() for symbol in own.free_symbols}
        roots = {root.symbol for root in part.roots}
        self.definitions = part.definitions
        self.known = [own for own in part.definitions if own.symbol in used and own.symbol not in unknowns]
        named = [own for own in part.definitions if own.symbol not in {*used, *unknowns, *roots}]
        self.named = [own for own in named if not own.formula.free_symbols & unknowns]
        self.late = [own.symbol for own in named if own not in self.named]
        self.names = {own.formula: own.symbol for own in self.named}

    def of(self, unknowns: Sequence[sympy.Symbol]) -> list[Definition]:
        """What defines these."""
        return [own for own in self.definitions if own.symbol in unknowns]
