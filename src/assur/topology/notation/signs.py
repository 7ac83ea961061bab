"""The signs of the notation: what is read as which, and how each style writes them.

A text is first written in plain letters, one character for one, so that places stay what they are: what
looks like a hyphen is one, a double bar is the sign of parallel, a bold or a raised R is an R.
"""

from __future__ import annotations

import re
import unicodedata
from typing import Literal

from assur.joints.catalogue import BY_LETTER
from assur.topology.poc import Style

Relation = Literal["parallel", "perpendicular", "coaxial", "meeting"]

_LOOKALIKES = {
    "-": "‐‑‒–—―−⁃",
    "∥": "‖║ǁ",
    "|": "∣│",
    "⊥": "⟂⏊┴",
    "◇": "◊⋄♢⬦",
    "⌢": "⁀⏜",
    "/": "∕⁄",
    "'": "′’",
    **{letter: joint_type.lookalikes for letter, joint_type in BY_LETTER.items()},
}
_TABLE = {ord(sign): plain for plain, signs in _LOOKALIKES.items() for sign in signs}

SPACE = re.compile(r"(?:\s|[$.·~\N{BULLET OPERATOR}]|\\[,;:! ]|\\(?:quad|left|right)(?![a-zA-Z]))+")
DIAMOND = re.compile(r"◇|<>|\\(?:Diamond|diamond|lozenge)(?![a-zA-Z])")
OPEN, CLOSE = re.compile(r"\\?\{"), re.compile(r"\\?\}")
BRANCH = re.compile(r"\|(?!\|)|\\mid(?![a-zA-Z])")
NOTHING = re.compile(r"-+")
RELATIONS: dict[Relation, re.Pattern[str]] = {
    "parallel": re.compile(r"\|\||∥|//|\\\||\\parallel(?![a-zA-Z])"),
    "perpendicular": re.compile(r"⊥|_\|_|\\(?:perp|bot)(?![a-zA-Z])"),
    "coaxial": re.compile(r"/"),
    "meeting": re.compile(r"⌢|\^(?![{(])|\\(?:small)?frown(?![a-zA-Z])"),
}

WRITTEN: dict[Style, dict[str, str]] = {
    "unicode": {"parallel": "∥", "perpendicular": "⊥", "coaxial": "/", "meeting": "⌢", "diamond": "◇", "branch": "|"},
    "ascii": {"parallel": "||", "perpendicular": "_|_", "coaxial": "/", "meeting": "^", "diamond": "<>", "branch": "|"},
    "latex": {
        "parallel": r"\parallel",
        "perpendicular": r"\perp",
        "coaxial": "/",
        "meeting": r"\frown",
        "diamond": r"\Diamond",
        "branch": r"\mid",
    },
}


def plain_letters(text: str) -> str:
    """The text in plain letters and signs, as long as it was.

    >>> plain_letters("‖ ⟂ − 𝑅₃")
    '∥ ⊥ - R3'
    """
    return "".join(map(_plain, text))


def _plain(sign: str) -> str:
    if sign.isascii():
        return sign
    known = _TABLE.get(ord(sign)) or unicodedata.normalize("NFKC", sign)
    return _TABLE.get(ord(known), known) if len(known) == 1 else sign
