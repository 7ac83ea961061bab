"""Stored sweeps: the solutions of all problems of a grid as files hold them, NaN where there is none, with a status.

Here both problems are swept, in one mode or in all of them. What is worked out, block by block, is what `sweep.py`
works out; a status is that of the answer to the single problem.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics import border
from assur.kinematics.closed_form.about import about, told
from assur.kinematics.closed_form.all_modes_sweep import all_modes_sweep
from assur.kinematics.closed_form.blocks import FloatArray, Progress
from assur.kinematics.closed_form.branches import Branches
from assur.kinematics.closed_form.filling import engine_for
from assur.kinematics.closed_form.formulas import formulas
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.closed_form.streamed import BLOCK, KINDS, fill
from assur.kinematics.closed_form.sweep import Want, inverse_sweep
from assur.kinematics.modes import Problem, all_modes, mode_signs
from assur.kinematics.position import direct, inverse
from assur.kinematics.status import Status, branch_kernel, classify, closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.results.disk import DISK, Disk
from assur.results.store.layout import Array, Plan, Shard, block_length
from assur.results.store.note import Counts
from assur.results.store.store import Solved, Store

Found = Mapping[str, NDArray[Any]]

ALL = "all"
"""Stands for every mode."""

ONE_MODE = ("inputs", "exists", "status", "det_jp", "det_jq", "factors", "condition_index", "smallest")
"""What can be kept of the inverse problem in one mode."""


def quantities(problem: Problem, mode: str) -> tuple[str, ...]:
    """What can be kept: of the inverse problem in one mode also what its Jacobians say.

    >>> quantities("direct", "+++")
    ('poses', 'exists', 'status')
    """
    if problem == "direct":
        return ("poses", "exists", "status")
    return ONE_MODE[:3] if mode == ALL else ONE_MODE


@dataclass(frozen=True, eq=False)
class StoredSweep:
    """A sweep into files; made by `stored_sweep`, which checks it.

    Attributes:
        record, problem: what is solved.
        grid: poses, or inputs as printed; angles in rad.
        mode: one mode, or "all".
        keep: quantities that are written.
    """

    record: MechanismRecord
    problem: Problem
    grid: Grid
    mode: str
    keep: tuple[str, ...]

    @property
    def every(self) -> bool:
        """Whether all modes are swept, which then have an axis of their own, K."""
        return self.mode == ALL

    @property
    def modes(self) -> tuple[str, ...]:
        """The modes, in the order of the axis K."""
        return all_modes(self.record, self.problem) if self.every else (self.mode,)

    @cached_property
    def arrays(self) -> tuple[Array, ...]:
        """What is kept: (K,) in all modes, then its rows, then the places along each coordinate that is not held."""
        rows = {
            "inputs": len(self.record.inputs),
            "poses": len(self.record.platform.pose),
            "factors": len(closed_form_of(self.record).factor_list),
        }
        first = (len(self.modes),) if self.every else ()
        places = tuple(count for count in self.grid.counts if count > 1)
        return tuple(
            Array(name, KINDS.get(name, "float64"), first + ((rows[name],) if name in rows else ()), places)
            for name in self.keep
        )

    @property
    def compiled(self) -> bool:
        """Whether compiled loops work on it, rather than NumPy; the bits are the same."""
        return engine_for(self.grid.size) == "compiled"

    def plan(self, shard: Shard | None = None) -> Plan:
        """What is to be in a store, of the whole grid or of a shard."""
        names, low, high = self.grid.names, self.grid.low, self.grid.high
        question = {
            "kind": "stored sweep",
            "mechanism": self.record.name,
            **formulas(self.record, self.problem),
            "dimensions": {name: float(value) for name, value in vars(self.record.values).items()},
            "problem": self.problem,
            "mode": self.mode,
            "limits": {name: [a, b] for name, a, b in zip(names, low, high, strict=True)},
            "counts": list(self.grid.counts),
            "keep": list(self.keep),
        }
        longest = BLOCK // (len(all_modes(self.record, self.problem)) if self.every else 1)
        return Plan(question, self.arrays, block_length(self.grid.size, longest), shard, about(self))

    def store(self, folder: Path, shard: Shard | None = None, disk: Disk = DISK) -> Store:
        """The store of a folder, not open yet, with a note for people (`sweep.json`)."""
        return Store(folder, self.plan(shard), told, disk)

    def fill(self, store: Store, *, progress: Progress | None = None, threads: int = 0) -> None:
        """Work out what a store lacks, in this process, which may be interrupted."""
        fill(store, self.block, self.grid, progress=progress, threads=threads)

    def block(self, given: FloatArray) -> Solved:
        """What is kept of the problems (m, b) of a block, and what is counted in it."""
        found = self.solve(given)
        return Solved({name: found[name] for name in self.keep}, _counted(found))

    def solve(self, given: FloatArray) -> Found:
        """What is kept of problems (m, b), and whether each exists: exists and status (K, b) or (b,), and so on."""
        found = self._found(given)
        if "status" in self.keep:
            found["status"] = self._status(given, found)
        for values in found.values():
            if values.dtype == float:
                values += 0.0  # a zero has no sign, whichever engine it is of
                values[~np.broadcast_to(_over(found["exists"], values), values.shape)] = np.nan
        self._to_file_angles(found)
        return found

    @property
    def _wanted(self) -> tuple[Want, ...]:
        """What the inverse sweep in one mode works out: factors for a status."""
        names = [name for name in self.keep if name != "status"] + ["exists"]
        return cast("tuple[Want, ...]", (*names, *(["factors"] if "status" in self.keep else [])))

    def _found(self, given: FloatArray) -> dict[str, NDArray[Any]]:
        record, engine = self.record, engine_for(self.grid.size)
        if self.problem == "inverse" and not self.every:
            wanted = tuple(dict.fromkeys(self._wanted))
            return inverse_sweep(record, given, self.mode, wanted, engine=engine, threads=1)
        values, exists = all_modes_sweep(record, self.problem, given, engine=engine, threads=1)
        name = "poses" if self.problem == "direct" else "inputs"
        if self.every:
            return {name: values, "exists": exists}
        place = all_modes(record, self.problem).index(self.mode)
        return {name: values[place], "exists": exists[place]}

    def _status(self, given: FloatArray, found: Found) -> NDArray[np.int8]:
        exists = found["exists"]
        if "factors" not in found:
            return self._answered(given).reshape(exists.shape)
        form = closed_form_of(self.record)
        status = classify(
            self.record, {item.name: row for item, row in zip(form.factor_list, found["factors"], strict=True)}
        )
        status[~exists] = Status.unreachable
        if any(margin.zero == "degenerate" for margin in form.inverse_margins) and not np.all(exists):
            status[~exists] = self._answered(given[:, ~exists])[0]
        return status

    def _answered(self, given: FloatArray) -> NDArray[np.int8]:
        """Status (K, b) of the answers to single problems, all at once."""
        solve = direct if self.problem == "direct" else inverse
        answer = solve(self.record, given.T, None if self.every else self.mode)
        if not isinstance(answer, Branches):
            raise AssertionError("a sweep has a closed form by signs")
        status = np.array(answer.formula_status)
        status[(answer.formula_overall_status == Status.unreachable)] = Status.unreachable
        return status.T

    def _to_file_angles(self, found: Found) -> None:
        if self.record.angle != "deg":
            return
        angles = {
            "inputs": [item.coordinate.kind == "angle" for item in self.record.inputs],
            "poses": [is_angle(name) for name in self.record.platform.pose],
        }
        for name in found.keys() & angles.keys():
            for k, angle in enumerate(angles[name]):
                if angle:
                    np.degrees(found[name][..., k, :], out=found[name][..., k, :])


def stored_sweep(
    record: MechanismRecord, problem: Problem, grid: Grid, mode: str = "", keep: Sequence[str] = ()
) -> StoredSweep:
    """A sweep into files, checked.

    Args:
        record: a mechanism with a closed form, of the direct problem one by signs.
        problem: "inverse", the grid is one of poses, or "direct", of inputs as printed.
        grid: the problems; every coordinate of a pose, or every input, in the file's order; angles in rad.
        mode: a mode, or "all"; where empty the file's default working mode, for the direct problem all.
        keep: of `quantities`; where empty the solutions with their status, for the direct problem with `exists`.

    Errors:
        UsageError: no closed form, or none by signs.
        UnknownNameError: an unknown mode or quantity.

    Example: the inverse problem along a line, kept for good.

        >>> import tempfile
        >>> from assur.model.registry import load_record
        >>> grid = Grid(("x", "y", "z"), (-15.0, 9.0, 300.0), (-15.0, 9.0, 600.0), (1, 1, 4))
        >>> sweep = stored_sweep(load_record("zeng2019"), "inverse", grid)
        >>> with tempfile.TemporaryDirectory() as folder, sweep.store(Path(folder)) as store:
        ...     faults = store.open()
        ...     sweep.fill(store)
        ...     found = store.finish()
        ...     found["inputs"].shape, found["status"].tolist(), store.counts["status"]
        ((3, 4), [0, 0, 8, 8], {'regular': 2, 'unreachable': 2})
    """
    closed_form_of(record)
    if problem == "direct":
        try:
            branch_kernel(record)
        except UsageError as error:
            hint = "`assur direct` solves one problem at a time, Mechanism.direct takes arrays"
            raise UsageError(error.message, hint=hint) from error
    names = record.platform.pose if problem == "inverse" else border.input_names(record)
    if grid.names != names:
        raise UsageError(f"a grid of {', '.join(grid.names)}", hint=f"{record.name} is swept over {', '.join(names)}")
    mode = mode or (record.modes.default_working if problem == "inverse" else ALL)
    if mode != ALL:
        mode_signs(record, problem, mode)
    allowed = quantities(problem, mode)
    for name in keep:
        if name not in allowed:
            also = "only the inverse problem in one mode has this" if name in ONE_MODE[3:] else ""
            raise UnknownNameError(f"quantity of the {problem} problem", name, allowed, hint=also)
    usual = ("inputs", "status") if problem == "inverse" else ("poses", "exists")
    return StoredSweep(record, problem, grid, mode, tuple(dict.fromkeys(keep)) or usual)


def _over(exists: NDArray[np.bool_], values: NDArray[Any]) -> NDArray[np.bool_]:
    """Existence (b,) or (K, b) with an axis for the rows of values (rows, b) or (K, rows, b)."""
    return exists[..., None, :] if values.ndim > exists.ndim else exists


def _counted(found: Found) -> Counts:
    """Problems by the number of modes that solve them, and branches by status."""
    modes = np.bincount(np.atleast_2d(found["exists"]).sum(axis=0))
    counts = {"modes": {str(k): int(n) for k, n in enumerate(modes) if n}}
    if "status" in found:
        counts["status"] = {Status(k).name: int(n) for k, n in enumerate(np.bincount(found["status"].ravel())) if n}
    return counts
