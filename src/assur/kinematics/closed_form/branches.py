"""The branches of a closed form: all solutions of a batch of problems, expanded only where asked."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError
from assur.kinematics import border
from assur.kinematics.answers.self_motion import SelfMotionCurve, has_self_motion, nearest_miss, self_motion_curves
from assur.kinematics.answers.solution import Failure
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.closed_form.mode_reading import ModeReading
from assur.kinematics.modes import Problem, all_modes, mode_signs, mode_texts, sign_axes, sign_names
from assur.kinematics.status import (
    FACTOR_TOLERANCE,
    Status,
    allows,
    branch_kernel,
    classify,
    closed_form_of,
    exists,
    scale,
    vanishes,
)
from assur.model.closed_form import Branch, Margin
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.numerics.number_types import Floats

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class Branches(SolutionSet):
    """All K branches for a batch (...) of problems, each named by its signs; made by `direct` and `inverse`.

    Attributes:
        modes_asked: (K, s) signs of the branches, in the order of the axis K.
        branch: the kernel's numbers, with leading sign axes that are not expanded.
    """

    record: MechanismRecord
    problem: Problem
    given: FloatArray
    modes_asked: NDArray[np.int8]
    sign_shape: tuple[int, ...]
    branch: Branch

    @cached_property
    def reading(self) -> ModeReading:
        """The kernel's numbers, of which everything here is a column."""
        return ModeReading(self.record, Floats(), self.branch)

    @property
    def complete(self) -> bool:
        """Whether these are all solutions of the model `complete_for`, by right of the closed form."""
        every = 2 ** len(sign_names(self.record, self.problem))
        return len(self.modes_asked) == every and not bool(
            np.any(np.isin(self.overall_status, (Status.not_closed, Status.undecided)))
        )

    @property
    def complete_for(self) -> str:
        """The model: "joint_graph", or "reduced" where the source leaves assemblies of the joint graph out."""
        return closed_form_of(self.record).complete_for

    @property
    def right(self) -> str:
        """By what right the answer is complete."""
        return "closed form, every branch of its roots"

    @cached_property
    def labels(self) -> NDArray[np.str_]:
        """Text (..., K) of this problem's mode."""
        return mode_texts(self.modes)

    @cached_property
    def other_labels(self) -> NDArray[np.str_]:
        """Text (..., K) of the other problem's mode."""
        return mode_texts(self.other_modes)

    @cached_property
    def margins(self) -> dict[str, FloatArray]:
        """Margins (..., K) by name; negative where a branch does not exist."""
        return {name: self._expand(value) for name, value in self.branch.margins.items()}

    @cached_property
    def factors(self) -> dict[str, FloatArray]:
        """Factors (..., K) of det Jp and det Jq by name."""
        return {name: self._where_real(self._expand(value)) for name, value in self.reading.factors.items()}

    @cached_property
    def poses(self) -> FloatArray:
        """Poses (..., K, m); NaN where the status is unreachable, self_motion or undecided without a pose."""
        columns = [self._expand(border.scalar(value)) for value in self.branch.pose]
        return self._where_real(np.stack(columns, axis=-1))

    @cached_property
    def inputs(self) -> FloatArray:
        """Printed inputs (..., K, n); NaN where there is no solution."""
        columns = [self._expand(value) for value in border.printed_inputs(self.record, self.branch.inputs)]
        return self._where_real(np.stack(columns, axis=-1))

    @cached_property
    def joints(self) -> FloatArray:
        """Every joint's value (..., K, coordinates), in rad or length; NaN where there is no solution."""
        columns = [self._expand(value) for value in border.joint_values(self.record, self.reading.joints)]
        return self._where_real(np.stack(columns, axis=-1))

    @cached_property
    def modes(self) -> NDArray[np.int8]:
        """Signs (..., K, s) of this problem's mode; 0 where two branches have merged."""
        shape = (*self.batch_shape, *self.modes_asked.shape)
        signs: NDArray[np.int8] = np.broadcast_to(self.modes_asked, shape) * ~self._merged
        return signs

    @cached_property
    def other_modes(self) -> NDArray[np.int8]:
        """Signs (..., K, s) of the other problem's mode (working for direct, assembly for inverse)."""
        return self.signs("inverse" if self.problem == "direct" else "direct")

    def signs(self, problem: Problem) -> NDArray[np.int8]:
        """Signs (..., K, s) of the quantities that name the modes of a problem, as they come out; 0 where zero."""
        form = closed_form_of(self.record)
        columns: list[NDArray[Any]] = []
        for name in sign_names(self.record, problem):
            sign = form.signs[name]
            value = self._expand(getattr(self.branch.core, sign.attribute)) / scale(self.record, sign.scale)
            columns.append(np.where(self._real & (np.abs(value) > FACTOR_TOLERANCE), np.sign(value), 0))
        shape = (*self._real.shape, len(columns))
        return np.stack(columns, axis=-1).astype(np.int8) if columns else np.zeros(shape, dtype=np.int8)

    @cached_property
    def exists(self) -> NDArray[np.bool_]:
        """Whether a branch (..., K) is a solution that is listed: real, and not the second copy of a merged one."""
        copies = np.any(self._merged & (self.modes_asked < 0), axis=-1) & (len(self.modes_asked) > 1)
        return np.asarray(self._real & ~copies)

    @cached_property
    def status(self) -> NDArray[np.int8]:
        """`Status` (..., K) of every branch."""
        return self._closed(self.formula_status)

    @cached_property
    def formula_status(self) -> NDArray[np.int8]:
        """The same by margins and factors alone, as sweeps want it: the loops of the joint graph are not asked."""
        with np.errstate(invalid="ignore"):
            status = classify(self.record, self.factors, self._real.shape)
        status[~self._real] = Status.unreachable
        form = closed_form_of(self.record)
        merging = [item for item in self._margin_list if item.zero == "merge"]
        known = {item.name: np.nan_to_num(self.margins[item.name]) for item in merging}  # NaN: nothing forbids it
        reachable = exists(self.record, merging, known)
        for margin in self._margin_list:
            if margin.zero == "degenerate":
                here = vanishes(self.record, margin, self.margins[margin.name])
                if form.self_motion is not None and form.self_motion.margin == margin.name:
                    status[here] = Status.self_motion
                else:
                    status[here & reachable] = Status.undecided
        return status

    @cached_property
    def overall_status(self) -> NDArray[np.int8]:
        """`Status` (...) of the answer: the most severe among the listed solutions, or why there is none.

        An undecided branch makes all undecided, unless a listed solution is not closed: then the formulas are wrong.
        """
        return self._overall(self.status)

    @property
    def formula_overall_status(self) -> NDArray[np.int8]:
        """The same (...) of `formula_status`."""
        return self._overall(self.formula_status)

    def _overall(self, status: NDArray[np.int8]) -> NDArray[np.int8]:
        listed = np.where(self.exists, status, -1).max(axis=-1)
        overall: NDArray[np.int8] = np.where(listed >= 0, listed, status.min(axis=-1)).astype(np.int8)
        for index in np.argwhere((listed < 0) & (overall == Status.self_motion)):
            place = tuple(index)
            if not has_self_motion(self.record, self.given[place]):
                overall[place] = Status.unreachable
        undecided = np.any(status == Status.undecided, axis=-1)
        overall[undecided & (overall != Status.not_closed)] = Status.undecided
        return overall

    @cached_property
    def curves(self) -> tuple[SelfMotionCurve, ...]:
        """The curves of a self-motion at the given inputs (a batch of one): described, never one sample."""
        self._only_one()
        return self_motion_curves(self.record, self.given) if self._in_self_motion else ()

    @cached_property
    def failures(self) -> tuple[Failure, ...]:
        """Why no branch exists (a batch of one); empty where one does."""
        self._only_one()
        if np.any(self._real) or self.curves:
            return ()
        if self._in_self_motion:
            return (nearest_miss(self.record, self.given),)
        pending = np.ones(len(self.modes_asked), dtype=bool)
        found = []
        for margin in self._margin_list:
            value = self.margins[margin.name]
            fails = pending & ~allows(self.record, margin, value) & (margin.zero != "degenerate")
            if np.any(fails):
                worst = float(np.max(value[fails]))
                found.append(Failure(margin.name, worst, margin.unit, margin.meaning, int(np.sum(fails))))
            pending &= ~fails
        return tuple(found)

    def quantities(self, name: str) -> FloatArray:
        """A quantity (..., K) that the source names, e.g. "gamma" (rad), "t", "J1", "M3"."""
        form = closed_form_of(self.record)
        found = form.quantities(Floats(), kernel_dimensions(self.record), self.branch.core) if form.quantities else {}
        if name not in found:
            raise UnknownNameError(f"quantity of {self.record.name}", name, found)
        return self._where_real(self._expand(border.scalar(found[name])))

    @property
    def named_quantities(self) -> dict[str, FloatArray]:
        """Every quantity (..., K) that the source names."""
        return {item.name: self.quantities(item.name) for item in closed_form_of(self.record).quantity_list}

    @property
    def _margin_list(self) -> tuple[Margin, ...]:
        form = closed_form_of(self.record)
        return form.direct_margins if self.problem == "direct" else form.inverse_margins

    @property
    def _in_self_motion(self) -> bool:
        """Whether the direct problem (a batch of one) degenerates to a self-motion, real or not."""
        return not np.any(self._real) and bool(np.any(self.status == Status.self_motion))

    @cached_property
    def _real(self) -> NDArray[np.bool_]:
        allowed = exists(self.record, self._margin_list, self.margins)
        return np.broadcast_to(allowed, (*self.batch_shape, len(self.modes_asked)))  # without margins: one for all

    @cached_property
    def _merged(self) -> NDArray[np.bool_]:
        names = sign_names(self.record, self.problem)
        merged = np.zeros((*self.batch_shape, *self.modes_asked.shape), dtype=bool)
        for margin in self._margin_list:
            for name in margin.signs:
                merged[..., names.index(name)] |= vanishes(self.record, margin, self.margins[margin.name])
        return merged

    def _expand(self, value: Any) -> FloatArray:
        """A kernel's number over sign axes and N problems, as (..., K)."""
        count = int(np.prod(self.batch_shape, dtype=int))
        wide = np.broadcast_to(np.asarray(value, dtype=float), (*self.sign_shape, count))
        rows = np.moveaxis(wide.reshape(len(self.modes_asked), count), 0, -1)
        return rows.reshape(*self.batch_shape, len(self.modes_asked))

    def _where_real(self, values: FloatArray) -> FloatArray:
        real = self._real if values.ndim == self._real.ndim else self._real[..., None]
        return np.where(real, values, np.nan)


def branches(record: MechanismRecord, problem: Problem, given: FloatArray, mode: str | None = None) -> Branches:
    """Every branch of a kernel at inputs or poses (..., n), or the one of a mode: one reading of the kernel.

    >>> from assur.model.registry import load_record
    >>> branches(load_record("fivebar"), "inverse", np.array([[0.0, 200.0], [0.0, 900.0]])).exists.sum(axis=1)
    array([4, 0])
    """
    form = closed_form_of(record)
    names = sign_names(record, problem)
    if mode is None:
        sign, shape = sign_axes(names), (2,) * len(names)
        asked = [mode_signs(record, problem, text) for text in all_modes(record, problem)]
    else:
        asked = [mode_signs(record, problem, mode)]
        sign, shape = SimpleNamespace(**dict(zip(names, map(float, asked[0]), strict=True))), ()
    flat = given.reshape(-1, given.shape[-1])
    components = border.input_components if problem == "direct" else border.pose_components
    kernel = branch_kernel(record) if problem == "direct" else form.inverse
    with np.errstate(
        divide="ignore", invalid="ignore", over="ignore"
    ):  # where a margin degenerates; its status says so
        branch = kernel(Floats(), kernel_dimensions(record), components(record, flat), sign)
    return Branches(record, problem, given, np.array(asked, dtype=np.int8), shape, branch)
