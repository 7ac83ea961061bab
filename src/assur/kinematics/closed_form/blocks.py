"""Blocks of a sweep: where they begin, what they are given, and several at a time where there are threads."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.work import Progress

FloatArray = NDArray[np.float64]
Components = Sequence[ArrayLike] | NDArray[np.float64]
"""One array (N,) per component, as a sequence or as the rows of one array."""

P = TypeVar("P")
T = TypeVar("T")

NOT_FINITE = "every component must be finite, not NaN or infinite"


def columns_of(components: Components, names: Sequence[str], what: str) -> tuple[tuple[FloatArray, ...], int]:
    """Components as arrays (N,) of floats, one per name, and N."""
    if len(components) != len(names):
        raise UsageError(f"{what}: {len(components)} components, {len(names)} wanted", hint=f"give {', '.join(names)}")
    columns = tuple(np.asarray(values, dtype=float) for values in components)
    shapes = {column.shape for column in columns}
    if len(shapes) != 1 or columns[0].ndim != 1:
        found = ", ".join(str(column.shape) for column in columns)
        raise UsageError(f"{what}: components of shapes {found}", hint="give arrays (N,) of one length")
    return columns, len(columns[0])


def each_block(
    work: Callable[[slice, FloatArray], None],
    columns: tuple[FloatArray, ...],
    count: int,
    block: int,
    progress: Progress | None,
    threads: int,
    whole: bool = False,
) -> None:
    """Do each block, of problems (b, k); several at a time where there are threads, but told in their order."""
    if block < 1:
        raise UsageError(f"a block of {block} poses; it needs at least 1")
    if threads < 1:
        raise UsageError(f"{threads} threads; it needs at least 1", hint="0 lets the engine choose")

    def one(part: slice) -> int:
        work(part, np.empty((0, 0)) if whole else _block(columns, part))
        return int(part.stop)

    for done in in_order(one, parts_of(count, block), min(threads, -(-count // block))):
        if progress is not None:
            progress(done, count)


def in_order(one: Callable[[P], T], parts: Iterable[P], threads: int) -> Iterator[T]:
    """Results in the order of the parts; no more than two parts per thread are begun ahead."""
    if threads <= 1:
        yield from map(one, parts)
        return
    with ThreadPoolExecutor(threads) as pool:
        waiting: deque[Future[T]] = deque()
        try:
            for part in parts:
                waiting.append(pool.submit(one, part))
                if len(waiting) >= 2 * threads:
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        finally:
            for future in waiting:
                future.cancel()


def parts_of(count: int, block: int) -> Iterator[slice]:
    """Where each block begins and ends.

    >>> list(parts_of(5, 2))
    [slice(0, 2, None), slice(2, 4, None), slice(4, 5, None)]
    """
    return (slice(start, min(start + block, count)) for start in range(0, count, block))


def _block(columns: tuple[FloatArray, ...], part: slice) -> FloatArray:
    """Problems (b, k) of a block, contiguous along each component."""
    given = np.stack([column[part] for column in columns])
    if not np.all(np.isfinite(given)):
        raise UsageError(NOT_FINITE)
    return given.T
