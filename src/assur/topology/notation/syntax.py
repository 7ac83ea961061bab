"""What a chain's text says, before any axis is placed: joints, diamonds, loops, and the signs between them."""

from __future__ import annotations

from dataclasses import dataclass

from assur.topology.chains import BASE, PLATFORM, ParallelogramKind
from assur.topology.directions import Vector
from assur.topology.notation.errors import Source
from assur.topology.notation.signs import Relation


@dataclass(frozen=True)
class WrittenDirection:
    """A direction that was written in brackets, `shown` as it was written, and where; labels of points on the axis."""

    vector: Vector
    shown: str
    at: int
    labels: tuple[str, ...] = ()


@dataclass(frozen=True)
class Tag:
    """The inner loop that an element belongs to, "2P4R": so many P and so many R in one plane."""

    prismatic: int
    revolute: int
    at: int

    def __str__(self) -> str:
        return _count(self.prismatic, "P") + _count(self.revolute, "R")


@dataclass(frozen=True)
class WrittenJoint:
    """A joint, or a parallelogram if it has a `kind`; `name` and `bar` are empty and `labels` none if not written."""

    letter: str
    at: int
    kind: ParallelogramKind | None = None
    name: str = ""
    tag: Tag | None = None
    directions: tuple[WrittenDirection, ...] = ()
    labels: tuple[str, ...] = ()
    bar: str = ""

    @property
    def points(self) -> tuple[str, tuple[tuple[str, ...], ...]]:
        """Label of its point or centre, and those of further points on each axis; an only axis has no centre.

        >>> direction = WrittenDirection((1.0, 0.0, 0.0), "x", 2, ("A",))
        >>> WrittenJoint("R", 0, directions=(direction,), labels=("B",)).points
        ('B', (('A',),))
        """
        inside = [direction.labels for direction in self.directions]
        if len(inside) < 2:
            first, *others = (*self.labels, *(label for labels in inside for label in labels), "")
            return first, (tuple(others[:-1]),) if others[:-1] else ()
        return "".join(self.labels), tuple(inside) if any(inside) else ()


@dataclass(frozen=True)
class Diamond:
    """Two elements in series, and the plane that they span."""

    members: tuple[WrittenJoint, WrittenJoint]
    at: int


@dataclass(frozen=True)
class WrittenLoop:
    """Branches side by side."""

    branches: tuple[Serial, ...]
    at: int


@dataclass(frozen=True)
class WrittenSign:
    """What stands between two elements; no relation where it says nothing."""

    relations: tuple[Relation, ...]
    at: int


@dataclass(frozen=True)
class Serial:
    """Elements in series, and the signs between neighbours (one fewer)."""

    items: tuple[WrittenJoint | Diamond | WrittenLoop, ...]
    signs: tuple[WrittenSign, ...]


@dataclass(frozen=True)
class WrittenLimb:
    """A chain as written. `literature`: it uses signs, a diamond or tags, or stands in SOC{ }. `ends` are links."""

    source: Source
    serial: Serial
    literature: bool
    ends: tuple[str, str] = (BASE, PLATFORM)


def _count(number: int, letter: str) -> str:
    return f"{number if number > 1 else ''}{letter}" if number else ""
