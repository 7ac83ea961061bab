"""What a store holds: arrays of rows over places, the places cut into blocks, and a shard's run of these."""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from assur.errors import UsageError

NUMBER_OF_BLOCKS = 64
"""How many blocks a grid is cut into unless they would be too short or too long: enough for a few dozen shards."""
SHORTEST = 1024
"""Places in a block, at least: below, the calls take longer than the work."""


@dataclass(frozen=True)
class Array:
    """An array of a store, a `.npy` file.

    Attributes:
        name: of the file, without its ending.
        dtype: kind of number, as NumPy names it.
        rows: lengths of the axes before the places; () where there is one row.
        places: lengths of the axes over which the places run, the last one fastest.
    """

    name: str
    dtype: str
    rows: tuple[int, ...]
    places: tuple[int, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """All axes."""
        return self.rows + self.places

    @property
    def height(self) -> int:
        """Number of rows."""
        return math.prod(self.rows)

    @property
    def length(self) -> int:
        """Number of places."""
        return math.prod(self.places)

    @cached_property
    def header(self) -> bytes:
        """The first bytes of the file."""
        stream = io.BytesIO()
        described = np.lib.format.dtype_to_descr(np.dtype(self.dtype))
        np.lib.format.write_array_header_1_0(stream, {"descr": described, "fortran_order": False, "shape": self.shape})
        return stream.getvalue()

    @property
    def size(self) -> int:
        """Bytes of the numbers."""
        return self.height * self.length * np.dtype(self.dtype).itemsize

    @property
    def file_size(self) -> int:
        """Bytes of the file."""
        return len(self.header) + self.size

    def spans(self, part: slice) -> Iterator[tuple[int, int]]:
        """Where in the file each row of some places begins, and how many bytes it has there."""
        wide = np.dtype(self.dtype).itemsize
        for row in range(self.height):
            yield len(self.header) + wide * (row * self.length + part.start), wide * (part.stop - part.start)


@dataclass(frozen=True)
class Shard:
    """One of n parts of a store, counted from 1.

    >>> Shard.read("2/7")
    Shard(index=2, of=7)
    """

    index: int
    of: int

    @classmethod
    def read(cls, text: str) -> Shard:
        """From I/N.

        Errors:
            UsageError: no such text, or I is not between 1 and N.
        """
        first, slash, second = (part.strip() for part in text.partition("/"))
        whole = slash and all(part.isascii() and part.isdigit() and len(part) < 10 for part in (first, second))
        if not whole or not 1 <= int(first) <= int(second):
            raise UsageError(f"shard: '{text}' is not I/N with I from 1 to N", hint="for example 2/7, the second of 7")
        return cls(int(first), int(second))


@dataclass(frozen=True)
class Plan:
    """What is to be in a store.

    Attributes:
        question: all that the numbers depend on, as plain data.
        arrays: the arrays over the whole grid.
        block: places in a block; the last one may have fewer.
        shard: which part of the blocks, all where None.
        about: what people are told of the arrays of the whole grid, as plain data; empty where nobody is.
    """

    question: Mapping[str, Any]
    arrays: tuple[Array, ...]
    block: int
    shard: Shard | None = None
    about: Mapping[str, Any] | None = None

    @property
    def whole(self) -> Plan:
        """The same without a shard."""
        return replace(self, shard=None)

    @property
    def size(self) -> int:
        """Places of the whole grid."""
        return self.arrays[0].length

    @property
    def blocks(self) -> range:
        """The numbers of the blocks; of a shard its own, a run of those of the whole grid.

        >>> array = Array("status", "int8", (), (5, 7))
        >>> [list(Plan({}, (array,), 10, Shard(k, 3)).blocks) for k in (1, 2, 3)]
        [[0], [1], [2, 3]]
        """
        count = -(-self.size // self.block)
        if self.shard is None:
            return range(count)
        return range(count * (self.shard.index - 1) // self.shard.of, count * self.shard.index // self.shard.of)

    @property
    def places(self) -> slice:
        """Its places among those of the whole grid."""
        blocks = self.blocks
        return slice(min(blocks.start * self.block, self.size), min(blocks.stop * self.block, self.size))

    @property
    def length(self) -> int:
        """How many places it has."""
        return int(self.places.stop) - int(self.places.start)

    @cached_property
    def files(self) -> tuple[Array, ...]:
        """The arrays of its files: of a shard one axis of places."""
        if self.shard is None:
            return self.arrays
        return tuple(replace(array, places=(self.length,)) for array in self.arrays)

    @property
    def bytes(self) -> int:
        """Bytes of all numbers in its files."""
        return sum(array.size for array in self.files)

    def part(self, number: int) -> slice:
        """Places of a block among those of the whole grid."""
        return slice(number * self.block, min((number + 1) * self.block, self.size))

    def within(self, number: int) -> slice:
        """Places of a block among those of the files."""
        part, first = self.part(number), self.places.start
        return slice(part.start - first, part.stop - first)


def block_length(size: int, longest: int, shortest: int = SHORTEST) -> int:
    """Places in a block of a grid: by the grid alone, neither by the machine nor by how it is shared.

    >>> block_length(1000, 65536), block_length(640_000, 65536), block_length(10**9, 65536)
    (1024, 10000, 65536)
    """
    return min(max(-(-size // NUMBER_OF_BLOCKS), shortest), max(longest, shortest))


def known_array(name: str, kept: Mapping[str, Any]) -> Array:
    """An array from what a note says of it."""
    return Array(name, str(np.dtype(kept["dtype"])), *(tuple(map(int, kept[key])) for key in ("rows", "places")))
