"""Loop closure of the joint graph and all postures of a Gough-Stewart platform, beside yardsticks of the same run.

    .venv/bin/python bench/kinematics.py [--poses 10000] [--repeats 5]

Closure: the paper's mechanism with its real parallelograms (17 joints, 4 loops, 10 redundant constraints), one mode,
inputs locked a few millimetres from where each start was closed, by the recorded Newton step. The yardstick is what
every Newton step must do at least, solving one system of 14 unknowns for each pose; that of the recorded step is
itself, without what NumPy does before and after. Grids of mechanisms without a closed form are followed from home.
Processor time is measured, so that a busy machine does little harm. MuJoCo, where it is installed, closes the same
poses by Newton steps with its own Jacobians. The exit code is 1 if a pose is wrong.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

import numpy as np
from rich.console import Console
from rich.table import Table

import assur
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import FloatArray, assemble, closure_error, closure_jacobian
from assur.kinematics.following.from_home import followed_together
from assur.kinematics.following.platform_held import holding
from assur.kinematics.newton import BLOCK, ENOUGH, Newton
from assur.kinematics.newton_step import NewtonStep
from assur.kinematics.pose import pose_error, pose_of
from assur.kinematics.rates.finite_motion import classify_at, status_of
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.search import search
from assur.synthesis.drafting.drafting import drafted
from assur.topology.notation import parse_chains

RNG = np.random.default_rng(0)
MODE = "++-++"
PAR4 = Path(__file__).parents[1] / "tests" / "kinematics" / "following" / "par4.toml"
HYBRID = ["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "R[z] R[z] C[z]"]


def timed(work: Callable[[], object], repeats: int, clock: Callable[[], float] = time.perf_counter) -> float:
    """Median seconds."""
    took = []
    for _ in range(repeats):
        start = clock()
        work()
        took.append(clock() - start)
    return median(took)


def closure(rows: Table, poses: int, repeats: int) -> bool:
    """Batched direct problem on the joint graph from neighbouring starts; whether it agrees with the closed form."""
    mechanism = assur.load("zeng2019")
    box = RNG.uniform([-60, -100, 400], [40, 100, 450], size=(2 * poses, 3))
    found = mechanism.inverse(box, MODE)
    reached = np.flatnonzero(found.exists[:, 0])[:poses]
    start = found.joints[reached, 0]
    inputs = start[:, mechanism.input_indices] + RNG.uniform(-3, 3, size=(len(start), 3))
    start[:, mechanism.input_indices] = inputs
    closed = assemble(mechanism, start, held=mechanism.input_indices, near=True)
    claimed = mechanism.direct(inputs)
    gaps = np.linalg.norm(claimed.poses - pose_of(mechanism, closed.values)[:, None], axis=-1)
    right = bool(np.all(closed.closed) and np.nanmax(np.nanmin(gaps, axis=1)) < 1e-6)
    ours = timed(
        lambda: assemble(mechanism, start, held=mechanism.input_indices, near=True), repeats, time.process_time
    )
    matrix = RNG.normal(size=(len(start), 14, 14))
    least = closed.steps * timed(lambda: np.linalg.solve(matrix, matrix[..., :1]), repeats, time.process_time)
    size = len(start)
    rows.add_row(
        f"closure, {size} poses", f"{1e6 * ours / size:.1f} µs a pose", f"{1e6 * least / size:.1f} µs",
        f"{ours / least:.1f}", f"{closed.steps} steps",
    )  # fmt: skip
    return right & newton(rows, mechanism, start, closed.values, repeats)


def newton(rows: Table, mechanism: assur.Mechanism, start: FloatArray, expected: FloatArray, repeats: int) -> bool:
    """The recorded Newton step from the same starts; whether it ends where least squares do."""
    method = Newton(mechanism, NewtonStep(mechanism.input_indices))
    found = method(start)
    right = bool(np.all(found.residual <= ENOUGH) and np.abs(found.values - expected).max() < 1e-9)
    ours = timed(lambda: method(start), repeats, time.process_time) / len(start)
    block = start[:BLOCK]
    bare = (
        (found.steps + 1)
        * timed(lambda: method.program(mechanism, block), 20 * repeats, time.process_time)
        / len(block)
    )
    took = f"{1e6 * ours:.2f} µs a pose", f"{1e6 * bare:.2f} µs", f"{ours / bare:.1f}"
    count = len(method.program.tape.operations)
    rows.add_row("closure, recorded", *took, f"{found.steps} steps of {count} operations")
    return right


def hybrid() -> assur.Mechanism:
    """The mechanism of the README that has no closed form."""
    with TemporaryDirectory() as folder:
        path = Path(folder, "hybrid.toml")
        path.write_text(drafted(parse_chains(HYBRID), path).text, encoding="utf-8")
        return assur.load(path)


def around_home(mechanism: assur.Mechanism, *axes: tuple[float, float, int]) -> FloatArray:
    """Poses of a grid, each coordinate from one number to another away from home."""
    away = np.meshgrid(*(np.linspace(*axis) for axis in axes), indexing="ij")
    return np.asarray(pose_of(mechanism, mechanism.home_values) + np.stack(away, axis=-1).reshape(-1, len(axes)))


def followed(rows: Table, name: str, mechanism: assur.Mechanism, poses: FloatArray, repeats: int) -> bool:
    """A grid without a closed form, home's mode followed; whether all loops are closed where the platform is to be.

    The yardstick is what following needs at least: the operations of one Newton step a pose, as bare products of arrays
    in the cache.
    """
    warm = timed(lambda: followed_together(mechanism, poses[:1]), 1, time.process_time)
    joints, reached = followed_together(mechanism, poses)
    length = characteristic_length(mechanism)
    away = np.max(np.abs(pose_error(mechanism, joints, poses, length)))
    right = bool(np.all(reached) and max(np.max(closure_error(mechanism, joints)), away) <= 1.01 * ENOUGH * length)
    ours = timed(lambda: followed_together(mechanism, poses), repeats, time.process_time) / len(poses)
    count = len(holding(mechanism, "poses").program.tape.operations)
    numbers = RNG.normal(size=(3, BLOCK))
    least = count * timed(lambda: np.multiply(*numbers[:2], out=numbers[2]), 10_000, time.process_time) / BLOCK
    took = f"{1e6 * ours:.2f} µs a pose", f"{1e6 * least:.2f} µs", f"{ours / least:.1f}"
    what = f"{len(mechanism.coordinates)} joint values, {count} operations a step, ready in {warm:.2f} s"
    rows.add_row(f"{name}, {len(poses)} poses", *took, what)
    return right


def statuses(rows: Table, mechanism: assur.Mechanism, poses: FloatArray, repeats: int) -> bool:
    """Statuses of a grid; whether they are those by singular values, of which the yardstick is one decomposition."""
    joints, _ = followed_together(mechanism, poses)
    ours = timed(lambda: classify_at(mechanism, joints), repeats, time.process_time) / len(joints)
    right = np.array_equal(
        classify_at(mechanism, joints), status_of(mechanism, joints, instantaneous(mechanism, joints))
    )
    closure = closure_jacobian(mechanism, joints[:BLOCK])
    least = timed(lambda: np.linalg.svd(closure), 20 * repeats, time.process_time) / len(closure)
    took = f"{1e6 * ours:.1f} µs a pose", f"{1e6 * least:.1f} µs", f"{ours / least:.1f}"
    rows.add_row("its statuses", *took, "one singular value decomposition of the closure")
    return right


def met(rows: Table, repeats: int) -> bool:
    """A search of all assemblies; whether it settles. A start is closed at least once, by as many steps as near by."""
    mechanism = assur.load("delta_4s")
    found = search(mechanism, "direct", np.zeros(3))
    ours = timed(lambda: search(mechanism, "direct", np.zeros(3)), repeats, time.process_time)
    count = len(mechanism.coordinates)
    matrix = RNG.normal(size=(found.starts, count, count))
    least = 5 * timed(lambda: np.linalg.solve(matrix, matrix[..., :1]), repeats, time.process_time)
    took = f"{ours:.2f} s", f"{1e3 * least:.0f} ms", f"{ours / least:.0f}"
    rows.add_row("search, Delta robot", *took, f"{len(found.joints)} assemblies from {found.starts} starts")
    return found.settled


def mujoco(rows: Table, repeats: int) -> None:
    """The same closure by Newton steps on MuJoCo's model, one pose after another, where MuJoCo is installed."""
    if find_spec("mujoco") is None:
        rows.add_row("closure by MuJoCo", "not installed", "", "", "pip install '.[sim]'")
        return
    from assur.crosscheck.engine import engine, put, settle

    mechanism = assur.load("zeng2019")
    poses = RNG.uniform([-60, -100, 400], [40, 100, 450], size=(60, 3))
    found = mechanism.inverse(poses, MODE)
    model = engine(mechanism)
    starts = found.joints[found.exists[:, 0], 0]
    push = RNG.normal(size=model.model.nv)
    push *= 3e-3 / np.linalg.norm(push)

    def all_of_them() -> bool:
        ends = []
        for joints in starts:
            put(model, joints)
            ends.append(settle(model, push))
        return all(ends)

    settled = all_of_them()
    took = timed(all_of_them, repeats) / len(starts)
    rows.add_row(
        f"closure by MuJoCo {model.version}", f"{1e6 * took:.0f} µs a pose", "", "", "all" if settled else "some"
    )


def postures(rows: Table, repeats: int) -> bool:
    """Every posture of Dietmaier's platform at its home; whether these are all, of forty complex ones."""
    mechanism = assur.load("gough_stewart")
    legs = [item.sign * mechanism.home_values[item.coordinate.index] + item.offset for item in mechanism.inputs]
    found = mechanism.direct(legs)
    ours = timed(lambda: mechanism.direct(legs).exists, repeats)
    matrix = RNG.normal(size=(40, 8, 8)) + 1j
    least = timed(lambda: np.linalg.solve(matrix, matrix[..., :1]), 100)
    rows.add_row(
        "Gough-Stewart, all postures", f"{ours:.2f} s", f"{1e6 * least:.0f} µs a step of 40", f"{ours / least:.0f}",
        f"{len(found)} real, {found.right}",
    )  # fmt: skip
    return bool(found.complete)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--poses", type=int, default=10_000)
    parser.add_argument("--repeats", type=int, default=5)
    asked = parser.parse_args()
    rows = Table("what", "ours", "yardstick", "ratio", "found", box=None)
    right = closure(rows, asked.poses, asked.repeats)
    draft, par4, side = hybrid(), assur.load(PAR4), (-80.0, 80.0, 10)
    fine = around_home(draft, (0.0, 60.0, 250), (-60.0, 60.0, 400), (0.0, 0.0, 1))
    right &= followed(rows, "grid of a draft", draft, fine, asked.repeats)
    right &= followed(rows, "grid of a Par4", par4, around_home(par4, side, side, side, (-0.6, 0.6, 10)), 1)
    right &= statuses(rows, draft, fine[::12], asked.repeats)
    right &= met(rows, asked.repeats)
    mujoco(rows, asked.repeats)
    right &= postures(rows, asked.repeats)
    Console(width=140).print(rows)
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
