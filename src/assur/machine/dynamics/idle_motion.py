"""Motions that nothing drives, as the swing of a rod that weighs beside its axis, while the pose moves as prescribed.

Neither inputs nor platform feel how a rod between ball joints spins. Where its weight and inertia are the same however
it spins, nothing depends on it, and it keeps the least kinetic energy. Elsewhere its own equation of motion decides

    N^T (M u' + h + g - J^T w) = 0

with N the motions that leave inputs and pose as they are, from where the motion begins on. So what is exerted along it
is what gives the motion back.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.machine.dynamics.departure import Departure
from assur.machine.dynamics.equation_of_motion import EquationOfMotion
from assur.machine.dynamics.prescribed_motion import PrescribedMotion
from assur.machine.motion.joint_motion import ClosedMotion
from assur.machine.motion.screws import rate_metres
from assur.work import stage

FloatArray = NDArray[np.float64]


def swung(
    equation: EquationOfMotion, prescribed: PrescribedMotion, first: FloatArray
) -> tuple[FloatArray, FloatArray, Departure | None]:
    """Joint values and rates (N, n) at the moments of a motion that begins at joint values (n,), and what ends it."""
    from assur.machine.dynamics.steps import StepsInTime  # with the integrators of SciPy

    law = _ByPose(equation, prescribed)
    begin, motion = float(prescribed.times[0]), equation.motion(first[None])
    steps = StepsInTime(equation, law)
    departure = None
    states = [(begin, steps.state(first, motion.rates(law.at(begin)[1])[0], 0.0))]
    with stage("motions that nothing drives", len(prescribed.times)) as work:
        for time in prescribed.times[1:].tolist():
            departure = steps.to(states, time)
            if departure is not None:
                break
            work.at(len(states), len(prescribed.times), f"{time:.3g} s")
    values, rates, _ = (np.array(part) for part in zip(*(steps.parts(state) for _, state in states), strict=True))
    return values, rates, departure


@dataclass(frozen=True, eq=False)
class _ByPose:
    """The law of a motion whose pose is prescribed."""

    equation: EquationOfMotion
    prescribed: PrescribedMotion

    def at(self, time: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Pose (1, m), rates and accelerations (1, k), these in SI units."""
        pose, velocity, acceleration = self.prescribed.at(np.array([time]))
        metres = rate_metres(self.equation.record)
        return pose, velocity * metres, acceleration * metres

    def second(self, time: float, motion: ClosedMotion, rates: FloatArray) -> FloatArray:
        closing = motion.second(rates, self.at(time)[2])
        return np.asarray(closing + motion.idle_accelerations(self.equation.needed(motion, rates, closing)))

    def power(self, _time: float, _motion: ClosedMotion, rates: FloatArray) -> FloatArray:
        return np.zeros(len(rates))

    def kept(self, time: float, motion: ClosedMotion, rates: FloatArray) -> FloatArray:
        closed = self.equation.closing_rates(motion, rates)
        return closed + motion.along(self.at(time)[1] - (motion.pose @ closed[..., None])[..., 0])

    def pose(self, time: float) -> FloatArray:
        return self.at(time)[0]
