"""Nasty intervals, exact arithmetic to hold them against, and the IEEE 1788 test vectors."""

import re
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from assur.numerics.intervals.interval import Interval

VECTORS = Path(__file__).parent / "vectors" / "libieeep1788.itl"
LITERAL = re.compile(r"\[[^\]]*\]")
CASE = re.compile(r"^\s+(\w+) ((?:\[[^\]]*\] ?)+)= (\[[^\]]*\]);", re.MULTILINE)
EMPTY = None
NASTY = [
    0.0, 5e-324, 1e-323, 2.0**-1074 * 3, 2.0**-1022, np.nextafter(2.0**-1022, 0), 2.0**-1021, 2.0**-969, 2.0**-960,
    1e-200, 2.0**-537, 1e-16, 2.0**-53, 0.1, 1 / 3, np.nextafter(1.0, 0), 1.0, np.nextafter(1.0, 2), 1.5, 2.0,
    np.nextafter(2.0, 0), 3.0, np.pi, 1e8, 2.0**53, 2.0**53 + 2, 1e154, 1e160, 2.0**1023, np.nextafter(np.inf, 0),
]  # fmt: skip


@pytest.fixture(scope="session")
def nasty():
    """Floats at which rounding goes wrong first: about zero, powers of two, underflow, overflow; both signs."""
    return np.array(NASTY + [-number for number in NASTY])


@pytest.fixture(scope="session")
def nasty_intervals(nasty):
    """Every interval (N,) of two of them, and those with an infinite bound."""
    ends = np.concatenate([nasty, [-np.inf, np.inf]])
    low, high = (part.ravel() for part in np.meshgrid(ends, ends))
    kept = (low <= high) & (low < np.inf) & (high > -np.inf)
    return Interval.of(low[kept], high[kept])


@pytest.fixture(scope="session")
def vectors():
    """(operation, arguments, result) of the IEEE 1788 test vectors; a bound pair, or None for the empty set."""
    found = [
        (name, tuple(map(_bounds, LITERAL.findall(given))), _bounds(result))
        for name, given, result in CASE.findall(VECTORS.read_text(encoding="utf-8"))
    ]
    assert len(found) == 740
    return found


def _bounds(literal):
    inside = literal.strip("[] ")
    if inside == "empty":
        return EMPTY
    if inside == "entire":
        return (-np.inf, np.inf)
    low, high = (_number(part.strip()) for part in inside.split(","))
    return (low, high)


def _number(text):
    return float.fromhex(text) if "X" in text.upper() else float(text)


@pytest.fixture(scope="session")
def bounded_by():
    """Whether exact rationals lie between bounds that may be infinite."""

    def holds(low, exact, high):
        above = low == -np.inf or (np.isfinite(low) and Fraction(low) <= exact)
        return bool(above and (high == np.inf or (np.isfinite(high) and exact <= Fraction(high))))

    return holds
