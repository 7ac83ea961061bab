"""Recorded formulas as MathML, the markup of mathematics that browsers typeset without scripts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from html import escape, unescape
from xml.etree import ElementTree

from assur.report.formulas.latex import bracket, close, name_mathml
from assur.report.formulas.normal import Power, Product, summands
from assur.report.formulas.trace import Letter, Traced
from assur.results.kinds import PrintedFormula

TIMES = "<mo>\u2062</mo>"
APPLY = '<mo>\u2061</mo><mspace width="0.14em"/>'
_WORD = re.compile(r"(<\w+>)*<mi>[^<]{2,}")
"""A function or a name of several letters, which stands apart from what is before it."""

THIN = '<mspace width="0.17em"/>'


def equation(left: str, right: str, spoken: str = "") -> str:
    """An equation left = right, as a display formula; `spoken` is its plain text for who cannot see it."""
    return display(f"{left}<mo>=</mo>{right}", spoken)


def display(content: str, spoken: str = "") -> str:
    """A formula on a line of its own."""
    return f'<math display="block"{_alternative(spoken)}><mrow>{content}</mrow></math>'


def inline(content: str, spoken: str = "") -> str:
    """A formula in running text or in a cell."""
    return f"<math{_alternative(spoken)}><mrow>{content}</mrow></math>"


def named_formula(name: str) -> PrintedFormula:
    """A name of the code in a cell."""
    return PrintedFormula(inline(name_mathml(name), name))


def _alternative(spoken: str) -> str:
    return f' alttext="{escape(spoken)}"' if spoken else ""


def letter_mathml(letter: Letter) -> str:
    r"""A letter, or the function of it that is meant.

    >>> letter_mathml(Letter("alpha", "<mi>α</mi>", "cos"))
    '<mrow><mi>cos</mi><mo>\u2061</mo><mspace width="0.14em"/><mi>α</mi></mrow>'
    """
    if not letter.function:
        return letter.mathml
    inner = f"<mrow><mo>(</mo>{letter.mathml}<mo>)</mo></mrow>" if letter.function == "sgn" else letter.mathml
    return f"<mrow><mi>{letter.function}</mi>{APPLY}{inner}</mrow>"


def term_mathml(term: Traced) -> str:
    """MathML of a recorded formula."""
    parts = []
    for place, product in enumerate(summands(term)):
        if place:
            parts.append("<mo>−</mo>" if product.coefficient < 0 else "<mo>+</mo>")
        elif product.coefficient < 0:
            parts.append(close("−"))
        parts.append(_product(product))
    return "".join(parts) or "<mn>0</mn>"


def matrix_mathml(rows: Sequence[Sequence[Traced]]) -> str:
    """MathML of a matrix of recorded formulas."""
    cells = "".join("<mtr>" + "".join(f"<mtd>{term_mathml(entry)}</mtd>" for entry in row) + "</mtr>" for row in rows)
    return f'<mrow class="matrix"><mtable>{cells}</mtable></mrow>'


def _product(product: Product) -> str:
    size = abs(product.coefficient)
    above = _side(size.numerator, product.above, bare=bool(product.below) or size.denominator != 1)
    if not product.below and size.denominator == 1:
        return above
    return f"<mfrac><mrow>{above}</mrow><mrow>{_side(size.denominator, product.below, bare=True)}</mrow></mfrac>"


def _side(whole: int, powers: Sequence[Power], *, bare: bool) -> str:
    """One side of a fraction, or a whole product; a bracket that stands alone there needs no brackets."""
    if bare and whole == 1 and len(powers) == 1 and powers[0].exponent == 1 and _is_sum(powers[0].base):
        return term_mathml(powers[0].base)
    number = [f"<mn>{whole}</mn>"] if whole != 1 or not powers else []
    return _joined([*number, *(_power(power) for power in powers)])


def _joined(factors: Iterable[str]) -> str:
    product = ""
    for factor in factors:
        gap = THIN if _WORD.match(factor) else ""
        product += f"{TIMES}{gap}{factor}" if product else factor
    return product


def _power(power: Power) -> str:
    base, exponent = power.base, f"<mn>{power.exponent}</mn>"
    if base.letter is not None and base.letter.function and power.exponent > 1:
        function = f"<msup><mi>{base.letter.function}</mi>{exponent}</msup>"
        return f"<mrow>{function}{APPLY}{base.letter.mathml}</mrow>"
    if base.letter is not None:
        written = letter_mathml(base.letter)
    elif base.operator == "sqrt":
        written = f"<msqrt><mrow>{term_mathml(base.parts[0])}</mrow></msqrt>"
    else:
        written = f"<mrow>{bracket('(')}{term_mathml(base)}{bracket(')')}</mrow>"
    return written if power.exponent == 1 else f"<msup>{written}{exponent}</msup>"


def _is_sum(term: Traced) -> bool:
    return term.letter is None and term.operator in ("+", "-")


def tops(mathml: str) -> list[ElementTree.Element]:
    """The parts of a formula that stand side by side on its line."""
    content = re.sub(r"&(?!amp;|lt;|gt;|quot;|#)(\w+);", lambda match: unescape(match[0]), mathml)
    parts = list(ElementTree.fromstring(content))  # made by assur.report.formulas
    while len(parts) == 1 and parts[0].tag == "mrow" and not parts[0].get("class"):
        parts = list(parts[0])
    return parts
