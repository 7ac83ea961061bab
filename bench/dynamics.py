"""Forces of the actuators at many poses in motion, beside MuJoCo's and Pinocchio's inverse dynamics of the same links.

    .venv/bin/python bench/dynamics.py [--poses 100000] [--repeats 3]

Ours holds the loops closed and tells the forces of the drives; the others are asked for the open tree per state, MuJoCo
with its constraints, whose forces at rest it does not tell from those of drives. So the times are of less work than
ours. First, forces at some poses must be those by singular values, to 1e-7; else the exit code is 1. Processor time of
one thread, the median of the repeats.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from importlib.util import find_spec
from statistics import median

import numpy as np
from rich.console import Console
from rich.table import Table

import assur
from assur.export.urdf import urdf
from assur.kinematics.rates.acceleration import joints_in_mode
from assur.machine.forces.balance import Asked, balanced
from assur.machine.forces.batches import balanced_in_batches
from assur.machine.forces.loads import load_of
from assur.machine.masses.link_masses import masses
from assur.mechanism import Mechanism

MECHANISMS = {"zeng2019": "++-++", "delta_4s": None}
STATES = 10_000


def seconds(work: Callable[[], object], repeats: int) -> float:
    took = []
    for _ in range(repeats):
        start = time.process_time()
        work()
        took.append(time.process_time() - start)
    return median(took)


def ours(rows: Table, name: str, mode: str | None, asked: argparse.Namespace) -> bool:
    """Whether pivots and singular values agree."""
    mechanism = assur.load(name)
    low, high = np.array([mechanism.box[each] for each in mechanism.platform.pose]).T
    middle, reach = 0.5 * (low + high), 0.25 * (high - low)
    random = np.random.default_rng(0)
    poses = random.uniform(middle - reach, middle + reach, size=(2 * asked.poses, len(low)))
    joints = joints_in_mode(mechanism, poses, mode)
    reached = np.flatnonzero(np.isfinite(joints).all(axis=1))[: asked.poses]
    poses, values = poses[reached], joints[reached]
    velocity, change = (random.normal(size=poses.shape) for _ in range(2))
    question = Asked(mechanism, values, masses(mechanism), load_of(None), velocity, change)
    answer = balanced_in_batches(question)
    few = np.arange(0, len(values), max(len(values) // 100, 1))
    expected = balanced(question.part(few))
    off = float(np.max(np.abs(answer.forces[few] - expected.forces)) / np.max(np.abs(expected.forces)))
    times = {
        "forces, from joint values": seconds(lambda: balanced_in_batches(question), asked.repeats),
        "forces, from poses": seconds(
            lambda: mechanism.forces(poses, 1e3 * velocity, 1e3 * change, mode=mode), asked.repeats
        ),
        "singular values, from joint values": seconds(lambda: balanced(question.part(few)), asked.repeats)
        * len(values)
        / len(few),
    }
    for what, took in times.items():
        rows.add_row(f"{name}: {what}", f"{len(values)} poses", f"{1e6 * took / len(values):.2f}")
    mujoco(rows, mechanism, asked.repeats)
    pinocchio(rows, mechanism, asked.repeats)
    return off < 1e-7


def mujoco(rows: Table, mechanism: Mechanism, repeats: int) -> None:
    if find_spec("mujoco") is None:
        rows.add_row(f"{mechanism.name}: MuJoCo", "not installed", "-")
        return
    from assur.crosscheck import engine as engines

    engine = engines.engine(mechanism)
    engines.put(engine, mechanism.home_values)
    model, data, inverse = engine.model, engine.data, engine.mujoco.mj_inverse

    def work() -> None:
        for _ in range(STATES):
            inverse(model, data)

    rows.add_row(f"{mechanism.name}: mj_inverse", f"{STATES} states", f"{1e6 * seconds(work, repeats) / STATES:.2f}")


def pinocchio(rows: Table, mechanism: Mechanism, repeats: int) -> None:
    if find_spec("pinocchio") is None:
        rows.add_row(f"{mechanism.name}: Pinocchio", "not installed", "-")
        return
    import pinocchio as engine

    model = engine.buildModelFromXML(urdf(mechanism))
    data, place = model.createData(), engine.neutral(model)
    still = np.zeros(model.nv)

    def work() -> None:
        for _ in range(STATES):
            engine.rnea(model, data, place, still, still)

    rows.add_row(
        f"{mechanism.name}: rnea, open tree", f"{STATES} states", f"{1e6 * seconds(work, repeats) / STATES:.2f}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--poses", type=int, default=100_000)
    parser.add_argument("--repeats", type=int, default=3)
    asked = parser.parse_args()
    rows = Table("inverse dynamics", "of", "µs each", box=None)
    right = [ours(rows, name, mode, asked) for name, mode in MECHANISMS.items()]
    Console().print(rows)
    sys.exit(0 if all(right) else 1)


if __name__ == "__main__":
    main()
