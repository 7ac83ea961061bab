"""Bounds of real numbers as pairs (low, high) of exact binary numbers, rounded outwards by python-flint's balls."""

from __future__ import annotations

from flint import arb

Bounds = tuple[arb, arb]


def add(a: Bounds, b: Bounds) -> Bounds:
    """Sum."""
    return (a[0] + b[0]).lower(), (a[1] + b[1]).upper()


def subtract(a: Bounds, b: Bounds) -> Bounds:
    """Difference."""
    return (a[0] - b[1]).lower(), (a[1] - b[0]).upper()


def multiply(a: Bounds, b: Bounds) -> Bounds:
    """Product; of one and the same object, its square.

    >>> x = (arb(-1), arb(2))
    >>> multiply(x, x), multiply(x, (arb(-1), arb(2)))
    ((0, 4.00000000000000), (-2.00000000000000, 4.00000000000000))
    """
    if a is b:
        size = magnitude(a)
        return (size[0] * size[0]).lower(), (size[1] * size[1]).upper()
    corners = [x * y for x in a for y in b]
    return min(c.lower() for c in corners), max(c.upper() for c in corners)


def divide(a: Bounds, b: Bounds) -> Bounds:
    """Quotient; the divisor must not be zero anywhere."""
    if not nonzero(b):
        raise ZeroDivisionError("division by what may be zero")
    corners = [x / y for x in a for y in b]
    return min(c.lower() for c in corners), max(c.upper() for c in corners)


def negative(a: Bounds) -> Bounds:
    """The number with the other sign."""
    return (-a[1]).lower(), (-a[0]).upper()


def magnitude(a: Bounds) -> Bounds:
    """Absolute value."""
    low, high = negative(a)
    return max(a[0], low, arb(0)), max(high, a[1])


def root(a: Bounds) -> Bounds:
    """Root of max(x, 0)."""
    return max(a[0], arb(0)).sqrt().lower(), max(a[1], arb(0)).sqrt().upper()


def cosine(a: Bounds) -> Bounds:
    """Cosine: the values at both ends, and 1 or -1 where a whole multiple of pi may lie between.

    >>> low, high = cosine((arb(-1), arb(2)))
    >>> round(float(low), 3), float(high)
    (-0.416, 1.0)
    """
    if magnitude(a)[1] > 2**60:
        return arb(-1), arb(1)
    first = int((a[0] / arb.pi()).lower().floor().unique_fmpz())
    last = int((a[1] / arb.pi()).upper().ceil().unique_fmpz())
    if last - first > 3:
        return arb(-1), arb(1)
    peaks = [(k, arb(k) * arb.pi()) for k in range(first, last + 1)]
    signs = [(-1) ** (k % 2) for k, at in peaks if at.upper() >= a[0] and at.lower() <= a[1]]
    ends = a[0].cos(), a[1].cos()
    low, high = min(end.lower() for end in ends), max(end.upper() for end in ends)
    return arb(-1) if -1 in signs else max(low, arb(-1)), arb(1) if 1 in signs else min(high, arb(1))


def sine(a: Bounds) -> Bounds:
    """Sine: the cosine of the angle less a quarter of a turn."""
    quarter = arb.pi() / 2
    return cosine(subtract(a, (quarter.lower(), quarter.upper())))


def nonzero(a: Bounds) -> bool:
    """Whether zero is certainly not inside."""
    return bool(a[0] > 0 or a[1] < 0)
