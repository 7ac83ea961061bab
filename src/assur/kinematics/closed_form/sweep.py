"""Sweeps: the closed forms over millions of poses, block by block, so that only the answer needs memory.

Here the inverse problem in one mode; `all_modes_sweep.py` has both problems in all of them, with the same engines.

A kernel's temporaries are as long as a block and stay in the cache; components come as separate arrays and
the answers have the components first, (rows, N). Where `exists` is False the other numbers are those of the
nearest branch (roots of negative radicands count as 0) and mean nothing.

There are two engines. "numpy" works in arrays, "compiled" in one fused loop that is made from the same kernel
(`recorded`) and kept on disk; "auto" takes the second where it is loaded already, or where there is so much to do that
loading it is repaid. The bits of an answer depend neither on the engine, nor on the block, nor on the number of
threads; only a zero may have another sign, which compares equal.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError
from assur.kinematics import border
from assur.kinematics.closed_form.blocks import Components, FloatArray, columns_of, each_block
from assur.kinematics.closed_form.filling import Engine, Filler, chosen, empty, run
from assur.kinematics.closed_form.mode_reading import mode_reading
from assur.kinematics.closed_form.recorded import recording
from assur.kinematics.modes import mode_signs
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.numerics.singular_values import float_condition_index
from assur.numerics.small_matrices import determinant
from assur.work import Progress

Want = Literal["inputs", "exists", "det_jp", "det_jq", "factors", "condition_index", "smallest"]

ALL_WANTED: tuple[Want, ...] = ("inputs", "exists", "det_jp", "det_jq", "factors", "condition_index", "smallest")
WANT: tuple[Want, ...] = ALL_WANTED[:5]
"""What is worked out where nothing is said."""

BLOCK = 16384
"""Poses per block: measured, long enough to hide the calls and short enough for a cache of 1 MB."""


def inverse_sweep(
    record: MechanismRecord,
    components: Components,
    mode: str = "",
    want: Sequence[Want] = WANT,
    *,
    block: int | None = None,
    progress: Progress | None = None,
    engine: Engine = "auto",
    threads: int = 0,
) -> dict[str, NDArray[Any]]:
    """Inverse problem in one working mode at N poses, with the determinants and their factors.

    Args:
        record: the mechanism; it must have a closed form.
        components: m arrays (N,), the pose coordinates in the file's order (lengths, angles in rad).
        mode: the working mode, such as "++-++"; the file's default where none is given.
        want: what to work out, of "inputs", "exists", "det_jp", "det_jq", "factors", "condition_index", "smallest".
        block: poses that are worked on at a time; the engine's own choice where none is given.
        progress: called after every block with the poses done and N.
        engine: "numpy", "compiled" (needs numba), or "auto": compiled where that is repaid.
        threads: how many work on it; where 0, one for NumPy, and as many as there are cores for compiled loops.

    Returns:
        What was wanted by name: inputs (n, N) as printed, exists (N,) bool, det_jp (N,) and det_jq (N,) of the
        regular Jacobians, factors (f, N) in the order of the closed form's list, condition_index (N,), which is
        1/cond2 of Jp^-1 Jq, 0 where either is singular, and smallest (N,), its smallest singular value.

    Errors:
        UsageError: an unknown mode, quantity or engine, components of unequal length or not finite, a block below 1,
            threads below 0.

    Example: Table 2, row 4, of Zeng et al. 2019.

        >>> from assur.model.registry import load_record
        >>> found = inverse_sweep(load_record("zeng2019"), ([-15.4714], [9.6849], [456.3315]), "++-++")
        >>> found["inputs"][:, 0].round(3), found["exists"]
        (array([ 162.691, -143.321,  -24.678]), array([ True]))
    """
    for name in want:
        if name not in ALL_WANTED:
            raise UnknownNameError("quantity of a sweep", name, ALL_WANTED)
    form = closed_form_of(record)
    signs = mode_signs(record, "inverse", mode or record.modes.default_working)
    columns, count = columns_of(components, record.platform.pose, f"poses of {record.name}")
    sizes = {"inputs": len(record.inputs), "factors": len(form.factor_list)}
    answer, numbers, truths = empty(want, sizes, count)
    tape = chosen(engine, count, lambda: recording(record, "inverse", tuple(dict.fromkeys(want))))
    if tape is not None:
        rows = tuple(row for name in answer if name != "exists" for row in tape.rows[name])
        run(
            Filler(tape, tape.uniform(signs), rows, tape.truths, numbers, truths),
            components,
            columns,
            block,
            progress,
            threads,
        )
        return answer

    def work(part: slice, given: FloatArray) -> None:
        _in_one_mode(record, given, mode, {name: array[..., part] for name, array in answer.items()})

    each_block(work, columns, count, BLOCK if block is None else block, progress, threads or 1)
    return answer


def _in_one_mode(record: MechanismRecord, given: FloatArray, mode: str, answer: Mapping[str, NDArray[Any]]) -> None:
    """What is wanted in one mode at poses (b, m), by NumPy, into arrays (rows, b) or (b,)."""
    turn = float(np.prod([item.sign for item in record.inputs]))  # of det Jq, from joint values to printed inputs
    read = mode_reading(record, mode, border.pose_components(record, given))
    with np.errstate(divide="ignore", invalid="ignore"):
        if "inputs" in answer:
            _store(answer["inputs"], border.printed_inputs(record, read.branch.inputs))
        if "exists" in answer:
            answer["exists"][...] = read.exists
        if answer.keys() & {"det_jp", "det_jq", "condition_index", "smallest"}:
            jp, jq = read.jacobians
            if "det_jp" in answer:
                answer["det_jp"][...] = determinant(jp)
            if "det_jq" in answer:
                np.multiply(determinant(jq), turn, out=answer["det_jq"])
            if answer.keys() & {"condition_index", "smallest"}:
                for name, value in zip(("condition_index", "smallest"), float_condition_index(jp, jq), strict=True):
                    if name in answer:
                        answer[name][...] = value
        if "factors" in answer:
            _store(answer["factors"], [read.factors[item.name] for item in closed_form_of(record).factor_list])


def _store(rows: NDArray[Any], values: Sequence[Any]) -> None:
    for row, value in zip(rows, values, strict=True):
        row[...] = value
