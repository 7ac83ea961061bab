"""What a kernel's text can have in hand: numbers of any type, plain data, records; and what it may do with them.

A number is whatever is none of the rest: an array, an interval, a recorded number. It has + - * / and `ns.sqrt`, and
nothing else: no attribute, no method and no index of it is ever looked up.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType, SimpleNamespace
from typing import Any

from assur.model.closed_form import Branch
from assur.model.kernels.faults import PARTS, KernelFault, LimitFault, checked_length

Value = Any


@dataclass(frozen=True)
class OfferedFunction:
    """A function of ours that a kernel may call.

    Attributes:
        name: as the kernel's text calls it.
        function: called with values of the evaluator.
        takes: "numbers" and tuples of them, or "anything".
    """

    name: str
    function: Callable[..., Value]
    takes: str = "anything"


@dataclass(frozen=True)
class Module:
    """A module of ours, as a table of what a kernel may take from it."""

    name: str
    names: Mapping[str, Value]


class Function:
    """A function of the kernel's text; `assur.model.kernels.functions` makes and calls them."""


PLAIN = (bool, int, str, type(None))
"""What may be compared, and what a condition may be made of: never a number that a kernel computes with."""
TABLES = (dict, MappingProxyType)
RECORDS = (SimpleNamespace, Branch)
_DATA = (tuple, list, str, type(None), range, *TABLES, *RECORDS, OfferedFunction, Module, Function, bytes, type)
_known: dict[type, bool] = {int: True, float: True}
known = _known.get
"""Of a type that was met before: whether it is one of numbers. The operations ask it first, being most of the work."""


def is_number(value: Value) -> bool:
    """Whether a value is one that + - * / are meant for.

    >>> is_number(2.5), is_number((1, 2)), is_number("2")
    (True, False, False)
    """
    kind = type(value)
    if kind not in _known:
        data = issubclass(kind, _DATA) or (dataclasses.is_dataclass(kind) and kind.__module__ == Branch.__module__)
        _known[kind] = not data and not callable(value)
    return _known[kind]


def kind_of(value: Value) -> str:
    """What a value is, in a word; never the value itself, which may be large.

    >>> kind_of((1, 2)), kind_of(0.5), kind_of(None)
    ('a tuple', 'a number', 'None')
    """
    words = {str: "a text", list: "a list", tuple: "a tuple", type(None): "None", bool: "a truth value"}
    if type(value) in words:
        return words[type(value)]
    if isinstance(value, TABLES):
        return "a table"
    if isinstance(value, Function | OfferedFunction):
        return "a function"
    if isinstance(value, tuple | SimpleNamespace):
        return "a record"
    return "a number" if is_number(value) else f"a {type(value).__name__}"


def entries(value: Value) -> tuple[Value, ...]:
    """What a loop runs over, a star spreads and a row of names is given.

    >>> entries([1, 2]), entries("xy"), entries({"a": 1})
    ((1, 2), ('x', 'y'), ('a',))
    """
    if isinstance(value, tuple | list | str | range | dict | MappingProxyType):
        checked_length(len(value))
        return tuple(value)
    raise KernelFault(f"{kind_of(value)} is taken apart", "a tuple, a list, a text or a table")


def text_of(value: Value) -> str:
    """A part of a text: a whole number or another text.

    >>> text_of(3)
    '3'
    """
    if type(value) in (int, str):
        return str(value)
    raise KernelFault(f"{kind_of(value)} in a text", "a whole number or a text")


def truth(value: Value) -> bool:
    """Whether a condition holds; of a number a kernel cannot know.

    >>> truth(()), truth(1)
    (False, True)
    """
    if isinstance(value, (*PLAIN, tuple, list, *TABLES)):
        return bool(value)
    raise KernelFault(
        f"a condition on {kind_of(value)}",
        "conditions on whole numbers, texts and None",
        hint="a kernel never decides: return the quantity as a margin, its sign is judged outside",
    )


def key(value: Value) -> Value:
    """A key of a table.

    >>> key("x")
    'x'
    """
    if type(value) in (str, int):
        return value
    raise KernelFault(f"{kind_of(value)} as a key", "a text or a whole number")


def parts_of(value: Value) -> int:
    """How many parts a value has, itself and what it is made of, each as often as it occurs.

    Errors:
        LimitFault: more than anything may have that is walked through.

    >>> parts_of((1, (2, 3)))
    5
    """
    count, left = 0, [value]
    while left:
        part = left.pop()
        count += 1
        if isinstance(part, tuple | list):
            left += part
        elif isinstance(part, TABLES):
            left += part.values()
        elif isinstance(part, RECORDS):
            left += vars(part).values()
        if count + len(left) > PARTS:
            raise LimitFault(f"a value of more than {PARTS} parts", hint="a tuple that holds itself twice is doubled")
    return count


def frozen(value: Value) -> Value:
    """The same data without anything that could be changed later, so that a kernel keeps nothing from call to call.

    >>> frozen([1, [2]])
    (1, (2,))
    """
    if isinstance(value, list):
        return tuple(frozen(part) for part in value)
    if type(value) is tuple and any(isinstance(part, list | tuple | dict) for part in value):
        return tuple(frozen(part) for part in value)
    if isinstance(value, dict):
        return MappingProxyType({name: frozen(part) for name, part in value.items()})
    return value


def attribute(value: Value, name: str) -> Value:
    """An attribute: of a record its entry, of a module of ours what it offers, `sqrt` of the namespace."""
    if name.startswith("_"):
        raise KernelFault(f"the attribute '{name}'", "names that do not begin with an underscore")
    if isinstance(value, RECORDS):
        own = vars(value)
        return own[name] if name in own else _entry(own, name)
    if isinstance(value, Module):
        return _entry(value.names, name)
    if isinstance(value, tuple) and name in getattr(type(value), "_fields", ()):
        return getattr(value, name)
    if name == "sqrt" and not isinstance(value, _DATA) and callable(getattr(type(value), "sqrt", None)):
        return OfferedFunction("sqrt", value.sqrt)
    raise KernelFault(
        f"the attribute '{name}' of {kind_of(value)}",
        "attributes of p, sign, core and other records, and ns.sqrt",
        hint="a number has + - * / and ** only" if is_number(value) else "",
    )


def method(value: Value, name: str) -> Value:
    """What `value.name(...)` calls: a method of a list, text or table, else an attribute.

    A method is called where it is named and is no value: kept for later it would keep its list or table as well, and
    with that something from one call to the next.

    >>> method(["x"], "append").name
    'append'
    """
    function = _METHODS.get((_family(value), name)) if isinstance(value, (list, str, *TABLES)) else None
    return OfferedFunction(name, lambda *arguments: function(value, *arguments)) if function else attribute(value, name)


def _entry(names: Mapping[str, Value], name: str) -> Value:
    if name not in names:
        known = ", ".join(sorted(key for key in names if not key.startswith("_")))
        raise KernelFault(f"no '{name}' there", f"there is: {known[:400]}")
    return names[name]


def _family(value: Value) -> type:
    return dict if isinstance(value, TABLES) else type(value)


def _append(target: list[Value], value: Value) -> None:
    checked_length(len(target) + 1)
    target.append(value)


def _extend(target: list[Value], values: Value) -> None:
    more = entries(values)
    checked_length(len(target) + len(more))
    target.extend(more)


def _joined(between: str, parts: Value) -> str:
    texts = [text_of(part) for part in entries(parts)]
    checked_length(sum(map(len, texts)) + len(between) * len(texts))
    return between.join(texts)


def _get(table: Mapping[Any, Value], name: Value, default: Value = None) -> Value:
    return table.get(key(name), default)


_METHODS: Mapping[tuple[type, str], Callable[..., Value]] = {
    (list, "append"): _append,
    (list, "extend"): _extend,
    (str, "join"): _joined,
    (dict, "get"): _get,
    (dict, "items"): lambda table: tuple(table.items()),
    (dict, "keys"): lambda table: tuple(table),
    (dict, "values"): lambda table: tuple(table.values()),
}


def record(**parts: Value) -> SimpleNamespace:
    """A record of named values, as SimpleNamespace makes it.

    >>> record(x=1).x
    1
    """
    for name in parts:
        if not name.isidentifier() or name.startswith("_"):
            raise KernelFault("a record with a name that is none", "names that do not begin with an underscore")
    return SimpleNamespace(**{name: frozen(part) for name, part in parts.items()})


def spread(value: Value) -> Iterable[tuple[str, Value]]:
    """Names and values that two stars hand to a call."""
    if not isinstance(value, TABLES):
        raise KernelFault(f"two stars before {kind_of(value)}", "a table of names")
    for name, part in value.items():
        if type(name) is not str:
            raise KernelFault("a name that is no text", "a table of names")
        yield name, part
