"""Natural vibrations of a structure at rest: consistent masses of its beams, the other links as rigid bodies.

Drives are held by the stiffness of their actuators; a rotor behind a gear that yields moves by itself. Spins that
nothing holds take part only as what vibrates drags them along.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from assur.machine.elasticity.beams import consistent_mass
from assur.machine.elasticity.strains import Strains
from assur.machine.elasticity.structure_masses import beam_motion, body_motion, rigid_bodies
from assur.machine.masses.link_masses import Masses, bar_weights, masses

FloatArray = NDArray[np.float64]
MASSLESS = 1e-12
"""Share of the largest below which a motion has no mass, and no frequency."""


@dataclass(frozen=True, eq=False)
class Vibrations:
    """Natural vibrations: frequencies (F,) in Hz, ascending, and shapes (U, F) in the unknowns of `state`.

    `lacking` are links of which the file says no mass: there are no frequencies then.
    """

    state: Strains
    frequencies: FloatArray
    shapes: FloatArray
    lacking: tuple[str, ...]


def vibrations(state: Strains, count: int = 6) -> Vibrations:
    """The slowest vibrations at the first configuration of a structure.

    >>> from assur.kinematics.home import home_values
    >>> from assur.machine.elasticity.strains import strains
    >>> from assur.machine.elasticity.structure import structure
    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> own = vibrations(strains(structure(record), home_values(record)[None]))
    >>> len(own.frequencies), bool(own.frequencies[0] > 1)
    (6, True)
    """
    known = masses(state.structure.record)
    if known.lacking or not state.held[0]:
        none = np.empty((state.structure.unknowns, 0))
        return Vibrations(state, np.empty(0), none, known.lacking)
    basis = np.eye(state.structure.unknowns) if state.closing is None else state.closing[0]
    mass = basis.T @ mass_matrix(state, known) @ basis
    free = state.free[0][:, np.any(state.free[0] != 0.0, axis=0)]
    bent = np.linalg.svd(np.column_stack([free, np.zeros(len(free))]), full_matrices=True)[0][:, free.shape[1] :]
    dragged = np.linalg.pinv(free.T @ mass @ free, rcond=MASSLESS, hermitian=True) @ free.T @ mass @ bent
    bent = bent - free @ dragged
    held = bent.T @ state.kept(state.stiffness)[0] @ bent
    sizes, vectors = eigh(bent.T @ mass @ bent, held)  # 1 / omega^2, as masses may be zero where stiffness is not
    kept = np.flatnonzero(sizes > MASSLESS * sizes[-1])[::-1][:count]
    return Vibrations(state, 1.0 / (2.0 * np.pi * np.sqrt(sizes[kept])), basis @ bent @ vectors[:, kept], ())


def mass_matrix(state: Strains, known: Masses) -> FloatArray:
    """The mass matrix (U, U) in J s2 at the first configuration: beams, rigid links, rotors."""
    own = state.structure
    record = own.record
    whole = np.zeros((own.unknowns, own.unknowns))
    for place, beam in enumerate(own.beams):
        weights = bar_weights(record, beam.link)
        if weights is not None:
            carried = beam_motion(state, place)
            whole += carried.T @ consistent_mass(beam.beam, *weights) @ carried
    for link, body in rigid_bodies(own, known).items():
        moved, turn = body_motion(state, link, body), state.frames[link][0][0]
        spread = np.zeros((6, 6))
        spread[:3, :3] = turn @ body.inertia @ turn.T
        spread[3:, 3:] = body.mass * np.eye(3)
        whole += moved.T @ spread @ moved
    whole[own.coordinates, own.coordinates] += np.diag(own.springs.rotors * state.scales**2)
    return whole
