"""Closed forms as tapes: one straight-line program per problem and wanted numbers, for every mode and all dimensions.

Dimensions, signs of one mode and tolerances are uniform numbers, so that one compiled loop serves them all. For all
modes the kernel is recorded once per combination of signs; what several share is one entry. What a loop cannot do
(an angle from its cosine and sine, matrices beyond 3 x 3) NumPy does afterwards, block by block.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from types import SimpleNamespace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from assur.kinematics import border
from assur.kinematics.modes import Problem, sign_names
from assur.kinematics.status import branch_kernel, closed_form_of, tolerance
from assur.kinematics.turns import periodic_inputs
from assur.model.closed_form import Branch, Margin
from assur.model.kernel_dimensions import dimension_numbers, kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.numerics.recording.loops import CompiledLoop, compiled
from assur.numerics.recording.tape import Recorded, Recorder, Tape
from assur.numerics.singular_values import SIZES, condition_index
from assur.numerics.small_matrices import LARGEST_BY_COFACTORS, by_cofactors

FloatArray = NDArray[np.float64]

Finish = Literal["", "angle", "determinant", "condition_index", "smallest"]


@dataclass(frozen=True)
class AnswerRow:
    """A row of an answer: a number of the tape, or what NumPy makes of several.

    Attributes:
        take: outputs of the tape.
        finish: what is made of them; nothing where empty.
        sign, offset: of an angle, from the joint's value to the printed one; the sign also of a determinant.
    """

    take: tuple[str, ...]
    finish: Finish = ""
    sign: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, eq=False)
class Recording:
    """The tape of a problem of a mechanism.

    Attributes:
        record, problem: whose closed form it is.
        tape: its varying numbers are the given components, an angle as two, cosine and sine.
        rows: wanted quantity -> its rows; in all modes one list per combination of signs, one after the other.
        truths: outputs that say whether a branch exists: one, or one per combination.
    """

    record: MechanismRecord
    problem: Problem
    tape: Tape
    rows: Mapping[str, tuple[AnswerRow, ...]]
    truths: tuple[str, ...]

    @cached_property
    def loop(self) -> CompiledLoop:
        """The tape as a compiled loop."""
        return compiled(self.tape)

    @cached_property
    def has_angles(self) -> bool:
        """Whether a given component is an angle."""
        return _has_angles(self.record, self.problem)

    def uniform(self, signs: Sequence[float] = ()) -> FloatArray:
        """The uniform numbers: the record's dimensions, its tolerances, and the signs of a mode."""
        record, form = self.record, closed_form_of(self.record)
        known = {f"p.{name}": value for name, value in dimension_numbers(record).items()}
        known |= {f"sign.{name}": sign for name, sign in zip(sign_names(record, self.problem), signs, strict=False)}
        known |= {f"tolerance.{item.name}": _bound(record, item) for item in _margins(form, self.problem)}
        return np.array([known[name] for name in self.tape.uniform], dtype=float)

    def prepared(self, block: FloatArray) -> FloatArray:
        """What the tape is given (k, b), from the components (m, b): cosines and sines of the angles among them."""
        if not self.has_angles:
            return block
        convert = border.pose_components if self.problem == "inverse" else border.input_components
        return np.stack(list(_flat(convert(self.record, block.T))))


@lru_cache(maxsize=64)
def recording(record: MechanismRecord, problem: Problem, want: tuple[str, ...] = (), every: bool = False) -> Recording:
    """The tape of a problem in one mode, with wanted quantities of a sweep, or in all modes.

    Args:
        record: a mechanism with a closed form.
        problem: which one; the direct problem needs a closed form by signs.
        want: of "inputs", "exists", "det_jp", "det_jq", "factors", "condition_index", "smallest"; for the inverse
            problem in one mode only.
        every: all modes: inputs or poses, and existence, of each.

    Example:
        >>> from assur.model.registry import load_record
        >>> found = recording(load_record("zeng2019"), "inverse", ("inputs", "exists"))
        >>> found.tape.varying, len(found.rows["inputs"]), found.truths
        (('x', 'y', 'z'), 3, ('exists',))
    """
    writer = _Writer(record, problem)
    if not every:
        signs = {name: writer.ns.uniform(f"sign.{name}") for name in sign_names(record, problem)}
        writer.one(SimpleNamespace(**signs), want)
    else:
        names = sign_names(record, problem)
        for signs_of in itertools.product([1.0, -1.0], repeat=len(names)):
            writer.mode(SimpleNamespace(**dict(zip(names, signs_of, strict=True))))
    rows = {name: tuple(items) for name, items in writer.rows.items()}
    return Recording(record, problem, writer.ns.tape(writer.outputs), rows, tuple(writer.truths))


class _Writer:
    """Records a kernel; collects outputs and the rows made of them."""

    def __init__(self, record: MechanismRecord, problem: Problem) -> None:
        self.record, self.problem, self.form = record, problem, closed_form_of(record)
        self.ns = Recorder()
        self.given = self._components()
        self.p = kernel_dimensions(record, lambda name: self.ns.uniform(f"p.{name}"))
        self.bounds = {item.name: self.ns.uniform(f"tolerance.{item.name}") for item in _margins(self.form, problem)}
        self.kernel = self.form.inverse if problem == "inverse" else branch_kernel(record)
        self.outputs: dict[str, Any] = {}
        self.rows: dict[str, list[AnswerRow]] = {}
        self.truths: list[str] = []

    def one(self, sign: SimpleNamespace, want: Sequence[str]) -> None:
        """One mode, with what is wanted of it."""
        branch = self.kernel(self.ns, self.p, self.given, sign)
        if "inputs" in want:
            self.rows["inputs"] = self._input_rows(branch, "")
        if "exists" in want:
            self._exists(branch, "exists")
        jp, jq = self.form.jacobians(self.ns, self.p, branch.core)
        turn = float(np.prod([item.sign for item in self.record.inputs]))  # from joint values to printed inputs
        for name, matrix, factor in (("det_jp", jp, 1.0), ("det_jq", jq, turn)):
            if name in want:
                self.rows[name] = [self._determinant(name, matrix, factor)]
        if {"condition_index", "smallest"} & set(want):
            self._condition(jp, jq, want)
        if "factors" in want:
            found = self.form.factors(self.ns, self.p, branch.core)
            self.rows["factors"] = [self._number(f"factor.{f.name}", found[f.name]) for f in self.form.factor_list]

    def mode(self, sign: SimpleNamespace) -> None:
        """One of all modes."""
        branch = self.kernel(self.ns, self.p, self.given, sign)
        label = f"mode{len(self.truths)}"
        self._exists(branch, f"{label}.exists")
        if self.problem == "inverse":
            self.rows.setdefault("inputs", []).extend(self._input_rows(branch, label))
        else:
            names = self.record.platform.pose
            found = [self._row(f"{label}.{name}", value) for name, value in zip(names, branch.pose, strict=True)]
            self.rows.setdefault("poses", []).extend(found)

    def _components(self) -> tuple[Any, ...]:
        if self.problem == "inverse":
            return tuple(self._varying(name, is_angle(name)) for name in self.record.platform.pose)
        items = self.record.inputs
        raw = tuple(
            self._varying(item.name, bool(same)) for item, same in zip(items, periodic_inputs(self.record), strict=True)
        )
        if _has_angles(self.record, "direct"):  # NumPy prepares them all
            return raw
        return tuple(item.joint_value(value) for value, item in zip(raw, items, strict=True))

    def _varying(self, name: str, angle: bool) -> Any:
        if angle:
            return self.ns.varying(f"cos {name}"), self.ns.varying(f"sin {name}")
        return self.ns.varying(name)

    def _input_rows(self, branch: Branch, label: str) -> list[AnswerRow]:
        rows = []
        for value, item in zip(branch.inputs, self.record.inputs, strict=True):
            plain = isinstance(value, tuple) or (item.sign, item.offset) == (1.0, 0.0)
            printed = value if plain else item.sign * value + item.offset
            rows.append(self._row(f"{label}.{item.name}", printed, item.sign, item.offset))
        return rows

    def _row(self, name: str, value: Any, sign: float = 1.0, offset: float = 0.0) -> AnswerRow:
        if not isinstance(value, tuple):
            return self._number(name, value)
        self.outputs[f"{name}.cos"], self.outputs[f"{name}.sin"] = value
        return AnswerRow((f"{name}.cos", f"{name}.sin"), "angle", sign, offset)

    def _number(self, name: str, value: Any) -> AnswerRow:
        self.outputs[name] = value
        return AnswerRow((name,))

    def _determinant(self, name: str, matrix: Sequence[Sequence[Any]], factor: float) -> AnswerRow:
        if len(matrix) <= LARGEST_BY_COFACTORS:
            return self._number(name, by_cofactors(matrix) * factor if name == "det_jq" else by_cofactors(matrix))
        return AnswerRow(self._entries(name, matrix), "determinant", factor)

    def _condition(self, jp: Sequence[Sequence[Any]], jq: Sequence[Sequence[Any]], want: Sequence[str]) -> None:
        names: tuple[Literal["condition_index", "smallest"], ...] = ("condition_index", "smallest")
        if len(jp) in SIZES:
            for name, value in zip(names, condition_index(self.ns, jp, jq), strict=True):
                if name in want:
                    self.rows[name] = [self._number(name, value)]
            return
        take = (*self._entries("det_jp", jp), *self._entries("det_jq", jq))
        for name in names:
            if name in want:
                self.rows[name] = [AnswerRow(take, name)]

    def _entries(self, name: str, matrix: Sequence[Sequence[Any]]) -> tuple[str, ...]:
        labels = [f"{name}.{r}{c}" for r in range(len(matrix)) for c in range(len(matrix))]
        self.outputs.update(zip(labels, (entry for row in matrix for entry in row), strict=True))
        return tuple(labels)

    def _exists(self, branch: Branch, name: str) -> None:
        result: Recorded | None = None
        for margin in _margins(self.form, self.problem):
            value, bound = branch.margins[margin.name], self.bounds[margin.name]
            if margin.zero == "degenerate":
                allowed = ~self.ns.apply(">=", bound, abs(value))
            else:
                allowed = self.ns.apply(">=", value, bound)
            result = allowed if result is None else result & allowed
        self.outputs[name] = self.ns.apply(">=", 1.0, 0.0) if result is None else result
        self.truths.append(name)


def _margins(form: Any, problem: Problem) -> tuple[Margin, ...]:
    return tuple(form.inverse_margins if problem == "inverse" else form.direct_margins)


def _bound(record: MechanismRecord, margin: Margin) -> float:
    """What a margin, or its magnitude, is compared with (`existence.allows`)."""
    return tolerance(record, margin) * (1.0 if margin.zero == "degenerate" else -1.0)


def _has_angles(record: MechanismRecord, problem: Problem) -> bool:
    if problem == "inverse":
        return any(map(is_angle, record.platform.pose))
    return bool(np.any(periodic_inputs(record)))


def _flat(values: Sequence[Any]) -> list[FloatArray]:
    return [part for value in values for part in (value if isinstance(value, tuple) else (value,))]
