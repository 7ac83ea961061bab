"""Formulas in mechanism files: a small grammar of our own, read exactly, never by `eval`.

    sum     = product { ("+" | "-") product }
    product = factor { ("*" | "/") factor }
    factor  = "-" factor | number [ "deg" | "rad" ] | name | "pi" | function "(" sum ")" | "(" sum ")"

Functions are sqrt, sin and cos. A name is made of parts joined by dots, each a letter followed by letters,
digits and underscores and then, if need be, primes: `l2`, `leg1.B.y`, `O'.x`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np

from assur.errors import UsageError
from assur.model.syntax import (
    Angle,
    Call,
    Functions,
    Literal,
    Name,
    Negative,
    Node,
    Number,
    Operands,
    Pi,
    evaluate,
    renamed,
)

MAX_LENGTH = 1000
MAX_DEPTH = 30
FUNCTIONS = ("sqrt", "sin", "cos")
ANGLE_UNITS = ("deg", "rad")
RESERVED = (*FUNCTIONS, *ANGLE_UNITS, "pi")

_PART = r"[A-Za-z_][A-Za-z0-9_]*'*"
_TOKEN = re.compile(
    rf"(?P<number>(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>{_PART}(?:\.{_PART})*)|(?P<sign>[-+*/()])",
    re.ASCII,
)
_VALUE = "a number, a name, '-' or '('"
_HINTS = {
    ",": "write decimals with a point: 0.5, not 0,5",
    "^": "there are no powers: write l2*l2",
    "[": "brackets are round: ( )",
    "{": "brackets are round: ( )",
    "\N{MINUS SIGN}": "write - (the hyphen on the keyboard)",
    "\N{EN DASH}": "write - (the hyphen on the keyboard)",
    "\N{MULTIPLICATION SIGN}": "write *",
    "\N{MIDDLE DOT}": "write *",
    "\N{DEGREE SIGN}": "write deg: 30 deg",
    "\N{GREEK SMALL LETTER PI}": "write pi",
    "\N{SQUARE ROOT}": "write sqrt( )",
}


class FormulaError(UsageError):
    """A formula that does not follow the grammar: what was found where, and what was expected there."""

    def __init__(self, text: str, position: int, given: str, expected: str, *, hint: str = "") -> None:
        start = max(0, position - 40)
        shown = text[start : position + 40].replace("\n", " ").replace("\t", " ")
        caret = " " * (position - start) + "^"
        super().__init__(f"cannot read this formula:\n  {shown}\n  {caret} {given}; expected {expected}", hint=hint)
        self.text = text
        self.position = position
        self.given = given
        self.expected = expected


@dataclass(frozen=True)
class Formula:
    """A formula that has been read.

    Attributes:
        text: as written.
        root: its syntax tree.
        names: every name in it that has to be looked up (pi and the functions are not among them).
    """

    text: str
    root: Node
    names: frozenset[str]

    def evaluate(
        self,
        lookup: Mapping[str, Any],
        functions: Functions = np,
        number: Literal = float,
    ) -> Any:
        """Value of the formula over any type that has + - * / .

        Args:
            lookup: name -> value; angles in rad.
            functions: sqrt, sin, cos and pi of the number type: `numpy`, `math`, `sympy`, ...
            number: how a literal is read; `sympy.Rational` reads it exactly.

        Example:
            >>> parse("(l3 - 2)/2 * cos(60 deg)").evaluate({"l3": 10.0})
            np.float64(2.0000000000000004)
        """
        return evaluate(self.root, lookup, functions, number)

    def renamed(self, names: Mapping[str, str]) -> Formula:
        """The same formula with other names; its text stays as written."""
        own = frozenset(names.get(name, name) for name in self.names)
        return Formula(self.text, renamed(self.root, names), own)


def parse(text: str) -> Formula:
    """Read a formula.

    Errors:
        FormulaError: a syntax error, a literal outside the range of floats, more than 1000 characters or
            30 nested brackets.

    Example:
        >>> sorted(parse("C1.y - B1.y + sqrt(l2*l2)").names)
        ['B1.y', 'C1.y', 'l2']
    """
    return _Reader(text).formula()


@dataclass(frozen=True)
class _Token:
    kind: str
    text: str
    position: int


class _Reader:
    """Recursive descent; the depth counts brackets and signs, so that no text can exhaust the stack."""

    def __init__(self, text: str) -> None:
        self.text = text
        if len(text) > MAX_LENGTH:
            self._fail(0, f"{len(text)} characters", f"at most {MAX_LENGTH}")
        self.tokens = self._tokens()
        self.index = 0
        self.depth = 0
        self.names: set[str] = set()

    def formula(self) -> Formula:
        root = self._sum()
        if self._next.kind != "end":
            self._unexpected("an operator or the end")
        return Formula(self.text, root, frozenset(self.names))

    def _tokens(self) -> list[_Token]:
        tokens: list[_Token] = []
        position = 0
        while position < len(self.text):
            if self.text[position].isspace():
                position += 1
                continue
            match = _TOKEN.match(self.text, position)
            if match is None:
                found = self.text[position]
                self._fail(position, repr(found), "a number, a name, an operator or a bracket", _HINTS.get(found, ""))
            tokens.append(_Token(match.lastgroup or "", match.group(), position))
            position = match.end()
        return [*tokens, _Token("end", "", len(self.text))]

    @property
    def _next(self) -> _Token:
        return self.tokens[self.index]

    def _take(self) -> _Token:
        token = self._next
        self.index += 1
        return token

    def _sum(self) -> Node:
        return self._chain(self._product, ("+", "-"))

    def _product(self) -> Node:
        return self._chain(self._factor, ("*", "/"))

    def _chain(self, part: Callable[[], Node], signs: tuple[str, str]) -> Node:
        first = part()
        rest: list[tuple[str, Node]] = []
        while self._next.text in signs:
            sign = self._take().text
            rest.append((sign, part()))
        return Operands(first, tuple(rest)) if rest else first

    def _factor(self) -> Node:
        token = self._take()
        if token.kind == "number":
            return self._number(token)
        if token.kind == "name":
            return self._name(token)
        if token.text in ("-", "("):
            return self._nested(token)
        self.index -= 1
        return self._unexpected(_VALUE)

    def _nested(self, token: _Token) -> Node:
        self.depth += 1
        if self.depth > MAX_DEPTH:
            self._fail(token.position, "too deep a nesting", f"at most {MAX_DEPTH} levels")
        node: Node = Negative(self._factor()) if token.text == "-" else self._bracket()
        self.depth -= 1
        return node

    def _bracket(self) -> Node:
        node = self._sum()
        if self._next.text != ")":
            self._unexpected("an operator or ')'")
        self._take()
        return node

    def _number(self, token: _Token) -> Node:
        if math.isinf(float(token.text)):
            self._fail(token.position, f"'{token.text}'", "a number below 1.8e308")
        if self._next.text in ANGLE_UNITS:
            return Angle(token.text, self._take().text)
        return Number(token.text)

    def _name(self, token: _Token) -> Node:
        if token.text in FUNCTIONS:
            if self._next.text != "(":
                self._unexpected(f"'(' after {token.text}")
            return Call(token.text, self._nested(self._take()))
        if token.text == "pi":
            return Pi()
        if token.text in ANGLE_UNITS:
            self._fail(token.position, f"'{token.text}'", _VALUE, f"a unit follows a number: 30 {token.text}")
        self.names.add(token.text)
        return Name(token.text)

    def _unexpected(self, expected: str) -> NoReturn:
        token = self._next
        hint = ""
        if expected.startswith("an operator") and token.kind in ("number", "name"):
            hint = "write * between factors: 2*l2"
        elif token.text == "*" and self.tokens[self.index - 1].text == "*":
            hint = _HINTS["^"]
        self._fail(token.position, f"'{token.text}'" if token.text else "the end", expected, hint)

    def _fail(self, position: int, given: str, expected: str, hint: str = "") -> NoReturn:
        raise FormulaError(self.text, position, given, expected, hint=hint)
