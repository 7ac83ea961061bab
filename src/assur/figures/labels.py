"""Labels: the LaTeX that files and callers give for a quantity, or its plain name where that cannot be set."""

from __future__ import annotations

import re
from functools import lru_cache

from assur.figures.letters import GREEK, mathematics, words

LONGEST = 300
"""Characters of a label at most; nested deeper, the setting of type runs out of stack."""
_KEPT = re.compile(r"[^A-Za-z0-9 .,'+-]")
_SCRIPTS = r"(?:_(?:[A-Za-z0-9]|\{[A-Za-z0-9,]+(?:_[0-9])?\}))?(?:\^[0-9])?"
_WORD = rf"\\(?:{'|'.join(sorted(GREEK))}|varphi|Pi|sin|cos)(?![A-Za-z])"
_NAME = rf"(?:[A-Za-z0-9)|]|\\mathbf\{{[A-Za-z]\}}|{_WORD}){_SCRIPTS}"
_BETWEEN = r"[-+=/,( ]|\\[, ]|\\(?:times|cdot|pm|det|angle|partial)(?![A-Za-z])"
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

    >>> label(r"\theta_{1", "theta"), label("", "l2"), label("", "q_a_b")
    ('\\theta', 'l_{2}', '\\mathrm{q\\ a\\ b}')
    """
    if is_settable(latex):
        return latex
    own = mathematics(name)
    return own if is_settable(own) else rf"\mathrm{{{upright(words(name))}}}"


def upright(text: str) -> str:
    """Words as they stand in mathematics, without what has a meaning there."""
    return _KEPT.sub(" ", text).strip().replace(" ", r"\ ") or "?"
