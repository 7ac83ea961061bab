"""Where masses are on a structure, and how they move: bars along their beams, other links as rigid bodies."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.machine.elasticity.strains import Strains
from assur.machine.elasticity.structure import ElasticStructure
from assur.machine.masses.link_masses import Masses, bar_weights
from assur.machine.masses.rigid_body import RigidBody

FloatArray = NDArray[np.float64]


def rigid_bodies(structure: ElasticStructure, known: Masses) -> dict[str, RigidBody]:
    """What of the links' masses is a rigid body: where bars bend and weigh only the payload is."""
    record = structure.record
    bodies = dict(known.carried(record.platform.link))
    for link in bodies.keys() & structure.skeletons.keys():
        if bar_weights(record, link) is not None:
            del bodies[link]
            if link == record.platform.link and known.payload is not None:
                bodies[link] = known.payload
    return bodies


def section_beside(structure: ElasticStructure, link: str, body: RigidBody) -> tuple[int, float]:
    """Which beam of a link that bends a rigid body of it is on, and how far in m from its first end: the nearest place.

    `body` has its centre in the link's frame, as masses have.
    """
    nearest = (np.inf, 0, 0.0)
    for place, beam in enumerate(structure.beams):
        if beam.link == link:
            along = float(np.clip((body.centre - beam.first) @ beam.axes[:, 0], 0.0, beam.beam.length))
            away = float(np.linalg.norm(body.centre - beam.first - along * beam.axes[:, 0]))
            nearest = min(nearest, (away, place, along))
    return nearest[1:]


def centre_of(state: Strains, link: str, body: RigidBody) -> FloatArray:
    """Its centre (3,) in the base frame, in m, at the first configuration."""
    turn, origin = (part[0] for part in state.frames[link])
    return np.asarray(origin + turn @ body.centre)


def body_motion(state: Strains, link: str, body: RigidBody) -> FloatArray:
    """Angular velocity, and velocity of its centre (6, U), of a rigid body of a link, at the first configuration.

    That of a link that bends moves with the section that is nearest to its centre.
    """
    own = state.structure
    if link in own.skeletons:
        place, _ = section_beside(own, link, body)
        return body_on_beam(state, link, body) @ beam_motion(state, place)
    twist = state.twists(own.bodies.index((link, 0)))[0]
    return _moved(twist, centre_of(state, link, body) - state.point[0], state.length)


def body_on_beam(state: Strains, link: str, body: RigidBody) -> FloatArray:
    """The same (6, 12) per twist of the first end of its beam in the beam's axes, and the beam's strain."""
    place, along = section_beside(state.structure, link, body)
    beam, axes = state.structure.beams[place].beam, state.beam_axes[0, place]
    section = beam.carried(np.array([along]))[0]
    turned, shifted = axes @ section[3:], axes @ section[:3]
    lever = centre_of(state, link, body) - state.beam_ends[0, place] + (beam.length - along) * axes[:, 0]
    return np.concatenate([turned, shifted + np.cross(turned, lever, axisa=0, axisb=0, axisc=0)])


def beam_motion(state: Strains, place: int) -> FloatArray:
    """Twist of a beam's first end in the beam's axes, then its strain (12, U), at the first configuration, in SI."""
    beam = state.structure.beams[place]
    turn, origin = (part[0] for part in state.frames[beam.link])
    first = origin + turn @ beam.first - state.point[0]
    twist = _moved(state.twists(beam.bodies[0])[0], first, state.length)
    axes = state.beam_axes[0, place].T
    return np.concatenate([axes @ twist[:3], axes @ twist[3:], state.units[:, None] * state.of_beams[0, place]])


def _moved(twist: FloatArray, lever: FloatArray, length: float) -> FloatArray:
    """A twist (6, U) about another point, in SI units."""
    return np.concatenate([twist[:3], length * twist[3:] + np.cross(twist[:3], lever, axisb=0, axisa=0, axisc=0)])
