r"""MathML of a report's formulas as LaTeX, for papers and for who copies a formula; it needs amsmath and amssymb."""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache
from xml.etree import ElementTree

from assur.report.formulas.mathml import tops
from assur.report.formulas.symbols import BOLD, FUNCTIONS, GREEK, OPERATORS
from assur.report.formulas.wrapping import wrapping
from assur.results.latex_text import escaped

Element = ElementTree.Element
NAMES = {sign: rf"\{name}" for name, sign in {**GREEK, **OPERATORS}.items() if name != "varphi"}
NAMES |= {"−": "-", "′": "'", "∑": r"\sum", "∏": r"\prod", "⋂": r"\bigcap", "⋃": r"\bigcup", "{": r"\{", "}": r"\}"}
NAMES |= {"\u2061": "", "\u2062": r"\,", "&": r"\&", "%": r"\%", "#": r"\#", "_": r"\_", "°": r"^{\circ}", "‖": r"\|"}
LETTERS = {chr(code): rf"\mathbf{{{chr(letter)}}}" for letter, code in BOLD.items()}
ACCENTS = {"¯": "bar", "˙": "dot", "\u0307": "dot", "¨": "ddot", "^": "hat", "~": "tilde", "→": "vec", "ˇ": "check"}
SPACES = {"0.14em": "", "0.17em": r"\,", "0.28em": r"\;", "0.33em": r"\ ", "1em": r"\quad", "2em": r"\qquad"}
BRACKETS = {"matrix": "bmatrix", "pmatrix": "pmatrix", "cases": "cases", "aligned": "aligned", "table": "matrix"}
LIMITED = ("min", "max")
WIDEST = 74
"""Letters on a line; a longer sum is broken before its signs."""


@lru_cache(maxsize=4096)
def tex(mathml: str) -> str:
    r"""A formula of `assur.report.formulas` in LaTeX, without dollar signs.

    >>> tex("<math><mrow><msup><mi>l</mi><mn>2</mn></msup><mo>−</mo><mfrac><mi>α</mi><mn>2</mn></mfrac></mrow></math>")
    'l^{2}-\\frac{\\alpha }{2}'
    """
    return "".join(map(_element, tops(mathml))).strip()


def broken_tex(mathml: str) -> str:
    """The same, a long sum as lines of an `aligned`, broken before signs that stand in no brackets."""
    lines, width, depth = [""], 0, 0
    for part in tops(mathml):
        own = _element(part)
        depth += (part.text in ("(", "[", "{")) - (part.text in (")", "]", "}"))
        if depth == 0 and part.tag == "mo" and part.text in ("+", "−", "=") and width > WIDEST / 2:
            lines.append("")
            width = 0
        lines[-1] += own
        width += len("".join(part.itertext()))
    if len(lines) == 1:
        return lines[0].strip()
    following = "".join(rf" \\ &\quad {line}" for line in lines[1:])
    return rf"\begin{{aligned}}&{lines[0]}{following}\end{{aligned}}"


def annotated(mathml: str) -> str:
    """A formula with its LaTeX beside it, which browsers hand over and screens do not show."""
    opening = re.match(r"<math[^>]*>", mathml)
    if opening is None:
        return mathml
    inner = wrapping(mathml)[opening.end() : -len("</math>")]
    source = tex(mathml).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    annotation = f'<annotation encoding="application/x-tex">{source}</annotation>'
    return f"{opening[0]}<semantics>{inner}{annotation}</semantics></math>"


def _element(part: Element) -> str:
    inside = [_element(child) for child in part]
    match part.tag:
        case "mi":
            return _letters(part.text or "")
        case "mo":
            return "".join(map(_sign, part.text or ""))
        case "mtext":
            return rf"\text{{{escaped(part.text or '')}}}"
        case "mspace":
            return SPACES.get(part.get("width", ""), r"\,")
        case "mfrac":
            return rf"\frac{{{inside[0]}}}{{{inside[1]}}}"
        case "msqrt":
            return rf"\sqrt{{{''.join(inside)}}}"
        case "msub" | "munder":
            return f"{inside[0].strip()}_{{{inside[1]}}}"
        case "msup":
            return f"{inside[0].strip()}^{{{inside[1]}}}"
        case "msubsup" | "munderover":
            return f"{inside[0].strip()}_{{{inside[1]}}}^{{{inside[2]}}}"
        case "mover":
            return rf"\{ACCENTS.get((part[1].text or '').strip(), 'hat')}{{{inside[0]}}}"
        case "mtable":
            return r" \\ ".join(" & ".join(map(_element, row)) for row in part)
        case "mphantom":
            return rf"\phantom{{{''.join(inside)}}}"
        case "mrow" if part.get("class") in BRACKETS:
            return _table(part, BRACKETS[str(part.get("class"))])
        case _:
            return (part.text or "") + "".join(inside)


def _table(part: Element, name: str) -> str:
    """A table with the brackets of its environment; those that stand about it in the markup are these."""
    table = next(child for child in part if child.tag == "mtable")
    return rf"\begin{{{name}}}{_element(table)}\end{{{name}}}"


def _letters(text: str) -> str:
    if text == "sgn":
        return r"\operatorname{sgn}"
    if text in FUNCTIONS or text in LIMITED:
        return rf"\{text} "
    if len(text) == 1:
        return _sign(text)
    plain = unicodedata.normalize("NFKD", text)
    if len(plain) == 2 and plain[1] in ACCENTS:
        return rf"\{ACCENTS[plain[1]]}{{{_sign(plain[0])}}}"
    return rf"\mathrm{{{''.join(_sign(sign) if sign in NAMES else sign for sign in text)}}}"


def _sign(sign: str) -> str:
    if sign in LETTERS:
        return LETTERS[sign]
    name = NAMES.get(sign)
    if name is None:
        name = sign if sign.isascii() else unicodedata.normalize("NFKD", sign)
    if not name.isascii():
        return rf"\text{{{escaped(sign)}}}"
    return name + " " if re.search(r"\\[A-Za-z]+$", name) else name
