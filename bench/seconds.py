"""Seconds of work that the tests judge by its calls or its boxes, never by a clock.

    .venv/bin/python bench/seconds.py [--repeats 3]

The best of some repeats, in processor time.
"""

from __future__ import annotations

import argparse
import resource
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np
from rich.console import Console
from rich.table import Table

import assur
from assur.kinematics.following.following import follow
from assur.kinematics.pose import pose_of
from assur.machine.elasticity.stiffness_maps import stiffness_maps
from assur.numerics.polynomials import roots
from assur.topology.notation import parse_chain
from assur.topology.symbolic.union import serial
from assur.workspace.aspects.adjacency import shared_faces
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.region import certified_workspace
from assur.workspace.region import workspace

MECHANISM = "zeng2019"
COMMANDS = (
    ("--help",),
    ("list",),
    ("show", MECHANISM),
    ("direct", MECHANISM, "162.6907", "-143.3209", "-24.6776"),
    ("inverse", MECHANISM, "-15.4714", "9.6849", "456.3315"),
    ("direct", "delta_4s", "0", "0", "0", "--method", "search"),
)
CHAIN = "R[x] R[y] P[z] R[z] R[x] P[y] R[y] R[x]"


def seconds(work: Callable[[], object]) -> float:
    start = time.process_time()
    work()
    return time.process_time() - start


def command_seconds(*words: str) -> float:
    """Of a whole process, as it is typed."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    call = [sys.executable, "-c", "from assur.cli.main import main; main()", *words]
    subprocess.run(call, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def works() -> dict[str, Callable[[], object]]:
    """What is timed, by what it is called in the table."""
    record = assur.load(MECHANISM)
    start = record.home_values
    ahead = pose_of(record, start) + np.array([30.0, 40.0, -40.0])
    poses, region = np.linspace(pose_of(record, start), ahead, 1000), workspace(record, resolution=16)
    coefficients = np.random.default_rng(1).normal(size=(10_000, 9))
    boxes = Boxes(np.zeros((3, 1)), np.ones((3, 1))).divided([48, 48, 48])
    chain = parse_chain(CHAIN)
    return {
        "roots of 10,000 polynomials of degree 8": lambda: roots(coefficients),
        "shared faces of 110,592 boxes": lambda: shared_faces(boxes),
        "motion of a chain of 8 joints by the rules": lambda: serial(chain),
        f"a path of {MECHANISM}, 50 steps": lambda: follow(record, start, poses=ahead, largest_step=0.02),
        f"stiffness of {MECHANISM} at 1,000 poses": lambda: record.stiffness(poses),
        f"stiffness of {MECHANISM} over 30 x 30 nodes": lambda: stiffness_maps(record, region, ["x", "z"], nodes=30),
        f"certified workspace of {MECHANISM}, gap 1e-5": lambda: certified_workspace(record, gap=1e-5, sections=()),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=3)
    repeats = parser.parse_args().repeats
    rows = Table("work", "s", box=None)
    for name, work in works().items():
        rows.add_row(name, f"{min(seconds(work) for _ in range(repeats)):.4f}")
    for words in COMMANDS:
        best = min(command_seconds(*words) for _ in range(repeats + 1))  # the first may still read and compile files
        rows.add_row(f"assur {' '.join(words)}", f"{best:.4f}")
    Console().print(rows)


if __name__ == "__main__":
    main()
