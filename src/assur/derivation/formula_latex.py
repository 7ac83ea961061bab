r"""Formulas as LaTeX, as papers print them: numbers before lengths, functions last, sums broken into rows.

What is written is within the little LaTeX that pages read, and needs nothing but amsmath.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import sympy

COLUMN = 40
"""Letters on a line of a column in print, about."""
ZERO = sympy.Integer(0)
FUNCTIONS = (sympy.cos, sympy.sin)
BREAK = "\n"
"""Where a row may end, in front of a sign."""

_GROUP = re.compile(r"\\[A-Za-z]+|[{}_^\\,&\s]")


@dataclass(frozen=True)
class PrintedLetter:
    """How a symbol is printed.

    Attributes:
        latex: the letter.
        function: "cos" or "sin", where the symbol is that of the letter.
        sense: -1 where the symbol is the negative of what is printed.
        rank: its place in a product: 1 dimensions, 2 what is known, 3 signs and roots, 5 functions.
    """

    latex: str
    function: Literal["", "cos", "sin"] = ""
    sense: int = 1
    rank: int = 2


Letters = Mapping[sympy.Symbol, PrintedLetter]


@dataclass(frozen=True, eq=False)
class FormulaLatex:
    r"""Writes formulas.

    >>> l2, c = sympy.symbols("l2 c")
    >>> writer = FormulaLatex({l2: PrintedLetter("l_{2}", rank=1), c: PrintedLetter(r"\theta_{9}", "cos", rank=5)})
    >>> writer.text(c**2 * l2 / 2 - 1), writer.text(-3 / l2)
    ('\\frac{l_{2}\\cos^{2}\\theta_{9}}{2} - 1', '-\\frac{3}{l_{2}}')
    """

    letters: Letters
    radicals: Mapping[sympy.Expr, sympy.Symbol] = field(default_factory=dict)

    def text(self, formula: Any) -> str:
        """On one line."""
        return self.marked(formula).replace(BREAK, " ")

    def marked(self, formula: Any) -> str:
        """On one line, with a mark where rows may end."""
        return self._sum(self.displayed(formula))

    def rows(self, formula: Any, before: int = 0) -> tuple[str, ...]:
        """In rows, none longer than a column where a sum can be broken; `before` letters stand ahead of them."""
        return self.broken(self.displayed(formula), before)

    def broken(self, displayed: sympy.Expr, before: int = 0) -> tuple[str, ...]:
        """The same of a formula that has the letters' senses already."""
        whole = self._sum(displayed)
        if width(whole) + before > COLUMN:
            whole = self._opened(displayed)
        return wrapped(whole, before)

    def displayed(self, formula: Any) -> sympy.Expr:
        """A formula with the letters' senses, over one denominator where it has one."""
        own = sympy.sympify(formula)
        turned = {symbol: -symbol for symbol in own.free_symbols if self.letters[symbol].sense < 0}
        own = own.subs(turned, simultaneous=True) if turned else own
        for radicand, root in self.radicals.items():
            own = own.subs(radicand, root**2)
        if self._has_divisor(own):
            above, below = sympy.fraction(sympy.together(own))
            return self._collected(above) / self._collected(below)
        return self._collected(own)

    def _has_divisor(self, formula: sympy.Expr) -> bool:
        """Whether it has a denominator, or three terms or more with numbers under them."""
        if any(power.exp.is_negative and power.base.free_symbols for power in formula.atoms(sympy.Pow)):
            return True
        return sum(not term.as_coeff_Mul()[0].is_Integer for term in sympy.Add.make_args(sympy.expand(formula))) > 2

    def _collected(self, formula: sympy.Expr) -> sympy.Expr:
        """Without the factor that all of it shares; what multiplies the same letters is under one root's name."""
        for radicand, root in self.radicals.items():
            inside = {*radicand.free_symbols, root}
            if not formula.free_symbols & inside:
                continue
            total = ZERO
            for letters, part in _by_letters(sympy.expand(formula), inside).items():
                total += letters * sympy.factor(part).subs(radicand, root**2)
            formula = total
        return sympy.factor_terms(formula)

    def _opened(self, formula: sympy.Expr) -> str:
        """A quotient as one over its denominator times a sum that can be broken."""
        above, below = sympy.fraction(formula)
        if below == 1 or not _inner_sum(above):
            return self._sum(formula)
        sign, factor = ("-", -above) if above.could_extract_minus_sign() else ("", above)
        divisor = self._sum(below).replace(BREAK, " ")
        return rf"{sign}\frac{{1}}{{{divisor}}}{self._factor(factor, 9)}"

    def _sum(self, formula: sympy.Expr) -> str:
        if not formula.is_Add:
            return self._signed(formula)
        terms = list(formula.as_ordered_terms())
        first = next((k for k, term in enumerate(terms) if not term.could_extract_minus_sign()), 0)
        terms.insert(0, terms.pop(first))
        texts = [self._signed(term) for term in terms]
        return texts[0] + "".join(
            f"{BREAK}- {text[1:]}" if text.startswith("-") else f"{BREAK}+ {text}" for text in texts[1:]
        )

    def _signed(self, term: sympy.Expr) -> str:
        if term.is_Add:
            return self._factor(term, 0)
        coefficient, rest = term.as_coeff_Mul()
        sign = "-" if coefficient.is_negative else ""
        return sign + self._product(abs(coefficient), sympy.Mul.make_args(rest))

    def _product(self, coefficient: sympy.Rational, factors: Sequence[sympy.Expr]) -> str:
        above = [factor for factor in factors if not _below(factor) and factor != 1]
        below = [1 / factor for factor in factors if _below(factor)]
        numerator, denominator = sympy.Rational(coefficient).p, sympy.Rational(coefficient).q
        top = self._joined(above, numerator)
        if not below and denominator == 1:
            return top
        return rf"\frac{{{self._plain(top, above, numerator)}}}{{{self._divisor(below, denominator)}}}"

    def _plain(self, top: str, above: Sequence[sympy.Expr], number: int) -> str:
        """A numerator that is one sum needs no brackets."""
        text = self._sum(above[0]) if len(above) == 1 and number == 1 and above[0].is_Add else top
        return text.replace(BREAK, " ")

    def _divisor(self, below: Sequence[sympy.Expr], number: int) -> str:
        return self._plain(self._joined(below, number), below, number)

    def _joined(self, factors: Sequence[sympy.Expr], number: int) -> str:
        texts = [str(number)] if number != 1 or not factors else []
        last = ""
        for factor in sorted(factors, key=self._rank):
            text = self._factor(factor, len(factors) + len(texts))
            if texts and _words_meet(last, text):
                text = rf"\,{text}"
            elif re.search(r"\\[A-Za-z]+$", last) and text[:1].isalpha():
                text = f" {text}"
            texts.append(text)
            last = text
        return "".join(texts)

    def _rank(self, factor: sympy.Expr) -> tuple[int, str]:
        base = factor.base if factor.is_Pow else factor
        if base.is_Add:
            return 4, ""
        if isinstance(base, FUNCTIONS):
            return 5, str(base)
        if base.is_Symbol:
            letter = self.letters[base]
            return letter.rank, letter.latex
        return 0, str(base)

    def _factor(self, factor: sympy.Expr, many: int) -> str:
        """One factor of a product of so many."""
        if factor.is_Symbol:
            return self._symbol(factor, "")
        if factor.is_Pow:
            return self._power(factor.base, factor.exp)
        if isinstance(factor, FUNCTIONS):
            return self._function(factor, "")
        if factor.is_Add:
            return f"({self._sum(factor)})" if many else self._sum(factor)
        if factor.is_Mul:
            return self._signed(factor)
        if factor.is_Rational and factor.q != 1:
            return rf"\frac{{{factor.p}}}{{{factor.q}}}"
        return str(sympy.latex(factor))

    def _power(self, base: sympy.Expr, power: sympy.Expr) -> str:
        if power == sympy.Rational(1, 2):
            return rf"\sqrt{{{self._sum(base).replace(BREAK, ' ')}}}"
        index = f"{power.p}/{power.q}" if power.is_Rational and power.q != 1 else str(power)
        if base.is_Symbol:
            return self._symbol(base, index)
        if isinstance(base, FUNCTIONS):
            return self._function(base, index)
        return f"({self._sum(base)})^{{{index}}}"

    def _function(self, function: sympy.Expr, power: str) -> str:
        """Cosine or sine of an angle among the dimensions."""
        angle = function.args[0]
        inner = _spaced(self._symbol(angle, "")) if angle.is_Symbol else f"({self._sum(angle)})"
        return rf"\{function.func.__name__}{f'^{{{power}}}' if power else ''}{inner}"

    def _symbol(self, symbol: sympy.Symbol, power: str) -> str:
        letter = self.letters[symbol]
        raised = f"^{{{power}}}" if power else ""
        if letter.function:
            return rf"\{letter.function}{raised}{_spaced(letter.latex)}"
        return f"{letter.latex}{raised}"


def _by_letters(formula: sympy.Expr, inside: set[sympy.Symbol]) -> dict[sympy.Expr, sympy.Expr]:
    """The terms of a sum by what they have of other letters than those inside."""
    parts: dict[sympy.Expr, sympy.Expr] = {}
    for term in sympy.Add.make_args(formula):
        own, rest = term.as_independent(*inside, as_Add=False)
        number, letters = own.as_coeff_Mul()
        surds = [factor for factor in sympy.Mul.make_args(letters) if not factor.free_symbols]
        letters = letters / sympy.Mul(*surds)
        parts[letters] = parts.get(letters, ZERO) + number * sympy.Mul(*surds) * rest
    return parts


def width(latex: str) -> int:
    r"""About how many letters wide a formula is.

    >>> width(r"l_{2}\cos\theta_{9}"), width(r"\frac{a + b}{2}")
    (7, 3)
    """
    while (fraction := _fraction(latex)) is not None:
        start, stop, above, below = fraction
        latex = latex[:start] + "x" * max(width(above), width(below)) + latex[stop:]
    latex = re.sub(r"\\mathrm\{(\w*)\}", r"\1", latex)
    latex, functions = re.subn(r"\\(?:sin|cos)", "abc", latex)
    latex = re.sub(r"\\[A-Za-z]+", "x", latex)
    small = sum(len(_GROUP.sub("", part)) for part in re.findall(r"[_^]\{[^{}]*\}", latex))
    return len(re.sub(r"[{}_^\\,\s]", "", latex)) - small // 3 + latex.count(BREAK) + functions // 2


def wrapped(latex: str, before: int = 0) -> tuple[str, ...]:
    """A formula in rows no longer than a column, broken where it may be."""
    rows, used = [""], before
    for part in latex.split(BREAK):
        own = width(part) + 1
        if rows[-1] and used + own > COLUMN:
            rows.append(part)
            used = before + own + 2
        else:
            rows[-1] = f"{rows[-1]} {part}".strip()
            used += own
    return tuple(rows)


def _fraction(latex: str) -> tuple[int, int, str, str] | None:
    r"""Where the first \frac of a formula begins and ends, and its two parts."""
    start = latex.find(r"\frac{")
    if start < 0:
        return None
    parts, place = [], start + len(r"\frac")
    for _ in range(2):
        depth, first = 0, place
        while True:
            depth += {"{": 1, "}": -1}.get(latex[place], 0)
            place += 1
            if depth == 0:
                break
        parts.append(latex[first + 1 : place - 1])
    return start, place, parts[0], parts[1]


def _words_meet(before: str, after: str) -> bool:
    """Whether a name of several letters stands beside another letter."""
    return before.removeprefix(r"\,").startswith(r"\mathrm") or after.startswith(r"\mathrm")


def _spaced(latex: str) -> str:
    return latex if latex.startswith("\\") else f" {latex}"


def _below(factor: sympy.Expr) -> bool:
    return bool(factor.is_Pow and factor.exp.is_negative and not factor.base.is_Integer)


def _inner_sum(formula: sympy.Expr) -> bool:
    return bool(formula.is_Add or any(part.is_Add for part in formula.args))
