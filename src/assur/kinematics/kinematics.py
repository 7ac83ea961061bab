"""`Kinematics`: a record with its positions, velocities and paths as methods, each one line to its function.

What is not asked at once is imported where it is called: a command loads what it prints and no more.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import called
from assur.joint_graph.frames import Frame, frames
from assur.kinematics import closure, position
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.border import Named, checked_joints, joint_array
from assur.kinematics.home import home_values
from assur.kinematics.modes import Method
from assur.model.mechanism import MechanismRecord

if TYPE_CHECKING:
    from assur.kinematics.certified.certify import Way as ProofWay
    from assur.kinematics.certified.result import CertifiedSolutions
    from assur.kinematics.following.path import Path
    from assur.kinematics.rates.instantaneous import Instant
    from assur.kinematics.rates.velocity import VelocityMap

FloatArray = NDArray[np.float64]


class Kinematics(MechanismRecord):
    """Positions, velocities and paths of a mechanism. Joint values may be given by name, as `Solution.joints` has them.

    Poses have m numbers and k rates, inputs n numbers, the joint graph c coordinates; (...) is any batch.
    """

    def direct(
        self, inputs: ArrayLike, mode: str | None = None, method: Method = "auto", *, crossed: bool = False
    ) -> SolutionSet:
        """Every pose at inputs (..., n), in the mechanism's unit and rad: `assur.kinematics.position.direct`.

        Without a `mode` all assembly modes. The answer has a `Status` for each solution; `unreachable` where there is
        none. Errors: UsageError for a wrong shape or what is not finite; UnknownNameError for a mode that there is not.

        >>> import assur
        >>> solutions = assur.load("zeng2019").direct([162.6907, -143.3209, -24.6776])  # Table 1 of Zeng et al. 2019
        >>> [(solution.mode, solution.pose[0].round(4).item()) for solution in solutions]
        [('+++', -15.4714), ('++-', -83.0873), ('--+', -83.0873), ('---', -15.4714)]
        """
        return position.direct(self, inputs, mode, method, crossed=crossed)

    def inverse(
        self, poses: ArrayLike, mode: str | None = None, method: Method = "auto", *, crossed: bool = False
    ) -> SolutionSet:
        """All inputs at poses (..., m), in the mechanism's unit and rad: `assur.kinematics.position.inverse`.

        Without a `mode` all working modes. Status and errors are as those of `direct`.

        >>> import assur
        >>> solutions = assur.load("zeng2019").inverse([-15.4714, 9.6849, 456.3315], "++-++")  # Table 2, row 4
        >>> solutions.inputs.round(3).tolist()
        [[162.691, -143.321, -24.678]]
        """
        return position.inverse(self, poses, mode, method, crossed=crossed)

    def certified_direct(self, inputs: ArrayLike, way: ProofWay = "auto") -> CertifiedSolutions:
        """The poses at inputs (n,), each in bounds that are proved: `assur.kinematics.certified.certify`.

        Lengths in the mechanism's unit, angles in rad. What cannot be proved is listed as undecided, with what is in
        the way. Errors: UsageError for a `way` that is not possible, and for a wrong shape.

        >>> import assur
        >>> assur.load("fivebar").certified_direct([1.0, 1.0]).headline
        'proved, 2 solutions and no other'
        """
        from assur.kinematics.certified.certify import certified_direct

        return certified_direct(self, inputs, way)

    def certified_inverse(self, pose: ArrayLike, way: ProofWay = "auto") -> CertifiedSolutions:
        """The inputs at a pose (m,), each in bounds that are proved; all else is as of `certified_direct`.

        >>> import assur
        >>> proved = assur.load("zeng2019").certified_inverse([-15.4714, 9.6849, 456.3315])
        >>> proved.headline, max(solution.width for solution in proved.solutions) < 1e-10
        ('proved, 8 solutions and no other', True)
        """
        from assur.kinematics.certified.certify import certified_inverse

        return certified_inverse(self, pose, way)

    def velocity_map(self, poses: ArrayLike, mode: str | None = None) -> VelocityMap:
        """Jp (..., k, k) and Jq (..., k, n) of Jp v = Jq q' at poses (..., m): `assur.kinematics.rates.velocity`.

        In a working mode, the file's default without one. Rates are in the mechanism's unit and rad per s; where Jp
        is singular they are NaN, and `singular_output` says so. Errors: UsageError, UnknownNameError as of `inverse`.

        All inputs of the paper's mechanism at one speed move its platform along Y, Eq. (25):

        >>> import assur
        >>> velocities = assur.load("zeng2019").velocity_map([-15.4714, 9.6849, 456.3315])
        >>> (velocities.output([1.0, 1.0, 1.0]).round(9) + 0.0).tolist()
        [0.0, 1.0, 0.0]
        """
        from assur.kinematics.rates.velocity import velocity_map

        return velocity_map(self, poses, mode)

    def velocity_map_at(self, joint_values: Named) -> VelocityMap:
        """The same from the joint graph alone, at joint values (..., c) or by name, of an assembly.

        >>> import assur
        >>> mechanism = assur.load("zeng2019")
        >>> solution = next(iter(mechanism.inverse([-15.4714, 9.6849, 456.3315], "++-++")))
        >>> (mechanism.velocity_map_at(solution.joints).output([1.0, 1.0, 1.0]).round(9) + 0.0).tolist()
        [0.0, 1.0, 0.0]
        """
        from assur.kinematics.rates.velocity import velocity_map_at

        return velocity_map_at(self, joint_values)

    def acceleration(
        self,
        poses: ArrayLike,
        input_rates: ArrayLike,
        input_accelerations: ArrayLike,
        mode: str | None = None,
    ) -> tuple[FloatArray, FloatArray]:
        """Velocity and acceleration (..., k) of the pose at poses (..., m): `assur.kinematics.rates.acceleration`.

        Rates and accelerations of inputs are (..., n), all in the mechanism's unit and rad, per s and s2. NaN where the
        mode does not reach the pose or Jp is singular. Errors: UsageError, UnknownNameError as of `inverse`.

        From rest the platform starts as the velocity map says of its inputs' accelerations:

        >>> import assur
        >>> fivebar, pose = assur.load("fivebar"), [20.0, 224.0]
        >>> _, starting = fivebar.acceleration(pose, [0.0, 0.0], [1.0, -1.0])
        >>> bool(abs(starting - fivebar.velocity_map(pose).output([1.0, -1.0])).max() < 1e-9)
        True
        """
        from assur.kinematics.rates.acceleration import acceleration

        return acceleration(self, poses, input_rates, input_accelerations, mode)

    def instantaneous(self, joint_values: Named) -> Instant:
        """First-order motion at joint values (..., c) or by name: ranks, freedoms and the six types of singularity.

        Where joint values do not close the loops `closed` is false and matrices are NaN. `gap` says how clear
        ranks are: a singular value kept over the largest dropped. See `assur.kinematics.rates.instantaneous`.

        >>> import assur
        >>> fivebar = assur.load("fivebar")
        >>> motion = fivebar.instantaneous(fivebar.home_values)
        >>> int(motion.ranks.freedoms), [name for name, holds in motion.types.items() if holds]
        (2, [])
        """
        from assur.kinematics.rates.instantaneous import instantaneous

        return instantaneous(self, joint_values)

    def follow(self, joint_values: Named, **options: Any) -> Path:
        """The path from an assembly (c,), or by name, to `inputs` (n,) or to a pose `poses` (m,), its mode kept.

        What it would have to pass, a singularity or a limit, stops it: `stopped` says what and where. Options and
        errors are those of `assur.kinematics.following.following.follow`.

        The five-bar's point goes up until crank and rod are in line, at sqrt((l1 + l2)^2 - g^2):

        >>> import assur
        >>> fivebar = assur.load("fivebar")
        >>> start = next(iter(fivebar.inverse([0.0, 200.0], "-+")))
        >>> path = fivebar.follow(start.joints, poses=[0.0, 400.0])
        >>> path.stopped.kind, path.poses[-1, 1].round(3).item(), round((294**2 - 70**2) ** 0.5, 3)
        ('serial', 285.545, 285.545)
        """
        from assur.kinematics.following.following import follow

        return called(follow, self, checked_joints(self, joint_values), **options)

    @property
    def home_values(self) -> FloatArray:
        """Joint values (c,) of the assembled home, in the mechanism's unit and rad, in the order of `coordinates`."""
        return home_values(self)

    def point(self, name: str, joint_values: Named) -> FloatArray:
        """Position (..., 3) of a lettered point or of a joint, in the base frame, at joint values (..., c) or by name.

        Errors: UnknownNameError for a letter that there is not.

        >>> import assur
        >>> fivebar = assur.load("fivebar")
        >>> solution = next(iter(fivebar.inverse([0.0, 224.0])))
        >>> (fivebar.point("P", solution.joints).round(9) + 0.0).tolist()
        [0.0, 224.0, 0.0]
        """
        from assur.joint_graph.points import point

        return point(self, name, joint_array(self, joint_values))

    def frames(self, joint_values: Named) -> dict[str, Frame]:
        """Frame of every link in the base frame: rotation (..., 3, 3) and origin (..., 3), at joint values (..., c).

        >>> import assur
        >>> fivebar = assur.load("fivebar")
        >>> rotation, origin = fivebar.frames(fivebar.home_values)[fivebar.base]
        >>> rotation.trace().item(), origin.tolist()
        (3.0, [0.0, 0.0, 0.0])
        """
        return frames(self, joint_array(self, joint_values))

    def closure_error(self, joint_values: Named) -> FloatArray:
        """Largest gap (...) over the cut joints at joint values (..., c), in length units; 0 at an assembly.

        >>> import assur
        >>> fivebar = assur.load("fivebar")
        >>> bool(fivebar.closure_error(fivebar.home_values) < 1e-9), bool(fivebar.closure_error([0.0] * 5) > 1.0)
        (True, True)
        """
        return closure.closure_error(self, joint_array(self, joint_values))

    def mobility(self, joint_values: Named) -> closure.AssemblyMobility:
        """Rank, freedoms and redundant constraints (...) of the joint graph at assemblies (..., c).

        >>> import assur
        >>> fivebar = assur.load("fivebar")
        >>> int(fivebar.mobility(fivebar.home_values).freedoms)
        2
        """
        return closure.mobility(self, joint_array(self, joint_values))
