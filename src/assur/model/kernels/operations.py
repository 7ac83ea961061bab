"""+ - * / and whole powers of numbers; what else the same signs mean for tuples, texts and tables."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from typing import Any

from assur.model.kernels.faults import KernelFault, checked_length, checked_whole
from assur.model.kernels.values import PLAIN, TABLES, Value, is_number, kind_of, known
from assur.numerics.powers import LARGEST, whole_power

LARGEST_PLAIN = 2**62
"""Whole numbers below this are not measured."""


def plus(a: Value, b: Value) -> Value:
    """A sum; tuples, lists and texts one after the other.

    >>> plus(1, 2), plus((1,), (2,))
    (3, (1, 2))
    """
    if (known(type(a)) or is_number(a)) and (known(type(b)) or is_number(b)):
        return _bounded(a + b)
    if type(a) is type(b) and isinstance(a, tuple | list | str):
        checked_length(len(a) + len(b))
        return a + b
    raise _refused("+", a, b)


def minus(a: Value, b: Value) -> Value:
    """A difference of numbers."""
    if (known(type(a)) or is_number(a)) and (known(type(b)) or is_number(b)):
        return _bounded(a - b)
    raise _refused("-", a, b)


def times(a: Value, b: Value) -> Value:
    """A product of numbers; a tuple, list or text several times over.

    >>> times(2, 3.5), times((0,), 3)
    (7.0, (0, 0, 0))
    """
    if (known(type(a)) or is_number(a)) and (known(type(b)) or is_number(b)):
        return _bounded(a * b)
    for many, count in ((a, b), (b, a)):
        if type(many) in (tuple, list, str) and type(count) is int:
            checked_length(len(many) * max(count, 0))
            return many * count
    raise _refused("*", a, b)


def over(a: Value, b: Value) -> Value:
    """A quotient of numbers."""
    if (known(type(a)) or is_number(a)) and (known(type(b)) or is_number(b)):
        return a / b
    raise _refused("/", a, b)


def power(base: Value, exponent: Value) -> Value:
    """A whole power, by products: so that it means the same over every number type.

    >>> power(3, 2), power(2.0, -2)
    (9, 0.25)
    """
    if not is_number(base) or type(exponent) is not int or abs(exponent) > LARGEST:
        shown = exponent if type(exponent) in (int, float) and abs(exponent) < 1e6 else kind_of(exponent)
        raise KernelFault(
            f"{kind_of(base)} to the power {shown}",
            f"whole powers from -{LARGEST} to {LARGEST}",
            hint="a root is ns.sqrt" if exponent == 0.5 else "",
        )
    result = whole_power(base, exponent)
    return checked_whole(result) if type(result) is int else result


def remainder(a: Value, b: Value) -> Value:
    """What is left of a division of whole numbers."""
    if type(a) is int and type(b) is int and b != 0:
        return a % b
    raise KernelFault(f"% of {kind_of(a)} and {kind_of(b)}", "whole numbers")


def whole_quotient(a: Value, b: Value) -> Value:
    """How often one whole number goes into another."""
    if type(a) is int and type(b) is int and b != 0:
        return a // b
    raise KernelFault(f"// of {kind_of(a)} and {kind_of(b)}", "whole numbers")


def union(a: Value, b: Value) -> Value:
    """Two tables in one, the second before the first."""
    if isinstance(a, TABLES) and isinstance(b, TABLES):
        checked_length(len(a) + len(b))
        return {**a, **b}
    raise _refused("|", a, b)


def negative(a: Value) -> Value:
    """The opposite number."""
    if is_number(a):
        return -a
    raise KernelFault(f"- of {kind_of(a)}", "a number")


def positive(a: Value) -> Value:
    """The number itself."""
    if is_number(a):
        return a
    raise KernelFault(f"+ of {kind_of(a)}", "a number")


def compared(test: Callable[[Any, Any], bool]) -> Callable[[Value, Value], bool]:
    """A comparison, of plain data alone."""

    def compare(a: Value, b: Value) -> bool:
        if isinstance(a, PLAIN) and isinstance(b, PLAIN):
            return bool(test(a, b))
        raise KernelFault(
            f"{kind_of(a)} is compared with {kind_of(b)}",
            "whole numbers, texts, None",
            hint="a kernel never decides: return the quantity as a margin, its sign is judged outside",
        )

    return compare


def contained(a: Value, b: Value) -> bool:
    """Whether plain data is among the entries of a tuple, list or table, or a text in another."""
    plain = isinstance(a, PLAIN)
    if plain and isinstance(b, TABLES):
        return a in b
    if plain and isinstance(b, tuple | list) and all(isinstance(part, PLAIN) for part in b):
        return a in b
    if isinstance(a, str) and isinstance(b, str):
        return a in b
    raise KernelFault(f"{kind_of(a)} is sought in {kind_of(b)}", "plain data among plain data")


def same(a: Value, b: Value) -> bool:
    """Whether two are one: of None and truth values alone."""
    if a is None or b is None or isinstance(a, bool) or isinstance(b, bool):
        return a is b
    raise KernelFault("'is' between values", "'is None'", hint="compare the places of two entries, k == n")


def entry(value: Value, index: Value) -> Value:
    """An entry of a tuple, list, text or table, or a slice.

    >>> entry((1, 2, 3), slice(1, None)), entry({"a": 5}, "a")
    ((2, 3), 5)
    """
    if isinstance(value, TABLES):
        if type(index) in (str, int) and index in value:
            return value[index]
        shown = f"'{index[:40]}'" if type(index) is str else index if type(index) is int else kind_of(index)
        raise KernelFault(f"no entry {shown} in a table", f"its keys: {', '.join(map(str, value))[:400]}")
    if isinstance(value, tuple | list | str):
        if isinstance(index, slice) or (type(index) is int and -len(value) <= index < len(value)):
            return value[index]
        if type(index) is int:
            raise KernelFault(f"entry {index} of {len(value)}", f"0 to {len(value) - 1}")
        raise KernelFault(f"{kind_of(index)} as an index", "a whole number")
    raise KernelFault(
        f"an entry of {kind_of(value)}", "entries of tuples, lists, texts and tables", hint=_of_number(value)
    )


def _of_number(value: Value) -> str:
    return "a number stands for many poses at once, and has no entries" if is_number(value) else ""


def _bounded(value: Value) -> Value:
    return value if type(value) is not int or -LARGEST_PLAIN < value < LARGEST_PLAIN else checked_whole(value)


def _refused(sign: str, a: Value, b: Value) -> KernelFault:
    return KernelFault(f"{kind_of(a)} {sign} {kind_of(b)}", f"{sign} between numbers")


BINARY: Mapping[str, Callable[[Value, Value], Value]] = {
    "Add": plus, "Sub": minus, "Mult": times, "Div": over, "Pow": power, "Mod": remainder, "FloorDiv": whole_quotient,
    "BitOr": union,
}  # fmt: skip
UNARY: Mapping[str, Callable[[Value], Value]] = {"USub": negative, "UAdd": positive}
COMPARISONS: Mapping[str, Callable[[Value, Value], bool]] = {
    "Eq": compared(operator.eq), "NotEq": compared(operator.ne), "Lt": compared(operator.lt),
    "LtE": compared(operator.le), "Gt": compared(operator.gt), "GtE": compared(operator.ge),
    "In": contained, "NotIn": lambda a, b: not contained(a, b), "Is": same, "IsNot": lambda a, b: not same(a, b),
}  # fmt: skip
