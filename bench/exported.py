"""The C that `assur export --format c` writes beside compiled loops and NumPy: hand-written forms, and derived ones.

    .venv/bin/python bench/exported.py [--count 100000] [--repeats 5]

Each program solves the same direct and inverse problems about home, one thread. Before anything is timed the numbers of
solutions must agree but for 1 in 10^4, where a margin is rounding; otherwise the exit code is 1. Needs gcc.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import numpy as np
from bench import cpu
from rich.console import Console
from rich.table import Table
from yardstick import compiler

import assur
from assur.derivation.derivation import derive
from assur.export.c99 import c99_text, identifier
from assur.kinematics.closed_form.all_modes_sweep import all_modes_sweep
from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.mechanism import Mechanism
from assur.model.closed_form import Eliminant
from assur.model.kernels.reading import names_of

ROOTS, POLYNOMIALS = ("zeng2019", "delta_4s", "three_crr"), ("planar_3rpr",)
FLAGS = ("-std=c99", "-O2", "-D_POSIX_C_SOURCE=199309L")
ODD = 1e-4
"""Share of problems at which the numbers of solutions may differ."""

DRIVER = """
#include "{file}"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

int main(int words, char **word)
{{
    long count = words > 2 ? atol(word[1]) : 0, found = 0;
    double *given = malloc(sizeof(double) * {size} * (size_t)count);
    FILE *file = fopen(words > 2 ? word[2] : "", "rb");
    static {name}_solution out[{upper}_{problem_upper}_MAX];
    struct timespec first, last;
    if (!given || !file || fread(given, sizeof(double) * {size}, (size_t)count, file) != (size_t)count)
        return 1;
    clock_gettime(CLOCK_MONOTONIC, &first);
    for (long k = 0; k < count; k++) {{
        int number = {name}_{problem}(&{name}_dimensions, given + {size} * k, out);
        found += number > 0 ? number : 0;
    }}
    clock_gettime(CLOCK_MONOTONIC, &last);
    printf("%ld %.9f\\n", found, (double)(last.tv_sec - first.tv_sec) + 1e-9 * (double)(last.tv_nsec - first.tv_nsec));
    return 0;
}}
"""


def problems(record: Mechanism, problem: Problem, count: int) -> np.ndarray:
    """Poses or inputs (N, n) about home, of which some have no answer."""
    home = pose_of(record, home_values(record))
    if problem == "direct":
        home = np.asarray(next(iter(inverse(record, home, method="closed form"))).inputs)
    sizes = 0.4 * np.maximum(np.abs(home), 0.3 * np.max(np.abs(home)))
    return home + sizes * np.random.default_rng(1).uniform(-1.0, 1.0, (count, len(home)))


def of_c(gcc: str, record: Mechanism, problem: Problem, given: np.ndarray, repeats: int) -> tuple[int, float]:
    """How many solutions the C finds, and the median of its seconds."""
    name = identifier(record.name)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        (folder / "form.c").write_text(c99_text(record), encoding="ascii")
        given.astype(float).tofile(folder / "given")
        driver = DRIVER.format(
            file="form.c", name=name, upper=name.upper(), problem=problem, problem_upper=problem.upper(),
            size=given.shape[1],
        )  # fmt: skip
        (folder / "driver.c").write_text(driver, encoding="ascii")
        subprocess.run([gcc, *FLAGS, str(folder / "driver.c"), "-o", str(folder / "run"), "-lm"], check=True)
        runs = [
            subprocess.run(
                [str(folder / "run"), str(len(given)), str(folder / "given")],
                check=True,
                capture_output=True,
                text=True,
            ).stdout.split()
            for _ in range(repeats)
        ]
    return int(runs[0][0]), median(float(seconds) for _, seconds in runs)


def has_polynomial(record: Mechanism, problem: Problem) -> bool:
    """Whether a problem ends in one polynomial, whose roots no compiled loop finds."""
    form = record.closed_form
    return problem == "direct" and form is not None and isinstance(form.direct, Eliminant)


def of_python(record: Mechanism, problem: Problem, given: np.ndarray, engine: str, repeats: int) -> tuple[int, float]:
    """The same of the compiled loop, of NumPy, and of the roots of a polynomial."""

    def number() -> int:
        if has_polynomial(record, problem):
            return int(np.count_nonzero(direct(record, given, method="closed form").exists))
        return int(np.count_nonzero(all_modes_sweep(record, problem, given.T.copy(), engine=engine, threads=1)[1]))

    solutions, seconds = number(), []
    for _ in range(repeats):
        begun = time.perf_counter()
        number()
        seconds.append(time.perf_counter() - begun)
    return solutions, median(seconds)


def main() -> int:
    parser = argparse.ArgumentParser(description="The exported C beside the compiled loops and NumPy.")
    parser.add_argument("--count", type=int, default=100_000)
    parser.add_argument("--repeats", type=int, default=5)
    args = parser.parse_args()
    gcc, console = compiler(), Console(width=None if sys.stdout.isatty() else 150, highlight=False)
    if gcc is None:
        console.print("no gcc: the exported C is not measured")
        return 0
    console.print(f"{cpu()}; numpy {np.__version__}; gcc {' '.join(FLAGS[:2])}, one thread")
    table = Table("closed form", title="exported C: all solutions of a problem with Jacobians, margins and factors")
    for heading in ("problem", "solutions", "C, ns a problem", "compiled loop, ns", "NumPy, ns"):
        table.add_column(heading, justify="right")
    same = True
    for name in (*ROOTS, *POLYNOMIALS):
        written = assur.load(name)
        text = derive(written).closed_form()
        derived = written.with_closed_form(names_of(text, Path("closed_form.py"))["CLOSED_FORM"], text)
        count = args.count if name in ROOTS else args.count // 20
        for word, record in (("", written), (", derived", derived)):
            for problem in ("direct", "inverse"):
                given = problems(record, problem, count)
                number, seconds = of_c(gcc, record, problem, given, args.repeats)
                engines = ("numpy",) if has_polynomial(record, problem) else ("compiled", "numpy")
                ours = [of_python(record, problem, given, engine, args.repeats) for engine in engines]
                same = same and all(abs(number - own) <= ODD * max(number, count) for own, _ in ours)
                times = [f"{1e9 * own / count:.0f}" for own in (seconds, *(took for _, took in ours))]
                times[1:1] = [""] * (3 - len(times))
                table.add_row(f"{name}{word}", problem, f"{number / count:.2f}", *times)
    console.print(table)
    if not same:
        console.print("[red]numbers of solutions differ")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
