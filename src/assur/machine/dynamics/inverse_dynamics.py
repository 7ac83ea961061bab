"""Forces of the actuators along a motion of the platform that is prescribed in time, the mode kept.

The poses are followed from the first on (`assur.kinematics.following`): a motion that meets a singularity, the border
of reach or a limit of the file is refused, with the moment and with what goes to zero there.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError, cut
from assur.kinematics.border import checked_poses, drives_of
from assur.kinematics.status import Status
from assur.machine.dynamics.departure import Departure
from assur.machine.dynamics.equation_of_motion import EquationOfMotion
from assur.machine.dynamics.followed_motion import followed_motion
from assur.machine.dynamics.idle_motion import swung
from assur.machine.dynamics.prescribed_motion import PrescribedMotion
from assur.machine.forces.actuator_forces import ActuatorForces, force_units, forces_at
from assur.machine.forces.loads import load_of
from assur.machine.forces.utilisation import Utilisation, peak, rms, utilisation
from assur.machine.masses.link_masses import all_masses
from assur.machine.motion.screws import rate_metres
from assur.model.mechanism import MechanismRecord
from assur.results.notebook import Entries, Tabulated

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class MotionForces(Tabulated):
    """Forces along a motion, at N moments, in SI units; none where the motion is refused.

    Attributes:
        record: the mechanism.
        times: (N,) in s.
        poses: (N, m) in the mechanism's unit and rad.
        velocities, accelerations: (N, k) of the pose, in m or rad, per s and s2.
        inputs: (N, d) printed inputs, in the mechanism's unit and rad, angles without jumps.
        answer: forces, energies, rates of inputs (`machine.forces.actuator_forces.ActuatorForces`); None where refused.
        departure: why the motion is refused; None where it is not.
        swings: whether rods weigh beside the axes about which nothing drives them, so that they swing on their own.
    """

    record: MechanismRecord
    times: FloatArray
    poses: FloatArray
    velocities: FloatArray
    accelerations: FloatArray
    inputs: FloatArray
    answer: ActuatorForces | None
    departure: Departure | None
    swings: bool = False

    @property
    def status(self) -> str:
        """The most severe of all moments; of a motion that is refused what it comes to."""
        if self.answer is None:
            return self.departure.kind if self.departure else ""
        return Status(int(self.answer.status.max())).name

    @property
    def forces(self) -> FloatArray:
        """What each actuator exerts (N, d), N or N m, friction left aside."""
        return np.empty((0, len(self.record.drives))) if self.answer is None else self.answer.forces

    @property
    def rates(self) -> FloatArray:
        """Rates of the inputs (N, d), m/s or rad/s."""
        return np.empty((0, len(self.record.drives))) if self.answer is None else self.answer.input_rates

    @cached_property
    def with_friction(self) -> FloatArray:
        """What each actuator exerts (N, d) with friction; where an input rests, what it needs at most."""
        if self.answer is None:
            return self.forces
        resting = self.rates == 0.0
        held = np.where(resting, np.sign(self.forces) * self.answer.friction_band, self.answer.friction)
        return np.asarray(self.forces + held)

    @property
    def kinetic_energy(self) -> FloatArray:
        """(N,) in J."""
        return np.empty(0) if self.answer is None else self.answer.kinetic_energy

    @property
    def potential_energy(self) -> FloatArray:
        """(N,) in J."""
        return np.empty(0) if self.answer is None else self.answer.potential_energy

    @property
    def peak(self) -> FloatArray:
        """The largest force (d,) of each actuator, either way; NaN where the motion is refused."""
        return peak(self.forces)

    @property
    def rms(self) -> FloatArray:
        """The root of the mean square (d,) of the forces over time; NaN where the motion is refused."""
        return rms(self.times, self.forces)

    def utilisation(self, *, friction: bool = False) -> Utilisation:
        """Shares of what each actuator can, with friction or without.

        >>> import assur
        >>> from assur.machine.dynamics.prescribed_motion import harmonic
        >>> fivebar = assur.load("fivebar")
        >>> answer = fivebar.dynamics(harmonic(fivebar, [0.0, 224.0], [10.0, 0.0], omega=6.28, count=9))
        >>> bool((answer.utilisation(friction=True).force >= answer.utilisation().force).all())
        True
        """
        return utilisation(self.record, self.with_friction if friction else self.forces, self.rates)

    def _title(self) -> str:
        return f"forces of {self.record.name} along a motion ({self.status})"

    def _entries(self) -> Entries:
        if self.answer is None:
            return []
        units = force_units(self.record)
        names = [f"{own.name} [{unit}]" for own, unit in zip(self.record.drives, units, strict=True)]
        return [
            {"t [s]": float(time), **dict(zip(names, row.tolist(), strict=True))}
            for time, row in zip(self.times, self.forces, strict=True)
        ]

    def __str__(self) -> str:
        if self.departure is not None:
            return f"motion of {self.record.name} refused: {self.departure.text}"
        rows = [
            f"{item.name}: at most {peak:.6g} {unit}, rms {rms:.6g} {unit}"
            for item, peak, rms, unit in zip(
                self.record.drives, self.peak, self.rms, force_units(self.record), strict=True
            )
        ]
        span = f"{self.times[0]:.6g} s to {self.times[-1]:.6g} s"
        return "\n".join([f"forces of {self.record.name} from {span} ({self.status})", *rows])


def dynamics(
    record: MechanismRecord,
    motion: PrescribedMotion,
    mode: str | None = None,
    load: ArrayLike | None = None,
    *,
    gravity: bool = True,
    use_limits: bool = True,
) -> MotionForces:
    """Forces of the actuators along a motion that begins in a working mode (the file's default where none is given).

    Args:
        record: the mechanism.
        motion: of `machine.dynamics.prescribed_motion.harmonic` or `sampled`, or of `motion_file.read_motion`.
        mode: the working mode.
        load: (3,) force in N on the platform at its point, or (6,) with a moment in N m, in the base frame.
        gravity: whether it acts.
        use_limits: whether strokes of inputs and limits of joints bound the motion.

    Errors:
        UsageError: links without a mass, no motion.

    Example: the Delta carries its payload round a circle of 200 mm, once in 0.4 s.

    >>> import numpy as np
    >>> from assur.machine.dynamics.prescribed_motion import harmonic
    >>> from assur.model.registry import load_record
    >>> delta = load_record("delta_4s")
    >>> around = harmonic(delta, [0, 0, -0.9], [0.1, 0.1, 0], 5 * np.pi, [0, np.pi / 2, 0])
    >>> answer = dynamics(delta, around)
    >>> len(answer.times), answer.status
    (65, 'regular')
    """
    if not isinstance(motion, PrescribedMotion):
        raise UsageError(
            f"motion: {cut(repr(motion))} is no prescribed motion",
            hint="one comes from harmonic or sampled of assur.machine.dynamics.prescribed_motion",
        )
    equation = EquationOfMotion(record, all_masses(record), load_of(load, gravity))
    times = motion.times
    joints, departure = followed_motion(record, motion, mode, use_limits=use_limits)
    rates, swinging = None, False
    if departure is None:
        swinging = equation.motion(joints[[0, len(joints) // 2, -1]]).swings
        if swinging:
            joints, rates, departure = swung(equation, motion, joints[0])
    poses, velocities, accelerations = motion.at(times)
    poses = checked_poses(record, poses)
    if departure is not None:
        nothing, none = np.empty((0, velocities.shape[1])), np.empty((0, len(record.drives)))
        return MotionForces(record, times[:0], poses[:0], nothing, nothing, none, None, departure)
    velocities, accelerations = velocities * rate_metres(record), accelerations * rate_metres(record)
    answer = forces_at(record, joints, equation.load, velocities, accelerations, joint_rates=rates)
    inputs = drives_of(record, joints)
    return MotionForces(record, times, poses, velocities, accelerations, inputs, answer, None, swinging)
