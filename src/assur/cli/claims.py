"""Claims: statements that are checked while they are printed, and remembered with their outcome."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from assur.cli.output import heading, show
from assur.results.answers.installation import Claim

if TYPE_CHECKING:
    from rich.console import RenderableType

MARKS = {True: ("\N{CHECK MARK}", "ok"), False: ("\N{BALLOT X}", "FAILS")}
COLOURS = {True: "green", False: "bold red"}


@dataclass
class Ledger:
    """The claims made so far; a silent one prints nothing."""

    silent: bool
    claims: list[Claim] = field(default_factory=list)
    title: str = ""

    @property
    def failed(self) -> int:
        """Number of claims that do not hold."""
        return sum(not claim.holds for claim in self.claims)

    def section(self, title: str) -> None:
        """Begin a part."""
        self.title = title
        self.show(["", heading(title)])

    def show(self, items: Iterable[RenderableType]) -> None:
        """Print items, unless silent."""
        if not self.silent:
            show(items)

    def claim(self, text: str, holds: Any, observed: str) -> None:
        """State what has just been checked, with its outcome."""
        made = Claim(self.title, text, bool(holds), observed)
        self.claims.append(made)
        self.show([_line(made)])


def _line(claim: Claim) -> RenderableType:
    from rich.table import Table
    from rich.text import Text

    row = Table.grid(padding=(0, 1))
    row.add_row(Text(_mark(claim.holds), style=COLOURS[claim.holds]), Text(f"{claim.claim}: {claim.outcome}"))
    return row


def _mark(holds: bool) -> str:
    """A check mark or a cross, in words where the output cannot show them."""
    sign, word = MARKS[holds]
    try:
        sign.encode(sys.stdout.encoding or "ascii")
    except (UnicodeEncodeError, LookupError):
        return word
    return sign
