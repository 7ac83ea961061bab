"""The compiled path beside the hand-written C loop, NumPy and memory bandwidth, all measured in turn in one run.

    .venv/bin/python bench/compiled.py [--poses 1000000] [--grid 200] [--repeats 7] [--no-start]

Ratios are of medians; below 1 means that ours is faster. Before anything is timed, the compiled answers must have the
bits of NumPy's, otherwise the exit code is 1. Without gcc the columns of C stay empty. One thread, and all cores.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from statistics import median

import numpy as np
from bench import CHUNK, JOBS, MECHANISM, MODE, cpu, problems
from distinct import distinct_filler, distinct_inverses
from rich.console import Console
from rich.table import Table
from yardstick import Arrays, Yardstick, compile_library, compiler

import assur
from assur.kinematics.closed_form.all_modes_sweep import all_modes_sweep
from assur.kinematics.closed_form.filling import Filler
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.closed_form.recorded import Recording, recording
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.kinematics.modes import mode_signs
from assur.model.mechanism import MechanismRecord

CORES = os.cpu_count() or 1
ONE = ("inputs", "exists", "det_jp", "det_jq", "factors")
GRID_WANT = ("exists", "det_jp", "det_jq", "condition_index")

START = """
import time
begun = time.perf_counter()
import numpy as np, assur
from assur.kinematics.closed_form.sweep import inverse_sweep
record = assur.load({mechanism!r})
imported = time.perf_counter()
inverse_sweep(record, np.zeros((3, 1)), engine="compiled", threads=1)
print(time.perf_counter() - imported)
"""


def answers(job: str, record: MechanismRecord, values: np.ndarray, engine: str, threads: int = 1) -> Arrays:
    """The answer of a job in new arrays."""
    options = {"engine": engine, "threads": threads}
    if job == "inverse_one":
        return list(inverse_sweep(record, values, MODE, ONE, **options).values())
    if job == "inverse_distinct":
        return distinct_inverses(record, values, engine, threads)
    problem = "inverse" if job == "inverse_expanded" else "direct"
    return list(all_modes_sweep(record, problem, values, **options))


def filler_of(job: str, record: MechanismRecord, count: int) -> Filler:
    """What fills arrays that are in use already, as C does."""
    if job == "inverse_one":
        tape = recording(record, "inverse", ONE)
        rows = tuple(row for name in ONE if name != "exists" for row in tape.rows[name])
        return _filler(tape, tape.uniform(mode_signs(record, "inverse", MODE)), rows, tape.truths, count)
    if job == "inverse_distinct":
        return distinct_filler(recording(record, "inverse", every=True), count)
    tape = recording(record, "direct" if job == "direct_all" else "inverse", every=True)
    rows, truths = next(iter(tape.rows.values())), tape.truths
    return _filler(tape, tape.uniform(), rows, truths, count)


def _filler(tape: Recording, uniform: np.ndarray, rows: tuple, truths: tuple, count: int) -> Filler:
    return Filler(tape, uniform, rows, truths, np.zeros((len(rows), count)), np.zeros((len(truths), count), dtype=bool))


def seconds(works: dict[str, Callable[[], object]], repeats: int) -> dict[str, float]:
    """Median seconds of each work; they are done in turn, so that other load on the machine hits all alike."""
    found: dict[str, list[float]] = {name: [] for name in works}
    for _ in range(repeats):
        for name, work in works.items():
            start = time.perf_counter()
            answer = work()
            found[name].append(time.perf_counter() - start)
            del answer
    return {name: median(times) for name, times in found.items()}


def share(found: dict[str, float], name: str, other: str) -> str:
    return f"{found[name] / found[other]:.2f}" if name in found and other in found else "-"


def job_row(
    job: str, text: str, record: MechanismRecord, c: Yardstick | None, values: np.ndarray, repeats: int
) -> Sequence[str]:
    count = values.shape[1]
    filler = filler_of(job, record, count)
    size = values.nbytes + filler.numbers.nbytes + filler.truths.nbytes
    there = np.zeros(size // 8)
    works: dict[str, Callable[[], object]] = {
        "used": lambda: filler.fill_in_place(values, (0, count)),
        "memory": lambda: there.fill(1.0),
        "new": lambda: answers(job, record, values, "compiled"),
        "cores": lambda: answers(job, record, values, "compiled", CORES),
        "numpy": lambda: answers(job, record, values, "numpy"),
    }
    if c is not None:
        used = c.empty(job, count)
        works["c used"] = lambda: c.run(job, values, used)
        works["c new"] = lambda: c.run(job, values, c.empty(job, count))
    found = seconds(works, repeats)
    return (
        text,
        f"{count / found['used'] / 1e6:.0f}",
        share(found, "used", "c used"),
        share(found, "new", "c new"),
        share(found, "cores", "c new"),
        f"1/{found['numpy'] / found['new']:.1f}",
        share(found, "used", "memory"),
        f"{size / found['used'] / 1e9:.1f}",
    )


def same_bits(record: MechanismRecord, count: int) -> bool:
    for job in JOBS:
        values = problems(record, job.given, count)
        both = (answers(job.name, record, values, engine, CORES) for engine in ("compiled", "numpy"))
        if not all(np.array_equal(a, b) for a, b in zip(*both, strict=True)):
            return False
    return True


def grid_seconds(record: MechanismRecord, places: int, c: Yardstick | None, repeats: int) -> dict[str, float]:
    """Seconds of a cubic grid with determinants and condition, held as a whole.

    Beside it C's inverse with determinants and factors, but no condition, over blocks into arrays in use; and memory
    of the size of poses and answers, filled.
    """
    low, high = zip(*(record.box[name] for name in record.platform.pose), strict=True)
    grid = Grid(record.platform.pose, low, high, (places,) * 3)
    poses = grid.poses(slice(0, grid.size))

    def held(threads: int) -> object:
        return inverse_sweep(record, poses, MODE, GRID_WANT, engine="compiled", threads=threads)

    there = np.zeros(poses.size + sum(array.nbytes for array in held(1).values()) // 8)
    works: dict[str, Callable[[], object]] = {
        "held": lambda: held(1),
        "cores": lambda: held(CORES),
        "memory": lambda: there.fill(1.0),
    }
    if c is not None:
        used = c.empty("inverse_one", CHUNK)
        parts = [np.ascontiguousarray(poses[:, k : k + CHUNK]) for k in range(0, grid.size, CHUNK)]
        works["c"] = lambda: [c.run("inverse_one", part, used) for part in parts]
    return seconds(works, min(repeats, 3))


def starts() -> tuple[float, float]:
    """Seconds to the first answer of a compiled loop: made for the first time, and found on disk."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-c", START.format(mechanism=MECHANISM)]
        environment = {**os.environ, "ASSUR_CACHE": folder}
        first, second = (
            float(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, env=environment).stdout)
            for _ in range(2)
        )
    return first, second


def main() -> int:
    parser = argparse.ArgumentParser(description="The compiled path beside C, NumPy and memory bandwidth.")
    parser.add_argument("--poses", type=int, default=1_000_000)
    parser.add_argument("--grid", type=int, default=200)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--no-start", action="store_true", help="leave out how long a first and a second start take")
    args = parser.parse_args()
    record = assur.load(MECHANISM)
    console = Console(width=None if sys.stdout.isatty() else 150, highlight=False)
    console.print(f"{cpu()}, {CORES} cores; numpy {np.__version__}")
    if not same_bits(record, 10_007):
        console.print("[red]compiled and NumPy differ")
        return 1
    gcc = compiler()
    c = Yardstick(compile_library(gcc), record, MODE) if gcc else None
    table = Table(
        "job", title=f"compiled, {args.poses} problems; ratios of time, medians of {args.repeats}, one thread"
    )
    for heading in ("10^6/s", "/C, same", "/C, new", f"/C, new, {CORES} cores", "/NumPy", "/filling memory", "GB/s"):
        table.add_column(heading, justify="right")
    for job in JOBS:
        table.add_row(*job_row(job.name, job.text, record, c, problems(record, job.given, args.poses), args.repeats))
    console.print(table)
    took = grid_seconds(record, args.grid, c, args.repeats)
    console.print(
        f"grid of {args.grid}^3, existence, determinants and condition, one thread: {took['held']:.2f} s held, "
        f"{share(took, 'held', 'memory')} of filling memory, {share(took, 'held', 'c')} of C, which has no condition; "
        f"{CORES} cores {took['cores']:.2f} s"
    )
    if not args.no_start:
        first, second = starts()
        console.print(
            f"first compiled answer: {first:.1f} s where the loop is made, {second:.2f} s where it is on disk"
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
