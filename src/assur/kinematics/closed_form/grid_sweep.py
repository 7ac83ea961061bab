"""Sweeps of grids into files: the arrays that are kept, their store, and a block, whatever it is that solves it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.at_border import power
from assur.kinematics.closed_form.about import coordinates, told
from assur.kinematics.closed_form.blocks import FloatArray, Progress
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.closed_form.streamed import KINDS, fill
from assur.kinematics.modes import Problem, all_modes
from assur.kinematics.status import Status, closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.results.disk import DISK, Disk
from assur.results.store.layout import Array, Plan, Shard
from assur.results.store.note import Counts
from assur.results.store.store import SolvedBlock, Store

SolutionRows = Mapping[str, NDArray[Any]]

_ROWS = {"inputs": "input", "poses": "coordinate", "factors": "factor"}

ALL = "all"
"""Stands for every mode."""


@dataclass(frozen=True, eq=False)
class GridSweep(ABC):
    """A sweep of a grid into files; made by `stored_sweep`, which checks it.

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
            "factors": len(self.record.closed_form.factor_list) if self.record.closed_form else 0,
        }
        first = (len(self.modes),) if self.every else ()
        places = tuple(count for count in self.grid.counts if count > 1)
        return tuple(
            Array(name, KINDS.get(name, "float64"), first + ((rows[name],) if name in rows else ()), places)
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
        """What is kept of problems (m, b), angles in rad, and whether each exists (K, b) or (b,)."""

    def plan(self, shard: Shard | None = None) -> Plan:
        """What is to be in a store, of the whole grid or of a shard."""
        names, low, high = self.grid.names, self.grid.low, self.grid.high
        question = {
            "kind": "stored sweep",
            "mechanism": self.record.name,
            **self.formulas,
            "dimensions": {name: float(value) for name, value in vars(self.record.values).items()},
            "problem": self.problem,
            "mode": self.mode,
            "limits": {name: [a, b] for name, a, b in zip(names, low, high, strict=True)},
            "counts": list(self.grid.counts),
            "keep": list(self.keep),
        }
        return Plan(question, self.arrays, self.block_length, shard, _about(self))

    def store(self, folder: Path, shard: Shard | None = None, disk: Disk = DISK) -> Store:
        """The store of a folder, not open yet, with a note for people (`sweep.json`)."""
        return Store(folder, self.plan(shard), told, disk)

    def fill(self, store: Store, *, progress: Progress | None = None, threads: int = 0) -> None:
        """Work out what a store lacks, in this process, which may be interrupted."""
        fill(store, self.block, self.grid, progress=progress, threads=threads)

    def block(self, given: FloatArray) -> SolvedBlock:
        """What is kept of the problems (m, b) of a block, and what is counted in it."""
        found = self.solve(given)
        return SolvedBlock({name: found[name] for name in self.keep}, _counted(found))

    def solve(self, given: FloatArray) -> SolutionRows:
        """What is kept of problems (m, b), and whether each exists: exists and status (K, b) or (b,), and so on."""
        found = self.answers(given)
        for values in found.values():
            if values.dtype == float:
                values += 0.0  # a zero has no sign, whichever engine it is of
                values[~np.broadcast_to(_over(found["exists"], values), values.shape)] = np.nan
        self._to_file_angles(found)
        return found

    def _to_file_angles(self, rows: SolutionRows) -> None:
        if self.record.angle != "deg":
            return
        angles = {
            "inputs": [item.coordinate.kind == "angle" for item in self.record.inputs],
            "poses": [is_angle(name) for name in self.record.platform.pose],
        }
        for name in rows.keys() & angles.keys():
            for k, angle in enumerate(angles[name]):
                if angle:
                    np.degrees(rows[name][..., k, :], out=rows[name][..., k, :])


def _over(exists: NDArray[np.bool_], values: NDArray[Any]) -> NDArray[np.bool_]:
    """Existence (b,) or (K, b) with an axis for the rows of values (rows, b) or (K, rows, b)."""
    return exists[..., None, :] if values.ndim > exists.ndim else exists


def _counted(rows: SolutionRows) -> Counts:
    """Problems by the number of modes that solve them, and branches by status."""
    modes = np.bincount(np.atleast_2d(rows["exists"]).sum(axis=0))
    counts = {"modes": {str(k): int(n) for k, n in enumerate(modes) if n}}
    if "status" in rows:
        counts["status"] = {Status(k).name: int(n) for k, n in enumerate(np.bincount(rows["status"].ravel())) if n}
    return counts


def _about(sweep: GridSweep) -> dict[str, Any]:
    """The sweep of a whole grid, without what is counted in it."""
    record = sweep.record
    kinds = coordinates(record, sweep.problem)
    units = {"length": record.unit, "angle": record.angle}
    axes: list[dict[str, Any]] = []
    held: dict[str, float] = {}
    scales = sweep.grid.scales or (1.0,) * len(kinds)
    for k, (name, kind) in enumerate(kinds.items()):
        scale = scales[k] / (record.angle_unit if kind == "angle" else 1.0)
        low, high = (value * scale for value in (sweep.grid.low[k], sweep.grid.high[k]))
        if sweep.grid.counts[k] == 1:
            held[name] = low
        else:
            axes.append({"name": name, "unit": units[kind], "low": low, "high": high, "count": sweep.grid.counts[k]})
    return {
        "mechanism": record.name,
        "dimensions": {name: float(value) for name, value in vars(record.values).items()},
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
        kinds = coordinates(record, "direct" if name == "inputs" else "inverse")
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
