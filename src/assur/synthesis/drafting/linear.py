"""Sums of named dimensions, such as B_x - A_x: what the formulas of a drafted file are made of."""

from __future__ import annotations

from dataclasses import dataclass

DUST = 1e-12
"""A share of a dimension below this is a rounding error of none."""


@dataclass(frozen=True)
class Linear:
    """A sum of dimensions, each times a number, in the order in which they came."""

    terms: tuple[tuple[str, float], ...] = ()

    def __add__(self, other: Linear) -> Linear:
        terms = dict(self.terms)
        for name, factor in other.terms:
            terms[name] = terms.get(name, 0.0) + factor
        return Linear(tuple((name, factor) for name, factor in terms.items() if abs(factor) > DUST))

    def __sub__(self, other: Linear) -> Linear:
        return self + other.times(-1.0)

    def times(self, factor: float) -> Linear:
        """The sum times a number."""
        return Linear(tuple((name, share * factor) for name, share in self.terms if abs(share * factor) > DUST))

    def text(self) -> str:
        """As a mechanism's file writes it: 0, or a formula.

        >>> (dimension("B_x") - dimension("A_x") + dimension("w").times(-0.5)).text()
        'B_x - A_x - w/2'
        >>> Linear().text()
        '0'
        """
        written = ""
        for name, factor in sorted(self.terms, key=lambda term: term[1] < 0):
            sign = ("-" if factor < 0 else "") if not written else (" - " if factor < 0 else " + ")
            written += sign + _share(name, abs(factor))
        return written or "0"


Point = tuple[Linear, Linear, Linear]
"""A point or a vector by its coordinates."""

ORIGIN: Point = (Linear(), Linear(), Linear())


def dimension(name: str) -> Linear:
    """One dimension alone."""
    return Linear(((name, 1.0),))


def plus(first: Point, second: Point) -> Point:
    """The sum of two vectors.

    >>> [part.text() for part in plus(ORIGIN, (dimension("R"), Linear(), Linear()))]
    ['R', '0', '0']
    """
    return (first[0] + second[0], first[1] + second[1], first[2] + second[2])


def minus(first: Point, second: Point) -> Point:
    """The vector from the second point to the first.

    >>> [part.text() for part in minus(ORIGIN, (dimension("R"), Linear(), Linear()))]
    ['-R', '0', '0']
    """
    return (first[0] - second[0], first[1] - second[1], first[2] - second[2])


def along(name: str, direction: tuple[float, float, float], share: float = 1.0) -> Point:
    """A dimension, or a share of it, along a direction.

    >>> [part.text() for part in along("w", (0.0, 0.6, -0.8), 0.5)]
    ['0', '0.3*w', '-0.4*w']
    """
    size = dimension(name)
    return (size.times(direction[0] * share), size.times(direction[1] * share), size.times(direction[2] * share))


def _share(name: str, factor: float) -> str:
    """A positive share of a dimension.

    >>> _share("w", 0.5), _share("w", 1.0), _share("w", 0.25)
    ('w/2', 'w', '0.25*w')
    """
    if abs(factor - 1.0) < DUST:
        return name
    return f"{name}/2" if abs(factor - 0.5) < DUST else f"{round(factor, 15)!r}*{name}"
