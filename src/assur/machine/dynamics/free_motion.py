"""The motion of a mechanism that is left to the forces of its actuators, gravity and a load.

Runge-Kutta of the eighth order takes steps by the equation of motion; after each the loops are closed again, and rates
that would open them are left out. An event of the watch ends it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError, cut
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import checked_poses, drives_of
from assur.kinematics.closure import closure_error
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.acceleration import joints_in_mode
from assur.kinematics.status import Status
from assur.machine.dynamics.departure import Departure, not_begun
from assur.machine.dynamics.equation_of_motion import EquationOfMotion
from assur.machine.dynamics.release import Release
from assur.machine.dynamics.steps import StepsInTime
from assur.machine.dynamics.watch import watch
from assur.machine.forces.loads import load_of
from assur.machine.masses.link_masses import all_masses
from assur.machine.motion.joint_motion import ClosedMotion
from assur.machine.motion.screws import rate_metres, screw_rates
from assur.model.mechanism import MechanismRecord
from assur.results.notebook import Entries, Tabulated
from assur.work import stage

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class FreeMotion(Tabulated):
    """The motion from a start, at N moments, in SI units.

    Attributes:
        record: the mechanism.
        times: (N,) in s.
        values: (N, n) joint values, in the mechanism's unit and rad.
        joint_rates, joint_accelerations: (N, n).
        forces: (N, d) of the actuators.
        work: (N,) what these and the load did, in J.
        under_gravity: whether it acts.
        motion: of the joints at these moments.
        departure: the event that ended it, or why it could not begin; None where it went on to its end.
    """

    record: MechanismRecord
    times: FloatArray
    values: FloatArray
    joint_rates: FloatArray
    joint_accelerations: FloatArray
    forces: FloatArray
    work: FloatArray
    under_gravity: bool
    motion: ClosedMotion
    departure: Departure | None

    @property
    def status(self) -> str:
        """What ended it: an event, or `regular` where it went on to its end."""
        return self.departure.kind if self.departure else Status.regular.name

    @cached_property
    def poses(self) -> FloatArray:
        """(N, m) in the mechanism's unit and rad."""
        return pose_of(self.record, self.values)

    @cached_property
    def velocities(self) -> FloatArray:
        """(N, k) of the pose, in m or rad per s."""
        return np.asarray((self.motion.pose @ self.joint_rates[..., None])[..., 0])

    @cached_property
    def accelerations(self) -> FloatArray:
        """(N, k) of the pose, in m or rad per s2."""
        own = (self.motion.pose @ self.joint_accelerations[..., None])[..., 0]
        changes = screw_rates(self.record, self.motion.inertia.screws, self.joint_rates)
        return np.asarray(own + self.motion.pose_bias(self.joint_rates, changes))

    @cached_property
    def inputs(self) -> FloatArray:
        """(N, d) printed inputs, in the mechanism's unit and rad."""
        return drives_of(self.record, self.values)

    @cached_property
    def rates(self) -> FloatArray:
        """Of the inputs (N, d), in m/s or rad/s."""
        return np.asarray(self.joint_rates @ self.motion.drives.T)

    @cached_property
    def kinetic_energy(self) -> FloatArray:
        """(N,) in J."""
        return self.motion.inertia.kinetic(self.joint_rates)

    @property
    def potential_energy(self) -> FloatArray:
        """(N,) in J."""
        return self.motion.inertia.potential

    @cached_property
    def drift(self) -> float:
        """The largest energy that came from nowhere, as a share of the largest kinetic energy; 0 at rest."""
        whole = self.kinetic_energy + self.under_gravity * self.potential_energy - self.work
        largest = float(np.max(self.kinetic_energy, initial=0.0))
        return float(np.max(np.abs(whole - whole[0]))) / largest if largest else 0.0

    @cached_property
    def gap(self) -> float:
        """The largest gap of the loops, in characteristic lengths."""
        return float(np.max(closure_error(self.record, self.values))) / characteristic_length(self.record)

    def _title(self) -> str:
        return f"free motion of {self.record.name} ({self.status})"

    def _entries(self) -> Entries:
        energies = zip(self.kinetic_energy.tolist(), self.potential_energy.tolist(), strict=True)
        return [
            {"t [s]": float(time), **dict(zip(self.record.platform.pose, pose.tolist(), strict=True))}
            | {"kinetic [J]": kinetic, "potential [J]": potential}
            for time, pose, (kinetic, potential) in zip(self.times, self.poses, energies, strict=True)
        ]

    def __str__(self) -> str:
        end = self.departure.text if self.departure else "it goes on to its end"
        return f"free motion of {self.record.name}, {self.times[0]:.6g} s to {self.times[-1]:.6g} s: {end}"


def free_motion(
    record: MechanismRecord,
    release: Release,
    mode: str | None = None,
    load: ArrayLike | None = None,
    *,
    gravity: bool = True,
    use_limits: bool = True,
) -> FreeMotion:
    """The motion from a start in a working mode (the file's default where none is given), without friction.

    Args:
        record: the mechanism.
        release: the start, and forces of the actuators in time.
        mode: the working mode.
        load: (3,) force in N on the platform at its point, or (6,) with a moment in N m, in the base frame.
        gravity: whether it acts.
        use_limits: whether strokes of inputs and limits of joints end the motion.

    Errors:
        UsageError: links without a mass, a pose of a wrong shape, no release.

    Example: the five-bar's platform falls for 10 ms, by next to g t^2 / 2 if its cranks did not weigh.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> start = Release(np.array([0.0, 224.0]), np.zeros(2), 0.01, lambda _: np.zeros(2), count=3)
    >>> fallen = free_motion(record, start)
    >>> fallen.drift < 1e-9, fallen.gap < 1e-10
    (True, True)
    """
    if not isinstance(release, Release):
        raise UsageError(
            f"release: {cut(repr(release))} is no release",
            hint="it is a Release(pose, velocity, t_end, forces) of assur.machine.dynamics.release",
        )
    equation = EquationOfMotion(record, all_masses(record), load_of(load, gravity))
    pose = checked_poses(record, release.pose)
    values = joints_in_mode(record, pose[None], mode)
    if not np.all(np.isfinite(values)):
        raise UsageError(not_begun(record, release.t_start, pose, mode).text)
    watched = watch(record, values[0], use_limits=use_limits)
    run = StepsInTime(equation, _ByForces(equation, release), watched)
    rates = equation.motion(values).rates((release.velocity * rate_metres(record))[None])[0]
    departure = watched.at_start(release.t_start, values[0])
    states = [(release.t_start, run.state(values[0], rates, 0.0))]
    with stage("free motion", release.count) as work:
        for time in (
            np.linspace(release.t_start, release.t_end, release.count)[1:].tolist() if departure is None else []
        ):
            departure = run.to(states, time)
            work.at(len(states), result=f"{states[-1][0]:.3g} s")
            if departure is not None:
                break
    return _told(equation, release, [(time, *run.parts(state)) for time, state in states], departure)


@dataclass(frozen=True, eq=False)
class _ByForces:
    """The law of a motion by the forces of a release."""

    equation: EquationOfMotion
    release: Release

    def second(self, time: float, motion: ClosedMotion, rates: FloatArray) -> FloatArray:
        return self.equation.accelerations(motion, rates, self.release.forces(time)[None])

    def power(self, time: float, motion: ClosedMotion, rates: FloatArray) -> FloatArray:
        return self.equation.power(motion, rates, self.release.forces(time)[None])

    def kept(self, _: float, motion: ClosedMotion, rates: FloatArray) -> FloatArray:
        return self.equation.closing_rates(motion, rates)

    def pose(self, _: float) -> None:
        return None


def _told(
    equation: EquationOfMotion,
    release: Release,
    states: list[tuple[float, FloatArray, FloatArray, float]],
    departure: Departure | None,
) -> FreeMotion:
    """The motion of states: time, joint values and rates (n,), work."""
    record = equation.record
    times, values, rates, work = (np.array(part) for part in zip(*states, strict=True))
    forces = np.array([release.forces(time) for time in times]).reshape(len(times), len(record.drives))
    motion = equation.motion(values)
    return FreeMotion(
        record=record,
        times=times,
        values=values,
        joint_rates=rates,
        joint_accelerations=equation.accelerations(motion, rates, forces),
        forces=forces,
        work=work,
        under_gravity=equation.load.gravity,
        motion=motion,
        departure=departure,
    )
