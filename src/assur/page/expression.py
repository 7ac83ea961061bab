"""Numbers as expressions of JavaScript: what a formula becomes when it is read over them."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

from assur.numerics.recording.javascript import number_text


class Expression:
    """A number as JavaScript text, in parentheses where it is more than a name; plain numbers may stand beside it.

    >>> x = Expression("x")
    >>> (0 * x + 2 * (1 * x - 0.5) / x).text
    '((2.0*(x-0.5))/x)'
    """

    __slots__ = ("text",)
    __array_ufunc__ = None

    def __init__(self, text: str) -> None:
        self.text = text

    def __add__(self, other: Any) -> Any:
        return self if _is(other, 0) else self._joined("+", other)

    def __radd__(self, other: Any) -> Any:
        return self + other

    def __sub__(self, other: Any) -> Any:
        return self if _is(other, 0) else self._joined("-", other)

    def __rsub__(self, other: Any) -> Any:
        return -self if _is(other, 0) else Expression(f"({text_of(other)}-{self.text})")

    def __mul__(self, other: Any) -> Any:
        if _is(other, 0):
            return 0
        if _is(other, -1):
            return -self
        return self if _is(other, 1) else Expression(f"({text_of(other)}*{self.text})")

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        return self if _is(other, 1) else self._joined("/", other)

    def __rtruediv__(self, other: Any) -> Any:
        return 0 if _is(other, 0) else Expression(f"({text_of(other)}/{self.text})")

    def __neg__(self) -> Expression:
        return Expression(f"(-{self.text})")

    def _joined(self, sign: str, other: Any) -> Expression:
        return Expression(f"({self.text}{sign}{text_of(other)})")


def text_of(number: Any) -> str:
    """A number or an expression as text.

    >>> text_of(-2), text_of(Expression("x"))
    ('(-2.0)', 'x')
    """
    if isinstance(number, Expression):
        return number.text
    text = number_text(number)
    return f"({text})" if text.startswith("-") else text


def _is(number: Any, value: int) -> bool:
    return not isinstance(number, Expression) and bool(number == value)


def _function(name: str) -> Any:
    def applied(number: Any) -> Any:
        if isinstance(number, Expression):
            return Expression(f"Math.{name}({number.text})")
        return getattr(math, name)(number)

    return applied


FUNCTIONS = SimpleNamespace(sqrt=_function("sqrt"), sin=_function("sin"), cos=_function("cos"), pi=math.pi)
"""What formulas call (`assur.model.syntax.Functions`)."""
