"""What a closed form declares, checked as it is made: each entry has the type that `assur.model.closed_form` says."""

from __future__ import annotations

import dataclasses
import types
import typing
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

from assur.model import closed_form
from assur.model.kernels.faults import KernelFault
from assur.model.kernels.values import TABLES, Function, Value, frozen, kind_of

LONGEST_TEXT = 1000
"""Characters of a meaning or a formula."""


def declaring(name: str) -> Callable[..., Value]:
    """The class of a declaration (`Margin`, `ClosedForm` ...), which refuses values of another type.

    >>> declaring("Sign")("lever1", "L").scale
    'L'
    """
    declared = getattr(closed_form, name)
    names = [item.name for item in dataclasses.fields(declared)]

    def make(*arguments: Value, **named: Value) -> Value:
        if len(arguments) > len(names) or not set(named) <= set(names):
            extra = ", ".join(sorted(set(named) - set(names)))[:100] or f"{len(arguments)} values"
            raise KernelFault(f"{name} is given {extra}", f"entries of {name}: {', '.join(names)}")
        given = {**dict(zip(names, arguments, strict=False)), **named}
        for key, value in given.items():
            if name != "Branch" and not _fits(value, _types(name)[key]):
                raise KernelFault(f"{key} of {name} is {kind_of(value)}", f"{key}: {_word(_types(name)[key])}")
        return declared(**{key: _own(value) for key, value in given.items()})

    return make


def _own(value: Value) -> Value:
    """Lists as tuples; a table stays one of its own."""
    return {key: frozen(part) for key, part in value.items()} if isinstance(value, TABLES) else frozen(value)


@lru_cache(maxsize=16)
def _types(name: str) -> dict[str, Any]:
    return typing.get_type_hints(getattr(closed_form, name))


def _fits(value: Value, kind: Any) -> bool:
    """Whether a value is of a type, entries of tuples and tables too."""
    origin, arguments = typing.get_origin(kind), typing.get_args(kind)
    if origin in (typing.Union, types.UnionType):
        return any(_fits(value, one) for one in arguments)
    if origin is typing.Literal:
        return type(value) is str and value in arguments
    if origin is tuple:
        return isinstance(value, tuple | list) and all(_fits(part, arguments[0]) for part in value)
    if origin in (Mapping, dict):
        return isinstance(value, TABLES) and all(
            _fits(key, str) and _fits(part, arguments[1]) for key, part in value.items()
        )
    if origin is Callable:
        return isinstance(value, Function)
    if kind is str:
        return type(value) is str and len(value) <= LONGEST_TEXT and value.isprintable()
    return type(value) is kind


def _word(kind: Any) -> str:
    """What a type is called in a message."""
    origin, arguments = typing.get_origin(kind), typing.get_args(kind)
    if origin in (typing.Union, types.UnionType):
        return " or ".join(_word(one) for one in arguments)
    if origin is typing.Literal:
        return ", ".join(f'"{one}"' for one in arguments)
    if origin is tuple:
        return f"a tuple, each {_word(arguments[0])}"
    if origin in (Mapping, dict):
        return f"a table of names, each {_word(arguments[1])}"
    if origin is not None:
        return "a function of this file"
    words: dict[Any, str] = {str: "a printable text", int: "a whole number", type(None): "None"}
    return words.get(kind) or str(kind.__name__)
