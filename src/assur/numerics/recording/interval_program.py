"""Tapes over intervals by machine code, a few elements at a time: the bits of NumPy without its passes.

For one product of intervals NumPy goes over its arrays some twenty times. Here one interpreter for all tapes, in
machine code, keeps a few elements of every entry in the processor's cache. Loading it takes a while, so it is not
loaded before as much work was done without it.
"""

from __future__ import annotations

import importlib.util
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.numerics.intervals import rounding
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.intervals.rates import ClampedIntervals
from assur.numerics.intervals.shapes import broadcast
from assur.numerics.number_types import Intervals
from assur.numerics.recording.interval_plan import IntervalPlan, interval_plan
from assur.numerics.recording.tape import Tape

Engine = Literal["auto", "numpy", "compiled"]

AT_ONCE = 64
"""Elements that are worked on at a time."""
SMALL = 400
"""So many elements cost what a call of NumPy's functions costs anyway."""
REPAID = 10_000_000
"""Elements times operations after which the code is loaded: by NumPy they take about a second."""


@dataclass(frozen=True, eq=False)
class IntervalProgram:
    """A tape to be evaluated over intervals.

    Attributes:
        tape: without comparisons; of each operation an argument is no written number.
        clamped: whether the root of max(x, 0) counts as defined where x is negative.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x, p = recorder.varying("x"), recorder.uniform("p")
    >>> program = IntervalProgram(recorder.tape({"y": x * x - p}))
    >>> found = program([Interval.of([-1.0, 2.0], [1.0, 3.0])], [Interval.of(1.0)])["y"]
    >>> found.contains([-0.5, 5.0]), found.contains([-1.1, 9.0])
    (array([ True,  True]), array([False, False]))
    """

    tape: Tape
    clamped: bool = False

    def __call__(
        self, varying: Sequence[Interval], uniform: Sequence[Interval], engine: Engine = "auto"
    ) -> dict[str, Interval]:
        """Outputs (N,) by name at intervals that vary, (N,) or (), and uniform ones, ().

        The bits do not depend on the engine, but for the sign of a zero; nor do the shapes: all outputs are (N,), or
        all () where nothing varying is (N,). They may be views that cannot be written.
        """
        shape = np.broadcast_shapes(*(number.low.shape for number in varying))
        if engine == "compiled" or (engine == "auto" and repaid(len(self.tape.operations), math.prod(shape))):
            return self._by_code(varying, uniform, shape)
        outputs = self.tape.evaluate(varying, uniform, ClampedIntervals() if self.clamped else Intervals())
        return {name: broadcast(as_interval(value), shape) for name, value in outputs.items()}

    def _by_code(
        self, varying: Sequence[Interval], uniform: Sequence[Interval], shape: tuple[int, ...]
    ) -> dict[str, Interval]:
        from assur.numerics.recording.interval_code import run  # numba takes long to start

        rounding.check_nearest()
        plan, count = self._plan, math.prod(shape)
        same = [*uniform, *(as_interval(number) for number in plan.numbers)]
        exact = np.array([number.low is number.high for number in (*varying, *same)], dtype=bool)
        given, work, answer = _rows(len(varying), count), _rows(plan.places, AT_ONCE), _rows(len(plan.rows), count)
        for rows, items in ((given, varying), (work, same)):
            for k, number in enumerate(items):
                rows[0][k], rows[1][k], rows[2][k] = number.low, number.high, number.defined
        run(plan.steps, (*given, exact), answer, work, self.clamped)
        low, high, defined = (part.reshape(len(part), *shape) for part in answer)
        stored = {k: Interval(low[row], high[row], defined[row]) for k, row in plan.rows.items()}
        return {name: stored[k] for name, k in self.tape.outputs.items()}

    @cached_property
    def _plan(self) -> IntervalPlan:
        return interval_plan(self.tape)


def _rows(height: int, count: int) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_]]:
    """Room for lower and upper bounds and for definedness, (height, count) each."""
    shape = height, count
    return np.empty(shape), np.empty(shape), np.empty(shape, dtype=bool)


@dataclass
class _Done:
    """Work done so far that machine code could have done."""

    work: int = 0
    compilable: bool = field(default_factory=lambda: importlib.util.find_spec("numba") is not None)


_DONE = _Done()


def repaid(operations: int, count: int) -> bool:
    """Whether machine code is to be used for so many operations on so many elements.

    It is loaded once as much was done without it as loading takes: so it never takes more than twice the time.
    """
    if _DONE.work < REPAID:
        _DONE.work += operations * max(count, SMALL)
    return _DONE.compilable and _DONE.work >= REPAID
