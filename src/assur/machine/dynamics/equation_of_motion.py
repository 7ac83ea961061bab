"""The equation of motion where forces are given: how all joints speed up.

For joint rates u the loops ask for A u = 0 and A u' + A' u = 0. Along the motions N that keep them closed

    N^T (M u' + h + g - D^T tau - J^T w) = 0

decides, as in `assur.machine.forces.actuator_forces`; so constraints that say the same twice do no harm.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.machine.forces.loads import Load
from assur.machine.masses.link_masses import Masses
from assur.machine.motion.inertia import link_inertia
from assur.machine.motion.joint_motion import MASSLESS, ClosedMotion, closed_motion, joint_scales_si
from assur.machine.motion.screws import rate_units
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class EquationOfMotion:
    """Of a mechanism with its masses, under a load."""

    record: MechanismRecord
    masses: Masses
    load: Load

    def motion(self, values: FloatArray) -> ClosedMotion:
        """What the joints can do at joint values (N, n)."""
        return closed_motion(link_inertia(self.record, values, self.masses), values)

    def accelerations(self, motion: ClosedMotion, rates: FloatArray, forces: FloatArray) -> FloatArray:
        """Of the joints (N, n) at rates (N, n), for forces (N, d) of the actuators, in SI units."""
        inertia = motion.inertia
        closing = motion.second(rates, np.zeros((len(rates), motion.pose.shape[1])))
        needed = self.needed(motion, rates, closing) - forces @ motion.drives
        across = np.swapaxes(motion.free, -1, -2)
        sizes, vectors = np.linalg.eigh(across @ inertia.matrix @ motion.free)
        kept = sizes > MASSLESS * sizes[:, -1:]
        moved = np.swapaxes(vectors, -1, -2) @ (across @ needed[..., None])
        moved *= np.where(kept, 1.0 / np.where(kept, sizes, 1.0), 0.0)[..., None]
        return np.asarray(closing - (motion.free @ (vectors @ moved))[..., 0])

    def needed(self, motion: ClosedMotion, rates: FloatArray, second: FloatArray) -> FloatArray:
        """M u' + h + g - J^T w (N, n) at rates and accelerations (N, n): what is left to the actuators."""
        inertia = motion.inertia
        weight = inertia.weight if self.load.gravity else 0.0
        pushed = np.einsum("nkj,nk->nj", motion.platform, self.load.wrench_at(motion.point))
        return np.asarray(inertia.needed(rates, second) + weight - pushed)

    def power(self, motion: ClosedMotion, rates: FloatArray, forces: FloatArray) -> FloatArray:
        """Of the actuators and the load (N,) in W."""
        twists = (motion.platform @ rates[..., None])[..., 0]
        own = np.sum(forces * (rates @ motion.drives.T), axis=-1)
        return np.asarray(own + np.sum(self.load.wrench_at(motion.point) * twists, axis=-1))

    def value_rates(self, values: FloatArray, rates: FloatArray) -> FloatArray:
        """How joint values change (N, n), in the mechanism's unit and rad, at joint rates (N, n) in SI units."""
        changes = rates / rate_units(self.record)
        for turn in joint_graph(self.record).turns:
            changes[:, turn] = rotations.vector_rates(values[:, turn], changes[:, turn])
        return changes

    def closing_rates(self, motion: ClosedMotion, rates: FloatArray) -> FloatArray:
        """The rates (N, n) nearest to these that keep the loops closed."""
        scales = joint_scales_si(self.record)
        share = np.swapaxes(motion.free, -1, -2) @ (rates / scales**2)[..., None]
        return np.asarray((motion.free @ share)[..., 0])
