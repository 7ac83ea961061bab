"""Tapes by levels: all operations of one kind whose arguments are known are done at once, as rows of one array.

Limbs are alike, and so are the entries of matrices: some three thousand operations of six limbs are some sixty on
arrays. To call NumPy takes as long as a thousand operations, so that this is what short batches cost. Each operation
is the tape's own: the bits are the same.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.numerics.recording.tape import Tape

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

GIVEN = ("varying", "uniform", "number")
"""What stands in the first level, in this order."""
OPERATIONS = {"+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide}


@dataclass(frozen=True, eq=False)
class Levels:
    """A tape without comparisons as operations on rows of an array, which begins with what is given.

    Attributes:
        size: how many rows there are.
        steps: name of the operation, the first row of its results and the row after them, and the rows of its arguments
            as bytes, all first ones before the second ones.
        numbers: those that are written into the tape, as bytes.
        outputs: rows of the tape's outputs, as bytes.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x, p = recorder.varying("x"), recorder.uniform("p")
    >>> own = levels(recorder.tape({"y": x * p, "z": recorder.sqrt(x), "w": p * p}))
    >>> [(name, last - first) for name, first, last, _ in own.steps]
    [('*', 2), ('root', 1)]
    >>> own.outputs_of(np.array([[4.0, 9.0]]), [0.5])
    array([[2.  , 4.5 ],
           [2.  , 3.  ],
           [0.25, 0.25]])
    """

    size: int
    steps: tuple[tuple[str, int, int, bytes], ...]
    numbers: bytes
    outputs: bytes

    def outputs_of(self, varying: NDArray[Any], uniform: Sequence[Any]) -> NDArray[Any]:
        """Outputs (m, N) of numbers (k, N) and (u,); without roots, these may be complex."""
        rows = _WORK.rows(self.size, varying.shape[1], varying.dtype)
        same = np.array([*uniform, *self._numbers])[:, None]
        rows[: len(varying)] = varying
        rows[len(varying) : len(varying) + len(same)] = same
        with np.errstate(all="ignore"):
            self._work_out(rows)
        return rows.take(self._outputs, axis=0)

    def _work_out(self, rows: NDArray[Any]) -> None:
        for name, first, last, arguments in self._arrays:
            taken = rows.take(arguments, axis=0)
            if name == "negative":
                np.negative(taken, out=rows[first:last])
            elif name == "root":
                np.sqrt(np.maximum(taken, 0.0), out=rows[first:last])
            else:
                OPERATIONS[name](taken[: last - first], taken[last - first :], out=rows[first:last])

    @cached_property
    def _arrays(self) -> list[tuple[str, int, int, IntArray]]:
        return [(name, first, last, np.frombuffer(rows, dtype=np.intp)) for name, first, last, rows in self.steps]

    @cached_property
    def _numbers(self) -> FloatArray:
        return np.frombuffer(self.numbers)

    @cached_property
    def _outputs(self) -> IntArray:
        return np.frombuffer(self.outputs, dtype=np.intp)


class _Work(threading.local):
    """Room that is kept from call to call: to be given new pages takes longer than to fill them."""

    def __init__(self) -> None:
        self.room = np.empty(0)

    def rows(self, size: int, count: int, dtype: np.dtype[Any]) -> NDArray[Any]:
        """An array (size, count) with anything in it, until the next is asked for."""
        needed = size * count * dtype.itemsize // self.room.itemsize
        if needed > len(self.room):
            self.room = np.empty(needed)
        return self.room[:needed].view(dtype).reshape(size, count)


_WORK = _Work()


def levels(tape: Tape) -> Levels:
    """The levels of a tape: of each kind the operations whose arguments stand in earlier ones."""
    depth: list[int] = []
    for operation in tape.operations:
        depth.append(1 + max([depth[k] for k in operation.arguments], default=-1))
    names = [operation.name for operation in tape.operations]
    rank = {name: k for k, name in enumerate(dict.fromkeys((*GIVEN, *names)))}
    order = sorted(range(len(names)), key=lambda k: (depth[k], rank[names[k]]))
    row = [0] * len(order)
    for place, k in enumerate(order):
        row[k] = place
    steps, first = [], 0
    for (_, name), group in groupby(order, key=lambda k: (depth[k], names[k])):
        own = [tape.operations[k].arguments for k in group]
        if name not in GIVEN:
            arguments = [row[k] for side in zip(*own, strict=True) for k in side]
            steps.append((name, first, first + len(own), _bytes(arguments)))
        first += len(own)
    written = np.array([tape.operations[k].number for k in order if names[k] == "number"], dtype=float)
    outputs = _bytes([row[k] for k in tape.outputs.values()])
    return Levels(max(len(order), 1), tuple(steps), written.tobytes(), outputs)


def _bytes(rows: Sequence[int]) -> bytes:
    return np.array(rows, dtype=np.intp).tobytes()
