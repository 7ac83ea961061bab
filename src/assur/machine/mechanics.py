"""`Mechanics`: a mechanism with masses, springs and tolerances; its forces, motions and errors as methods."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from assur.errors import called
from assur.kinematics.kinematics import Kinematics

if TYPE_CHECKING:
    from assur.machine.accuracy.pose_errors import PoseErrors
    from assur.machine.dynamics.free_motion import FreeMotion
    from assur.machine.dynamics.inverse_dynamics import MotionForces
    from assur.machine.dynamics.prescribed_motion import PrescribedMotion
    from assur.machine.dynamics.release import Release
    from assur.machine.dynamics.small_motions import SmallMotions
    from assur.machine.elasticity.stiffness import Stiffness
    from assur.machine.forces.actuator_forces import ActuatorForces


class Mechanics(Kinematics):
    """Forces, stiffness, motions in time and errors of a mechanism.

    Poses (..., m) are in the mechanism's unit and rad, answers in SI units, one for each of the N poses of the
    flattened batch. Links without a mass where one is needed are a UsageError.
    """

    def forces(
        self,
        poses: ArrayLike,
        velocity: ArrayLike | None = None,
        acceleration: ArrayLike | None = None,
        load: ArrayLike | None = None,
        *,
        gravity: bool = True,
        mode: str | None = None,
    ) -> ActuatorForces:
        """Forces (N, d) of the actuators in N or N m, energies and terms of motion at poses (..., m).

        Velocity and acceleration of the pose are (..., k), the load on the platform (..., 3) in N or (..., 6) with a
        moment in N m. A status says where there is no answer; see `assur.machine.forces.actuator_forces`.

        What holds 100 N does as much work as they do, whatever the platform's rate:

        >>> import assur
        >>> mechanism, pose = assur.load("zeng2019"), [-15.4714, 9.6849, 456.3315]
        >>> answer = mechanism.forces(pose, load=[0, 0, -100], gravity=False)
        >>> float(answer.forces[0] @ mechanism.velocity_map(pose).input([0, 0, 1])).__round__(6)
        100.0
        """
        from assur.machine.forces.actuator_forces import forces

        return forces(self, poses, velocity, acceleration, load, gravity=gravity, mode=mode)

    def stiffness(self, poses: ArrayLike, mode: str | None = None, *, shear: bool = True) -> Stiffness:
        """How the platform gives way at poses (..., m): stiffness and compliance (N, 6, 6) in N, m and rad.

        Errors: UsageError for an actuator without stiffness, a profile without material; see
        `assur.machine.elasticity.stiffness`.

        >>> import assur
        >>> answer = assur.load("zeng2019").stiffness([-15.4714, 9.6849, 456.3315])
        >>> values, directions = answer.translational
        >>> values.shape, directions.shape, bool((values < answer.actuator_only.translational[0]).all())
        ((1, 3), (1, 3, 3), True)
        """
        from assur.machine.elasticity.stiffness import stiffness

        return stiffness(self, poses, mode, shear=shear)

    def dynamics(self, motion: PrescribedMotion, mode: str | None = None, **options: Any) -> MotionForces:
        """Forces (N, d) of the actuators along a motion in time; its `status` says where it could not go on.

        Options are those of `assur.machine.dynamics.inverse_dynamics.dynamics`.

        >>> import assur
        >>> from assur.machine.dynamics.prescribed_motion import harmonic
        >>> fivebar = assur.load("fivebar")
        >>> answer = fivebar.dynamics(harmonic(fivebar, [0.0, 224.0], [10.0, 0.0], omega=6.28, count=9))
        >>> answer.status, answer.forces.shape
        ('regular', (9, 2))
        """
        from assur.machine.dynamics.inverse_dynamics import dynamics

        return called(dynamics, self, motion, mode, **options)

    def free_motion(self, release: Release, mode: str | None = None, **options: Any) -> FreeMotion:
        """The motion from a start by given forces of the actuators, without friction; `status` says what ended it.

        Options are those of `assur.machine.dynamics.free_motion.free_motion`.

        >>> import assur, numpy as np
        >>> from assur.machine.dynamics.release import Release
        >>> start = Release(np.array([0.0, 224.0]), np.zeros(2), 0.01, lambda time: np.zeros(2), count=3)
        >>> fallen = assur.load("fivebar").free_motion(start)
        >>> fallen.status, fallen.drift < 1e-9, fallen.gap < 1e-10  # energy that came from nowhere; loops
        ('regular', True, True)
        """
        from assur.machine.dynamics.free_motion import free_motion

        return called(free_motion, self, release, mode, **options)

    def small_motions(self, pose: ArrayLike, mode: str | None = None, **options: Any) -> SmallMotions:
        """Small motions about a pose (m,) that the actuators hold: M, D, K (k, k) and the poles in 1/s.

        Options are those of `assur.machine.dynamics.small_motions.small_motions`.

        >>> import assur
        >>> flat = assur.load("fivebar").small_motions([0.0, 224.0])  # it lies flat and stays where it is pushed to
        >>> flat.stable, len(flat.frequencies)
        (True, 0)
        """
        from assur.machine.dynamics.small_motions import small_motions

        return called(small_motions, self, pose, mode, **options)

    def errors(self, pose: ArrayLike, mode: str | None = None) -> PoseErrors:
        """How errors of dimensions and inputs move the platform at a pose (m,): (6,) for one unit of each.

        Errors: UsageError for a pose of another shape; see `assur.machine.accuracy.pose_errors`.

        `l7` and `l8` of the paper's mechanism act by their sum:

        >>> import assur
        >>> sensitivity = assur.load("zeng2019").errors([-15.4714, 9.6849, 456.3315]).sensitivity
        >>> bool(abs(sensitivity["l7"] - sensitivity["l8"]).max() < 1e-9)
        True
        """
        from assur.machine.accuracy.pose_errors import pose_errors

        return pose_errors(self, pose, mode)
