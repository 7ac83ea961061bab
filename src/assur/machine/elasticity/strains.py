"""What motions of a structure strain, at configurations: matrices of stiffness and mass, and the motions that are free.

Unknowns are twists of the roots about the platform's point, velocities over the characteristic length, and coordinates
over their units: plain numbers. Where rigid links close loops only motions that keep these closed count.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.pose import platform_frame
from assur.kinematics.rates.motions import SINGULAR, general_share
from assur.kinematics.validation.check import METRES
from assur.machine.elasticity.springs import VirtualJoint
from assur.machine.elasticity.structure import ElasticStructure
from assur.machine.motion.joint_motion import at_point, joint_scales_si
from assur.machine.motion.screws import joint_screws

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
FREE = 1e-6
"""A motion that strains less than this share of what the most strained one does is free; lengths are characteristic."""


@dataclass(frozen=True, eq=False)
class Strains:
    """A structure at N configurations, in SI units.

    Attributes:
        structure: what holds.
        frames: (N, 3, 3) and (N, 3) of every link, in m.
        point: (N, 3) the platform's.
        length: the characteristic one, in m.
        screws: (N, 6, w) of the coordinates about the platform's point, velocities over the length.
        scales: (w,) lengths or angles per coordinate's unknown.
    """

    structure: ElasticStructure
    frames: dict[str, tuple[FloatArray, FloatArray]]
    point: FloatArray
    length: float
    screws: FloatArray
    scales: FloatArray

    def twists(self, body: int) -> FloatArray:
        """Twist (N, 6, U) of a body per unknown, about the platform's point, velocity over the length."""
        own = self.structure
        whole = np.zeros((len(self.point), 6, own.unknowns))
        root = int(own.roots[body])
        if root:
            whole[:, range(6), range(6 * root - 6, 6 * root)] = 1.0
        whole[..., own.coordinates] = own.paths[body] * self.screws
        return whole

    @cached_property
    def platform(self) -> FloatArray:
        """Displacement, then rotation (N, 6, U) of the platform at its point, in m and rad."""
        twist = self.twists(self.structure.platform)
        return np.concatenate([self.length * twist[:, 3:], twist[:, :3]], axis=1)

    @cached_property
    def of_beams(self) -> FloatArray:
        """Strains (N, E, 6, U) of the beams in their axes, rotation before displacement, the latter over the length."""
        own = self.structure
        ends = np.array([beam.bodies for beam in own.beams], dtype=int).reshape(-1, 2)
        apart = np.zeros((len(self.point), len(own.beams), 6, own.unknowns))
        for end, sense in ((0, -1.0), (1, 1.0)):
            roots = own.roots[ends[:, end]]
            for beam in np.flatnonzero(roots):
                first = 6 * roots[beam] - 6
                apart[:, beam, range(6), range(first, first + 6)] += sense
        signs = own.paths[ends[:, 1]] - own.paths[ends[:, 0]]
        apart[..., own.coordinates] = self.screws[:, None] * signs[:, None]
        return self.in_axes(apart)

    def in_axes(self, apart: FloatArray) -> FloatArray:
        """Strains (N, E, 6, k) of the beams, of twists of their second ends' bodies against their first ends'."""
        axes, lever = self.beam_axes, (self.beam_ends - self.point[:, None]) / self.length
        turned = np.swapaxes(axes, -1, -2)
        moved = apart[..., 3:, :] + _crossing(lever, apart[..., :3, :])
        return np.concatenate([turned @ apart[..., :3, :], turned @ moved], axis=-2)

    @cached_property
    def beam_axes(self) -> FloatArray:
        """Axes (N, E, 3, 3) of the beams as columns in the base frame."""
        beams = self.structure.beams
        turned = [self.frames[beam.link][0] @ beam.axes for beam in beams]
        return np.stack(turned, axis=1) if beams else np.zeros((len(self.point), 0, 3, 3))

    @cached_property
    def beam_ends(self) -> FloatArray:
        """Second ends (N, E, 3) of the beams in the base frame, in m."""
        beams = self.structure.beams
        placed = [self.frames[beam.link] for beam in beams]
        ends = [turn @ beam.second + origin for beam, (turn, origin) in zip(beams, placed, strict=True)]
        return np.stack(ends, axis=1) if beams else np.zeros((len(self.point), 0, 3))

    @cached_property
    def units(self) -> FloatArray:
        """Strains in rad and m (6,) per strain."""
        return np.repeat([1.0, self.length], 3)

    @cached_property
    def closing(self) -> FloatArray | None:
        """Unknowns (N, U, U) that keep the loops of rigid bodies closed, else zero columns; None without such loops."""
        own = self.structure
        if not len(own.loops):
            return None
        closure = (own.loops[:, None] * self.screws[:, None]).reshape(len(self.point), -1, len(self.scales))
        _, sizes, across = np.linalg.svd(closure, full_matrices=True)
        rank = np.sum(sizes > SINGULAR * general_share(own.record) * sizes[:, :1], axis=-1)
        kept = np.arange(len(self.scales)) >= rank[:, None]
        roots = own.coordinates.start
        basis = np.zeros((len(self.point), own.unknowns, own.unknowns))
        basis[:, range(roots), range(roots)] = 1.0
        basis[:, roots:, roots:] = np.swapaxes(across, -1, -2) * kept[:, None]
        return basis

    def kept(self, matrix: FloatArray) -> FloatArray:
        """A form (N, U, U) on unknowns that keep rigid loops closed."""
        basis = self.closing
        return matrix if basis is None else np.swapaxes(basis, -1, -2) @ matrix @ basis

    @cached_property
    def stiffness(self) -> FloatArray:
        """The stiffness matrix (N, U, U) in J, of beams and springs, rigid loops left aside."""
        roots = [
            np.linalg.cholesky(beam.beam.stiffness * self.units * self.units[:, None]).T
            for beam in self.structure.beams
        ]
        springs = self.structure.springs
        stretched = np.sqrt(springs.stiffness)[:, None] * springs.ends * self.scales
        return self._form(np.array(roots).reshape(-1, 6, 6), stretched)

    def _form(self, roots: FloatArray, stretched: FloatArray) -> FloatArray:
        strained = (roots @ self.of_beams).reshape(len(self.point), 6 * len(roots), self.structure.unknowns)
        whole = np.swapaxes(strained, -1, -2) @ strained
        own = self.structure.coordinates
        whole[:, own, own] += stretched.T @ stretched
        return np.asarray(whole)

    @cached_property
    def free(self) -> FloatArray:
        """Motions (N, U, U) that strain nothing while the inputs stand still, orthonormal; else zero columns.

        Those that would open a loop of rigid bodies are among them: `closing` turns them into nothing.
        """
        alike = np.eye(6)[None].repeat(len(self.structure.beams), 0)
        sizes, vectors = np.linalg.eigh(self.kept(self._form(alike, self.structure.springs.ends)))
        return np.asarray(vectors * (sizes <= FREE**2 * sizes[:, -1:])[:, None])

    @cached_property
    def held(self) -> BoolArray:
        """Whether (N,) no free motion moves the platform."""
        moved = self.platform_kept @ self.free / np.repeat([self.length, 1.0], 3)[:, None]
        return np.asarray(np.max(np.abs(moved), axis=(-1, -2), initial=0.0) <= FREE)

    @cached_property
    def platform_kept(self) -> FloatArray:
        """`platform` (N, 6, U) for unknowns that keep rigid loops closed."""
        return self.platform if self.closing is None else self.platform @ self.closing

    @cached_property
    def _regular(self) -> FloatArray:
        """The stiffness with free motions held: loads that do not move these ask for the same."""
        whole = self.kept(self.stiffness)
        size = np.trace(whole, axis1=-2, axis2=-1) / whole.shape[-1]
        return np.asarray(whole + size[:, None, None] * (self.free @ np.swapaxes(self.free, -1, -2)))

    def displaced(self, loads: FloatArray) -> FloatArray:
        """Unknowns (N, U, k) under loads (N, U, k) that act on no free motion."""
        if self.closing is None:
            return np.asarray(np.linalg.solve(self._regular, loads))
        return np.asarray(self.closing @ np.linalg.solve(self._regular, np.swapaxes(self.closing, -1, -2) @ loads))


def strains(structure: ElasticStructure, values: FloatArray) -> Strains:
    """A structure at joint values (N, n) that close the loops."""
    record = structure.record
    metre, scales = METRES[record.unit], joint_scales_si(record)
    placed = {link: (turn, metre * origin) for link, (turn, origin) in frames(record, values).items()}
    point = metre * platform_frame(record, values)[1]
    length = metre * characteristic_length(record)
    own = at_point(joint_screws(record, values) * scales, point, length)
    yielding = [_virtual_screws(joint, placed[joint.link], point, length) for joint in structure.virtual.values()]
    before = list(structure.springs.before)
    screws = np.concatenate([own, *yielding, 0.0 * own[..., before]], axis=-1)
    ones = np.ones(screws.shape[-1] - len(scales) - len(before))
    return Strains(structure, placed, point, length, screws, np.concatenate([scales, ones, scales[before]]))


def _virtual_screws(
    joint: VirtualJoint, placed: tuple[FloatArray, FloatArray], point: FloatArray, length: float
) -> FloatArray:
    """Twists (N, 6, r) of a virtual joint about points (N, 3), velocities over the length."""
    turn, origin = placed
    turned, moved = turn @ joint.twists[:3], turn @ joint.twists[3:]
    lever = (point - origin - turn @ joint.point) / length
    return np.concatenate([turned, moved + _crossing(lever, turned)], axis=-2)


def _crossing(lever: FloatArray, turned: FloatArray) -> FloatArray:
    """Displacements (..., 3, U) at levers (..., 3) of rotations (..., 3, U)."""
    x, y, z = (lever[..., k, None] for k in range(3))
    a, b, c = (turned[..., k, :] for k in range(3))
    return np.stack([b * z - c * y, c * x - a * z, a * y - b * x], axis=-2)
