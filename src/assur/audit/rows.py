"""What an audit answers: one row for every printed number, and the evidence of every erratum."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

from assur.results.answers.answer import Answer

Verdict = Literal["ok", "wrong", "missing"]


@dataclass(frozen=True)
class Row:
    """One printed number beside ours.

    Attributes:
        source: its address, e.g. "Table 1 row 4".
        quantity: what it is a value of.
        printed: its digits or words, as printed; empty for what should have been printed.
        computed: ours, in `unit`; None where there is no number.
        verdict: "ok", "wrong", or "missing" for a solution that the source does not list.
        erratum: id of the erratum that explains it, empty where there is none.
        tolerance: half a unit of the last printed place, and that of every printed number that it is computed
            from times the local sensitivity; None where the comparison is not one of numbers.
        off_by: printed less computed; None where that is no number.
        note: what is behind the verdict: the constraint that breaks, how the number is known.
    """

    source: str
    quantity: str
    printed: str
    computed: float | int | str | None
    verdict: Verdict
    erratum: str = ""
    tolerance: float | None = None
    off_by: float | None = None
    unit: str = ""
    note: str = ""


@dataclass(frozen=True)
class Evidence:
    """What the evidence function of an erratum computed: whether the erratum holds, in words and in numbers.

    `holds` is None where the function was not run, since nobody gave leave (`assur.model.consent`).
    """

    holds: bool | None
    text: str
    values: Mapping[str, Any] = field(default_factory=dict)

    @property
    def word(self) -> str:
        """Whether it holds, in a word.

        >>> Evidence(True, "").word
        'yes'
        """
        return {True: "yes", False: "NO", None: "not run"}[self.holds]


@dataclass(frozen=True)
class Erratum:
    """An entry of a mechanism's `reference/errata.toml`, with the evidence that was computed for it.

    Attributes:
        where, printed: the place, and the words or formula that stand there.
        finding: what is the matter.
        not_computed: what was read and not computed; empty where all was computed.
        status: "unreported", or when it was reported to whom.
    """

    id: str
    where: str
    printed: str
    finding: str
    evidence_name: str
    evidence: Evidence
    not_computed: str = ""
    status: str = "unreported"


@dataclass(frozen=True)
class Audit(Answer):
    """The audit of one mechanism.

    Attributes:
        origin: "printed" where the reference data come from a publication, "derived" where they are ours.
    """

    mechanism: str
    source: str
    origin: Literal["printed", "derived"]
    rows: tuple[Row, ...]
    errata: tuple[Erratum, ...]
    derived: ClassVar[tuple[str, ...]] = ("ok", "wrong", "missing", "claims_hold")

    @property
    def ok(self) -> int:
        """Number of rows that agree."""
        return self._count("ok")

    @property
    def wrong(self) -> int:
        """Number of rows that do not."""
        return self._count("wrong")

    @property
    def missing(self) -> int:
        """Number of values that the source should have listed."""
        return self._count("missing")

    @property
    def claims_hold(self) -> bool:
        """Whether all that we claim holds: every erratum by its evidence, and every row of derived data."""
        holds = all(erratum.evidence.holds is not False for erratum in self.errata)
        return holds and (self.origin == "printed" or len(self.rows) == self.ok)

    def _count(self, verdict: Verdict) -> int:
        return sum(row.verdict == verdict for row in self.rows)
