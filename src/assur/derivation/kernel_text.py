"""Formulas as text of a kernel: + - * /, whole powers and `ns.sqrt`, dimensions as attributes of `p`."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from keyword import iskeyword
from typing import Any

from sympy import Add, Expr, Mul, expand_trig, factor
from sympy.printing.pycode import PythonCodePrinter

from assur.derivation.definitions import Definition
from assur.derivation.not_derived import NotDerivedError

WIDTH = 116


class KernelPrinter(PythonCodePrinter):  # type: ignore[misc]  # SymPy has no types
    """Prints formulas of a mechanism.

    >>> from sympy import Symbol, sqrt
    >>> KernelPrinter({"l2"}).doprint(sqrt(3) * Symbol("l2") / Symbol("x"))
    'ns.sqrt(3)*p.l2/x'
    >>> from sympy import cos
    >>> KernelPrinter({"alpha"}).doprint(cos(Symbol("alpha")))  # an angle is cosine and sine
    'p.alpha[0]'
    """

    def __init__(self, parameters: Iterable[str]) -> None:
        super().__init__()
        self._parameters = {*parameters}

    def doprint(self, expr: Any, assign_to: Any = None) -> str:
        """The text of a formula; an angle is cosine and sine, so that a sum of angles is written out.

        What is made of dimensions alone stands together and first: numbers, worked out once for arrays of all else.
        """
        return str(super().doprint(self._grouped(expand_trig(expr)), assign_to))

    def _is_fixed(self, formula: Any) -> bool:
        return all(symbol.name in self._parameters for symbol in formula.free_symbols)

    def _grouped(self, formula: Any) -> Any:
        """Sums whose terms that have the same factors beside dimensions are one term."""
        if not isinstance(formula, Expr) or formula.is_Atom or self._is_fixed(formula):
            return formula
        parts = [self._grouped(part) for part in formula.args]
        if not formula.is_Add:
            return formula.func(*parts)
        groups: dict[Any, list[Any]] = {}
        for part in parts:
            fixed, rest = part.as_independent(*self._varying(part), as_Add=False)
            groups.setdefault(rest, []).append(fixed)
        sums = {rest: own[0] if len(own) == 1 else factor(Add(*own)) for rest, own in groups.items()}
        return Add(*(Mul(own, rest) for rest, own in sums.items()))

    def _varying(self, formula: Any) -> list[Any]:
        return [symbol for symbol in formula.free_symbols if symbol.name not in self._parameters]

    def _as_ordered_terms(self, expr: Any, order: Any = None) -> list[Any]:
        terms = super()._as_ordered_terms(expr, order)
        return sorted(terms, key=lambda term: not self._is_fixed(term))

    def _print_Mul(self, expr: Any) -> str:
        fixed = [part for part in expr.args if self._is_fixed(part)]
        rest = [part for part in expr.args if not self._is_fixed(part)]
        under = all(part.is_Pow and part.exp.is_negative for part in rest)
        if len(fixed) < 2 or under:
            return str(super()._print_Mul(expr))
        ahead = super()._print_Mul(Mul(*fixed, evaluate=False))
        behind = super()._print_Mul(Mul(*rest, evaluate=False)) if len(rest) > 1 else self.parenthesize(rest[0], 50)
        return f"({ahead})*{behind}" if "/" in ahead or "-" in ahead[1:] else f"{ahead}*{behind}"

    def _print_Symbol(self, expr: Any) -> str:
        return f"p.{expr.name}" if expr.name in self._parameters else str(expr.name)

    def _print_cos(self, expr: Any) -> str:
        return self._of_angle(expr, 0)

    def _print_sin(self, expr: Any) -> str:
        return self._of_angle(expr, 1)

    def _of_angle(self, expr: Any, place: int) -> str:
        (angle,) = expr.args
        if angle.is_Symbol:
            return f"{self._print(angle)}[{place}]"
        degrees = f"{float(angle) * 180 / math.pi:g} deg" if angle.is_number else str(angle)
        raise NotDerivedError(f"a closed form has no cosine of {degrees}: make it an angle among the parameters")

    def _print_Pow(self, expr: Any, rational: bool = False) -> str:
        base, power = expr.base, expr.exp
        if power.is_Rational and power.q == 2:
            root = f"ns.sqrt({self._print(base)})" + (f"**{abs(power.p)}" if abs(power.p) > 1 else "")
            return root if power > 0 else f"1/{root}"
        if power.is_Integer and power < 0:
            inner = self.parenthesize(base, 60)
            return f"1/{inner}" if power == -1 else f"1/{inner}**{-power}"
        return str(super()._print_Pow(expr, rational=rational))

    def _print_Rational(self, expr: Any) -> str:
        return f"{expr.p}/{expr.q}"


def assignments(definitions: Iterable[Definition], printer: KernelPrinter) -> list[str]:
    """Lines of a kernel, one for each definition."""
    return [f"    {own.symbol.name} = {printer.doprint(own.formula)}" for own in definitions]


def sign_text(name: str) -> str:
    """A mode's sign in a kernel, whose name may be no identifier.

    >>> sign_text("leg1"), sign_text("A1-B3")
    ('sign.leg1', 'getattr(sign, "A1-B3")')
    """
    return f"sign.{name}" if name.isidentifier() and not iskeyword(name) else f'getattr(sign, "{name}")'


def sign_attribute(name: str) -> str:
    """Under what the quantity is kept that a sign is the sign of.

    >>> sign_attribute("leg1"), sign_attribute("A1-B3")
    ('of_leg1', 'of_A1_B3')
    """
    return "of_" + re.sub(r"\W", "_", name)
