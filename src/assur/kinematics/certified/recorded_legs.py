"""The conditions of the legs as programs over intervals: for a search that asks them of many thousand boxes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.certified.given import dimension_intervals, joint_inputs
from assur.kinematics.certified.legs import Legs, conditions_of
from assur.kinematics.modes import sign_names
from assur.kinematics.turns import periodic_inputs
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.numerics.branch_and_prune import Existing
from assur.numerics.dual import Dual, DualIntervals
from assur.numerics.intervals.functions import cosine_sine
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.intervals.shapes import broadcast, stack
from assur.numerics.recording.interval_program import IntervalProgram
from assur.numerics.recording.interval_tapes import FoldedTape, folded, with_derivatives
from assur.numerics.recording.tape import Recorded, Recorder

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
            outputs = self._programs.derivative(given, [*self._constants[False], as_interval(1.0)])
            return [self._dual(outputs, f"zero {k}") for k in range(len(self.legs.record.inputs))], ()
        clamped = isinstance(ns, Existing)
        outputs = self._programs.values[clamped](given, self._constants[clamped])
        zero, positive = ([outputs[name] for name in outputs if name.startswith(kind)] for kind in ("zero", "positive"))
        return zero, positive

    def _varying(self, values: Sequence[Interval], labels: IntArray) -> list[Interval]:
        """Numbers of the tape: lengths, cosines and sines, signs."""
        components: list[Interval] = []
        for name, value in zip(self.legs.record.platform.pose, values, strict=True):
            components += cosine_sine(value) if is_angle(name) else (value,)
        sure = np.ones(len(labels), dtype=bool)
        return [*components, *(Interval(row, row, sure) for row in self.legs.modes[labels].T)]

    def _dual(self, intervals: dict[str, Interval], name: str) -> Dual:
        """An output with its derivatives (m, N)."""
        count = intervals[name].shape
        zero = broadcast(as_interval(0.0), count)
        rates = [intervals.get(f"d{name}/d{axis}", zero) for axis in self.legs.record.platform.pose]
        return Dual(intervals[name], stack([broadcast(rate, count) for rate in rates], axis=0))

    @cached_property
    def _constants(self) -> dict[bool, tuple[Interval, ...]]:
        """What the programs take for all boxes; clamped or not."""
        given = [*dimension_intervals(self.legs.record).values()]
        for value in joint_inputs(self.legs.record, self.legs.inputs):
            given += map(as_interval, value) if isinstance(value, tuple) else [as_interval(value)]
        return {clamped: self._programs.folded.numbers(given, clamped=clamped) for clamped in (False, True)}

    @property
    def _programs(self) -> LegPrograms:
        return leg_programs(self.legs.record)


@dataclass(frozen=True, eq=False)
class LegPrograms:
    """The conditions of a mechanism's legs, for any inputs.

    Attributes:
        folded: the conditions; uniform are parameters and inputs, varying the pose and the signs of a working mode.
        values: them over intervals, roots of negative numbers defined or not.
        derivative: them beside their derivatives.
    """

    folded: FoldedTape
    values: dict[bool, IntervalProgram]
    derivative: IntervalProgram


@lru_cache(maxsize=16)
def leg_programs(record: MechanismRecord) -> LegPrograms:
    """The programs of a mechanism, recorded once.

    >>> from assur.model.registry import load_record
    >>> leg_programs(load_record("fivebar")).folded.varying.varying
    ('x', 'y', 'sign s1', 'sign s2')
    """
    recorder, names = Recorder(), record.platform.pose
    pose = tuple(_recorded(recorder.varying, name, is_angle(name)) for name in names)
    sign = SimpleNamespace(**{name: recorder.varying(f"sign {name}") for name in sign_names(record, "inverse")})
    p = kernel_dimensions(record, recorder.uniform)
    given = tuple(_recorded(recorder.uniform, f"input {k}", same) for k, same in enumerate(periodic_inputs(record)))
    zero, positive = conditions_of(record, recorder, p, pose, sign, given)
    outputs = {f"zero {k}": value for k, value in enumerate(zero)}
    outputs |= {f"positive {k}": value for k, value in enumerate(positive)}
    parts = folded(recorder.tape(outputs))
    angles = {name: (f"cos {name}", f"sin {name}") for name in names if is_angle(name)}
    derivative = IntervalProgram(with_derivatives(parts.varying, angles, names))
    return LegPrograms(parts, {own: IntervalProgram(parts.varying, own) for own in (False, True)}, derivative)


def _recorded(new: Callable[[str], Recorded], name: str, is_pair: bool) -> Recorded | tuple[Recorded, Recorded]:
    """A length, or cosine and sine of an angle."""
    return (new(f"cos {name}"), new(f"sin {name}")) if is_pair else new(name)
