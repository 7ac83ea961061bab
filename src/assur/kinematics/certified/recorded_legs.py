"""The conditions of the legs as programs over intervals: for a search that asks them of many thousand boxes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.certified.given import joint_inputs
from assur.kinematics.certified.legs import Legs, conditions_of
from assur.kinematics.modes import sign_names
from assur.model.pose import is_angle
from assur.numerics.branch_and_prune import Existing
from assur.numerics.dual import Dual, DualIntervals
from assur.numerics.intervals.functions import cosine_sine
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.intervals.shapes import broadcast, stack
from assur.numerics.recording.interval_program import IntervalProgram
from assur.numerics.recording.interval_tapes import folded, with_derivatives
from assur.numerics.recording.tape import Recorder, Tape

IntArray = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class RecordedLegs:
    """What `Legs` says, worked out by programs; over intervals, and duals that differentiate by each coordinate.

    >>> from assur.model.registry import load_record
    >>> legs = Legs(load_record("zeng2019"), np.array([162.6907, -143.3209, -24.6776]))
    >>> pose = tuple(Interval.of([value]) for value in (-15.4714, 9.6849, 456.3315))
    >>> zero, positive = RecordedLegs(legs)(Existing(), pose, np.array([0]))
    >>> len(zero), len(positive)
    (3, 4)
    """

    legs: Legs

    def __call__(self, ns: Any, numbers: tuple[Any, ...], labels: IntArray) -> tuple[Sequence[Any], Sequence[Any]]:
        """Equations and inequalities at poses, (N,) per coordinate."""
        values = [as_interval(number.value if isinstance(number, Dual) else number) for number in numbers]
        given = self._varying(values, labels)
        if isinstance(ns, DualIntervals):
            found = self._differentiated(given, self._constants[False])
            return [self._dual(found, f"zero {k}") for k in range(self._count)], ()
        clamped = isinstance(ns, Existing)
        found = self._programs[clamped](given, self._constants[clamped])
        zero, positive = ([found[name] for name in found if name.startswith(kind)] for kind in ("zero", "positive"))
        return zero, positive

    def _varying(self, values: Sequence[Interval], labels: IntArray) -> list[Interval]:
        """Numbers of the tape: lengths, cosines and sines, signs."""
        found: list[Interval] = []
        for name, value in zip(self.legs.record.platform.pose, values, strict=True):
            found += cosine_sine(value) if is_angle(name) else (value,)
        return [*found, *(as_interval(row) for row in self.legs.modes[labels].T)]

    def _dual(self, intervals: dict[str, Interval], name: str) -> Dual:
        """An output with its derivatives (m, N)."""
        count = intervals[name].shape
        zero = broadcast(as_interval(0.0), count)
        rates = [intervals.get(f"d{name}/d{axis}", zero) for axis in self.legs.record.platform.pose]
        return Dual(intervals[name], stack([broadcast(rate, count) for rate in rates], axis=0))

    @cached_property
    def _recorded(self) -> tuple[Tape, tuple[Interval, ...]]:
        """The kernel over recorded numbers, and what is uniform in it."""
        record, recorder = self.legs.record, Recorder()
        uniform: list[Interval] = []

        def given(name: str, value: Any) -> Any:
            uniform.append(as_interval(value))
            return recorder.uniform(name)

        pose = tuple(
            (recorder.varying(f"cos {name}"), recorder.varying(f"sin {name}"))
            if is_angle(name)
            else recorder.varying(name)
            for name in record.platform.pose
        )
        sign = SimpleNamespace(**{name: recorder.varying(f"sign {name}") for name in sign_names(record, "inverse")})
        p = SimpleNamespace(**{name: given(name, value) for name, value in vars(record.values).items()})
        wanted = tuple(
            tuple(given(f"input {k} {end}", part) for end, part in enumerate(item))
            if isinstance(item, tuple)
            else given(f"input {k}", item)
            for k, item in enumerate(joint_inputs(record, self.legs.inputs))
        )
        zero, positive = conditions_of(record, recorder, p, pose, sign, wanted)
        outputs = {f"zero {k}": value for k, value in enumerate(zero)}
        return recorder.tape(outputs | {f"positive {k}": value for k, value in enumerate(positive)}), tuple(uniform)

    @property
    def _count(self) -> int:
        return len(self.legs.record.inputs)

    @cached_property
    def _folded(self) -> dict[bool, tuple[Tape, tuple[Interval, ...]]]:
        return {clamped: folded(*self._recorded, clamped=clamped) for clamped in (False, True)}

    @cached_property
    def _constants(self) -> dict[bool, tuple[Interval, ...]]:
        return {clamped: numbers for clamped, (_, numbers) in self._folded.items()}

    @cached_property
    def _programs(self) -> dict[bool, IntervalProgram]:
        return {clamped: IntervalProgram(tape, clamped) for clamped, (tape, _) in self._folded.items()}

    def _differentiated(self, given: Sequence[Interval], constants: Sequence[Interval]) -> dict[str, Interval]:
        return self._derivative(given, [*constants, as_interval(1.0)])

    @cached_property
    def _derivative(self) -> IntervalProgram:
        names = self.legs.record.platform.pose
        angles = {name: (f"cos {name}", f"sin {name}") for name in names if is_angle(name)}
        return IntervalProgram(with_derivatives(self._folded[False][0], angles, names))
