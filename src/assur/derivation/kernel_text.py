"""Formulas as text of a kernel: + - * /, whole powers and `ns.sqrt`, dimensions as attributes of `p`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from sympy.printing.pycode import PythonCodePrinter

from assur.derivation.elimination import Definition

WIDTH = 116


class KernelPrinter(PythonCodePrinter):  # type: ignore[misc]  # SymPy has no types
    """Prints formulas of a mechanism.

    >>> from sympy import Symbol, sqrt
    >>> KernelPrinter({"l2"}).doprint(sqrt(3) * Symbol("l2") / Symbol("x"))
    'ns.sqrt(3)*p.l2/x'
    """

    def __init__(self, parameters: Iterable[str]) -> None:
        super().__init__()
        self._parameters = {*parameters}

    def _print_Symbol(self, expr: Any) -> str:
        return f"p.{expr.name}" if expr.name in self._parameters else str(expr.name)

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
