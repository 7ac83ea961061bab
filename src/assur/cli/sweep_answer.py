"""What `assur sweep` says: before it begins, where it was interrupted, and what the files hold."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.cli import sweep_grid
from assur.cli.options import Outcome, Shared
from assur.cli.output import Verbatim, heading, table
from assur.cli.paths import planned_folder
from assur.cli.progress import progress
from assur.cli.quantities import mode_words
from assur.errors import OutputError, UsageError

if TYPE_CHECKING:
    from rich.console import RenderableType

    from assur.kinematics.closed_form.grids import Grid
    from assur.kinematics.closed_form.kept import State
    from assur.kinematics.closed_form.stored import StoredSweep
    from assur.kinematics.modes import Problem
    from assur.mechanism import Mechanism

NOTE = "sweep.json"
AGAIN = "the same command goes on from there"


def outcome(
    record: Mechanism,
    grid: Grid,
    problem: Problem,
    mode: str | None,
    keep: Sequence[str],
    output: str,
    threads: int,
    shared: Shared,
) -> Outcome:
    """The sweep, run into a folder, as data and for a person."""
    from assur.kinematics.closed_form.stored import stored_sweep
    from assur.kinematics.closed_form.streamed import STATE
    from assur.results.files import write_whole
    from assur.results.json_text import json_text

    if threads < 0:
        raise UsageError(f"--threads: {threads} is no number of threads", hint="leave it out")
    sweep = stored_sweep(record, problem, grid, mode or "", keep)
    folder = planned_folder(output)
    if (folder / NOTE).exists() and not (folder / STATE).exists():
        raise UsageError(f"{folder / NOTE}: already there, and no note of a sweep", hint="choose another folder")
    try:
        state = sweep.begin(folder)
    except OSError as error:
        raise OutputError(f"cannot write {folder}: {error.strerror}", hint="choose another place") from error
    if not shared.json:
        sys.stderr.write(beforehand(sweep, state, folder) + "\n")
    try:
        with progress("sweep", shared) as step:
            sweep.run(state, folder, progress=step, threads=threads)
    except KeyboardInterrupt:
        sys.stderr.write(f"stopped at {state.done} of {grid.size}; {AGAIN}\n")
        raise
    except OSError as error:
        reason = f"cannot write {folder}: {error.strerror}; {state.done} of {grid.size} are done"
        raise OutputError(reason, hint=f"{AGAIN}, once that is mended") from error
    data = described(sweep, state)
    write_whole(folder / NOTE, json_text(data) + "\n")
    return Outcome({**data, "folder": str(folder)}, lambda: _shown(record, data, folder))


def beforehand(sweep: StoredSweep, state: State, folder: Path) -> str:
    """What it will take."""
    what = "poses" if sweep.problem == "inverse" else "inputs"
    begun = f", of which {state.done} are done" if state.done else ""
    engine = "a compiled loop" if sweep.compiled else "NumPy"
    return f"{sweep.grid.size} {what}{begun}, by {engine}: {size_text(sweep.size)} in {folder}"


def described(sweep: StoredSweep, state: State) -> dict[str, Any]:
    """The sweep as plain data: the grid, how its answers are known, the files, and what was counted."""
    from assur.kinematics.status import Status

    record, total = sweep.record, state.total
    kinds = sweep_grid.coordinates(record, sweep.problem)
    units = {"length": record.unit, "angle": record.angle}
    axes: list[dict[str, Any]] = []
    held: dict[str, float] = {}
    for k, (name, kind) in enumerate(kinds.items()):
        scale = sweep_grid.factor(record, kind)
        low, high = (value / scale for value in (sweep.grid.low[k], sweep.grid.high[k]))
        if sweep.grid.counts[k] == 1:
            held[name] = low
        else:
            axes.append({"name": name, "unit": units[kind], "low": low, "high": high, "count": sweep.grid.counts[k]})
    return {
        "mechanism": record.name,
        "dimensions": {name: float(value) for name, value in vars(record.values).items()},
        "problem": sweep.problem,
        "mode": sweep.mode,
        "modes": list(sweep.modes),
        "unit": record.unit,
        "angle": record.angle,
        "along": axes,
        "at": held,
        "problems": sweep.grid.size,
        "done": state.done,
        "how": _how(sweep),
        "counts": {
            "by_modes": dict(sorted(total["modes"].items(), key=lambda item: int(item[0]))),
            "by_status": {
                status.name: total["status"][status.name] for status in Status if status.name in total["status"]
            }
            if "status" in sweep.keep
            else None,
        },
        "bytes": sweep.size,
        "files": {name: _file(sweep, name, [axis["name"] for axis in axes]) for name in sweep.keep},
    }


def _how(sweep: StoredSweep) -> str:
    from assur.kinematics.status import closed_form_of

    model = "the reduced model" if closed_form_of(sweep.record).complete_for == "reduced" else "the joint graph"
    modes = "every branch of its roots" if len(sweep.modes) == 2 ** _signs(sweep) else "this mode alone"
    return f"closed form of {model}, {modes}, at the places of the grid and nowhere between them"


def _signs(sweep: StoredSweep) -> int:
    from assur.kinematics.modes import sign_names

    return len(sign_names(sweep.record, sweep.problem))


def _file(sweep: StoredSweep, name: str, along: Sequence[str]) -> dict[str, Any]:
    from assur.kinematics.closed_form.kept import KINDS

    rows, units, meaning = _rows(sweep, name)
    shape = list(sweep.shapes[name])
    axes = [*(["mode"] if sweep.mode == "all" else []), *([_ROWS[name]] if name in _ROWS else []), *along]
    kind = np.dtype(KINDS.get(name, float)).name
    return {
        "file": f"{name}.npy",
        "shape": shape,
        "dtype": kind,
        "axes": axes,
        "rows": rows,
        "units": units,
        "meaning": meaning,
    }


_ROWS = {"inputs": "input", "poses": "coordinate", "factors": "factor"}


def _rows(sweep: StoredSweep, name: str) -> tuple[list[str], list[str], str]:
    """Names and units of the rows of a file, where it has some, and what stands in it."""
    from assur.kinematics.answers.at_border import power
    from assur.kinematics.status import Status, closed_form_of

    record = sweep.record
    units = {"length": record.unit, "angle": record.angle}
    if name in ("inputs", "poses"):
        kinds = sweep_grid.coordinates(record, "direct" if name == "inputs" else "inverse")
        return list(kinds), [units[kind] for kind in kinds.values()], f"the {name}; NaN where there is no solution"
    if name == "factors":
        items = closed_form_of(record).factor_list
        return (
            [item.name for item in items],
            [power(record.unit, item.unit) for item in items],
            "factors of det Jp and det Jq",
        )
    meanings = {
        "exists": "whether the mode has a solution",
        "status": "status: " + ", ".join(f"{status.value} {status.name}" for status in Status),
        "det_jp": f"det Jp of the regular Jacobian, {record.unit} and rad",
        "det_jq": f"det Jq of the regular Jacobian, {record.unit} and rad",
        "condition_index": f"1/cond2 of Jp^-1 Jq, 0 where singular, {record.unit} and rad",
        "smallest": f"smallest singular value of Jp^-1 Jq, {record.unit} and rad",
    }
    return [], [], meanings[name]


def _shown(record: Mechanism, data: dict[str, Any], folder: Path) -> Iterable[RenderableType]:
    inverse = data["problem"] == "inverse"
    if data["mode"] == "all":
        mode = f"{len(data['modes'])} modes"
    else:
        mode = mode_words(record, data["mode"]) if inverse else f"assembly mode {data['mode']}"
    yield heading(f"{data['mechanism']}, {data['problem']} problem, {mode}: {data['problems']} problems")
    yield f"how: {data['how']}"
    grid = [f"{a['name']} {a['low']:g} .. {a['high']:g} {a['unit']}, {a['count']} places" for a in data["along"]]
    yield f"grid: {'; '.join(grid)}"
    if data["at"]:
        yield f"held: {', '.join(f'{name} = {value:g}' for name, value in data['at'].items())}"
    yield ""
    counts = data["counts"]
    if counts["by_status"]:
        what = "branches" if data["mode"] == "all" else "poses" if inverse else "inputs"
        yield table(("status", what), [(n, str(k)) for n, k in counts["by_status"].items()], left=("status",))
    else:
        yield table(("modes with a solution", "problems"), [(n, str(k)) for n, k in counts["by_modes"].items()])
    yield ""
    rows = [
        (item["file"], item["dtype"], " x ".join(map(str, item["shape"])), ", ".join(item["axes"]))
        for item in data["files"].values()
    ]
    yield table(("file", "dtype", "shape", "axes"), rows, left=("file", "dtype", "axes"))
    yield ""
    yield f"written: {folder}, {size_text(data['bytes'])}; {NOTE} there says what they hold"
    yield "in Python:"
    first = next(iter(data["files"].values()))["file"]
    yield Verbatim(f'    values = numpy.load({str(folder / first)!r}, mmap_mode="r")')


def size_text(count: int) -> str:
    """Bytes as a person reads them.

    >>> size_text(900), size_text(52_000_000), size_text(25 * 10**9)
    ('900 bytes', '52.0 MB', '25.0 GB')
    """
    for size, name in ((10**9, "GB"), (10**6, "MB"), (10**3, "kB")):
        if count >= size:
            return f"{count / size:.1f} {name}"
    return f"{count} bytes"
