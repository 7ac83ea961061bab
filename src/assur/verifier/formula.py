"""Formulas of mechanism files, read over any number type: rationals, + - * /, roots, cosines and sines of angles."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Protocol

PI, RADIAN = "pi", "rad"
LONGEST = 1000
MOST_POWER = 64
TOKEN = re.compile(r"\s*((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[A-Za-z_][\w']*|\*\*|[-+*/()])", re.ASCII)


@dataclass(frozen=True)
class AngleSum:
    """A sum of shares: of pi, of a radian, and of angles that have names, which no number type need know."""

    shares: Mapping[str, Any] = field(default_factory=dict)

    def plus(self, other: AngleSum) -> AngleSum:
        """The sum."""
        return AngleSum({k: self.shares.get(k, 0) + other.shares.get(k, 0) for k in {**self.shares, **other.shares}})

    def times(self, factor: Any) -> AngleSum:
        """A multiple."""
        return AngleSum({name: share * factor for name, share in self.shares.items()})


class NumberType(Protocol):
    """A number type: what it makes of a rational, and its functions. Its numbers have + - * / among themselves."""

    def number(self, value: Fraction) -> Any:
        """A rational."""

    def root(self, value: Any) -> Any:
        """The root that is not negative."""

    def circle(self, angle: AngleSum) -> tuple[Any, Any]:
        """Cosine and sine."""

    def radians(self, angle: AngleSum) -> Any:
        """An angle as a plain number."""


class FloatNumbers:
    """FloatNumbers.

    >>> value("2*l + sqrt(4)", {"l": 5.0}, FloatNumbers())
    12.0
    """

    number = float

    def root(self, value: float) -> float:
        """Square root."""
        return math.sqrt(value)

    def radians(self, angle: AngleSum) -> float:
        """The angle in rad."""
        return float(sum(share * (math.pi if name == PI else 1) for name, share in angle.shares.items()))

    def circle(self, angle: AngleSum) -> tuple[float, float]:
        """Cosine and sine."""
        turn = self.radians(angle)
        return math.cos(turn), math.sin(turn)


def value(text: Any, names: Mapping[str, Any], numbers: NumberType, longest: int = LONGEST) -> Any:
    """A formula of so many letters at most, or a number of the file: a rational, a number of the type, or an angle.

    Errors:
        ValueError: no formula, or one of angles and numbers that cannot be.
        ArithmeticError: it has no value.
    """
    if isinstance(text, (int, Fraction)) and not isinstance(text, bool):
        return Fraction(text)
    if not isinstance(text, str) or len(text) > longest:
        raise ValueError(f"{str(text)[:40]!r} is no formula")
    return _Reader(text, names, numbers).whole()


def number(text: Any, names: Mapping[str, Any], numbers: NumberType) -> Any:
    """A formula that is no angle, as a number of the type; of 0, 1 and -1 the integer."""
    result = value(text, names, numbers)
    if isinstance(result, AngleSum):
        return numbers.radians(result)
    if isinstance(result, Fraction):
        return int(result) if result in (0, 1, -1) else numbers.number(result)
    return result


class _Reader:
    """Recursive descent, and the value at once."""

    def __init__(self, text: str, names: Mapping[str, Any], numbers: NumberType) -> None:
        self.names, self.numbers = names, numbers
        self.tokens, place, text = [], 0, text.rstrip()
        while place < len(text):
            match = TOKEN.match(text, place)
            if match is None:
                raise ValueError(f"{text!r} is no formula")
            self.tokens.append(match[1])
            place = match.end()
        self.tokens.append("")
        self.tokens.reverse()

    def whole(self) -> Any:
        result = self._sum()
        if self.tokens != [""]:
            raise ValueError("a formula that goes on after its end")
        return result

    def _sum(self) -> Any:
        result = self._product()
        while self.tokens[-1] in ("+", "-"):
            minus = self.tokens.pop() == "-"
            term = self._product()
            result = self._joined("+", result, self._joined("*", term, Fraction(-1)) if minus else term)
        return result

    def _product(self) -> Any:
        result = self._factor()
        while self.tokens[-1] in ("*", "/"):
            sign = self.tokens.pop()
            result = self._joined(sign, result, self._factor())
        return result

    def _factor(self) -> Any:
        if self.tokens[-1] == "-":
            self.tokens.pop()
            return self._joined("*", self._factor(), Fraction(-1))
        base = self._atom()
        if self.tokens[-1] != "**":
            return base
        self.tokens.pop()
        exponent = self._factor()
        if not isinstance(exponent, Fraction) or exponent.denominator > 2 or not 0 < abs(exponent) <= MOST_POWER:
            raise ValueError("a power that is neither a small integer nor half of one")
        if exponent.denominator == 2:
            base = self.numbers.root(base if isinstance(base, Fraction) else plain(base, self.numbers))
        power = base
        for _ in range(abs(exponent.numerator) - 1):
            power = self._joined("*", power, base)
        return power if exponent > 0 else self._joined("/", Fraction(1), power)

    def _atom(self) -> Any:
        token = self.tokens.pop()
        if token == "(":
            result = self._sum()
            if self.tokens.pop() != ")":
                raise ValueError("a bracket that is not closed")
            return result
        if token in ("sqrt", "cos", "sin"):
            if self.tokens[-1] != "(":
                raise ValueError(f"{token} of nothing")
            return self._function(token, self._atom())
        if token[:1].isdigit() or token[:1] == ".":
            units = {"deg": AngleSum({PI: Fraction(1, 180)}), "rad": AngleSum({RADIAN: Fraction(1)})}
            unit = units.get(self.tokens[-1])
            return unit.times(Fraction(token)) if unit and self.tokens.pop() else Fraction(token)
        if not token or token in "+-**/)":
            raise ValueError("a formula that lacks a number")
        return AngleSum({PI: Fraction(1)}) if token == "pi" else self.names[token]

    def _function(self, name: str, argument: Any) -> Any:
        if name == "sqrt":
            return self.numbers.root(argument if isinstance(argument, Fraction) else plain(argument, self.numbers))
        if not isinstance(argument, AngleSum):
            raise ValueError(f"{name} of a plain number")
        return self.numbers.circle(argument)[name == "sin"]

    def _joined(self, sign: str, a: Any, b: Any) -> Any:
        return joined(sign, a, b, self.numbers)


def plain(operand: Any, numbers: NumberType) -> Any:
    """A rational or an angle as a number of the type."""
    if isinstance(operand, AngleSum):
        return numbers.radians(operand)
    return numbers.number(operand) if isinstance(operand, Fraction) else operand


def joined(sign: str, a: Any, b: Any, numbers: NumberType) -> Any:
    """Sum, product or quotient of rationals, angles and numbers of the type; rationals and angles stay exact."""
    angles = isinstance(a, AngleSum) + isinstance(b, AngleSum)
    if angles == 2 and sign == "+":
        return a.plus(b)
    if angles == 1 and sign == "*":
        angle, factor = (a, b) if isinstance(a, AngleSum) else (b, a)
        return angle.times(factor)
    if sign == "/" and isinstance(a, AngleSum) and not isinstance(b, AngleSum):
        return a.times(1 / b)
    if not (isinstance(a, Fraction) and isinstance(b, Fraction)):
        a, b = plain(a, numbers), plain(b, numbers)
    return a + b if sign == "+" else a * b if sign == "*" else a / b
