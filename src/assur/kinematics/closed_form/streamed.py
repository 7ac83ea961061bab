"""Grids of any size, 10^9 poses too: worked through in blocks, never held, and resumed where they were interrupted.

A grid is its axes; its poses are made block by block. `sweep_grid` writes what is wanted into a store
(`results/store`), a `.npy` file per quantity; `reduce_grid` adds each block to a total. Both keep a note that says
which question it is and how much of it is done: after Ctrl-C the same call goes on from there, and another question
is refused.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.closed_form.blocks import FloatArray, Progress, in_order, parts_of
from assur.kinematics.closed_form.filling import Engine, engine_for, threads_of
from assur.kinematics.closed_form.formulas import formulas
from assur.kinematics.closed_form.grids import Box, Grid, grid_over
from assur.kinematics.closed_form.sweep import ALL_WANTED, Want, inverse_sweep
from assur.kinematics.modes import mode_signs
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.results.store.layout import Array, Plan
from assur.results.store.store import SolvedBlock, Store
from assur.results.store.total import KeptTotal

T = TypeVar("T")
Solve = Callable[[FloatArray], Mapping[str, NDArray[Any]]]
"""Problems (m, b) -> found by name (..., b)."""

BLOCK = 65536
"""Poses that are in memory at a time, per thread."""
SAVED = 2.0
"""Seconds between two notes of what is done."""
KINDS: Mapping[str, str] = {"exists": "bool", "status": "int8"}
"""Numbers of an answer that are no floats, as NumPy names them."""


def sweep_grid(
    record: MechanismRecord,
    counts: Sequence[int],
    into: Path | str,
    *,
    box: Box | None = None,
    mode: str = "",
    want: Sequence[Want] = ("exists",),
    block: int = BLOCK,
    progress: Progress | None = None,
    engine: Engine = "auto",
    threads: int = 0,
) -> dict[str, NDArray[Any]]:
    """`inverse_sweep` over a grid, into files of a folder; the same call resumes what was interrupted.

    Args:
        record: a mechanism with a closed form.
        counts: places along each coordinate of the pose.
        into: a folder, made where it is missing; it gets `<quantity>.npy` and `state.json`.
        box: limits of coordinates; the file's where not given.
        mode: the working mode; the file's default where none is given.
        want: quantities of `inverse_sweep`.
        block: poses that one thread works on at a time: memory is a few times that, whatever the grid. It belongs to
            the question: files are checked block by block.
        progress: called after every block with the poses done and all.
        engine: as for `inverse_sweep`.
        threads: how many work on it; as many as there are cores where 0.

    Returns:
        What was wanted by name, as read-only memory maps: exists (*counts), inputs (n, *counts), and so on.

    Errors:
        UsageError: a grid that is refused (`grid_over`), a folder that holds another question or other files of these
            names, a disk that is too small.
        DamagedStoreError: files that are not what was written.

    Example:
        >>> import tempfile
        >>> from assur.model.registry import load_record
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     found = sweep_grid(load_record("zeng2019"), (5, 4, 3), folder)["exists"]
        ...     found.shape, int(found.sum())
        ((5, 4, 3), 32)
    """
    if block < 1:
        raise UsageError(f"a block of {block} poses; it needs at least 1")
    grid, names = grid_over(record, counts, box), tuple(dict.fromkeys(want))
    solve, question = _question(record, grid, mode, names, engine)
    rows = {"inputs": len(record.inputs), "factors": len(closed_form_of(record).factor_list)}
    arrays = tuple(
        Array(name, KINDS.get(name, "float64"), (rows[name],) if name in rows else (), grid.counts) for name in names
    )
    with Store(Path(into), Plan({"kind": "sweep", **question}, arrays, block)) as store:
        store.open()
        fill(store, lambda poses: SolvedBlock(solve(poses), {}), grid, progress=progress, threads=threads)
        return store.finish()


def fill(
    store: Store,
    solve: Callable[[FloatArray], SolvedBlock],
    grid: Grid,
    *,
    progress: Progress | None = None,
    threads: int = 0,
) -> None:
    """Work out the blocks that a store lacks, in this process.

    Args:
        store: open.
        solve: problems (m, b) -> the numbers of their block.
        grid: all problems.
        progress: called after every block.
        threads: how many work on it; as many as there are cores where 0.
    """

    def one(number: int) -> tuple[int, SolvedBlock]:
        return number, solve(grid.poses(store.plan.part(number)))

    store.fill(in_order(one, store.missing, threads_of(threads)), progress)


def reduce_grid(
    record: MechanismRecord,
    counts: Sequence[int],
    add: Callable[[T, FloatArray, Mapping[str, NDArray[Any]]], T],
    start: T,
    *,
    keep: Path | str | None = None,
    box: Box | None = None,
    mode: str = "",
    want: Sequence[Want] = ("exists",),
    block: int = BLOCK,
    progress: Progress | None = None,
    engine: Engine = "auto",
    threads: int = 0,
) -> T:
    """A total over a grid, block by block, in the order of the poses; nothing else is held.

    Args:
        record: as for `sweep_grid`, like all that is not told here.
        counts: places along each coordinate of the pose.
        add: (total, poses (m, b), found by name (..., b)) -> the total with this block; called in one thread.
        start: the total of nothing. Where `keep` is given it must be made of numbers, texts, lists and dicts (JSON).
        keep: a file that holds the total and how much is done, so that the same call resumes; none without.
        box: limits of coordinates.
        mode: the working mode.
        want: quantities of `inverse_sweep`.
        block: poses in a block; where `add` rounds, the last digits depend on it.
        progress: called after every block.
        engine: as for `inverse_sweep`.
        threads: how many work on it.

    Returns:
        The total.

    Example: how many poses of a grid the platform reaches.

        >>> from assur.model.registry import load_record
        >>> reduce_grid(load_record("zeng2019"), (5, 4, 3), lambda n, _, found: n + int(found["exists"].sum()), 0)
        32
    """
    grid, names = grid_over(record, counts, box), tuple(dict.fromkeys(want))
    solve, question = _question(record, grid, mode, names, engine)
    question = {**question, "kind": "total", "block": block}
    kept = KeptTotal(None if keep is None else Path(keep), question, start)
    if block < 1:
        raise UsageError(f"a block of {block} poses; it needs at least 1")
    total: T = kept.total
    begun = done = kept.done
    saved = time.monotonic()

    def one(part: slice) -> tuple[int, FloatArray, Mapping[str, NDArray[Any]]]:
        poses = grid.poses(part)
        return part.stop, poses, solve(poses)

    left = (slice(begun + part.start, begun + part.stop) for part in parts_of(grid.size - begun, block))
    try:
        for stop, poses, found in in_order(one, left, threads_of(threads)):
            total, done = add(total, poses, found), stop
            if time.monotonic() - saved > SAVED:
                kept.save(done, total)
                saved = time.monotonic()
            if progress is not None:
                progress(done, grid.size)
    finally:
        kept.save(done, total)
    return total


def _question(
    record: MechanismRecord, grid: Grid, mode: str, want: tuple[Want, ...], engine: Engine
) -> tuple[Solve, dict[str, Any]]:
    """What works out a block, and everything that its answer depends on."""
    for name in want:
        if name not in ALL_WANTED:
            raise UnknownNameError("quantity of a sweep", name, ALL_WANTED)
    asked = mode or record.modes.default_working
    mode_signs(record, "inverse", asked)
    taken = engine_for(grid.size) if engine == "auto" else engine

    def solve(poses: FloatArray) -> Mapping[str, NDArray[Any]]:
        return inverse_sweep(record, poses, asked, want, engine=taken, threads=1)

    return solve, {
        "mechanism": record.name,
        **formulas(record, "inverse"),
        "dimensions": {name: float(value) for name, value in vars(record.values).items()},
        "mode": asked,
        "box": {name: [a, b] for name, a, b in zip(grid.names, grid.low, grid.high, strict=True)},
        "counts": list(grid.counts),
        "want": list(want),
    }
