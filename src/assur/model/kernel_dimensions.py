"""The dimensions as kernels take them: a length as a number, an angle as cosine and sine, like inputs and poses."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import SimpleNamespace
from typing import Any

from assur.model.mechanism import MechanismRecord


def angle_components(name: str) -> tuple[str, str]:
    """Names of the two numbers of an angle.

    >>> angle_components("alpha")
    ('cos alpha', 'sin alpha')
    """
    return f"cos {name}", f"sin {name}"


def dimension_numbers(record: MechanismRecord) -> Mapping[str, float]:
    """All numbers of a mechanism's dimensions by name, in the file's units of length: two of an angle.

    >>> from assur.model.registry import load_record
    >>> dict(dimension_numbers(load_record("fivebar")))["l1"]
    100.0
    """
    numbers: dict[str, float] = {}
    for name, value in vars(record.values).items():
        if record.parameters[name].angular:
            numbers |= zip(angle_components(name), (math.cos(value), math.sin(value)), strict=True)
        else:
            numbers[name] = value
    return numbers


def kernel_dimensions(record: MechanismRecord, number: Callable[[str], Any] | None = None) -> SimpleNamespace:
    """What kernels take as `p`.

    Args:
        record: the mechanism.
        number: gives the number of a name of `dimension_numbers`, of any type; the mechanism's own if left out.
    """
    of = dimension_numbers(record).__getitem__ if number is None else number
    own = {
        name: tuple(map(of, angle_components(name))) if parameter.angular else of(name)
        for name, parameter in record.parameters.items()
    }
    return SimpleNamespace(**own)
