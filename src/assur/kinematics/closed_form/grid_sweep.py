"""Sweeps of grids into files: the arrays that are kept, their store, and a block, whatever it is that solves it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.answers.at_border import inputs_at_border, pose_at_border, power
from assur.kinematics.closed_form.about import coordinates, drive_kinds, told
from assur.kinematics.closed_form.blocks import FloatArray, in_order
from assur.kinematics.closed_form.filling import threads_of
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.closed_form.swept_dimensions import mechanism_of, reasons, refusal, runs
from assur.kinematics.modes import Problem, all_modes
from assur.kinematics.status import Status, closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.results.disk import DISK, Disk
from assur.results.store.layout import Array, Plan, Shard
from assur.results.store.note import Counts
from assur.results.store.store import SolvedBlock, Store
from assur.work import Progress

SolutionRows = Mapping[str, NDArray[Any]]

_KINDS = {"exists": "bool", "status": "int8"}
"""Numbers of an answer that are no floats, as NumPy names them."""

_ROWS = {"inputs": "input", "poses": "coordinate", "factors": "factor"}

_ABSENT = {"float64": np.nan, "bool": np.False_, "int8": np.int8(Status.no_mechanism)}
"""What stands where dimensions are of no mechanism."""

ALL = "all"
"""Stands for every mode."""


@dataclass(frozen=True, eq=False)
class GridSweep(ABC):
    """A sweep of a grid into files; made by `stored_sweep`, which checks it.

    Attributes:
        record, problem: what is solved.
        grid: dimensions if there are any, in the units of the file; then poses, or inputs as printed, angles in rad.
        mode: one mode, or "all".
        keep: quantities that are written.
    """

    record: MechanismRecord
    problem: Problem
    grid: Grid
    mode: str
    keep: tuple[str, ...]

    @property
    def dimensions(self) -> tuple[str, ...]:
        """The dimensions that vary, before the coordinates of the problem."""
        return self.grid.names[: -len(coordinates(self.record, self.problem))]

    @property
    def fixed_dimensions(self) -> dict[str, float]:
        """The other dimensions, angles in rad; those that a formula makes of swept ones as the file has them."""
        return {name: float(value) for name, value in vars(self.record.values).items() if name not in self.dimensions}

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
            "inputs": len(self.record.drives),
            "poses": len(self.record.platform.pose),
            "factors": len(self.record.closed_form.factor_list) if self.record.closed_form else 0,
        }
        first = (len(self.modes),) if self.every else ()
        places = tuple(count for count in self.grid.counts if count > 1)
        return tuple(
            Array(name, _KINDS.get(name, "float64"), first + ((rows[name],) if name in rows else ()), places)
            for name in self.keep
        )

    @property
    @abstractmethod
    def formulas(self) -> dict[str, str]:
        """What the numbers depend on beside dimensions, mode and grid."""

    @property
    @abstractmethod
    def how(self) -> str:
        """How the answers are known."""

    @property
    @abstractmethod
    def existence(self) -> str:
        """What it means that a solution exists."""

    @property
    @abstractmethod
    def engine(self) -> str:
        """What works on it, in words."""

    @property
    @abstractmethod
    def block_length(self) -> int:
        """Places in a block, by the whole grid alone."""

    @abstractmethod
    def answers(self, given: FloatArray) -> dict[str, NDArray[Any]]:
        """What is kept of problems (m, b) of the mechanism, angles in rad, and whether each exists (K, b) or (b,)."""

    def plan(self, shard: Shard | None = None) -> Plan:
        """What is to be in a store, of the whole grid or of a shard."""
        question = {
            "kind": "stored sweep",
            "mechanism": self.record.name,
            **self.formulas,
            "dimensions": self.fixed_dimensions,
            "swept dimensions": list(self.dimensions),
            "problem": self.problem,
            "mode": self.mode,
            "limits": list(zip(self.grid.names, self.grid.low, self.grid.high, strict=True)),
            "counts": list(self.grid.counts),
            "keep": list(self.keep),
        }
        return Plan(question, self.arrays, self.block_length, shard, _about(self))

    def store(self, folder: Path, shard: Shard | None = None, disk: Disk = DISK) -> Store:
        """The store of a folder, not open yet, with a note for people (`sweep.json`)."""
        return Store(folder, self.plan(shard), told, disk)

    def fill(self, store: Store, *, progress: Progress | None = None, threads: int = 0) -> None:
        """Work out what a store lacks, in this process, which may be interrupted."""

        def solved(number: int) -> tuple[int, SolvedBlock]:
            return number, self.block(self.grid.poses(store.plan.part(number)))

        store.fill(in_order(solved, store.missing, threads_of(threads)), progress)

    def block(self, given: FloatArray) -> SolvedBlock:
        """What is kept of the problems (m, b) of a block, and what is counted in it."""
        found, refused = self._of_mechanisms(given)
        rows = self._in_file_units(found)
        return SolvedBlock({name: rows[name] for name in self.keep}, _counted(rows, refused))

    def solve(self, given: FloatArray) -> SolutionRows:
        """What is kept of problems (d + m, b), and whether each exists: exists and status (K, b) or (b,), and so on."""
        return self._in_file_units(self._of_mechanisms(given)[0])

    def _in_file_units(self, answered: dict[str, NDArray[Any]]) -> SolutionRows:
        """The answers, NaN where there is none."""
        for values in answered.values():
            if values.dtype == float:
                values += 0.0  # a zero has no sign, whichever engine it is of
                values[~np.broadcast_to(_over(answered["exists"], values), values.shape)] = np.nan
        self._to_file_angles(answered)
        return answered

    def _of_mechanisms(self, given: FloatArray) -> tuple[dict[str, NDArray[Any]], dict[str, int]]:
        """The answers of one mechanism after the other; and how many problems have none, by the reason."""
        if not self.dimensions:
            return self.answers(given), {}
        first, count = len(self.dimensions), given.shape[1]
        filled = {array.name: np.full((*array.rows, count), _ABSENT[array.dtype]) for array in self.arrays}
        filled["exists"] = np.zeros((*((len(self.modes),) if self.every else ()), count), dtype=bool)
        refused = Counter[str]()
        for run in runs(given[:first]):
            values = tuple(given[:first, run.start].tolist())
            try:
                record = mechanism_of(self.record, self.dimensions, values)
            except UsageError as error:
                refused[refusal(error)] += run.stop - run.start
                continue
            found = replace(self, record=record).answers(given[first:, run])
            for name, rows in filled.items():
                rows[..., run] = found[name]
        return filled, reasons(refused)

    def _to_file_angles(self, rows: SolutionRows) -> None:
        for name, at_border in (("inputs", inputs_at_border), ("poses", pose_at_border)):
            if name in rows:
                rows[name][...] = np.moveaxis(at_border(self.record, np.moveaxis(rows[name], -2, -1)), -1, -2)


def _over(exists: NDArray[np.bool_], values: NDArray[Any]) -> NDArray[np.bool_]:
    """Existence (b,) or (K, b) with an axis for the rows of values (rows, b) or (K, rows, b)."""
    return exists[..., None, :] if values.ndim > exists.ndim else exists


def _counted(rows: SolutionRows, refused: Mapping[str, int]) -> Counts:
    """Problems by the number of modes that solve them, branches by status, and problems without a mechanism."""
    modes = np.bincount(np.atleast_2d(rows["exists"]).sum(axis=0))
    counts = {"modes": {str(k): int(n) for k, n in enumerate(modes) if n}}
    if refused:
        counts["refused"] = dict(refused)
    if "status" in rows:
        counts["status"] = {Status(k).name: int(n) for k, n in enumerate(np.bincount(rows["status"].ravel())) if n}
    return counts


def _about(sweep: GridSweep) -> dict[str, Any]:
    """The sweep of a whole grid, without what is counted in it."""
    record = sweep.record
    units = [(record.parameters[name].unit, 1.0) for name in sweep.dimensions]
    sizes = {"length": (record.unit, 1.0), "angle": (record.angle, record.angle_unit)}
    units += [sizes[kind] for kind in coordinates(record, sweep.problem).values()]
    grid, axes, held = sweep.grid, list[dict[str, Any]](), dict[str, float]()
    for k, (name, (unit, size)) in enumerate(zip(grid.names, units, strict=True)):
        scale = (grid.scales[k] if grid.scales else 1.0) / size
        low, high = grid.low[k] * scale, grid.high[k] * scale
        if grid.counts[k] == 1:
            held[name] = low
        else:
            axes.append({"name": name, "unit": unit, "low": low, "high": high, "count": grid.counts[k]})
    return {
        "mechanism": record.name,
        "dimensions": sweep.fixed_dimensions,
        "problem": sweep.problem,
        "mode": sweep.mode,
        "modes": list(sweep.modes),
        "unit": record.unit,
        "angle": record.angle,
        "along": axes,
        "at": held,
        "how": sweep.how,
        "files": {array.name: _file(sweep, array, [axis["name"] for axis in axes]) for array in sweep.arrays},
    }


def _file(sweep: GridSweep, array: Array, along: Sequence[str]) -> dict[str, Any]:
    rows, units, meaning = _rows(sweep, array.name)
    names = [*(["mode"] if sweep.every else []), *([_ROWS[array.name]] if rows else [])]
    return {
        "file": f"{array.name}.npy",
        "shape": list(array.shape),
        "dtype": array.dtype,
        "axes": [*names, *along],
        "rows": rows,
        "units": units,
        "meaning": meaning,
    }


def _rows(sweep: GridSweep, name: str) -> tuple[list[str], list[str], str]:
    """Names and units of the rows of a file, where it has some, and what stands in it."""
    record = sweep.record
    units = {"length": record.unit, "angle": record.angle}
    if name in ("inputs", "poses"):
        kinds = drive_kinds(record) if name == "inputs" else coordinates(record, "inverse")
        return list(kinds), [units[kind] for kind in kinds.values()], f"the {name}; NaN where `exists` would be false"
    if name == "factors":
        items = closed_form_of(record).factor_list
        names, powers = [item.name for item in items], [power(record.unit, item.unit) for item in items]
        return names, powers, "factors of det Jp and det Jq"
    meanings = {
        "exists": sweep.existence,
        "status": "status: " + ", ".join(f"{status.value} {status.name}" for status in Status),
        "det_jp": f"det Jp of the regular Jacobian, {record.unit} and rad",
        "det_jq": f"det Jq of the regular Jacobian, {record.unit} and rad",
        "condition_index": f"1/cond2 of Jp^-1 Jq, 0 where singular, {record.unit} and rad",
        "smallest": f"smallest singular value of Jp^-1 Jq, {record.unit} and rad",
    }
    return [], [], meanings[name]
