"""Recorded numbers that fold: what is known beforehand costs nothing in the program.

A kernel of general frames multiplies mostly by zeros and ones where axes are parallel. Here a plain 0, 1 or -1 leaves
no operation behind, x - x is zero, and arithmetic of plain numbers is done at once. Every other plain number becomes a
uniform one, so that mechanisms of other dimensions share one program. A result that is known is a plain float.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.numerics.powers import whole_power
from assur.numerics.recording.tape import Recorded, Recorder, Tape


class Folding:
    """Namespace for a kernel over folded numbers; it collects their operations and the plain numbers among them.

    >>> folding = Folding()
    >>> x = folding.varying("x")
    >>> tape = folding.tape({"y": 0.0 * x + 1.0 * x * 2.5})
    >>> [item.name for item in tape.operations], folding.numbers
    (['varying', 'uniform', '*'], array([2.5]))
    """

    def __init__(self) -> None:
        self.recorder = Recorder()
        self._known: dict[float, Recorded] = {}

    @property
    def numbers(self) -> NDArray[np.float64]:
        """The uniform numbers (u,) of the tape, in its order."""
        return np.array(list(self._known))

    def varying(self, name: str) -> Folded:
        """A number that is given for each element."""
        return Folded(self, self.recorder.varying(name))

    def sqrt(self, radicand: Any, /) -> Any:
        """Root of max(radicand, 0)."""
        if isinstance(radicand, Folded):
            return Folded(self, self.recorder.sqrt(radicand.value))
        return float(np.sqrt(max(radicand, 0.0)))

    def recorded(self, number: Any) -> Recorded:
        """A folded number, or a plain one, as the recorder has it."""
        if isinstance(number, Folded):
            return number.value
        if number not in self._known:
            self._known[number] = self.recorder.uniform(f"number{len(self._known)}")
        return self._known[number]

    def tape(self, outputs: Mapping[str, Any]) -> Tape:
        """What the wanted numbers need."""
        return self.recorder.tape({name: self.recorded(value) for name, value in outputs.items()})


@dataclass(frozen=True, eq=False)
class Folded:
    """A number of a kernel that is not known beforehand; finite, so that zero times it is zero."""

    folding: Folding
    value: Recorded

    def __neg__(self) -> Any:
        return Folded(self.folding, -self.value)

    def __add__(self, other: Any) -> Any:
        return self if _is(other, 0.0) else self._apply("+", self, other)

    def __radd__(self, other: Any) -> Any:
        return self if _is(other, 0.0) else self._apply("+", other, self)

    def __sub__(self, other: Any) -> Any:
        if isinstance(other, Folded) and other.value.index == self.value.index:
            return 0.0
        return self if _is(other, 0.0) else self._apply("-", self, other)

    def __rsub__(self, other: Any) -> Any:
        return -self if _is(other, 0.0) else self._apply("-", other, self)

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)

    def __mul__(self, other: Any) -> Any:
        if _is(other, 0.0):
            return 0.0
        if _is(other, 1.0):
            return self
        return -self if _is(other, -1.0) else self._apply("*", self, other)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        if _is(other, 1.0):
            return self
        return -self if _is(other, -1.0) else self._apply("/", self, other)

    def __rtruediv__(self, other: Any) -> Any:
        return 0.0 if _is(other, 0.0) else self._apply("/", other, self)

    def _apply(self, name: str, first: Any, second: Any) -> Folded:
        folding = self.folding
        return Folded(folding, folding.recorder.apply(name, folding.recorded(first), folding.recorded(second)))


def _is(number: Any, value: float) -> bool:
    return not isinstance(number, Folded) and bool(number == value)
