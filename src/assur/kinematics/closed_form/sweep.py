"""Sweeps: the closed forms over millions of poses, block by block, so that only the answer needs memory.

A kernel's temporaries are as long as a block and stay in the cache; components come as separate arrays and
the answers have the components first, (rows, N). Where `exists` is False the other numbers are those of the
nearest branch (roots of negative radicands count as 0) and mean nothing. The bits of an answer do not
depend on the block.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from types import SimpleNamespace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics import border
from assur.kinematics.closed_form.existence import exists
from assur.kinematics.modes import Problem, mode_signs, sign_axes, sign_names
from assur.kinematics.status import branch_kernel, closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.numerics.number_types import Floats
from assur.numerics.small_matrices import determinant

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
Components = Sequence[ArrayLike] | NDArray[np.float64]
"""One array (N,) per component, as a sequence or as the rows of one array."""

Progress = Callable[[int, int], None]
Want = Literal["inputs", "exists", "det_jp", "det_jq", "factors"]

WANT: tuple[Want, ...] = ("inputs", "exists", "det_jp", "det_jq", "factors")
BLOCK = 16384
"""Poses per block in one mode: measured, long enough to hide the calls and short enough for a cache of 1 MB."""

BLOCK_ALL = 8192
"""Poses per block where every temporary holds several branches."""


def inverse_sweep(
    record: MechanismRecord,
    components: Components,
    mode: str = "",
    want: Sequence[Want] = WANT,
    *,
    block: int = BLOCK,
    progress: Progress | None = None,
) -> dict[str, NDArray[Any]]:
    """Inverse problem in one working mode at N poses, with the determinants and their factors.

    Args:
        record: the mechanism; it must have a closed form.
        components: m arrays (N,), the pose coordinates in the file's order (lengths, angles in rad).
        mode: the working mode, such as "++-++"; the file's default where none is given.
        want: what to work out, of "inputs", "exists", "det_jp", "det_jq", "factors".
        block: poses that are worked on at a time.
        progress: called after every block with the poses done and N.

    Returns:
        What was wanted by name: inputs (n, N) as printed, exists (N,) bool, det_jp (N,) and det_jq (N,) of the
        regular Jacobians, factors (f, N) in the order of the closed form's list.

    Errors:
        UsageError: an unknown mode or quantity, components of unequal length or not finite, a block below 1.

    Example: Table 2, row 4, of Zeng et al. 2019.

        >>> from assur.model.registry import load_record
        >>> found = inverse_sweep(load_record("zeng2019"), ([-15.4714], [9.6849], [456.3315]), "++-++")
        >>> found["inputs"][:, 0].round(3), found["exists"]
        (array([ 162.691, -143.321,  -24.678]), array([ True]))
    """
    for name in want:
        if name not in WANT:
            raise UnknownNameError("quantity of a sweep", name, WANT)
    form, p, ns = closed_form_of(record), record.values, Floats()
    signs = mode_signs(record, "inverse", mode or record.modes.default_working)
    sign = SimpleNamespace(**dict(zip(sign_names(record, "inverse"), map(float, signs), strict=True)))
    columns, count = _columns(components, record.platform.pose, f"poses of {record.name}")
    names = [item.name for item in form.factor_list]
    answer = _empty(want, {"inputs": len(record.inputs), "factors": len(names)}, count)
    turn = float(np.prod([item.sign for item in record.inputs]))  # of det Jq, from joint values to printed inputs
    with np.errstate(divide="ignore", invalid="ignore"):
        for part, given in _blocks(columns, count, block, progress):
            branch = form.inverse(ns, p, border.pose_components(record, given), sign)
            if "inputs" in answer:
                _store(answer["inputs"], border.printed_inputs(record, branch.inputs), part)
            if "exists" in answer:
                answer["exists"][part] = exists(record, form.inverse_margins, branch.margins)
            if "det_jp" in answer or "det_jq" in answer:
                jp, jq = form.jacobians(ns, p, branch.core)
                if "det_jp" in answer:
                    answer["det_jp"][part] = determinant(jp)
                if "det_jq" in answer:
                    np.multiply(determinant(jq), turn, out=answer["det_jq"][part])
            if "factors" in answer:
                found = form.factors(ns, p, branch.core)
                _store(answer["factors"], [found[name] for name in names], part)
    return answer


def inverse_all_sweep(
    record: MechanismRecord,
    components: Components,
    *,
    block: int = BLOCK_ALL,
    progress: Progress | None = None,
) -> tuple[tuple[FloatArray, ...], BoolArray]:
    """All inverses at N poses, as the few distinct numbers that they are combinations of.

    Returns:
        One array per input, and `exists`, with an axis per working sign (plus, then minus) before the axis N;
        an axis is 1 long where the sign makes no difference. Broadcasting gives every combination.

    Example: the 32 inverses of a pose of Zeng et al. 2019 are combinations of 4 + 4 + 4 numbers.

        >>> from assur.model.registry import load_record
        >>> inputs, exists = inverse_all_sweep(load_record("zeng2019"), ([-15.4714], [9.6849], [456.3315]))
        >>> [array.shape for array in inputs], exists.shape
        ([(2, 1, 2, 1, 1, 1), (2, 1, 1, 2, 1, 1), (1, 2, 1, 1, 2, 1)], (2, 2, 1, 1, 1, 1))
    """
    columns, count = _columns(components, record.platform.pose, f"poses of {record.name}")
    solve = _all_branches(record, "inverse")
    values, exists = solve(np.empty((0, len(columns))))  # of no poses: shapes only
    answer = tuple(np.empty((*np.shape(value)[:-1], count)) for value in values)
    real = np.empty((*exists.shape[:-1], count), dtype=bool)
    for part, given in _blocks(columns, count, block, progress):
        values, real[..., part] = solve(given)
        for row, value in zip(answer, values, strict=True):
            row[..., part] = value
    return answer, real


def inverse_all_expanded_sweep(
    record: MechanismRecord,
    components: Components,
    *,
    block: int = BLOCK_ALL,
    progress: Progress | None = None,
) -> tuple[FloatArray, BoolArray]:
    """All inverses at N poses: printed inputs (K, n, N) and exists (K, N), K in the order of the working modes."""
    columns, count = _columns(components, record.platform.pose, f"poses of {record.name}")
    return _expanded(record, "inverse", columns, count, block, progress)


def direct_all_sweep(
    record: MechanismRecord,
    components: Components,
    *,
    block: int = BLOCK_ALL,
    progress: Progress | None = None,
) -> tuple[FloatArray, BoolArray]:
    """All directs at N inputs (n arrays (N,), as printed): poses (K, m, N) and exists (K, N), K by assembly mode.

    Where the inputs let the platform move (self-motion) no pose exists: it would be one sample of a curve.

    Example: the inputs of Table 1 of Zeng et al. 2019 have four poses.

        >>> from assur.model.registry import load_record
        >>> poses, exists = direct_all_sweep(load_record("zeng2019"), ([162.6907], [-143.3209], [-24.6776]))
        >>> poses.shape, int(exists.sum())
        ((8, 3, 1), 4)
    """
    columns, count = _columns(components, border.input_names(record), f"inputs of {record.name}")
    return _expanded(record, "direct", columns, count, block, progress)


def _expanded(
    record: MechanismRecord,
    problem: Problem,
    columns: tuple[FloatArray, ...],
    count: int,
    block: int,
    progress: Progress | None,
) -> tuple[FloatArray, BoolArray]:
    solve = _all_branches(record, problem)
    axes = (2,) * len(sign_names(record, problem))
    rows = len(record.inputs) if problem == "inverse" else len(record.platform.pose)
    answer = np.empty((*axes, rows, count))
    real = np.empty((*axes, count), dtype=bool)
    for part, given in _blocks(columns, count, block, progress):
        values, real[..., part] = solve(given)
        for k, value in enumerate(values):
            answer[..., k, part] = value
    branches = 2 ** len(axes)
    return answer.reshape(branches, rows, count), real.reshape(branches, count)


def _all_branches(
    record: MechanismRecord, problem: Problem
) -> Callable[[FloatArray], tuple[list[FloatArray], BoolArray]]:
    """A function from a block (b, k) of problems to its answers and their existence, along the sign axes."""
    form, p, ns = closed_form_of(record), record.values, Floats()
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


def _columns(components: Components, names: Sequence[str], what: str) -> tuple[tuple[FloatArray, ...], int]:
    """Components as arrays (N,) of floats, one per name, and N."""
    if len(components) != len(names):
        raise UsageError(f"{what}: {len(components)} components, {len(names)} wanted", hint=f"give {', '.join(names)}")
    columns = tuple(np.asarray(values, dtype=float) for values in components)
    shapes = {column.shape for column in columns}
    if len(shapes) != 1 or columns[0].ndim != 1:
        found = ", ".join(str(column.shape) for column in columns)
        raise UsageError(f"{what}: components of shapes {found}", hint="give arrays (N,) of one length")
    return columns, len(columns[0])


def _empty(want: Sequence[str], rows: Mapping[str, int], count: int) -> dict[str, NDArray[Any]]:
    return {
        name: np.empty((rows[name], count) if name in rows else count, bool if name == "exists" else float)
        for name in want
    }


def _blocks(
    columns: tuple[FloatArray, ...], count: int, block: int, progress: Progress | None
) -> Iterator[tuple[slice, FloatArray]]:
    """Each block's place and its problems (b, k), contiguous along each component."""
    if block < 1:
        raise UsageError(f"a block of {block} poses; it needs at least 1")
    for start in range(0, count, block):
        part = slice(start, min(start + block, count))
        given = np.stack([column[part] for column in columns])
        if not np.all(np.isfinite(given)):
            raise UsageError("every component must be finite, not NaN or infinite")
        yield part, given.T
        if progress is not None:
            progress(part.stop, count)


def _store(rows: NDArray[Any], values: Sequence[Any], part: slice) -> None:
    for row, value in zip(rows, values, strict=True):
        row[part] = value
