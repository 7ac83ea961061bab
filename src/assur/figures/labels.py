"""Labels: the LaTeX that files and callers give for a quantity, or its plain name where that cannot be set."""

from __future__ import annotations

import re
from functools import lru_cache

from assur.figures.letters import GREEK, mathematics, words
from assur.model.formula import FormulaError, parse
from assur.model.syntax import Angle, Call, Name, Negative, Node, Number, Operands, Pi

LONGEST = 300
"""Characters of a label at most; nested deeper, the setting of type runs out of stack."""
_KEPT = re.compile(r"[^A-Za-z0-9 .,'+-]")
_SCRIPTS = r"(?:_(?:[A-Za-z0-9]|\{[A-Za-z0-9,]+(?:_[0-9])?\}))?(?:\^[0-9])?"
_WORD = rf"\\(?:{'|'.join(sorted(GREEK))}|varphi|Pi|sin|cos)(?![A-Za-z])"
_NAME = rf"(?:[A-Za-z0-9)|]|\\mathbf\{{[A-Za-z]\}}|{_WORD}){_SCRIPTS}"
_BETWEEN = r"[-+=/,( ]|\\[, ]|\\(?:times|cdot|pm|det|angle|partial)(?![A-Za-z])"
_INDEXED = re.compile(rf"({'|'.join(sorted(GREEK, key=len, reverse=True))}|[A-Za-z])(?:_?([A-Z0-9]\w?)|_([a-z]))")
_PLAIN = re.compile(rf"(?:{_NAME}|{_BETWEEN})+")
"""Sums, products and equations of letters with one index and one power, which can always be set."""


@lru_cache(maxsize=4096)
def is_settable(latex: str) -> bool:
    r"""Whether the figures can set a piece of LaTeX, given without dollar signs.

    >>> is_settable(r"\theta_{1}"), is_settable(r"\theta_{1"), is_settable("a_b_c"), is_settable("a$ $b")
    (True, False, False, False)
    """
    plain = latex.replace(r"\$", "")
    if not latex.strip() or len(latex) > LONGEST or "$" in plain or not latex.isprintable():
        return False
    if _PLAIN.fullmatch(latex):
        return True
    from matplotlib.mathtext import MathTextParser  # slow to load, and few files need it

    try:
        MathTextParser("path").parse(f"${latex}$")
    except (ValueError, RecursionError):
        return False
    return True


def label(latex: str, name: str) -> str:
    r"""LaTeX that can be set, without dollar signs: that which is given, else the name as mathematics, else as words.

    What is given is the name itself where a file gives nothing else.

    >>> label(r"\theta_{1", "theta"), label("q1", "q1"), label("", "q_a_b")
    ('\\theta', 'q_{1}', '\\mathrm{q\\ a\\ b}')
    """
    if latex != name and is_settable(latex):
        return latex
    own = mathematics(name)
    return own if is_settable(own) else rf"\mathrm{{{upright(words(name))}}}"


def upright(text: str) -> str:
    """Words as they stand in mathematics, without what has a meaning there."""
    return _KEPT.sub(" ", text).strip().replace(" ", r"\ ") or "?"


def formula_text(formula: str) -> str:
    r"""A formula of parameters as mathematics; as it is written where it cannot be set.

    >>> formula_text("2*d"), formula_text("l4"), formula_text("sqrt(3)*r"), formula_text("uP"), formula_text("alphaA")
    ('$2d$', '$l_{4}$', '$\\sqrt{3}\\,r$', '$u_{P}$', '$\\alpha_{A}$')
    >>> formula_text("(h + R)*cos(30 deg)/2"), formula_text("l2 + C_w/2")
    ('$(h+R)\\,\\cos(30^{\\circ})/2$', '$l_{2}+C_{w}/2$')
    """
    try:
        whole = node_latex(parse(formula).root)
    except FormulaError:
        return formula
    return f"${whole}$" if is_settable(whole) else formula


def node_latex(node: Node) -> str:
    """The LaTeX of a formula's tree, without dollar signs."""
    match node:
        case Number(text):
            return text
        case Angle(text, unit):
            return rf"{text}^{{\circ}}" if unit == "deg" else text
        case Name(text):
            indexed = _INDEXED.fullmatch(text)
            return label(f"{mathematics(indexed[1])}_{{{indexed[2] or indexed[3]}}}" if indexed else "", text)
        case Pi():
            return r"\pi"
        case Negative(of):
            return f"-{_factor(of)}"
        case Call(function, of):
            return rf"\sqrt{{{node_latex(of)}}}" if function == "sqrt" else rf"\{function}({node_latex(of)})"
        case Operands(first, rest) if rest[0][0] in "+-":
            return node_latex(first) + "".join(sign + _factor(term) for sign, term in rest)
        case Operands(first, rest):
            text = _factor(first)
            for sign, term in rest:
                text += (sign if sign == "/" else _times(text)) + _factor(term)
            return text


def _times(before: str) -> str:
    """What stands between a factor and the next one: nothing after a number."""
    return "" if before.isdigit() else r"\,"


def _factor(node: Node) -> str:
    """A tree as a factor: a sum in brackets."""
    is_sum = isinstance(node, Operands) and node.rest[0][0] in "+-"
    return f"({node_latex(node)})" if is_sum else node_latex(node)
