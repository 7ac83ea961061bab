"""Stored sweeps in closed form: both problems, in one mode or in all of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closed_form.all_modes_sweep import all_modes_sweep
from assur.kinematics.closed_form.blocks import FloatArray
from assur.kinematics.closed_form.branches import Branches
from assur.kinematics.closed_form.filling import engine_for
from assur.kinematics.closed_form.formulas import formulas
from assur.kinematics.closed_form.grid_sweep import GridSweep
from assur.kinematics.closed_form.sweep import Want, inverse_sweep
from assur.kinematics.modes import all_modes, sign_names
from assur.kinematics.position import direct, inverse
from assur.kinematics.status import Status, classify, closed_form_of
from assur.results.store.layout import block_length

BLOCK = 65536
"""Answers in memory at a time, per thread."""

SolutionRows = Mapping[str, NDArray[Any]]


@dataclass(frozen=True, eq=False)
class ClosedFormSweep(GridSweep):
    """A sweep in closed form; a status is that of the answer to the single problem."""

    @property
    def formulas(self) -> dict[str, str]:
        """The closed form, in a few letters, and the version."""
        return formulas(self.record, self.problem)

    @property
    def how(self) -> str:
        """Of which model the answers are, and that nothing is said between the places."""
        model = "the reduced model" if closed_form_of(self.record).complete_for == "reduced" else "the joint graph"
        every = len(self.modes) == 2 ** len(sign_names(self.record, self.problem))
        modes = "every branch of its roots" if every else "this mode alone"
        return f"closed form of {model}, {modes}, at the places of the grid and nowhere between them"

    @property
    def existence(self) -> str:
        """That a branch is real."""
        return "whether the mode has a solution"

    @property
    def engine(self) -> str:
        """NumPy or a compiled loop; the bits are the same."""
        return {"compiled": "a compiled loop", "numpy": "NumPy"}[engine_for(self.grid.size)]

    @property
    def block_length(self) -> int:
        """Places in a block: fewer where each has many modes."""
        longest = BLOCK // (len(all_modes(self.record, self.problem)) if self.every else 1)
        return block_length(self.grid.size, longest)

    @property
    def _wanted(self) -> tuple[Want, ...]:
        """What the inverse sweep in one mode works out: factors for a status."""
        names = [name for name in self.keep if name != "status"] + ["exists"]
        return cast("tuple[Want, ...]", (*names, *(["factors"] if "status" in self.keep else [])))

    def answers(self, given: FloatArray) -> dict[str, NDArray[Any]]:
        """What is kept of problems (m, b), angles in rad, and whether each exists (K, b) or (b,)."""
        found = self._found(given)
        if "status" in self.keep:
            found["status"] = self._status(given, found)
        return found

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

    def _status(self, given: FloatArray, rows: SolutionRows) -> NDArray[np.int8]:
        exists = rows["exists"]
        if "factors" not in rows:
            return self._answered(given).reshape(exists.shape)
        form = closed_form_of(self.record)
        factors = {factor.name: row for factor, row in zip(form.factor_list, rows["factors"], strict=True)}
        status = classify(self.record, factors, exists.shape)
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
