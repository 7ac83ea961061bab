"""Whole powers by products, so that they mean the same over every number type."""

from __future__ import annotations

from typing import Any

LARGEST = 16
"""Further ones are refused: what is meant is a function, not algebra."""


def whole_power(base: Any, exponent: int) -> Any:
    """A number to a small whole power; 1 for the power 0.

    Args:
        base: of any number type.
        exponent: from -16 to 16.

    Errors:
        TypeError: another power, as one that is no whole number.

    >>> whole_power(3, 2), whole_power(2.0, -2), whole_power(5, 0)
    (9, 0.25, 1)
    """
    if type(exponent) is not int or abs(exponent) > LARGEST:
        raise TypeError(f"a power that is no whole number from -{LARGEST} to {LARGEST}")
    if exponent == 0:
        return 1
    result = base
    for digit in bin(abs(exponent))[3:]:
        result = result * result
        if digit == "1":
            result = result * base
    return 1 / result if exponent < 0 else result
