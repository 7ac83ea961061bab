"""Ours beside Codac and pymadcad, where installed, in one run: paving and direct solution with proof, closure.

    .venv/bin/python bench/others.py [--poses 100] [--repeats 5]

Processor time of one call on one thread, medians, in turn, once our machine code is loaded (it is after about a second
of work of its kind in one process); a ratio below 1 means that ours is faster. All answers are compared first, by what
each of them proves or claims: where they contradict each other the word DISAGREE stands there and the exit code is 1.
What is not installed is said; ours is measured all the same.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from statistics import median
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import with_pymadcad
from bench import MECHANISM, problems
from codac_process import Codac, Paved
from rich.console import Console
from rich.markup import escape
from rich.table import Table

import assur
from assur.kinematics.certified.certify import certified_direct
from assur.kinematics.closed_form.all_modes_sweep import all_modes_sweep
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.kinematics.newton import ENOUGH, Newton
from assur.kinematics.newton_step import NewtonStep
from assur.kinematics.pose import pose_of
from assur.numerics.recording.interval_program import repaid
from assur.workspace.certified.criteria import criteria
from assur.workspace.certified.paving import Paving, pave
from assur.workspace.domain import box_of

SIZES = (10.0, 1.0)  # mm, extent of a box about the boundary
INPUTS = (163.0, -143.0, -25.0)  # near pose 3* of the paper's Table 1; four real poses
PUSH = 3.0  # mm, from a start to what is solved for
PRECISIONS = (1e-6, 1e-12)  # pymadcad's own default, and one near what floats can do
NEAR = 1e3  # by so much more than its loops a pose may be open; another assembly would be millimetres away
ROUNDING = 1e-10  # mm
MANY = 10_000  # poses closed at once
MISSING = "not installed"
HOW = escape("pip install '.[bench]'")
BAD = "[red]DISAGREE[/]"


def seconds(
    works: dict[str, Callable[[], object]], repeats: int, elsewhere: Callable[[], float] | None = None
) -> dict[str, float]:
    """Median seconds of processor time of each work, done in turn: what else the machine does counts little.

    `elsewhere` does its work in another process and says how long that took; it is "theirs".
    """
    found: dict[str, list[float]] = {name: [] for name in (*works, *(["theirs"] if elsewhere else []))}
    for _ in range(repeats):
        for name, work in works.items():
            start = time.process_time()
            work()
            found[name].append(time.process_time() - start)
        if elsewhere:
            found["theirs"].append(elsewhere())
    return {name: median(times) for name, times in found.items()}


def warm(record: assur.Mechanism) -> None:
    """Work until machine code has repaid its loading: Codac's was compiled before, and works from its first box on."""
    while not repaid(0, 0):
        certified_direct(record, INPUTS, way="boxes")
    certified_direct(record, INPUTS, way="boxes")  # it is loaded by the first that uses it


def ms(value: float) -> str:
    return f"{1e3 * value:.1f} ms"


def us(value: float) -> str:
    return f"{1e6 * value:.1f} µs"


def bounds(found: Paving | Paved) -> str:
    return f"{found.low / 1e6:.4f} .. {found.high / 1e6:.4f}"


def paving(rows: Table, record: assur.Mechanism, codac: Codac, repeats: int) -> bool:
    """The workspace of the default mode in its box, down to boxes of a size, and to the bounds that Codac reaches."""
    asked, box = criteria(record), box_of(record, None)
    right = True
    for size in SIZES:
        ours = partial(pave, asked, box, finest={"x": size, "z": size})
        found = ours()
        said = f"ours {bounds(found)} dm³"
        if not codac.version:
            took = seconds({"ours": ours}, repeats)
            rows.add_row(f"paving, {size:g} mm", ms(took["ours"]), MISSING, "", said)
            continue
        theirs, _ = codac.workspace(size)
        share = (theirs.high - theirs.low) / theirs.low
        as_near = partial(pave, asked, box, gap=share)
        near = as_near()
        took = seconds({"ours": ours, "as near": as_near}, repeats, lambda size=size: codac.workspace(size)[1])
        whole = f"{said}, Codac {bounds(theirs)}"
        right &= compared(rows, f"paving, {size:g} mm", took, "ours", whole, agreeing(record, found, theirs))
        closer = f"ours {bounds(near)} dm³, {len(near.boundary)} open boxes, Codac {theirs.boundary}"
        name = f"paving, gap of Codac's {size:g} mm"
        right &= compared(rows, name, took, "as near", closer, agreeing(record, near, theirs))
    return right


def compared(rows: Table, what: str, took: dict[str, float], own: str, said: str, agree: bool) -> bool:
    """A row of ours beside Codac's; whether they agree."""
    ratio = f"{took[own] / took['theirs']:.2f}"
    rows.add_row(what, ms(took[own]), ms(took["theirs"]), ratio, f"{said}: {'agree' if agree else BAD}")
    return agree


def agreeing(record: assur.Mechanism, found: Paving, theirs: Paved) -> bool:
    """Whether the bounds overlap, and our closed form reaches what Codac has inside and nothing that it has outside."""
    overlap = found.low <= theirs.high and theirs.low <= found.high
    inside, outside = (
        inverse_sweep(record, np.array([x, np.zeros_like(x), z]), record.modes.default_working, ("exists",))["exists"]
        for x, z in (theirs.inside, theirs.outside)
    )
    return bool(overlap and inside.all() and not outside.any())


def direct(rows: Table, record: assur.Mechanism, codac: Codac, repeats: int) -> bool:
    """Every pose at given inputs, each proved and proved to be all; ours by two routes.

    Only that by boxes contracts and halves as Codac does.
    """
    works: dict[str, Callable[[], Any]] = {
        "closed form": partial(certified_direct, record, INPUTS),
        "boxes": partial(certified_direct, record, INPUTS, way="boxes"),
    }
    answers = {name: work() for name, work in works.items()}
    right = all(answer.complete and not answer.undecided for answer in answers.values())
    if not codac.version:
        took = seconds(works, repeats)
        for name, answer in answers.items():
            rows.add_row(f"certified direct, {name}", ms(took[name]), MISSING, "", answer.headline)
        return right
    (low, high, looked), _ = codac.direct(INPUTS)
    took = seconds(works, repeats, lambda: codac.direct(INPUTS)[1])
    for name, answer in answers.items():
        said = f"{answer.headline}; Codac {len(low)}, in {looked} boxes"
        agree = same_poses(answer.solutions, low, high)
        right &= compared(rows, f"certified direct, {name}", took, name, said, agree)
    return right


def same_poses(ours: tuple, low: np.ndarray, high: np.ndarray) -> bool:
    """Whether the proved boxes of both meet one to one."""
    meets = np.array([np.all((item.pose.low <= high) & (low <= item.pose.high), axis=1) for item in ours])
    return meets.shape == (len(low), len(low)) and bool(np.all(meets.sum(0) == 1) and np.all(meets.sum(1) == 1))


def neighbours(record: assur.Mechanism, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Closed joint values (K, n) of the default mode, and as many poses (K, 3) near them that the mode reaches too."""
    rng = np.random.default_rng(2019)
    poses = rng.uniform([-60, -100, 400], [40, 100, 450], size=(2 * count, 3))
    moved = poses + rng.uniform(-PUSH, PUSH, size=poses.shape)
    here, there = (record.inverse(some, record.modes.default_working) for some in (poses, moved))
    both = np.flatnonzero(here.exists[:, 0] & there.exists[:, 0])[:count]
    return here.joints[both, 0], moved[both]


def closure(rows: Table, record: assur.Mechanism, start: np.ndarray, poses: np.ndarray, repeats: int) -> bool:
    """The pose at given inputs from a neighbour, by the joint graph: 17 joints, 4 loops, 10 redundant constraints."""
    start = start.copy()
    start[:, record.input_indices] = record.inverse(poses, record.modes.default_working).inputs[:, 0]
    engine = Newton(record, NewtonStep(record.input_indices))
    found = engine(start)
    right = (
        bool(np.all(found.residual <= ENOUGH)) and np.abs(pose_of(record, found.values) - poses).max() < NEAR * ROUNDING
    )
    many = np.tile(start, (MANY // len(start), 1))
    took = seconds({"one": lambda: [engine(one[None]) for one in start], "many": lambda: engine(many)}, repeats)
    own = Own(took["one"] / len(start), took["many"] / len(many))
    if with_pymadcad.version() is None:
        rows.add_row("inputs given, one pose by closure", own.text, MISSING, "", HOW)
        return right
    solve = with_pymadcad.model(record).at_inputs

    def away(values: np.ndarray, which: np.ndarray) -> float:
        values[:, record.input_indices] = start[which][:, record.input_indices]  # it hands back what it started with
        return float(np.abs(pose_of(record, values) - poses[which]).max())

    for precision in PRECISIONS:
        works = [partial(solve, record, one, precision) for one in start]
        right &= beside(rows, "inputs given, one pose by closure", own, works, precision, away, repeats)
    return right


def inverse(rows: Table, record: assur.Mechanism, start: np.ndarray, poses: np.ndarray, repeats: int) -> bool:
    """The inputs at a pose: ours in all 32 modes by the closed form, pymadcad's in the mode of a neighbouring start."""
    some = problems(record, "poses", 1_000_000)
    all_modes_sweep(record, "inverse", some[:, :1], engine="compiled", threads=1)  # made before it is timed
    took = seconds(
        {
            "one": lambda: [record.inverse(pose) for pose in poses],
            "many": lambda: all_modes_sweep(record, "inverse", some, engine="compiled", threads=1),
        },
        repeats,
    )
    own = Own(took["one"] / len(poses), took["many"] / some.shape[1])
    if with_pymadcad.version() is None:
        rows.add_row("pose given: ours 32 modes", own.text, MISSING, "", HOW)
        return True
    solve, right = with_pymadcad.model(record, platform_given=True).at_pose, True
    inputs = record.inverse(poses, record.modes.default_working).inputs[:, 0]

    def away(values: np.ndarray, which: np.ndarray) -> float:
        return float(np.abs(values[:, record.input_indices] - inputs[which]).max())

    for precision in PRECISIONS:
        works = [partial(solve, *pair, precision) for pair in zip(poses, start, strict=True)]
        right &= beside(rows, "pose given: ours 32 modes, theirs 1", own, works, precision, away, repeats)
    return right


@dataclass(frozen=True)
class Own:
    """Seconds a pose of ours: asked for one by one, and as one of many."""

    one: float
    many: float

    @property
    def text(self) -> str:
        return f"{us(self.one)}, of many {1e6 * self.many:.3g} µs"


def beside(
    rows: Table,
    name: str,
    own: Own,
    works: Sequence[Callable[[], np.ndarray | None]],
    precision: float,
    away: Callable[[np.ndarray, np.ndarray], float],
    repeats: int,
) -> bool:
    """A row for pymadcad at a precision; whether everything that converges ends where ours does."""
    answers = [work() for work in works]
    which = np.flatnonzero([answer is not None for answer in answers])
    gap = away(np.array([answers[k] for k in which]), which) if len(which) else 0.0
    agree = gap < NEAR * max(precision / with_pymadcad.UNIT, ROUNDING)
    took = seconds({"": lambda: [work() for work in works]}, repeats)[""] / len(works)
    rows.add_row(
        f"{name}, precision {precision:g}", own.text, us(took), f"{own.one / took:.2g}, of many {own.many / took:.2g}",
        f"pymadcad: {len(which)} of {len(works)} converge, within {gap:.0e} mm of ours{'' if agree else ': ' + BAD}",
    )  # fmt: skip
    return agree


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--poses", type=int, default=100)
    parser.add_argument("--repeats", type=int, default=5)
    asked = parser.parse_args()
    record = assur.load(MECHANISM)
    console = Console(width=None if sys.stdout.isatty() else 170, highlight=False)
    codac = Codac(record)
    warm(record)
    for name, found, missing in (
        ("Codac", codac.version, codac.missing),
        ("pymadcad", with_pymadcad.version(), with_pymadcad.missing),
    ):
        console.print(f"{name} {found or f'{MISSING} ({escape(missing)}): {HOW}'}")
    rows = Table("what", "ours", "theirs", "ours/theirs", "found", box=None)
    right = paving(rows, record, codac, asked.repeats)
    right &= direct(rows, record, codac, asked.repeats)
    start, poses = neighbours(record, asked.poses)
    right &= closure(rows, record, start, poses, asked.repeats)
    right &= inverse(rows, record, start, poses, asked.repeats)
    console.print(rows)
    console.print(
        "Neither gives all modes of a pose, nor determinants or condition: sweeps and grids stand beside C and memory."
    )
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
