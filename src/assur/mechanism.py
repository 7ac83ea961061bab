"""`Mechanism`: a record with its analyses as methods, each one line to the function that does the work.

An analysis is imported where it is called, but for the position problem: a command loads what it prints and no more.
What draws and writes stands above this module, and is looked up by its name when it is asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.joint_graph.frames import Frame, frames
from assur.kinematics import closure, position
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.border import Named, checked_joints, joint_array
from assur.kinematics.contract.admission import admitted_record, check_closed_form
from assur.kinematics.home import home_values
from assur.kinematics.modes import Method
from assur.model import registry
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, is_angle

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from assur.kinematics.certified.certify import Way as ProofWay
    from assur.kinematics.certified.result import CertifiedSolutions
    from assur.kinematics.following.path import Path as Way
    from assur.kinematics.rates.instantaneous import Instant
    from assur.kinematics.rates.velocity import VelocityMap
    from assur.machine.accuracy.pose_errors import PoseErrors
    from assur.machine.dynamics.free_motion import FreeMotion
    from assur.machine.dynamics.inverse_dynamics import MotionForces
    from assur.machine.dynamics.prescribed_motion import PrescribedMotion
    from assur.machine.dynamics.release import Release
    from assur.machine.dynamics.small_motions import SmallMotions
    from assur.machine.elasticity.stiffness import Stiffness
    from assur.machine.forces.actuator_forces import ActuatorForces
    from assur.performance.indices import Indices
    from assur.performance.scaling import Length
    from assur.singularity.verdict import Verdict
    from assur.topology.analysis import Mode
    from assur.topology.facts import Topology
    from assur.workspace.aspects.aspects import Aspects
    from assur.workspace.region import Workspace

FloatArray = NDArray[np.float64]


class Mechanism(MechanismRecord):
    """A mechanism, from `assur.load`. Poses are (..., m), inputs (..., n), lengths in its unit, angles in rad.

    Values of joints, inputs and poses may be given by name as well, as `Solution.joints` has them.
    """

    def with_parameters(self, /, **values: float) -> Self:
        """The same mechanism with other dimensions, checked as those of the file are."""
        from assur.model.dimensions import with_parameters  # which reads the file again

        changed = with_parameters(self, **values)
        check_closed_form(changed)
        return changed

    def direct(
        self, inputs: ArrayLike, mode: str | None = None, method: Method = "auto", *, crossed: bool = False
    ) -> SolutionSet:
        """Every pose at inputs (..., n): see `assur.kinematics.position.direct`."""
        return position.direct(self, inputs, mode, method, crossed=crossed)

    def inverse(
        self, poses: ArrayLike, mode: str | None = None, method: Method = "auto", *, crossed: bool = False
    ) -> SolutionSet:
        """All inputs at poses (..., m): see `assur.kinematics.position.inverse`."""
        return position.inverse(self, poses, mode, method, crossed=crossed)

    def velocity_map(self, poses: ArrayLike, mode: str | None = None) -> VelocityMap:
        """Jp and Jq at poses (..., m): see `assur.kinematics.rates.velocity.velocity_map`."""
        from assur.kinematics.rates.velocity import velocity_map

        return velocity_map(self, poses, mode)

    def velocity_map_at(self, joint_values: Named) -> VelocityMap:
        """Jp and Jq from the joint graph at joint values (..., n): see `assur.kinematics.rates.velocity`."""
        from assur.kinematics.rates.velocity import velocity_map_at

        return velocity_map_at(self, joint_values)

    def acceleration(
        self,
        poses: ArrayLike,
        input_rates: ArrayLike,
        input_accelerations: ArrayLike,
        mode: str | None = None,
    ) -> tuple[FloatArray, FloatArray]:
        """Velocity and acceleration of the pose: see `assur.kinematics.rates.acceleration`."""
        from assur.kinematics.rates.acceleration import acceleration

        return acceleration(self, poses, input_rates, input_accelerations, mode)

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
        """Forces of the actuators, energies and terms of motion at poses (..., m): `machine.forces.actuator_forces`."""
        from assur.machine.forces.actuator_forces import forces

        return forces(self, poses, velocity, acceleration, load, gravity=gravity, mode=mode)

    def stiffness(self, poses: ArrayLike, mode: str | None = None, *, shear: bool = True) -> Stiffness:
        """How the platform gives way at poses (..., m): see `machine.elasticity.stiffness.stiffness`."""
        from assur.machine.elasticity.stiffness import stiffness

        return stiffness(self, poses, mode, shear=shear)

    def dynamics(self, motion: PrescribedMotion, mode: str | None = None, **options: Any) -> MotionForces:
        """Forces of the actuators along a motion in time: options as `machine.dynamics.inverse_dynamics` has them."""
        from assur.machine.dynamics.inverse_dynamics import dynamics

        return dynamics(self, motion, mode, **options)

    def free_motion(self, release: Release, mode: str | None = None, **options: Any) -> FreeMotion:
        """The motion from a start by given forces: see `machine.dynamics.free_motion.free_motion` for the options."""
        from assur.machine.dynamics.free_motion import free_motion

        return free_motion(self, release, mode, **options)

    def small_motions(self, pose: ArrayLike, mode: str | None = None, **options: Any) -> SmallMotions:
        """Small motions about a held pose (m,): see `machine.dynamics.small_motions.small_motions` for the options."""
        from assur.machine.dynamics.small_motions import small_motions

        return small_motions(self, pose, mode, **options)

    def errors(self, pose: ArrayLike, mode: str | None = None) -> PoseErrors:
        """How errors of dimensions and inputs move the platform: see `machine.accuracy.pose_errors.pose_errors`."""
        from assur.machine.accuracy.pose_errors import pose_errors

        return pose_errors(self, pose, mode)

    def singularity(self, pose: ArrayLike, mode: str | None = None) -> Verdict:
        """The verdict on one pose (m,): see `assur.singularity.verdict`."""
        from assur.singularity.verdict import verdict

        return verdict(self, pose, mode)

    def singularity_at(self, joint_values: Named) -> Verdict:
        """The verdict on one configuration of the joint graph (n,): see `assur.singularity.verdict.verdict_at`."""
        from assur.singularity.verdict import verdict_at

        return verdict_at(self, joint_values)

    def instantaneous(self, joint_values: Named) -> Instant:
        """First-order motion at joint values (..., n): see `assur.kinematics.rates.instantaneous.instantaneous`."""
        from assur.kinematics.rates.instantaneous import instantaneous

        return instantaneous(self, joint_values)

    def certified_direct(self, inputs: ArrayLike, way: ProofWay = "auto") -> CertifiedSolutions:
        """The poses at inputs (n,), proved by intervals: see `assur.kinematics.certified.certify`."""
        from assur.kinematics.certified.certify import certified_direct

        return certified_direct(self, inputs, way)

    def certified_inverse(self, pose: ArrayLike, way: ProofWay = "auto") -> CertifiedSolutions:
        """The inputs at a pose (m,), proved by intervals: see `assur.kinematics.certified.certify`."""
        from assur.kinematics.certified.certify import certified_inverse

        return certified_inverse(self, pose, way)

    def workspace(self, mode: str | None = None, **options: Any) -> Workspace:
        """The workspace of a working mode: see `assur.workspace.region.workspace` for the options."""
        from assur.workspace.region import workspace

        return workspace(self, mode, **options)

    def aspects(self, mode: str | None = None, **options: Any) -> Aspects:
        """The aspects of a working mode, proved: see `assur.workspace.aspects.aspects.aspects` for the options."""
        from assur.workspace.aspects.aspects import aspects

        return aspects(self, mode, **options)

    def indices(self, poses: ArrayLike, mode: str | None = None, characteristic_length: Length = None) -> Indices:
        """Condition, manipulability, transmission at poses (..., m): see `assur.performance.indices.indices`."""
        from assur.performance.indices import indices

        return indices(self, poses, mode, characteristic_length)

    def follow(self, joint_values: Named, **options: Any) -> Way:
        """The way from an assembly to inputs or to a pose, the mode kept; see `kinematics.following.following`."""
        from assur.kinematics.following.following import follow

        return follow(self, checked_joints(self, joint_values), **options)

    def topology(self, actuate: Sequence[str] | None = None, mode: Mode | None = None) -> Topology:
        """POC sets, DOF, coupling degree and what follows from them: see `assur.topology`."""
        from assur.derived_topology import topology

        return topology(self, actuate=actuate, mode=mode)

    def point(self, name: str, joint_values: Named) -> FloatArray:
        """Position (..., 3) of a lettered point or of a joint: see `assur.joint_graph.points.point`."""
        from assur.joint_graph.points import point

        return point(self, name, joint_array(self, joint_values))

    def plot(self, figure: str = "solid", *, width: str = "") -> Figure:
        """A figure of `assur figures` as matplotlib's, at the width of a page; see `assur.figures.catalogue`.

        >>> (25.4 * load("fivebar").plot("flow", width="ieee").get_size_inches()).round().tolist()
        [44.0, 91.0]
        """
        page = import_module("assur.figures.page").page_width(width)
        context = import_module("assur.figures.context").Context(self, page=page)
        drawn: Figure = import_module("assur.figures.catalogue").draw(self, figure, context)
        return drawn

    def page(self, path: str | Path) -> Path:
        """Write the page in which the mechanism can be moved, one HTML file, and return its path.

        >>> import tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     load("fivebar").page(Path(folder) / "fivebar.html").name
        'fivebar.html'
        """
        pages = import_module("assur.page")
        written: Path = import_module("assur.results.files").write_whole(path, pages.page_html(pages.scene(self)))
        return written

    def report(self, path: str | Path, *, figures: bool = True) -> Path:
        """Write everything about the mechanism as one HTML file and return its path; see `assur.report.report`."""
        import_module("assur.report.report").write_report(self, path, figures=figures)
        return Path(path)

    def __str__(self) -> str:
        """Its inputs, pose and dimensions as a table."""
        from assur.results.notebook import text_table

        return text_table(f"{self.name}: {self.title}", *self._table())

    def _repr_html_(self) -> str:
        """The same for a notebook, with its structure as a picture."""
        from assur.results.notebook import html_table

        picture = import_module("assur.figures.encode").encoded(self.plot("structure"), "png", 110)
        return html_table(f"{self.name}: {self.title}", *self._table(), picture)

    def _table(self) -> tuple[tuple[str, ...], list[tuple[object, ...]]]:
        """Columns and rows of what is given and asked of it."""
        units = {"length": self.unit, "angle": self.angle}
        kinds = {
            name: "length" if name in LENGTHS else "angle" if is_angle(name) else "" for name in self.platform.pose
        }
        driven = {item.name: item.coordinate for item in self.inputs}
        rows: list[tuple[object, ...]] = [
            ("input", name, "", units[at.kind], f"{at.kind} of joint {at.joint}") for name, at in driven.items()
        ]
        rows += [("pose", name, "", units.get(kind, ""), "") for name, kind in kinds.items()]
        rows += [
            ("dimension", name, f"{item.value:g}", "" if item.unit == "1" else item.unit, item.meaning)
            for name, item in self.parameters.items()
        ]
        return ("what", "name", "value", "unit", "meaning"), rows

    @property
    def home_values(self) -> FloatArray:
        """Joint values (n,) of the assembled home."""
        return home_values(self)

    def frames(self, joint_values: Named) -> dict[str, Frame]:
        """Frame of every link, (..., 3, 3) and (..., 3) in the base frame, at joint values (..., n)."""
        return frames(self, joint_array(self, joint_values))

    def closure_error(self, joint_values: Named) -> FloatArray:
        """Largest gap (...) over the cut joints, in length units."""
        return closure.closure_error(self, joint_array(self, joint_values))

    def mobility(self, joint_values: Named) -> closure.AssemblyMobility:
        """Rank, freedoms and redundant constraints of the joint graph at joint values (..., n)."""
        return closure.mobility(self, joint_array(self, joint_values))


def load(name: str | Path, /, **parameters: Any) -> Mechanism:
    """A built-in mechanism by name, or one from a file, with some of its parameters changed.

    A closed form beside a file of one's own is held against the joint graph first (`assur.kinematics.contract`): where
    it does not agree, that is a `MechanismFileError`.

    >>> load("zeng2019", l2=300).parameters["l2"].value
    300.0
    """
    return _of_record(admitted_record(name, **parameters))


@lru_cache(maxsize=64)
def _of_record(record: MechanismRecord) -> Mechanism:
    return Mechanism(**vars(record))


def names() -> tuple[str, ...]:
    """Names of the built-in mechanisms."""
    return registry.names()
