"""Answers filled by compiled loops: rows that a loop writes, and rows that NumPy makes of its numbers; which engine."""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics import border
from assur.kinematics.closed_form.blocks import NOT_FINITE, Components, FloatArray, each_block
from assur.kinematics.closed_form.recorded import AnswerRow, Recording
from assur.numerics.recording.loops import empty_rows
from assur.numerics.singular_values import float_condition_index
from assur.numerics.small_matrices import determinant
from assur.work import Progress

BoolArray = NDArray[np.bool_]


Engine = Literal["auto", "numpy", "compiled"]

BLOCK_COMPILED = 65536
"""Poses per block of a compiled loop, which has no temporaries: what one thread does at a time."""

REPAID = 5_000_000
"""Poses from which "auto" loads a compiled loop; making it for the first time takes a second or two."""

REPAID_LOADED = 10_000
"""Poses from which "auto" takes a loop that is loaded."""


@dataclass(frozen=True, eq=False)
class Filler:
    """Fills an answer, part by part, by the compiled loop; parts may be filled by several threads.

    Attributes:
        recording: the tape.
        uniform: its uniform numbers.
        rows: what each row of `numbers` is.
        truths_wanted: for each row of `truths`, the output of the tape.
        numbers, truths: the answer (R, N) and (T, N), contiguous.
    """

    recording: Recording
    uniform: FloatArray
    rows: tuple[AnswerRow, ...]
    truths_wanted: tuple[str, ...]
    numbers: FloatArray
    truths: BoolArray

    def fill(self, given: FloatArray, start: int) -> bool:
        """Fill from element `start` on, for components (m, b); whether all of these are finite."""
        if self.recording.has_angles and not np.all(np.isfinite(given)):
            return False
        rows, loop = self._places, self.recording.loop
        ready, count = self.recording.prepared(given), given.shape[1]
        if all(not row.finish for row in self.rows):
            return not loop.fill(ready, self.uniform, (self.numbers, self.truths), rows, (0, count), shift=start)
        wide = np.empty((len(rows[0]), count)), np.empty((len(rows[1]), count), dtype=bool)
        odd = loop.fill(ready, self.uniform, wide, rows, (0, count), streaming=False)
        named = dict(zip(self._outputs, wide[0], strict=True))
        done: dict[AnswerRow, int] = {}
        part = slice(start, start + count)
        for k, row in enumerate(self.rows):
            first = done.setdefault(row, k)
            self.numbers[k, part] = finished(row, named) if first == k else self.numbers[first, part]
        self.truths[:, part] = wide[1]
        return not odd

    def fill_in_place(self, given: FloatArray, part: tuple[int, int]) -> bool:
        """`fill` for part of contiguous components (m, N), without copying them, where nothing is left to NumPy."""
        if self.recording.has_angles or any(row.finish for row in self.rows):
            return self.fill(given[:, slice(*part)], part[0])
        return not self.recording.loop.fill(given, self.uniform, (self.numbers, self.truths), self._places, part)

    @cached_property
    def _outputs(self) -> tuple[str, ...]:
        """Outputs that the rows take, in the order of the loop's rows."""
        if all(not row.finish for row in self.rows):
            return tuple(row.take[0] for row in self.rows)
        return tuple(dict.fromkeys(name for row in self.rows for name in row.take))

    @cached_property
    def _places(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        places = self.recording.loop.places
        first, second = ([places[name] for name in names] for names in (self._outputs, self.truths_wanted))
        return np.array(first, dtype=np.intp), np.array(second, dtype=np.intp)


def finished(row: AnswerRow, numbers: Mapping[str, FloatArray]) -> FloatArray:
    """A row (b,) from the outputs of the tape, each (b,)."""
    values = [numbers[name] for name in row.take]
    if not row.finish:
        return values[0]
    if row.finish == "angle":
        angle = border.scalar(tuple(values))
        return angle if (row.sign, row.offset) == (1.0, 0.0) else row.sign * angle + row.offset
    if row.finish == "determinant":
        return determinant(_square(values)) * row.sign
    half = len(values) // 2
    return np.asarray(float_condition_index(_square(values[:half]), _square(values[half:]))[row.finish == "smallest"])


def _square(values: Sequence[Any]) -> list[list[Any]]:
    size = int(np.sqrt(len(values)))
    return [list(values[k * size : (k + 1) * size]) for k in range(size)]


def chosen(engine: Engine, count: int, record: Callable[[], Recording]) -> Recording | None:
    """The tape whose loop is to be run; None where NumPy is the engine."""
    if engine not in get_args(Engine):
        raise UnknownNameError("engine of a sweep", engine, get_args(Engine))
    if engine == "auto" and (count < REPAID_LOADED or importlib.util.find_spec("numba") is None):
        return None
    if engine == "numpy":
        return None
    found = record()
    return found if engine == "compiled" or count >= REPAID or found.loop.loaded else None


def engine_for(count: int) -> Literal["numpy", "compiled"]:
    """The engine of a grid that is worked out in parts: by its size alone, so that every part has the same one.

    >>> engine_for(10**4), engine_for(10**9)
    ('numpy', 'compiled')
    """
    return "compiled" if count >= REPAID else "numpy"


def run(
    filler: Filler,
    components: Components,
    columns: tuple[FloatArray, ...],
    block: int | None,
    progress: Progress | None,
    threads: int,
) -> None:
    """Fill an answer by a compiled loop; contiguous components are not copied."""
    whole = components if isinstance(components, np.ndarray) and components.flags.c_contiguous else None
    whole = whole if whole is not None and whole.dtype == np.float64 else None

    def work(part: slice, given: FloatArray) -> None:
        fine = (
            filler.fill(given.T, part.start) if whole is None else filler.fill_in_place(whole, (part.start, part.stop))
        )
        if not fine:
            raise UsageError(NOT_FINITE)

    size = BLOCK_COMPILED if block is None else block
    each_block(work, columns, len(columns[0]), size, progress, threads_of(threads), whole is not None)


def empty(
    want: Sequence[str], rows: Mapping[str, int], count: int
) -> tuple[dict[str, NDArray[Any]], FloatArray, BoolArray]:
    """What is wanted by name, as views of all numbers (R, N) and all truths (T, N)."""
    names = tuple(dict.fromkeys(want))
    numbers = empty_rows(sum(rows.get(name, 1) for name in names if name != "exists"), count)
    truths = np.empty((int("exists" in names), count), dtype=bool)
    answer: dict[str, NDArray[Any]] = {}
    place = 0
    for name in names:
        if name == "exists":
            answer[name] = truths[0]
        else:
            answer[name] = numbers[place : place + rows[name]] if name in rows else numbers[place]
            place += rows.get(name, 1)
    return answer, numbers, truths


def threads_of(threads: int) -> int:
    """How many threads a compiled loop runs in: as many as there are cores where 0.

    >>> threads_of(3)
    3
    """
    return threads or os.cpu_count() or 1
