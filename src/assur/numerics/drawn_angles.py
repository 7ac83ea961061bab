"""Angles without trigonometry: sums of shares of a turn and of drawn angles, with exact cosines and sines."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any

from assur.numerics.vectors import sum_of_angles

TURN = ""
"""The part of an angle that is a share of a turn."""


@dataclass(frozen=True)
class DrawnAngle:
    """A sum of rational multiples of named angles, a turn among them."""

    parts: Mapping[str, Fraction] = field(default_factory=dict)

    def __neg__(self) -> DrawnAngle:
        return self * -1

    def __add__(self, other: DrawnAngle) -> DrawnAngle:
        names = dict.fromkeys((*self.parts, *other.parts))
        return DrawnAngle({name: self.parts.get(name, 0) + other.parts.get(name, Fraction(0)) for name in names})

    def __sub__(self, other: DrawnAngle) -> DrawnAngle:
        return self + -other

    def __mul__(self, other: Any) -> DrawnAngle:
        factor = _rational(other)
        return DrawnAngle({name: part * factor for name, part in self.parts.items()})

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        if not isinstance(other, DrawnAngle):
            return self * (1 / _rational(other))
        ratios = {self.parts.get(name, Fraction(0)) / part for name, part in other.parts.items() if part}
        if len(ratios) != 1 or set(self.parts) - set(other.parts):
            raise InexactError("a quotient of two angles")
        return ratios.pop()


class InexactError(ArithmeticError):
    """What no exact arithmetic is made for, as an angle that is a number."""


class DrawnAngles(ABC):
    """Cosines and sines of angles for a namespace of numbers that are drawn."""

    @abstractmethod
    def circle(self) -> tuple[Any, Any]:
        """Cosine and sine of an angle that is drawn."""

    @abstractmethod
    def multiple(self, _turns: Fraction) -> tuple[Any, Any] | None:
        """Cosine and sine of a share of a turn, where there are some."""

    @property
    def pi(self) -> DrawnAngle:
        """Half a turn."""
        return DrawnAngle({TURN: Fraction(1, 2)})

    def cos(self, angle: Any) -> Any:
        """Cosine of an angle."""
        return self.pair(angle)[0]

    def sin(self, angle: Any) -> Any:
        """Sine of an angle."""
        return self.pair(angle)[1]

    def pair(self, angle: Any) -> tuple[Any, Any]:
        """Cosine and sine of an angle; a share of a drawn one is drawn too, unless it is a whole multiple."""
        if not isinstance(angle, DrawnAngle):
            raise InexactError("the cosine of a number")
        result: tuple[Any, Any] = (1, 0)
        for name, share in angle.parts.items():
            result = sum_of_angles(result, self._part(name, share))
        return result

    def _part(self, name: str, share: Fraction) -> tuple[Any, Any]:
        if share == 0:
            return 1, 0
        own = self.multiple(share) if name == TURN else None
        if own is not None:
            return own
        size = abs(share)
        whole = size.numerator if size.denominator == 1 and name != TURN else 1
        base = self._drawn.setdefault((name, size / whole), None) or self.circle()
        self._drawn[name, size / whole] = base
        result: tuple[Any, Any] = (1, 0)
        for _ in range(whole):
            result = sum_of_angles(result, base)
        return result if share > 0 else (result[0], -result[1])

    @cached_property
    def _drawn(self) -> dict[tuple[str, Fraction], Any]:
        return {}


def _rational(number: Any) -> Fraction:
    exact = getattr(number, "exact", number)
    if not isinstance(exact, (int, Fraction)):
        raise InexactError("an angle times a number that is none")
    return Fraction(exact)
