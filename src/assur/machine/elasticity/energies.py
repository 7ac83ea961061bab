"""Strain energy: how much of it is in which link, in which kind of strain, in which actuator."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.machine.elasticity.beams import KINDS
from assur.machine.elasticity.strains import Strains

FloatArray = NDArray[np.float64]
ACTUATORS = "actuators"
"""Stands for all of them among links and kinds of strain."""


@dataclass(frozen=True, eq=False)
class EnergyShares:
    """Shares of a strain energy. Each split sums to 1.

    Attributes:
        links, kinds: of all energy, by elastic links and by kinds of strain, that of all actuators among them.
        actuators: of the energy of the actuators.
        energy: all of it, in J.
    """

    links: Mapping[str, float]
    kinds: Mapping[str, float]
    actuators: Mapping[str, float]
    energy: float


def energy_shares(state: Strains, moved: FloatArray) -> EnergyShares:
    """Energy of beams and actuators at the first configuration of a structure, of unknowns (U, k), summed over k."""
    own, record = state.structure, state.structure.record
    links = dict.fromkeys(own.skeletons, 0.0)
    kinds = dict.fromkeys(KINDS, 0.0)
    for beam, strain in zip(own.beams, state.of_beams[0] @ moved, strict=True):
        wrench = beam.beam.stiffness @ (strain * state.units[:, None])
        for kind, part in zip(KINDS, beam.beam.parts, strict=True):
            energy = 0.5 * float(np.sum(wrench * (part @ wrench)))
            links[beam.link] += energy
            kinds[kind] += energy
    joints = moved[own.unknowns - len(state.scales) :] * state.scales[:, None]
    springs = 0.5 * own.stiffness * np.sum(joints**2, axis=1)
    actuators = {item.name: float(springs[item.coordinate.index]) for item in record.drives}
    links[ACTUATORS] = kinds[ACTUATORS] = sum(actuators.values())
    return EnergyShares(_shares(links), _shares(kinds), _shares(actuators), sum(kinds.values()))


def _shares(energies: Mapping[str, float]) -> dict[str, float]:
    whole = sum(energies.values())
    return {name: energy / whole if whole else 0.0 for name, energy in energies.items()}
