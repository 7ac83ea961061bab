"""Grids of any size, 10^9 poses too: worked through in blocks, never held, and resumed where they were interrupted.

A grid is its axes; its poses are made block by block. `sweep_grid` writes what is wanted into `.npy` files, one per
quantity; `reduce_grid` adds each block to a total. Both keep a small JSON file that says which question it is and how
much of it is done: after Ctrl-C the same call goes on from there, and another question is refused.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.closed_form.blocks import FloatArray, Progress, in_order, parts_of
from assur.kinematics.closed_form.filling import Engine, chosen, threads_of
from assur.kinematics.closed_form.formulas import formulas
from assur.kinematics.closed_form.grids import Box, Grid, grid_over
from assur.kinematics.closed_form.kept import RowsFile, State, make_files
from assur.kinematics.closed_form.recorded import recording
from assur.kinematics.closed_form.sweep import ALL_WANTED, Want, inverse_sweep
from assur.kinematics.modes import mode_signs
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord

T = TypeVar("T")
Solve = Callable[[FloatArray], Mapping[str, NDArray[Any]]]
"""Problems (m, b) -> found by name (..., b)."""

BLOCK = 65536
"""Poses that are in memory at a time, per thread."""
SAVED = 2.0
"""Seconds between two notes of what is done."""
STATE = "state.json"


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
        block: poses that one thread works on at a time: memory is a few times that, whatever the grid.
        progress: called after every block with the poses done and all.
        engine: as for `inverse_sweep`.
        threads: how many work on it; as many as there are cores where 0.

    Returns:
        What was wanted by name, as read-only memory maps: exists (*counts), inputs (n, *counts), and so on.

    Errors:
        UsageError: a grid that is refused (`grid_over`), a folder that holds another question or other files of these
            names, a disk that is too small.

    Example:
        >>> import tempfile
        >>> from assur.model.registry import load_record
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     found = sweep_grid(load_record("zeng2019"), (5, 4, 3), folder)["exists"]
        ...     found.shape, int(found.sum())
        ((5, 4, 3), 32)
    """
    grid, names = grid_over(record, counts, box), tuple(dict.fromkeys(want))
    solve, question = _question(record, grid, mode, names, engine)
    folder = Path(into)
    rows = {"inputs": len(record.inputs), "factors": len(closed_form_of(record).factor_list)}
    shapes: dict[str, tuple[int, ...]] = {name: ((rows[name],) if name in rows else ()) + grid.counts for name in names}
    state = begun_grid({**question, "kind": "sweep"}, shapes, folder)
    return write_grid(
        state, solve, shapes, grid, folder, lambda *_: None, None, block=block, progress=progress, threads=threads
    )


def begun_grid(question: Mapping[str, Any], shapes: Mapping[str, tuple[int, ...]], folder: Path) -> State:
    """The note of a grid that is written into a folder: that of before, or a new one beside new files.

    Args:
        question: all that the answer depends on.
        shapes: what is written -> the shape of its file; its last axes are those of the grid.
        folder: where.

    Errors:
        UsageError: the folder holds another question, or other files of these names; the disk is too small.
    """
    state = State(folder / STATE, question)
    if not state.known:
        make_files({name: folder / f"{name}.npy" for name in shapes}, shapes)
        state.save(0, None)
    return state


def write_grid(
    state: State,
    solve: Solve,
    shapes: Mapping[str, tuple[int, ...]],
    grid: Grid,
    folder: Path,
    add: Callable[[T, Mapping[str, NDArray[Any]]], T],
    start: T,
    *,
    block: int = BLOCK,
    progress: Progress | None = None,
    threads: int = 0,
) -> dict[str, NDArray[Any]]:
    """Work out what is left of a grid, into the files of `begun_grid`; the note counts what is done.

    Args:
        state: what is done; its `total` holds what `add` makes of it.
        solve: problems (m, b) -> found by name (..., b), of which the names in `shapes` are written.
        shapes: as for `begun_grid`.
        grid: the problems.
        folder: as for `begun_grid`.
        add: (total, found) -> the total with this block; of numbers, texts, lists and dicts.
        start: the total of nothing.
        block: problems that one thread works on at a time.
        progress: called after every block.
        threads: how many work on it.

    Returns:
        What was written by name, as read-only memory maps.
    """
    files = {name: folder / f"{name}.npy" for name in shapes}
    with ExitStack() as stack:
        places = {name: RowsFile(stack.enter_context(path.open("r+b")), grid.size) for name, path in files.items()}

        def keep(first: int, found: Mapping[str, NDArray[Any]], _poses: FloatArray, total: T) -> T:
            for name, place in places.items():
                place.write(first, found[name].reshape(-1, found[name].shape[-1]))
            return add(total, found)

        _work(solve, grid, state, keep, state.total if state.done else start, block, threads_of(threads), progress)
    return {name: np.load(path, mmap_mode="r") for name, path in files.items()}


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
    state = State(None if keep is None else Path(keep), {**question, "kind": "total", "block": block})
    total: T = state.total if state.known else start

    def one(_: int, found: Mapping[str, NDArray[Any]], poses: FloatArray, total: T) -> T:
        return add(total, poses, found)

    return _work(solve, grid, state, one, total, block, threads_of(threads), progress)


def _question(
    record: MechanismRecord, grid: Grid, mode: str, want: tuple[Want, ...], engine: Engine
) -> tuple[Solve, dict[str, Any]]:
    """What works out a block, and everything that its answer depends on."""
    for name in want:
        if name not in ALL_WANTED:
            raise UnknownNameError("quantity of a sweep", name, ALL_WANTED)
    asked = mode or record.modes.default_working
    mode_signs(record, "inverse", asked)
    compiled = chosen(engine, grid.size, lambda: recording(record, "inverse", want)) is not None

    def solve(poses: FloatArray) -> Mapping[str, NDArray[Any]]:
        return inverse_sweep(record, poses, asked, want, engine="compiled" if compiled else "numpy", threads=1)

    return solve, {
        "mechanism": record.name,
        **formulas(record, "inverse"),
        "dimensions": {name: float(value) for name, value in vars(record.values).items()},
        "mode": asked,
        "box": {name: [a, b] for name, a, b in zip(grid.names, grid.low, grid.high, strict=True)},
        "counts": list(grid.counts),
        "want": list(want),
    }


def _work(
    solve: Solve,
    grid: Grid,
    state: State,
    keep: Callable[[int, Mapping[str, NDArray[Any]], FloatArray, T], T],
    total: T,
    block: int,
    threads: int,
    progress: Progress | None,
) -> T:
    """Every block that is not done, in order; what is done is noted now and then, and at the end however it comes."""
    if block < 1:
        raise UsageError(f"a block of {block} poses; it needs at least 1")
    begun = state.done

    def one(part: slice) -> tuple[int, int, FloatArray, Mapping[str, NDArray[Any]]]:
        poses = grid.poses(part)
        return part.start, part.stop, poses, solve(poses)

    done, saved = begun, time.monotonic()
    shifted = (slice(begun + part.start, begun + part.stop) for part in parts_of(grid.size - begun, block))
    try:
        for start, stop, poses, found in in_order(one, shifted, threads):
            total, done = keep(start, found, poses, total), stop
            if time.monotonic() - saved > SAVED:
                state.save(done, total)
                saved = time.monotonic()
            if progress is not None:
                progress(done, grid.size)
    finally:
        state.save(done, total)
    return total
