"""The velocity equations for print: Jp v = Jq q' row by row, and where the factors of both determinants vanish."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import sympy

from assur.derivation.closed_form_formulas import ClosedFormFormulas
from assur.derivation.constraint_couples import COPLANAR, coplanar_couples
from assur.derivation.factor_meanings import FactorMeanings
from assur.derivation.formula_latex import BREAK, COLUMN, width, wrapped
from assur.derivation.letters_of_names import input_letter
from assur.derivation.written_parts import WrittenFormula
from assur.derivation.written_solution import WrittenSolution
from assur.results.latex_text import letter

NUMBER = 8
"""Letters that the number of an equation takes."""
LONG = 28
"""A factor that is wider in print is told by its meaning alone; what multiplies a rate is broken where it is wider."""


@dataclass(frozen=True)
class PrintedFactor:
    """A factor: its formula unless that is long, and where it vanishes, in LaTeX.

    Its kind is "parallel" or "serial", or "constraint" of what is none of a determinant and lowers the closure's rank.
    """

    kind: str
    formula: str
    meaning: str


@dataclass(frozen=True)
class PrintedVelocities:
    """The velocity equations: one for each freedom, and the factors that may vanish."""

    equations: tuple[WrittenFormula, ...]
    factors: tuple[PrintedFactor, ...]


def printed_velocities(written: WrittenSolution) -> PrintedVelocities:
    """Of an inverse problem that was solved. Errors: NotDerivedError, where the equations do not follow."""
    solution = written.solution
    formulas = ClosedFormFormulas(solution, solution, {})
    own = _Velocities(written, formulas)
    return PrintedVelocities(tuple(own.equations()), tuple(own.factors()))


class _Velocities:
    def __init__(self, written: WrittenSolution, formulas: ClosedFormFormulas) -> None:
        self.written, self.formulas = written, formulas
        record = written.solution.symbols.record
        self.pose = [rf"\dot{{{letter(name)}}}" for name in record.platform.pose]
        self.inputs = [rf"\dot{{{_stem(input_letter(own))}}}{_index(input_letter(own))}" for own in record.inputs]

    def equations(self) -> Iterator[WrittenFormula]:
        velocities = self.formulas.velocities
        for row, other in zip(velocities.jp.tolist(), velocities.jq.tolist(), strict=True):
            sign = -1 if all(self._negative(entry) for entry in row if entry != 0) else 1
            left, right = (
                self._sum([sign * entry for entry in part], rates)
                for part, rates in ((row, self.pose), (other, self.inputs))
            )
            first, second = (text.replace(BREAK, " ") for text in (left, right))
            if width(first) + width(second) + 3 < COLUMN - NUMBER:
                yield WrittenFormula(first, (second,))
            elif width(second) < COLUMN // 2 - NUMBER // 2:
                yield WrittenFormula(second, wrapped(left, width(second) + 2 + NUMBER))
            else:
                behind = self._sum([-sign * entry for entry in other], self.inputs)
                mark = f"- {behind[1:]}" if behind[0] == "-" else f"+ {behind}"
                yield WrittenFormula("0", wrapped(f"{left}{BREAK}{mark}", NUMBER))

    def _negative(self, entry: sympy.Expr) -> bool:
        return bool(self.written.writer.displayed(entry).could_extract_minus_sign())

    def _sum(self, row: list[sympy.Expr], rates: list[str]) -> str:
        """A row times its rates, with marks where it may be broken."""
        texts = []
        for entry, rate in zip(row, rates, strict=True):
            if entry != 0:
                sign = "-" if self._negative(entry) else ""
                plain = -entry if sign else entry
                text = self.written.writer.marked(plain)
                text = text if width(text) > LONG else text.replace(BREAK, " ")
                factor = f"({text})" if self.written.writer.displayed(plain).is_Add else text
                texts.append(f"{sign}{rate}" if plain == 1 else rf"{sign}{factor}\,{rate}")
        if not texts:
            return "0"
        further = (f"- {text[1:]}" if text[0] == "-" else f"+ {text}" for text in texts[1:])
        return BREAK.join([texts[0], *further])

    def factors(self) -> Iterator[PrintedFactor]:
        said, told = FactorMeanings(self.written.solution), list[tuple[str, sympy.Expr]]()
        for _, kind, value in self.formulas.factors:
            if any(kind == other and said.proportional(value, own) for other, own in told):
                continue
            told.append((kind, value))
            meaning = said.of(value, kind, shared=self.formulas.is_shared(value))
            if meaning.text == "it never vanishes":
                continue
            text = self.written.writer.text(-value if self._negative(value) else value)
            yield PrintedFactor(kind, text if width(text) <= LONG else "", self.written.phrase(meaning))
        if coplanar_couples(self.written.solution):
            yield PrintedFactor("constraint", "", COPLANAR)


def _stem(latex: str) -> str:
    return latex.partition("_")[0]


def _index(latex: str) -> str:
    _, mark, index = latex.partition("_")
    return mark + index
