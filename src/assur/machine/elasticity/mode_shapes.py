"""Mode shapes: how a structure moves in its natural vibrations, and what is strained."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.validation.check import METRES
from assur.machine.elasticity.energies import EnergyShares, energy_shares
from assur.machine.elasticity.skeletons import SAME
from assur.machine.elasticity.strains import Strains
from assur.machine.elasticity.structure import ElasticStructure
from assur.machine.elasticity.structure_masses import beam_motion
from assur.machine.elasticity.vibrations import Vibrations
from assur.machine.masses.bars import joint_points

FloatArray = NDArray[np.float64]
SECTIONS = 9
"""Of each beam, ends included: a cubic is a curve then."""


@dataclass(frozen=True, eq=False)
class ModeShape:
    """One natural vibration at its largest: of all points of `links` that which moves most has gone one metre.

    Attributes:
        frequency: in Hz.
        platform: (6,) displacement of the platform's point in m, then its rotation in rad.
        links: link -> points (k, 3) at rest in the base frame, and their displacements (k, 3), in m: nine sections of
            each beam and of each rigid tie from a beam to a joint that is not on it, the joints of a rigid link.
        shares: of the strain energy.
    """

    frequency: float
    platform: FloatArray
    links: Mapping[str, tuple[FloatArray, FloatArray]]
    shares: EnergyShares

    def deflected(self, furthest: float) -> dict[str, FloatArray]:
        """Link -> curves (c, k, 3) in the base frame, in m, where the point that moves most has gone `furthest`.

        One of each beam and tie, and of a rigid link one through its joints.
        """
        placed = {link: rest + furthest * moved for link, (rest, moved) in self.links.items()}
        beams = {link: points.reshape(-1, SECTIONS, 3) for link, points in placed.items() if link in self.shares.links}
        return {link: beams.get(link, points[None]) for link, points in placed.items()}


def mode_shapes(own: Vibrations) -> tuple[ModeShape, ...]:
    """The shape of each vibration, its sign so that the platform's largest displacement is positive.

    >>> from assur.model.registry import load_record
    >>> from assur.machine.elasticity.stiffness import stiffness
    >>> slowest = stiffness(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315]).mode_shapes()[0]
    >>> max(slowest.shares.links, key=slowest.shares.links.get)
    'link12'
    """
    rest = _at_rest(own.state)
    motions = _motions(own.state)
    found = []
    for frequency, shape in zip(own.frequencies, own.shapes.T, strict=True):
        links = {link: motion @ shape for link, motion in motions.items()}
        platform = own.state.platform[0] @ shape
        largest = float(np.max(np.linalg.norm(np.concatenate(list(links.values())), axis=1)))
        sense = np.sign(platform[np.argmax(np.abs(platform[:3]))]) or 1.0
        unit = sense / (largest or 1.0)
        moved = {link: (rest[link], unit * displaced) for link, displaced in links.items()}
        shares = energy_shares(own.state, shape[:, None])
        found.append(ModeShape(float(frequency), unit * platform, moved, shares))
    return tuple(found)


def _at_rest(state: Strains) -> dict[str, FloatArray]:
    """Points (k, 3) of every link in the base frame, in m."""
    record, beams = state.structure.record, state.structure.beams
    metre = METRES[record.unit]
    found = {}
    for link in record.links:
        turn, origin = (part[0] for part in state.frames[link])
        places = [
            beam.first + share * (beam.second - beam.first)
            for beam in beams
            if beam.link == link
            for share in np.linspace(0.0, 1.0, SECTIONS)
        ] or [metre * point for point in joint_points(record, link).values()]
        tied = [points for _, points in _ties(state.structure, link)]
        found[link] = origin + np.reshape([*places, *np.reshape(tied, (-1, 3))], (-1, 3)) @ turn.T
    return found


def _ties(structure: ElasticStructure, link: str) -> list[tuple[int, FloatArray]]:
    """Of each joint that is on no beam of an elastic link its node, and sections (9, 3) from there to it."""
    if link not in structure.skeletons:
        return []
    own, ties = structure.skeletons[link], []
    for joint, point in joint_points(structure.record, link).items():
        node, way = own.ties[joint], METRES[structure.record.unit] * point - own.nodes[own.ties[joint]]
        if np.linalg.norm(way) > SAME * np.max(np.ptp(own.nodes, axis=0)):
            ties.append((node, own.nodes[node] + np.linspace(0.0, 1.0, SECTIONS)[:, None] * way))
    return ties


def _motions(state: Strains) -> dict[str, FloatArray]:
    """Displacements (k, 3, U) of those points per unknown."""
    structure = state.structure
    found: dict[str, list[FloatArray]] = {link: [] for link in structure.record.links}
    for place, beam in enumerate(structure.beams):
        along = beam.beam.carried(np.linspace(0.0, beam.beam.length, SECTIONS))[:, :3]  # (s, 3, 12)
        found[beam.link].append(state.beam_axes[0, place] @ along @ beam_motion(state, place))
    for link, points in _at_rest(state).items():
        if not found[link]:
            found[link].append(_carried(state, (link, 0), points))
        tied = points[sum(map(len, found[link])) :].reshape(-1, SECTIONS, 3)
        for (node, _), own in zip(_ties(structure, link), tied, strict=True):
            found[link].append(_carried(state, (link, node), own))
    return {link: np.concatenate(parts) for link, parts in found.items()}


def _carried(state: Strains, body: tuple[str, int], points: FloatArray) -> FloatArray:
    """Displacements (k, 3, U) of points (k, 3) of a rigid body per unknown."""
    twist = state.twists(state.structure.bodies.index(body))[0]
    levers = points - state.point[0]
    return np.asarray(state.length * twist[3:] + np.cross(twist[None, :3], levers[..., None], axis=1))
