"""What figures and reports of one mechanism share: each analysis is made once, and only where something asks for it."""

from __future__ import annotations

import contextlib
import hashlib
from collections.abc import Callable, Hashable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray

from assur import derived_topology
from assur.errors import UsageError
from assur.figures.near import near_solid
from assur.figures.style import PAGE
from assur.kinematics.answers.at_border import inputs_from_border
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.border import inputs_of
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.model.dimensions import with_parameters
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.performance.indices import Indices, indices, indices_at
from assur.performance.overall import GlobalIndex, OverallIndices, global_condition_index, overall
from assur.results.attempt import REFUSED, attempt
from assur.results.typeset_text import minus
from assur.scene.camera import Camera, plane
from assur.scene.companion import Companion, companion
from assur.scene.skeleton import Skeleton, skeleton
from assur.singularity.examples import SingularExample, Way, brought_to, singular_examples
from assur.topology.facts import Topology
from assur.workspace.aspects.aspects import KINDS, Aspects, aspects
from assur.workspace.certified.criteria import criteria
from assur.workspace.certified.region import CertifiedWorkspace
from assur.workspace.certified.volume_bounds import volume_bounds
from assur.workspace.domain import box_of
from assur.workspace.region import Workspace, default_resolution, workspace
from assur.workspace.sign_changes import ways_across
from assur.workspace.slices import MOST, slice_at

FloatArray = NDArray[np.float64]

Made = TypeVar("Made")

POINTS = 2**10
"""Of the workspace's box, over which a caption's means are taken."""

IN_SPACE, TURNING = 32, 64
"""Into so many parts a box in space is cut for its aspects, along each length and along each angle."""


@dataclass(frozen=True, eq=False)
class Context:
    """A mechanism and what its figures are made of.

    Attributes:
        record: the mechanism.
        given_workspace: one that is there already; else it is computed when a figure needs it.
        resolution: cells along each coordinate of a workspace that is computed; None for the usual number.
        page: the width in mm that no figure should exceed, with panels below one another where it is narrow.
    """

    record: MechanismRecord
    given_workspace: Workspace | None = None
    resolution: int | None = None
    page: float = PAGE
    _kept: dict[Hashable, Any] = field(default_factory=dict, repr=False)

    def kept(self, name: Hashable, make: Callable[[], Made]) -> Made:
        """What is made under a name, the first time that it is asked for; a drawing, or what several figures show."""
        if name not in self._kept:
            self._kept[name] = make()
        made: Made = self._kept[name]
        return made

    @cached_property
    def companion(self) -> Companion:
        """How it is drawn."""
        return companion(self.record)

    @cached_property
    def drawn_joints(self) -> FloatArray:
        """Joint values (n,) of the configuration that is drawn: at the companion's inputs, else home."""
        if self.companion.inputs and self.record.closed_form:
            inputs = inputs_from_border(self.record, self.companion.inputs)
            found = direct(self.record, inputs, self.record.modes.default_assembly or None)
            if np.any(found.exists):
                near = skeleton(self.record, self.companion, home_values(self.record))
                return np.asarray(min(found.joints[found.exists], key=lambda values: self._gap(near, values)))
        return home_values(self.record)

    def apart(self, values: FloatArray) -> float:
        """How far joints and points are at joint values (n,) from where they are in that configuration.

        A rod that spins about its ball joints is not apart from itself.
        """
        return self._gap(self.skeleton, values)

    def _gap(self, drawn: Skeleton, values: FloatArray) -> float:
        there = skeleton(self.record, self.companion, values).points
        return float(sum(np.linalg.norm(there[name] - at) for name, at in drawn.points.items()))

    @cached_property
    def skeleton(self) -> Skeleton:
        """The mechanism in that configuration."""
        return skeleton(self.record, self.companion, self.drawn_joints)

    @cached_property
    def schematic(self) -> Skeleton:
        """The mechanism with the dimensions and in the pose that show best how it is made."""
        plan = self.companion.schematic
        try:
            record = with_parameters(self.record, **plan.parameters) if plan.parameters else self.record
            values = self._schematic_values(record)
        except UsageError:  # the user's own dimensions do not allow it
            return self.skeleton
        return skeleton(record, self.companion, values)

    def _schematic_values(self, record: MechanismRecord) -> FloatArray:
        pose = self.companion.schematic.pose
        if pose and record.closed_form:
            found = inverse(record, pose, record.modes.default_working or None)
            if found.exists[0]:
                return np.asarray(found.joints[0])
        return home_values(record)

    def camera(self, figure: str, otherwise: Camera) -> Camera:
        """The view of a figure: the companion's, the plane of a mechanism that moves in one, or another."""
        return self.companion.camera(figure, plane("x", "y") if self.planar else otherwise)

    @property
    def planar(self) -> bool:
        """Whether every axis that turns is parallel to Z and every one that slides is across it, at home."""
        return all(
            abs(abs(float(axis[2])) - (0.0 if mark.slides else 1.0)) < 1e-9
            for mark in self.skeleton.marks
            for axis in (mark.axes if len(mark.axes) else np.zeros((1, 3)) + 0.5)
        )

    @property
    def schematic_note(self) -> str:
        """What the caption must say of other dimensions."""
        plan = self.companion.schematic
        if not plan.parameters or self.schematic.record is self.record:
            return ""
        values = ", ".join(
            f"{name} = {minus(f'{value:g}')} {self.record.unit}" for name, value in plan.parameters.items()
        )
        return f" Drawn with {values} {plan.because}.".replace("  ", " ")

    @cached_property
    def assemblies(self) -> SolutionSet:
        """Every direct solution at the inputs of the configuration that is drawn."""
        return direct(self.record, inputs_of(self.record, self.drawn_joints))

    @cached_property
    def examples(self) -> tuple[SingularExample, ...]:
        """One singular configuration for each factor that has one; `UsageError` where there is no box to look in."""
        if not self.record.box:
            raise UsageError(f"the file of {self.record.name} gives no box to look for configurations in")
        pose = pose_of(self.record, self.drawn_joints)
        return tuple(brought_to(self.record, pose, item) for item in singular_examples(self.record, ways=self._ways))

    def _ways(self) -> Iterator[Way]:
        """Ways on which the map of the workspace shows that something vanishes; none where there is no workspace."""
        with contextlib.suppress(*REFUSED):
            yield from ways_across(self.workspace)

    @cached_property
    def topology(self) -> Topology:
        """Its topology, derived."""
        return derived_topology.topology(self.record)

    @property
    def cells(self) -> int:
        """Cells of the workspace along each coordinate."""
        return self.resolution or default_resolution(self.record)

    @cached_property
    def workspace(self) -> Workspace:
        """The workspace in the default working mode and the file's box."""
        return self.given_workspace or workspace(self.record, resolution=self.cells)

    @cached_property
    def bounds(self) -> CertifiedWorkspace | str:
        """Proved bounds of its volume and of its sections, or why there are none."""
        return attempt(lambda: volume_bounds(self.record, self.workspace))

    @cached_property
    def aspects(self) -> Aspects:
        """The aspects of the default working mode in the file's box, coarse enough for a few seconds."""
        box = box_of(self.record, None, slice_at(self.record).free)
        flat = sum(criteria(self.record, factors=KINDS).used) < MOST
        extents = {name: high - low for name, (low, high) in zip(box.names, box.intervals, strict=True)}
        parts = {name: TURNING if is_angle(name) else IN_SPACE for name in box.names}
        finest = None if flat else {name: extent / parts[name] for name, extent in extents.items()}
        return aspects(self.record, finest=finest)

    @cached_property
    def near(self) -> Manifold:
        """What of it is within its stated distance of a parallel-singular surface."""
        return near_solid(self.workspace)

    def indices_at(self, points: FloatArray) -> Indices:
        """Every index at points (..., free coordinates) of the workspace, in its mode.

        >>> from assur.model.registry import load_record
        >>> here = Context(load_record("fivebar")).indices_at(np.array([[0.0, 200.0], [0.0, 5000.0]]))
        >>> np.isfinite(here["condition"]).tolist()
        [True, False]
        """
        key = (points.shape, hashlib.blake2b(np.ascontiguousarray(points).tobytes()).digest())
        return self.kept(key, lambda: self._indices_at(points))  # several figures show the same plane

    def _indices_at(self, points: FloatArray) -> Indices:
        found, flat, batch = self.workspace, points.reshape(-1, points.shape[-1]), points.shape[:-1]
        if self.record.closed_form:
            return indices(self.record, found.slice.poses(flat).reshape(*batch, -1), found.mode)
        return indices_at(self.record, found.joints(flat).reshape(*batch, -1))

    @cached_property
    def overall_indices(self) -> OverallIndices | None:
        """Means over the workspace; None without a closed form, where each pose would have to be searched for."""
        return overall(self.record, self.workspace, POINTS) if self.record.closed_form else None

    @cached_property
    def mean_index(self) -> GlobalIndex:
        """The mean of the local condition index over the workspace."""
        return global_condition_index(self.record, self.workspace)
