"""The answer of `assur sweep`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import Answer


@dataclass(frozen=True)
class SweptCoordinate:
    """Places along a coordinate of the grid, both ends too."""

    name: str
    unit: str
    low: float
    high: float
    count: int


@dataclass(frozen=True)
class SweptShard:
    """Which part of the grid: the `index`-th `of` so many, from place to place of all problems."""

    index: int
    of: int
    first: int
    last: int
    problems: int


@dataclass(frozen=True)
class SweptCounts:
    """Problems by how many modes solve them, and branches by status where it was kept; problems without a mechanism."""

    by_modes: Mapping[str, int]
    by_status: Mapping[str, int] | None
    refused: Mapping[str, int]


@dataclass(frozen=True)
class SweptFile:
    """An array and its axes; `rows` and `units` are those of an axis that is none of the grid."""

    file: str
    shape: tuple[int, ...]
    dtype: str
    axes: tuple[str, ...]
    rows: tuple[str, ...]
    units: tuple[str, ...]
    meaning: str


@dataclass(frozen=True)
class SweepAnswer(Answer):
    """What the files in a folder hold, and the blocks that were repaired."""

    mechanism: str
    dimensions: Mapping[str, float]
    problem: str
    mode: str
    modes: tuple[str, ...]
    unit: str
    angle: str
    along: tuple[SweptCoordinate, ...]
    at: Mapping[str, float]
    how: str
    problems: int
    done: int
    shard: SweptShard | None
    counts: SweptCounts
    bytes: int
    files: Mapping[str, SweptFile]
    folder: str
    repaired: tuple[str, ...]
