"""What a kernel may import: the declarations of a closed form, records, and the algebra of `assur.numerics`."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping
from functools import lru_cache
from importlib import import_module
from typing import Any

from assur.model.kernels.declarations import declaring
from assur.model.kernels.faults import LENGTH, FormFault, KernelFault, checked_length
from assur.model.kernels.operations import plus
from assur.model.kernels.values import (
    TABLES,
    Module,
    OfferedFunction,
    Value,
    attribute,
    entries,
    frozen,
    is_number,
    key,
    kind_of,
    known,
    record,
    text_of,
)

ALGEBRA: Mapping[str, tuple[str, ...]] = {
    "vectors": (
        "about_x", "about_y", "about_z", "add", "apply", "cross", "difference_of_angles", "dot", "length",
        "of_quaternion", "opposite", "product", "scaled", "subtract", "sum_of_angles", "taking", "transposed", "triple",
    ),
    "meetings": ("angle_with", "coincident_spheres", "linear_in_three", "three_spheres"),
    "legs": ("couples", "from_leg", "in_leg", "pointing", "thirds", "two_bars"),
    "triangles": ("cross", "lines", "polynomial", "position", "rotated"),
    "polynomials": ("add", "half_angle", "multiply", "scaled", "subtract"),
    "resultants": ("ASKEW", "eliminant", "nearer", "nearer_angles", "other_two", "sum_of_squares"),
    "expanded": ("coefficients_of", "unknowns"),
}  # fmt: skip
"""Modules of `assur.numerics` and what a kernel may take from each; a test compares the docs with this table."""

DECLARATIONS = (
    "Branch", "ClosedForm", "Eliminant", "Factor", "Margin", "PolynomialSystem", "Quantity", "SelfMotion", "Sign",
)  # fmt: skip
COUNTS: Mapping[str, tuple[int, str]] = {
    "unknowns": (0, "count"),
    "half_angle": (1, "degree"),
    "coefficients_of": (1, "count"),
}
"""Functions that are told how many numbers to make -> place and name of that argument."""
MANY = 64
"""That a function makes at most; its work grows with the square, or worse."""
LARGEST_ENTRY = 10**6
"""Of a whole number among the numbers that a function of ours is given: a product with a tuple would repeat it."""
_NUMERICS, _DECLARED = "assur.numerics", "assur.model.closed_form"
OFFERED: Mapping[str, tuple[str, ...]] = {
    "types": ("SimpleNamespace",),
    "itertools": ("combinations", "product"),
    _DECLARED: DECLARATIONS,
    _NUMERICS: tuple(ALGEBRA),
    **{f"{_NUMERICS}.{name}": names for name, names in ALGEBRA.items()},
}
"""Modules that a kernel may import from, and what it may take of each."""


def imported(module: str, name: str) -> Value:
    """What `from module import name` gives.

    Errors:
        FormFault: nothing that a kernel may use.

    >>> imported("assur.numerics.vectors", "dot").name
    'dot'
    """
    names = OFFERED.get(module)
    if names is None:
        hint = "roots are ns.sqrt; no other function of it can be certified" if module in ("math", "numpy") else ""
        raise FormFault(f"an import of {module[:60]}", f"imports from {', '.join(OFFERED)}", hint)
    if name not in names:
        raise FormFault(f"'{name[:60]}' of {module}", f"names of {module} for kernels: {', '.join(names)}")
    return _named(module, name)


@lru_cache(maxsize=128)
def _named(module: str, name: str) -> Value:
    """What a name that is offered stands for; of ours no module is loaded that is not asked for."""
    if module == "types":
        return OfferedFunction(name, record)
    if module == "itertools":
        return OfferedFunction(name, {"combinations": _combinations, "product": _product}[name])
    if module == _DECLARED:
        return OfferedFunction(name, declaring(name))
    if module == _NUMERICS:
        path = f"{_NUMERICS}.{name}"
        return Module(path, {own: _named(path, own) for own in ALGEBRA[name]})
    return _offered(name, vars(import_module(module))[name])


def _offered(name: str, value: Value) -> Value:
    """A function as a kernel may call it, or a constant."""
    if not callable(value):
        return frozen(value)
    if name not in COUNTS:
        return OfferedFunction(name, value, "numbers")
    place, argument = COUNTS[name]

    def counted(*arguments: Value, **named: Value) -> Value:
        count = named.get(argument, arguments[place] if len(arguments) > place else None)
        if type(count) is not int or not 0 <= count <= MANY:
            raise KernelFault(f"{argument} of {name}", f"a whole number from 0 to {MANY}")
        return value(*arguments, **named)

    return OfferedFunction(name, counted, "numbers")


def numeric(value: Value, left: int = LENGTH, depth: int = 6) -> int:
    """How many numbers a value holds, if it holds nothing else.

    Errors:
        KernelFault: something else, or too many.

    >>> numeric((1, (2.0, 3)))
    3
    """
    kind = type(value)
    if kind is not int and known(kind):
        return 1
    if kind is int and abs(value) > LARGEST_ENTRY:
        raise KernelFault("a whole number over a million is given to a function", "smaller ones, or write it as 1e6")
    if is_number(value) or callable(getattr(type(value), "sqrt", None)):
        return 1
    if depth == 0 or not isinstance(value, (tuple, list, *TABLES)):
        raise KernelFault(f"{kind_of(value)} is given to a function of numbers", "numbers, and tuples of them")
    count = 0
    for part in value.values() if isinstance(value, TABLES) else value:
        count += numeric(part, left - count, depth - 1)
        checked_length(count + LENGTH - left)
    return count


def _combinations(values: Value, count: Value) -> Value:
    parts = entries(values)
    if type(count) is not int or not 0 <= count <= len(parts):
        raise KernelFault(f"combinations of {kind_of(count)} entries", f"0 to {len(parts)}")
    checked_length(math.comb(len(parts), count))
    return tuple(itertools.combinations(parts, count))


def _product(*many: Value) -> Value:
    rows = [entries(values) for values in many]
    checked_length(math.prod(map(len, rows)))
    return tuple(itertools.product(*rows))


def _range(*ends: Value) -> Value:
    if not ends or len(ends) > 3 or any(type(end) is not int for end in ends):
        raise KernelFault("range of something else than whole numbers", "range(stop), range(start, stop[, step])")
    try:
        numbers = range(*ends)
        checked_length(len(numbers))
    except (ValueError, OverflowError) as error:
        raise KernelFault("a range that has no length", f"at most {LENGTH} entries, a step that is not 0") from error
    return tuple(numbers)


def _zip(*many: Value, strict: Value = False) -> Value:
    rows = [entries(values) for values in many]
    if strict is True and len({len(row) for row in rows}) > 1:
        raise KernelFault(f"zip of {', '.join(str(len(row)) for row in rows)} entries", "equally many in each")
    return tuple(zip(*rows, strict=False))


def _enumerate(values: Value, start: Value = 0) -> Value:
    if type(start) is not int:
        raise KernelFault(f"enumerate from {kind_of(start)}", "a whole number")
    return tuple(enumerate(entries(values), start))


def _dict(pairs: Value = (), **named: Value) -> Value:
    table = dict(pairs) if isinstance(pairs, TABLES) else dict(_pair(pair) for pair in entries(pairs))
    return {**table, **named}


def _pair(value: Value) -> tuple[Any, Value]:
    parts = entries(value)
    if len(parts) != 2:
        raise KernelFault(f"a table of rows of {len(parts)}", "pairs of a key and a value")
    return key(parts[0]), parts[1]


def _sum(values: Value, start: Value = 0) -> Value:
    total = start
    for value in entries(values):
        total = plus(total, value)
    return total


def _len(values: Value) -> int:
    return len(entries(values))


def _getattr(value: Value, name: Value) -> Value:
    if type(name) is not str:
        raise KernelFault(f"getattr with {kind_of(name)}", "a name")
    return attribute(value, name)


def _no_magnitude(_: Value) -> Value:
    raise KernelFault("abs of a number", "+ - * / and ns.sqrt", "a magnitude is ns.sqrt(x*x)")


_OF_PYTHON: Mapping[str, Callable[..., Value]] = {
    "abs": _no_magnitude,
    "dict": _dict,
    "enumerate": _enumerate,
    "getattr": _getattr,
    "len": _len,
    "list": lambda values=(): list(entries(values)),
    "range": _range,
    "reversed": lambda values: entries(values)[::-1],
    "str": text_of,
    "sum": _sum,
    "tuple": lambda values=(): entries(values),
    "zip": _zip,
}
BUILTINS: Mapping[str, Value] = {name: OfferedFunction(name, function) for name, function in _OF_PYTHON.items()}
"""Functions of Python that the form knows; what they make is at once a tuple, a list or a table."""
