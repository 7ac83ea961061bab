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
        with_motion: those of them that have the wanted motion by the rules.
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
    found = list(parts)
    return Tally(
        classes=sum(part.classes for part in found),
        combinations=sum(part.combinations for part in found),
        with_motion=sum(part.with_motion for part in found),
        coupling_degrees=sum((part.coupling_degrees for part in found), Counter()),
        tried=sum(part.tried for part in found),
        unfixed=sum(part.unfixed for part in found),
        disagreements=tuple(text for part in found for text in part.disagreements),
    )
