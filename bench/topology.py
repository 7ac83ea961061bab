"""Milliseconds for the whole topology of a mechanism, by both routes, beside a yardstick measured in the same run.

    .venv/bin/python bench/topology.py [--repeats 15]

The yardstick is what the second route cannot do without: the singular values of the closure of the whole joint graph at
the configurations at which ranks are taken. The exit code is 1 if an answer is not what the rules and twists agree on.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from statistics import median

import numpy as np
from rich.console import Console
from rich.table import Table

import assur
from assur.topology.facts import Topology
from assur.topology.screws.edges import closure
from assur.topology.screws.twists import edges

NAMES = ("zeng2019", "tripteron", "delta_4s", "gough_stewart")


def timed(work: Callable[[], object], repeats: int) -> float:
    """Median milliseconds."""
    took = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        took.append(time.perf_counter() - start)
    return 1e3 * median(took)


def yardstick(found: Topology, repeats: int) -> float:
    values = np.zeros((4, sum(len(joint.screws) for joint in found.linkage.joints.values())))
    matrix = closure(edges(found.linkage, values, collapsed=False))
    return timed(lambda: np.linalg.svd(matrix, compute_uv=False), repeats)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=15)
    repeats = parser.parse_args().repeats
    rows = Table("topology", "F", "κ", "ms", "ranks alone [ms]", "ratio", box=None)
    agree = True
    for name in NAMES:
        given = assur.load(name) if name in assur.names() else name
        found = assur.topology(given)
        agree = agree and found.routes_agree
        ours, least = timed(lambda given=given: assur.topology(given), repeats), yardstick(found, repeats)
        rows.add_row(
            name, str(found.dof), str(found.coupling_degree), f"{ours:.1f}", f"{least:.2f}", f"{ours / least:.0f}"
        )
    Console().print(rows)
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
