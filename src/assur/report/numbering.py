"""The numbers of figures and equations: each from 1 on, in the order in which they stand."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

from assur.results.kinds import Formulas, Picture, Result, Section


@dataclass(frozen=True)
class Numbering:
    """The numbers that come next.

    Example:
        >>> from assur.results.kinds import PrintedFormula
        >>> lines = Formulas("f", (PrintedFormula("<math></math>", "(25)"), PrintedFormula("<math></math>")))
        >>> [section] = Numbering().numbered([Section("S", results=[lines])])
        >>> [line.number for line in section.results[0].lines]
        ['1', '2']
    """

    figures: Iterator[int] = field(default_factory=lambda: itertools.count(1))
    equations: Iterator[int] = field(default_factory=lambda: itertools.count(1))

    def numbered(self, sections: Iterable[Section]) -> tuple[Section, ...]:
        """The sections with their figures and equations numbered, those of sections inside them too."""
        return tuple(replace(section, results=tuple(map(self._result, section.results))) for section in sections)

    def _result(self, result: Result | Section) -> Result | Section:
        match result:
            case Section():
                return self.numbered([result])[0]
            case Picture():
                return replace(result, number=str(next(self.figures)))
            case Formulas():
                lines = tuple(replace(line, number=str(next(self.equations))) for line in result.lines)
                return replace(result, lines=lines)
            case _:
                return result
