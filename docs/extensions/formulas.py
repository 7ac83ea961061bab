r"""LaTeX of the pages as MathML, which browsers typeset without a script: nothing is loaded from anywhere.

The report's converter does the work. What its small LaTeX lacks is made here first and put in by a placeholder:
accents, `aligned`, `pmatrix`, `\binom`, `\phantom`. What still is not understood is a warning, and no page shows it.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from html import escape

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.writers.html5 import HTML5Translator

from assur.report.formulas.latex import latex_mathml

LOGGER = logging.getLogger(__name__)
SAME = {
    r"\tfrac": r"\frac", r"\qquad": r"\quad\quad", r"\operatorname": r"\mathrm", r"\le": "≤", r"\ge": "≥", r"\ne": "≠",
    r"\Bigl": "", r"\Bigr": "", r"\to": "→", r"\in": "∈", r"\max": r"\mathrm{max}",
}  # fmt: skip
"""Commands that another one, or a letter, says as well."""

ACCENTS = {"bar": "¯", "dot": "˙", "ddot": "¨", "hat": "^", "tilde": "~"}
FIRST = 0xE000
"""The first placeholder, of the private letters of Unicode."""

_TABLE = re.compile(r"\\begin\{(aligned|pmatrix)\}(.*?)\\end\{\1\}", re.DOTALL)
_COMMAND = re.compile(r"\\[A-Za-z]+")
_ACCENT = re.compile(rf"\\({'|'.join(ACCENTS)})\s*(?:\{{([^{{}}]*)\}}|(\\[A-Za-z]+|[\w\ue000-\uf8ff]))")
_PHANTOM = re.compile(r"\\phantom\{([^{}]*)\}")
_BINOM = re.compile(r"\\binom\{([^{}]*)\}\{([^{}]*)\}")
_HALF = re.compile(r"\\frac(\d)(\d)")
_TAG = re.compile(r"\\tag\{([^{}]*)\}")
_NEGATIVE = re.compile(r"(^|<mrow>|<mo[^>]*>[(=\[,]</mo>)<mo>([−±∥⊥])</mo>")
_FUNCTION = re.compile(r"(</(?:mi|mn|msub|msup|msubsup)>)(<mi>(?:sin|cos|tan|cot|det|arccos)</mi>)")
_PLACEHOLDER = re.compile(r"<(mo|mi)>([\ue000-\uf8ff])</\1>")


def mathml(latex: str) -> str:
    """MathML of a piece of LaTeX, without the outer <math>."""
    made: list[str] = []
    found = _converted(latex, made)
    while _PLACEHOLDER.search(found):
        found = _PLACEHOLDER.sub(lambda mark: made[ord(mark[2]) - FIRST], found)
    return _spaced(found)


def _spaced(markup: str) -> str:
    """Signs close to what they negate, a thin space before a function, none about a slash."""
    markup = _NEGATIVE.sub(r'\1<mo lspace="0" rspace="0">\2</mo>', markup)
    markup = _FUNCTION.sub(r'\1<mspace width="0.17em"/>\2', markup)
    return markup.replace("<mo>/</mo>", '<mo lspace="0" rspace="0">/</mo>')


def _converted(latex: str, made: list[str]) -> str:
    """MathML with placeholders for what is in `made`, which grows."""

    def keep(markup: str) -> str:
        made.append(f"<mrow>{markup}</mrow>")
        return chr(FIRST + len(made) - 1)

    def inner(text: str) -> str:
        return _converted(text, made)

    text = _COMMAND.sub(lambda found: SAME.get(found[0], found[0]), latex)
    text = _HALF.sub(r"\\frac{\1}{\2}", text.replace(r"\$", keep("<mi>$</mi>")))
    text = _TAG.sub(lambda found: rf"\quad\quad\text{{({found[1]})}}", text)
    text = _PHANTOM.sub(lambda found: keep(f"<mphantom>{inner(found[1])}</mphantom>"), text)
    text = _ACCENT.sub(lambda found: keep(_accent(inner(found[2] or found[3]), ACCENTS[found[1]])), text)
    text = _BINOM.sub(lambda found: keep(_over(inner(found[1]), inner(found[2]))), text)
    text = _TABLE.sub(lambda found: keep(_table(found[1], found[2], inner)), text)
    return latex_mathml(text)


def _accent(base: str, sign: str) -> str:
    return f'<mover accent="true"><mrow>{base}</mrow><mo stretchy="false">{sign}</mo></mover>'


def _over(above: str, below: str) -> str:
    return f'<mo>(</mo><mfrac linethickness="0"><mrow>{above}</mrow><mrow>{below}</mrow></mfrac><mo>)</mo>'


def _table(kind: str, text: str, inner: Callable[[str], str]) -> str:
    rows = [[inner(cell) for cell in row.split("&")] for row in text.split(r"\\")]
    cells = ["".join(f"<mtd><mrow>{cell}</mrow></mtd>" for cell in row) for row in rows]
    table = f'<mtable class="{kind}">{"".join(f"<mtr>{row}</mtr>" for row in cells)}</mtable>'
    return f"<mo>(</mo>{table}<mo>)</mo>" if kind == "pmatrix" else table


def _markup(latex: str, node: nodes.Element, display: str) -> str:
    markup = mathml(latex)
    for left in re.findall(r"<mtext>(\\[^<]*)</mtext>", markup):
        LOGGER.warning("LaTeX that is not understood: %s", left, location=node)
    return f'<math display="{display}" alttext="{escape(latex)}"><mrow>{markup}</mrow></math>'


def inline(writer: HTML5Translator, node: nodes.math) -> None:
    """A formula in running text."""
    writer.body.append(_markup(node.astext(), node, "inline"))
    raise nodes.SkipNode


def block(writer: HTML5Translator, node: nodes.math_block) -> None:
    """A formula on a line of its own."""
    writer.body.append(f'<div class="formula">{_markup(node.astext(), node, "block")}</div>\n')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """The renderer `mathml`, which conf.py names."""
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
