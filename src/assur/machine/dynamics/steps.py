"""Steps of a motion in time, by the law that says how its joints speed up; after each the loops are closed again."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import DOP853

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import assemble
from assur.kinematics.turns import joint_units, whole_turns_less
from assur.kinematics.validation.check import METRES
from assur.machine.dynamics.departure import Departure
from assur.machine.dynamics.equation_of_motion import EquationOfMotion
from assur.machine.dynamics.watch import Watch, too_fast
from assur.machine.motion.joint_motion import ClosedMotion, joint_scales_si

FloatArray = NDArray[np.float64]
RELATIVE = 1e-10
"""Error of a step."""
OF_PLACES, OF_RATES = 1e-12, 1e-10
"""Least errors that count, in rad and characteristic lengths, and these per s: the spins of thin rods, which have
hardly any inertia, are noise of this size."""


class LawOfMotion(Protocol):
    """How one configuration goes on, with joint rates (1, n), in SI units."""

    def second(self, time: float, motion: ClosedMotion, rates: FloatArray) -> FloatArray:
        """Joint accelerations (1, n)."""

    def power(self, time: float, motion: ClosedMotion, rates: FloatArray) -> FloatArray:
        """What is done (1,) in W."""

    def kept(self, time: float, motion: ClosedMotion, rates: FloatArray) -> FloatArray:
        """The rates (1, n) nearest to these that are allowed."""

    def pose(self, time: float) -> FloatArray | None:
        """Where the platform must be (m,); None where nothing says it."""


class StepsInTime:
    """Of Runge-Kutta of the eighth order, by states: joint values, their rates, work, all without dimensions."""

    def __init__(self, equation: EquationOfMotion, law: LawOfMotion, watch: Watch | None = None) -> None:
        record = equation.record
        length = METRES[record.unit] * characteristic_length(record)
        self.equation, self.law, self.watch = equation, law, watch
        self.count = len(record.coordinates)
        self.units = np.concatenate(
            [joint_units(record), joint_scales_si(record), [max(equation.masses.total, 1e-300) * length**2]]
        )
        self.least = np.repeat([OF_PLACES, OF_RATES], [self.count, self.count + 1])
        self.solver: Any = None

    def state(self, values: FloatArray, rates: FloatArray, work: float) -> FloatArray:
        """The state (2 n + 1,) of joint values and rates (n,) and work."""
        return np.asarray(np.concatenate([values, rates, [work]]) / self.units)

    def parts(self, state: FloatArray) -> tuple[FloatArray, FloatArray, float]:
        """Joint values and rates (n,), and work, of a state."""
        whole = state * self.units
        return whole[: self.count], whole[self.count : -1], float(whole[-1])

    def to(self, states: list[tuple[float, FloatArray]], time: float) -> Departure | None:
        """Go on from the last of the states to a time; the state there, or at the event that ended it, follows them."""
        if self.solver is None:
            solver_of: Any = DOP853  # whose types know neither arrays of tolerances nor that steps fail
            self.solver = solver_of(self._change, *states[-1], time, rtol=RELATIVE, atol=self.least)
        solver = self.solver
        solver.t_bound, solver.status = time, "running"
        while solver.t < time:
            solver.step()
            event = self._event()
            if event is not None:
                if solver.status != "failed":
                    states.append((event.time, self._closed(event.time, solver.dense_output()(event.time))))
                return event
            solver.y = self._closed(float(solver.t), solver.y)
            solver.f = solver.fun(solver.t, solver.y)
        states.append((time, solver.y))
        return None

    def _event(self) -> Departure | None:
        """What ends the motion in the last step."""
        solver, watch = self.solver, self.watch
        if solver.status == "failed":
            return too_fast(self.equation.record, float(solver.t), self.parts(solver.y)[0])
        if watch is None:
            return None
        return watch.event(partial(self._values, solver.dense_output()), float(solver.t_old or 0.0), float(solver.t))

    def _values(self, between: Callable[[float], FloatArray], time: float) -> FloatArray:
        """Joint values (n,) at a time within a step."""
        return np.asarray(between(time)[: self.count] * self.units[: self.count])

    def _change(self, time: float, state: FloatArray) -> FloatArray:
        values, rates, _ = (np.atleast_2d(part) for part in self.parts(state))
        motion = self.equation.motion(values)
        second, power = self.law.second(time, motion, rates), self.law.power(time, motion, rates)
        change = self.equation.value_rates(values, rates)[0], second[0], power
        return np.asarray(np.concatenate(change) / self.units)

    def _closed(self, time: float, state: FloatArray) -> FloatArray:
        """The state with its loops closed, and rates that keep them so."""
        values, rates, work = self.parts(state)
        record = self.equation.record
        assembled = assemble(record, values[None], poses=self.law.pose(time), near=True)
        near = whole_turns_less(record, assembled.values)
        return self.state(near[0], self.law.kept(time, self.equation.motion(near), rates[None])[0], work)
