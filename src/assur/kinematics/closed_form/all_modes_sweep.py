"""Sweeps in all modes at once: what several branches share is worked out once."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from assur.kinematics import border
from assur.kinematics.closed_form.blocks import Components, FloatArray, columns_of, each_block
from assur.kinematics.closed_form.filling import Engine, Filler, chosen, run
from assur.kinematics.closed_form.recorded import recording
from assur.kinematics.modes import Problem, sign_axes, sign_names
from assur.kinematics.status import branch_kernel, closed_form_of, exists
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.numerics.number_types import Floats
from assur.numerics.recording.loops import empty_rows
from assur.work import Progress

BoolArray = NDArray[np.bool_]

BLOCK = 8192
"""Poses per block, where every temporary holds several branches."""


def all_modes_sweep(
    record: MechanismRecord,
    problem: Problem,
    components: Components,
    *,
    block: int | None = None,
    progress: Progress | None = None,
    engine: Engine = "auto",
    threads: int = 0,
) -> tuple[FloatArray, BoolArray]:
    """All inverses at N poses, or all directs at N inputs, written out mode by mode.

    Args:
        record: a mechanism with a closed form, of the direct problem one by signs.
        problem: "inverse" or "direct".
        components: m arrays (N,) of poses, or n arrays (N,) of inputs as printed; lengths and rad.
        block: problems that are worked on at a time; the engine's own choice where none is given.
        progress: called after every block with the problems done and N.
        engine: "numpy", "compiled" or "auto", as for `inverse_sweep`.
        threads: how many work on it, as for `inverse_sweep`.

    Returns:
        Printed inputs (K, n, N), or poses (K, m, N), and exists (K, N), K in the order of the problem's modes. Where
        the inputs let the platform move (self-motion) no pose exists: it would be one sample of a curve.

    Example: the inputs of Table 1 of Zeng et al. 2019 have four poses.

        >>> from assur.model.registry import load_record
        >>> inputs = ([162.6907], [-143.3209], [-24.6776])
        >>> poses, exists = all_modes_sweep(load_record("zeng2019"), "direct", inputs)
        >>> poses.shape, int(exists.sum())
        ((8, 3, 1), 4)
    """
    names = record.platform.pose if problem == "inverse" else border.input_names(record)
    what = "poses" if problem == "inverse" else "inputs"
    columns, _ = columns_of(components, names, f"{what} of {record.name}")
    axes, count = _mode_axes(record, problem), len(columns[0])
    branches = _size(axes)
    rows = len(record.inputs) if problem == "inverse" else len(record.platform.pose)
    solve = all_branches(record, problem)
    numbers, truths = empty_rows(branches * rows, count), np.empty((branches, count), dtype=bool)
    found = numbers.reshape(branches, rows, count), truths
    tape = chosen(engine, count, lambda: recording(record, problem, every=True))
    if tape is not None:
        wanted = tape.rows["inputs" if problem == "inverse" else "poses"]
        filler = Filler(tape, tape.uniform(), wanted, tape.truths, numbers, truths)
        run(filler, components, columns, block, progress, threads)
        return found
    answer, real = numbers.reshape(*axes, rows, count), truths.reshape(*axes, count)

    def work(part: slice, given: FloatArray) -> None:
        values, real[..., part] = solve(given)
        for k, value in enumerate(values):
            answer[..., k, part] = value

    each_block(work, columns, count, BLOCK if block is None else block, progress, threads or 1)
    return found


def _mode_axes(record: MechanismRecord, problem: Problem) -> tuple[int, ...]:
    return (2,) * len(sign_names(record, problem))


def _size(shape: Sequence[int]) -> int:
    return int(np.prod(shape, dtype=int))


def all_branches(
    record: MechanismRecord, problem: Problem
) -> Callable[[FloatArray], tuple[list[FloatArray], BoolArray]]:
    """A function from a block (b, k) of problems to its answers and their existence, along the sign axes.

    An axis is 1 long where the sign makes no difference.
    """
    form, p, ns = closed_form_of(record), kernel_dimensions(record), Floats()
    direct = None if problem == "inverse" else branch_kernel(record)
    sign = sign_axes(sign_names(record, problem))
    margins = form.inverse_margins if problem == "inverse" else form.direct_margins

    def solve(given: FloatArray) -> tuple[list[FloatArray], BoolArray]:
        with np.errstate(divide="ignore", invalid="ignore"):
            if direct is None:
                branch = form.inverse(ns, p, border.pose_components(record, given), sign)
                values = border.printed_inputs(record, branch.inputs)
            else:
                branch = direct(ns, p, border.input_components(record, given), sign)
                values = [border.scalar(value) for value in branch.pose]
            return values, exists(record, margins, branch.margins)

    return solve
