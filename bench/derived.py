"""Derived closed forms beside the hand-written ones of the same mechanisms: seconds of both, measured in turn.

    .venv/bin/python bench/derived.py [--count 20000] [--repeats 5] [NAME ..]

Every branch of the inverse problem, and of the direct one: swept where it is square roots, by NumPy and by compiled
loops, and polynomials by their roots. Ratios are of the least processor times; below 1 means that the derived form is
faster. Exit code 1 where the median of the ratios of square roots is above 1.2, or one of them above 1.5.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from statistics import median

import numpy as np
from rich.console import Console
from rich.table import Table

from assur.derivation.kept import derived_closed_form
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closed_form.all_modes_sweep import all_modes_sweep
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS
from assur.model.registry import load_record

TOWERS = ("zeng2019", "fivebar", "delta_4s", "linear_delta_4s", "linear_delta_4r", "orthoglide", "tsai_platform",
          "three_p2us", "three_crr", "tripteron")  # fmt: skip
POLYNOMIALS = ("planar_3rpr", "planar_3rrr", "three_rrc")
MEDIAN, MOST = 1.2, 1.5
NEAR = 0.05
"""Poses about home, in characteristic lengths and rad."""


def derived(written: MechanismRecord, folder: Path) -> MechanismRecord:
    """The mechanism with its derived form."""
    own = folder / written.name
    own.mkdir()
    shutil.copy(written.file, own / "mechanism.toml")
    (own / "closed_form.py").write_text(derived_closed_form(written))
    return load_record(own)


def given(record: MechanismRecord, count: int) -> dict[str, np.ndarray]:
    """Poses about home (count, m), and inputs at which a branch is there."""
    home, length = pose_of(record, home_values(record)), characteristic_length(record)
    scales = np.array([length if name in LENGTHS else 1.0 for name in record.platform.pose])
    poses = home + NEAR * scales * np.random.default_rng(0).uniform(-1.0, 1.0, (count, len(home)))
    answer = inverse(record, poses, method="closed form")
    place = np.argmax(answer.exists, axis=-1)
    inputs = np.take_along_axis(answer.inputs, place[:, None, None], axis=1)[:, 0]
    return {"inverse": poses, "direct": inputs[np.all(np.isfinite(inputs), axis=-1)]}


def works(record: MechanismRecord, values: dict[str, np.ndarray]) -> dict[str, Callable[[], object]]:
    """What is measured."""
    own: dict[str, Callable[[], object]] = {}
    for problem, rows in values.items():
        if problem == "direct" and record.name in POLYNOMIALS:
            few = rows[: max(1, len(rows) // 40)]
            own["direct, roots"] = lambda few=few: direct(record, few, method="closed form").poses
            continue
        for engine in ("numpy", "compiled"):
            own[f"{problem}, {engine}"] = lambda p=problem, r=rows, e=engine: list(
                all_modes_sweep(record, p, r.T, engine=e, threads=1)
            )
    return own


def ratios(name: str, folder: Path, count: int, repeats: int) -> Iterator[tuple[str, float, float]]:
    """What, and the least seconds of the hand-written and of the derived form."""
    written = load_record(name)
    other = derived(written, folder)
    values = given(written, count)
    pairs = zip(works(written, values).items(), works(other, values).items(), strict=True)
    for (what, first), (_, second) in pairs:
        first(), second()  # what is compiled once
        times: tuple[list[float], list[float]] = ([], [])
        for _ in range(repeats):
            for work, own in zip((first, second), times, strict=True):
                begun = time.process_time()
                work()
                own.append(time.process_time() - begun)
        yield what, min(times[0]), min(times[1])


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("names", nargs="*", default=[*TOWERS, *POLYNOMIALS])
    parser.add_argument("--count", type=int, default=20000)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    console, table = Console(), Table("mechanism", "what", "hand-written [ms]", "derived [ms]", "ratio")
    every: dict[str, list[float]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in options.names:
            for what, first, second in ratios(name, Path(folder), options.count, options.repeats):
                table.add_row(name, what, f"{1e3 * first:.2f}", f"{1e3 * second:.2f}", f"{second / first:.2f}")
                if name in TOWERS:
                    every.setdefault(what, []).append(second / first)
    console.print(table)
    for what, own in every.items():
        console.print(f"{what}: median {median(own):.2f}, largest {max(own):.2f}")
    slow = any(median(own) > MEDIAN or max(own) > MOST for own in every.values())
    return int(slow)


if __name__ == "__main__":
    sys.exit(main())
