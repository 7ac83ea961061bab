"""Relations of dimensions that a derivation takes as hypotheses: those of the file's numbers, or of its formulas."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from assur.verifier.formula import FloatNumbers, NumberType, plain, value
from assur.verifier.mechanism import FileMechanism
from assur.verifier.reading import RefusedError, require

SAME = 1e-9
"""Share of the largest dimension within which a file's numbers have a relation: home closes its loops as nearly."""


@dataclass(frozen=True)
class Relations:
    """Hypotheses of one problem.

    Attributes:
        mechanism: the file.
        formulas: dimension -> what it is, as written.
    """

    mechanism: FileMechanism
    formulas: Mapping[str, str]

    @property
    def texts(self) -> tuple[str, ...]:
        """In words."""
        return tuple(f"{name} = {text}" for name, text in self.formulas.items())

    def among(self, free: Mapping[str, Any], numbers: NumberType) -> dict[str, Any]:
        """Dimensions, of which those with a relation follow from the others. Errors: RefusedError."""
        return _following(self.formulas, free, numbers)

    def held_by_numbers(self) -> None:
        """Errors: RefusedError, where the file's numbers do not have a relation."""
        own = self.mechanism.dimensions(FloatNumbers())
        largest = max((abs(own[name]) for name, (_, unit) in self.mechanism.parameters.items() if not unit), default=0)
        following = self.among(own, FloatNumbers())
        for name, text in self.formulas.items():
            if not abs(float(following[name]) - float(own[name])) <= SAME * float(largest):
                raise RefusedError(f"the file's {name} is not {text[:60]}")

    def unstated(self, free: Mapping[str, Any], numbers: NumberType, zero: Callable[[Any], bool]) -> tuple[str, ...]:
        """Those that no formula of the file's parameters says.

        Args:
            free: a number of the type for each dimension.
            numbers: the type.
            zero: whether one vanishes.
        """
        written = {name: text for name, (text, _) in self.mechanism.parameters.items() if isinstance(text, str)}
        own = _following(written, free, numbers)
        gaps = (own[name] - plain(value(text, own, numbers), numbers) for name, text in self.formulas.items())
        return tuple(text for text, gap in zip(self.texts, gaps, strict=True) if not zero(gap))


def _following(formulas: Mapping[str, str], free: Mapping[str, Any], numbers: NumberType) -> dict[str, Any]:
    """Values by name, of which some follow by formulas of the others. Errors: RefusedError."""
    require(formulas.keys() <= free.keys(), "a relation of what is no dimension")
    known = {name: own for name, own in free.items() if name not in formulas}
    for name, text in [*formulas.items()] * len(formulas):
        if name not in known:
            try:
                known[name] = value(text, known, numbers)
            except KeyError:  # of what follows itself, perhaps later
                continue
    require(len(known) == len(free), f"relations that say each other: {', '.join(free.keys() - known.keys())[:80]}")
    return known
