"""Text in plain letters: the signs of the theory as a terminal without them can show them."""

from __future__ import annotations

import unicodedata
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import RenderableType

_SIGNS = {
    **{"∥": "||", "⊥": "_|_", "◇": "<>", "⌢": "^", "∪": "u", "∩": "n", "⋃": "U", "⋂": "N"},
    **{"ρ": "rho", "κ": "kappa", "ξ": "xi", "Δ": "Delta", "Σ": "sum ", "∑": "sum ", "ω": "omega"},
    **{"⁰": "^0", "¹": "^1", "²": "^2", "³": "^3", "⁴": "^4", "⁵": "^5", "⁶": "^6", "½": "1/2"},
    **{"×": "x", "·": ".", "−": "-", "–": "-", "≤": "<=", "≥": ">=", "≠": "!=", "→": "->", "∈": "in", "⊆": "<="},
    **{"′": "'", "’": "'", "°": " deg", "√": "sqrt"},
    **dict.fromkeys("⎡⎢⎣", "["),
    **dict.fromkeys("⎤⎥⎦", "]"),
}
_TABLE = str.maketrans(_SIGNS)


def ascii_text(text: str) -> str:
    """The same in ASCII; accents are dropped, and a sign that has no plain form becomes a question mark.

    >>> ascii_text("t³ r²(∥◇(R12, R3)), κ = 1, Jérôme")
    't^3 r^2(||<>(R12, R3)), kappa = 1, Jerome'
    """
    letters = unicodedata.normalize("NFKD", text.translate(_TABLE))
    kept = "".join(sign for sign in letters if not unicodedata.combining(sign))
    return kept.encode("ascii", "replace").decode("ascii")


def ascii_rule(shown: RenderableType) -> RenderableType:
    """The same, a table with a rule of hyphens under its head."""
    from rich.box import Box
    from rich.table import Table

    if isinstance(shown, Table):
        shown.box = Box("    \n    \n -- \n" + "    \n" * 5, ascii=True)
    return shown
