"""LaTeX of the pages as MathML, which browsers typeset without a script: nothing is loaded from anywhere.

The report's reader does the work; what it does not understand is a warning, so that no page shows it.
"""

from __future__ import annotations

import re
from html import escape, unescape

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.writers.html5 import HTML5Translator

from assur.report.formulas.latex import latex_mathml

LOGGER = logging.getLogger(__name__)


def _markup(node: nodes.Element, display: str) -> str:
    latex = node.astext()
    markup = latex_mathml(latex)
    for left in re.findall(r"<merror><mtext>(.*?)</mtext>", markup, re.DOTALL):
        LOGGER.warning("LaTeX that is not understood: %s", unescape(left), location=node)
    return f'<math display="{display}" alttext="{escape(latex)}"><mrow>{markup}</mrow></math>'


def inline(writer: HTML5Translator, node: nodes.math) -> None:
    """A formula in running text."""
    writer.body.append(_markup(node, "inline"))
    raise nodes.SkipNode


def block(writer: HTML5Translator, node: nodes.math_block) -> None:
    """A formula on a line of its own."""
    writer.body.append(f'<div class="formula">{_markup(node, "block")}</div>\n')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """The renderer `mathml`, which conf.py names."""
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
