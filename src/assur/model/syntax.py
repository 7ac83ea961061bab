"""The syntax tree of a formula, and its value over any type that has + - * / ."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

Literal = Callable[[str], Any]
_OPERATORS = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}


class Functions(Protocol):
    """What a number type brings to a formula. The modules `math`, `numpy` and `sympy` are such objects."""

    @property
    def sqrt(self) -> Callable[[Any], Any]:
        """Square root."""

    @property
    def sin(self) -> Callable[[Any], Any]:
        """Sine of an angle in rad."""

    @property
    def cos(self) -> Callable[[Any], Any]:
        """Cosine of an angle in rad."""

    @property
    def pi(self) -> Any:
        """The number pi."""


@dataclass(frozen=True)
class Number:
    """A literal, kept as written so that it can be read exactly."""

    text: str


@dataclass(frozen=True)
class Angle:
    """A literal with a unit: `120 deg`, `3 rad`. Its value is in rad."""

    text: str
    unit: str


@dataclass(frozen=True)
class Name:
    """A name, to be looked up."""

    text: str


@dataclass(frozen=True)
class Pi:
    """The number pi."""


@dataclass(frozen=True)
class Negative:
    """The negative of a term."""

    of: Node


@dataclass(frozen=True)
class Call:
    """A function of one argument."""

    function: str
    of: Node


@dataclass(frozen=True)
class Operands:
    """Terms joined by + and -, or factors joined by * and /, from left to right."""

    first: Node
    rest: tuple[tuple[str, Node], ...]


Node = Number | Angle | Name | Pi | Negative | Call | Operands


def evaluate(node: Node, lookup: Mapping[str, Any], functions: Functions, number: Literal) -> Any:
    """Value of a tree; see `assur.model.formula.Formula.evaluate`."""
    match node:
        case Number(text):
            return number(text)
        case Angle(text, unit):
            return number(text) * functions.pi / number("180") if unit == "deg" else number(text)
        case Name(text):
            return lookup[text]
        case Pi():
            return functions.pi
        case Negative(of):
            return -evaluate(of, lookup, functions, number)
        case Call(function, of):
            own = {"sqrt": functions.sqrt, "sin": functions.sin, "cos": functions.cos}[function]
            return own(evaluate(of, lookup, functions, number))
        case Operands(first, rest):
            result = evaluate(first, lookup, functions, number)
            for sign, term in rest:
                result = _OPERATORS[sign](result, evaluate(term, lookup, functions, number))
            return result


def renamed(node: Node, names: Mapping[str, str]) -> Node:
    """The same tree with other names."""
    match node:
        case Name(text):
            return Name(names.get(text, text))
        case Negative(of):
            return Negative(renamed(of, names))
        case Call(function, of):
            return Call(function, renamed(of, names))
        case Operands(first, rest):
            return Operands(renamed(first, names), tuple((sign, renamed(term, names)) for sign, term in rest))
        case _:
            return node
