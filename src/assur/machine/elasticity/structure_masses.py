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


def tied_to(structure: ElasticStructure, link: str, body: RigidBody) -> int:
    """The body of the structure that a rigid body of a link is on: of a link that bends the node nearest to its centre.

    `body` has its centre in the link's frame, as masses have.
    """
    node = 0
    if link in structure.skeletons:
        node = int(np.argmin(np.linalg.norm(structure.skeletons[link].nodes - body.centre, axis=1)))
    return structure.bodies.index((link, node))


def centre_of(state: Strains, link: str, body: RigidBody) -> FloatArray:
    """Its centre (3,) in the base frame, in m, at the first configuration."""
    turn, origin = (part[0] for part in state.frames[link])
    return np.asarray(origin + turn @ body.centre)


def body_motion(state: Strains, link: str, body: RigidBody) -> FloatArray:
    """Angular velocity, and velocity of its centre (6, U), of a rigid body of a link, at the first configuration."""
    twist = state.twists(tied_to(state.structure, link, body))[0]
    return _moved(twist, centre_of(state, link, body) - state.point[0], state.length)


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
