"""How large a search was, and what became of what it looked at."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Tally:
    """Numbers of a search, or of a part of it.

    Attributes:
        classes: sets of classes of limbs that the rules were asked about.
        combinations: mechanisms that they stand for.
        with_motion: those of them that have the required motion by the rules.
        coupling_degrees: number of these with each κ, where the rules give it.
        tried: those that were looked at one by one.
        unfixed: those of them whose driven joints, locked, leave a freedom.
        disagreements: those of them on which the two routes differ, in words.
    """

    classes: int = 0
    combinations: int = 0
    with_motion: int = 0
    coupling_degrees: Counter[int] = field(default_factory=Counter)
    tried: int = 0
    unfixed: int = 0
    disagreements: tuple[str, ...] = ()


def total(parts: Iterable[Tally]) -> Tally:
    """The sum of some parts.

    >>> total([Tally(tried=2), Tally(tried=3, unfixed=1)]).tried
    5
    """
    tallies = list(parts)
    return Tally(
        classes=sum(part.classes for part in tallies),
        combinations=sum(part.combinations for part in tallies),
        with_motion=sum(part.with_motion for part in tallies),
        coupling_degrees=sum((part.coupling_degrees for part in tallies), Counter()),
        tried=sum(part.tried for part in tallies),
        unfixed=sum(part.unfixed for part in tallies),
        disagreements=tuple(text for part in tallies for text in part.disagreements),
    )
