"""Poses per second of the sweeps over zeng2019, beside a hand-written C loop measured in the same run.

    .venv/bin/python bench/bench.py [--poses 1000000] [--repeats 9]

Before anything is timed, both must agree to 1e-9 (of the largest value of each row) on every pose, and on
every validity exactly, and every branch must occur; otherwise the exit code is 1. Without gcc only our side
is measured.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import platform
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np
from distinct import distinct_inverses
from rich.console import Console
from rich.table import Table
from yardstick import Arrays, Yardstick, compile_library, compiler

import assur
from assur.kinematics.closed_form.all_modes_sweep import all_modes_sweep
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.model.mechanism import MechanismRecord

MECHANISM = "zeng2019"
MODE = "++-++"
SEED = 2019
TOLERANCE = 1e-9
CHUNK = 65536  # poses compared at a time


@dataclass(frozen=True)
class Job:
    """One sweep: the C function of that name, ours with the same answer, and what it is given."""

    name: str
    text: str
    given: str
    ours: Callable[[MechanismRecord, np.ndarray], Arrays]


def one_mode(record: MechanismRecord, poses: np.ndarray) -> Arrays:
    found = inverse_sweep(record, poses, MODE)
    return [np.atleast_2d(found[name]) for name in ("inputs", "exists", "det_jp", "det_jq", "factors")]


def distinct(record: MechanismRecord, poses: np.ndarray) -> Arrays:
    numbers, exists = distinct_inverses(record, poses, "numpy")
    return [*np.split(numbers, len(record.inputs)), exists]


def expanded(record: MechanismRecord, poses: np.ndarray) -> Arrays:
    inputs, exists = all_modes_sweep(record, "inverse", poses)
    return [inputs.reshape(-1, inputs.shape[-1]), exists]


def directs(record: MechanismRecord, inputs: np.ndarray) -> Arrays:
    poses, exists = all_modes_sweep(record, "direct", inputs)
    return [poses.reshape(-1, poses.shape[-1]), exists]


JOBS = (
    Job("inverse_one", f"inverse, mode {MODE}, det Jp, det Jq, 9 factors", "poses", one_mode),
    Job("inverse_distinct", "all 32 inverses as 12 numbers", "poses", distinct),
    Job("inverse_expanded", "all 32 inverses written out", "poses", expanded),
    Job("direct_all", "all 8 directs", "inputs", directs),
)


def problems(record: MechanismRecord, given: str, count: int) -> np.ndarray:
    """Random poses in the search box, or inputs within the half length of the base: (3, N), nothing else made.

    The box is made symmetric about the origin, because in the box itself many working modes never exist.
    """
    reach = record.parameters["a"].value
    sizes = [max(map(abs, record.box[name])) for name in record.platform.pose] if given == "poses" else [reach] * 3
    values = np.empty((3, count))
    rng = np.random.default_rng(SEED)
    for row, size in zip(values, sizes, strict=True):
        rng.random(out=row)
        row -= 0.5
        row *= 2 * size
    return values


def disagreement(job: Job, record: MechanismRecord, c: Yardstick, values: np.ndarray) -> tuple[float, bool]:
    """Largest difference of ours and C, per row relative to its largest value, and whether every branch occurs.

    It is infinite where shapes or validities differ.
    """
    worst, count, occurs = 0.0, values.shape[1], np.zeros(1, dtype=bool)
    for start in range(0, count, CHUNK):
        part = np.ascontiguousarray(values[:, start : start + CHUNK])
        theirs = c.run(job.name, part, c.empty(job.name, part.shape[1]))
        for a, b in zip(job.ours(record, part), theirs, strict=True):
            if a.dtype == bool:
                occurs = occurs | b.any(axis=1)
            worst = max(worst, difference(a, b))
    return worst, bool(occurs.all())


def difference(a: np.ndarray, b: np.ndarray) -> float:
    if a.shape != b.shape or a.dtype != b.dtype:
        return float("inf")
    if a.dtype == bool:
        return 0.0 if np.array_equal(a, b) else float("inf")
    size = np.maximum(np.abs(b).max(axis=1), np.finfo(float).tiny)
    gap = float((np.abs(a - b).max(axis=1) / size).max())
    return gap if np.isfinite(gap) else float("inf")


def seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    answer = work()
    took = time.perf_counter() - start
    del answer
    return took


def timings(
    job: Job, record: MechanismRecord, c: Yardstick | None, values: np.ndarray, repeats: int
) -> dict[str, list[float]]:
    """Seconds of ours, C into new arrays (as ours) and C into arrays already in use, in turn."""
    count = values.shape[1]
    works: dict[str, Callable[[], object]] = {"ours": lambda: job.ours(record, values)}
    if c is not None:
        used = c.run(job.name, values, c.empty(job.name, count))
        works["new"] = lambda: c.run(job.name, values, c.empty(job.name, count))
        works["used"] = lambda: c.run(job.name, values, used)
    found: dict[str, list[float]] = {name: [] for name in works}
    for _ in range(repeats):
        for name, work in works.items():
            found[name].append(seconds(work))
    return found


def high_water() -> int:
    """Peak resident memory of this process in bytes (Linux: since `reset_high_water`)."""
    status = Path("/proc/self/status")
    if status.exists():
        line = next(line for line in status.read_text().splitlines() if line.startswith("VmHWM"))
        return int(line.split()[1]) * 1024
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def reset_high_water() -> None:
    """Forget the peak of the imports; where the system cannot, the peak before the job is the baseline."""
    switch = Path("/proc/self/clear_refs")
    with contextlib.suppress(OSError):
        switch.write_text("5")


def print_memory(job: Job, record: MechanismRecord, count: int) -> None:
    """In a process of its own: what the job adds to the memory of imports and problems; what of it is the answer."""
    values = problems(record, job.given, count)
    reset_high_water()
    before = high_water()
    answer = job.ours(record, values)
    peak = high_water() - before
    print(json.dumps({"peak": peak, "answer": sum(array.nbytes for array in answer)}))


def memory(job: Job, count: int) -> dict[str, int]:
    command = [sys.executable, __file__, "--memory", job.name, "--poses", str(count)]
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
    found: dict[str, int] = json.loads(done.stdout)
    return found


def rate(times: Sequence[float], count: int) -> str:
    """Median, and best, in millions of poses per second."""
    return f"{count / median(times) / 1e6:.1f} ({count / min(times) / 1e6:.1f})"


def ratio(found: dict[str, list[float]], name: str) -> str:
    if name not in found:
        return "-"
    share = median(found["ours"]) / median(found[name])
    return f"1/{share:.1f}"


def cpu() -> str:
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    return next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), platform.machine())


def version(gcc: str) -> str:
    done = subprocess.run([gcc, "-dumpfullversion"], check=True, stdout=subprocess.PIPE, text=True)
    return done.stdout.strip()


def agree(console: Console, record: MechanismRecord, c: Yardstick, count: int) -> bool:
    """Whether every job of ours gives what C gives; says by how much they differ."""
    for job in JOBS:
        worst, all_occur = disagreement(job, record, c, problems(record, job.given, count))
        console.print(f"{job.text}: ours and C differ by {worst:.1e} at most on {count} {job.given}")
        if worst > TOLERANCE:
            console.print(f"[red]that is more than {TOLERANCE:g}: they do not compute the same")
            return False
        if not all_occur:
            console.print("[red]but some branch exists for none of them: give more --poses")
            return False
    return True


def main() -> int:
    parser = argparse.ArgumentParser(description="Speed of the sweeps beside a hand-written C loop.")
    parser.add_argument("--poses", type=int, default=1_000_000)
    parser.add_argument("--repeats", type=int, default=9)
    parser.add_argument("--memory", choices=[job.name for job in JOBS], help=argparse.SUPPRESS)
    args = parser.parse_args()
    if args.poses < 1000 or args.repeats < 1:
        parser.error("--poses is at least 1000 and --repeats at least 1")
    record = assur.load(MECHANISM)
    if args.memory:
        print_memory(next(job for job in JOBS if job.name == args.memory), record, args.poses)
        return 0

    console = Console(width=None if sys.stdout.isatty() else 150, highlight=False)
    gcc = compiler()
    by = f"gcc {version(gcc)}" if gcc else "no gcc here: the yardstick is missing"
    console.print(f"{cpu()}, one thread; numpy {np.__version__}; {by}")
    peaks = {job.name: memory(job, args.poses) for job in JOBS}
    c = Yardstick(compile_library(gcc), record, MODE) if gcc else None
    if c is not None and not agree(console, record, c, args.poses):
        return 1

    title = f"{args.poses} random problems, median (best) of {args.repeats} runs, in millions per second"
    table = Table("job", title=title)
    for heading in ("ours", "C, new arrays", "C, same arrays", "ratio, new", "ratio, same", "peak MB", "answer MB"):
        table.add_column(heading, justify="right")
    for job in JOBS:
        found = timings(job, record, c, problems(record, job.given, args.poses), args.repeats)
        rates = [rate(found[name], args.poses) if name in found else "-" for name in ("ours", "new", "used")]
        ratios = [ratio(found, name) for name in ("new", "used")]
        sizes = [f"{peaks[job.name][name] / 1e6:.0f}" for name in ("peak", "answer")]
        table.add_row(job.text, *rates, *ratios, *sizes)
    console.print(table)
    return 0


if __name__ == "__main__":
    sys.exit(main())
