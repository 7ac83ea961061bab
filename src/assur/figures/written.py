"""Written numbers: true minus signs, powers of ten, and units with upright letters and raised powers."""

from __future__ import annotations

import math


def units(unit: str) -> str:
    """A unit as captions and axes show it: letters upright, powers raised.

    >>> units("mm^2 rad"), units("(mm/rad)^2"), units("m")
    ('mm$^2$ rad', '(mm/rad)$^2$', 'm')
    """
    parts = (part.partition("^") for part in unit.split(" "))
    return " ".join(f"{base}$^{power}$" if power else base for base, _, power in parts)


def times_ten(digits: str, power: int) -> str:
    """Digits times a power of ten, which is left out where it is 1.

    >>> times_ten("2.25", 7), times_ten("2.25", 0)
    ('2.25·10$^{7}$', '2.25')
    """
    return f"{digits}·10$^{{{power}}}$" if power else digits


def at_least(value: float) -> str:
    """A positive number to three digits, rounded down; a large or a small one with a power of ten.

    >>> at_least(15524.65), at_least(2.6038), at_least(22_504_620.0), at_least(0.0)
    ('15500', '2.6', '2.25·10$^{7}$', '0')
    """
    if value <= 0:
        return "0"
    power = math.floor(math.log10(value))
    kept = math.floor(value / 10.0 ** (power - 2))
    plain = -3 <= power < 5
    return times_ten(f"{kept / 10.0 ** (2 - power if plain else 2):g}", 0 if plain else power)
