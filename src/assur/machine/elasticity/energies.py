"""Strain energy: how much of it is in which link, in which kind of strain, in which actuator."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.machine.elasticity.beams import KINDS
from assur.machine.elasticity.springs import ACTUATORS, JOINTS
from assur.machine.elasticity.strains import Strains

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class EnergyShares:
    """Shares of a strain energy. Each split sums to 1.

    Attributes:
        links, kinds: of all energy, by elastic links and by kinds of strain; among links that of all actuators with
            their gears, and of all joints that give way, among kinds that of actuators, of gears and of joints.
        actuators: of the energy of the actuators with their gears, by inputs.
        joints: of that of the joints.
        energy: all of it, in J.
    """

    links: Mapping[str, float]
    kinds: Mapping[str, float]
    actuators: Mapping[str, float]
    joints: Mapping[str, float]
    energy: float

    @property
    def bent(self) -> dict[str, float]:
        """Shares of the elastic links alone."""
        return {name: share for name, share in self.links.items() if name not in (ACTUATORS, JOINTS)}


def ranked(shares: Mapping[str, float]) -> list[tuple[str, float]]:
    """Names with their shares, the largest first; equal ones, but for rounding, in the order of the file.

    >>> ranked({"leg1.rod": 0.25, "leg2.rod": 0.25 + 1e-12, "arm": 0.5})
    [('arm', 0.5), ('leg1.rod', 0.25), ('leg2.rod', 0.250000000001)]
    """
    return sorted(shares.items(), key=lambda pair: -round(pair[1], 6))


def energy_shares(state: Strains, moved: FloatArray) -> EnergyShares:
    """Energy of beams and springs at the first configuration of a structure, of unknowns (U, k), summed over k."""
    own, springs = state.structure, state.structure.springs
    links = dict.fromkeys(own.skeletons, 0.0)
    given = [kind for beam in own.beams for kind in beam.beam.kinds]
    kinds = dict.fromkeys([*KINDS, *given, *springs.kinds[::-1]], 0.0)
    for beam, strain in zip(own.beams, state.of_beams[0] @ moved, strict=True):
        wrench = beam.beam.stiffness @ (strain * state.units[:, None])
        for kind, part in zip(beam.beam.kinds, beam.beam.parts, strict=True):
            energy = 0.5 * float(np.sum(wrench * (part @ wrench)))
            links[beam.link] += energy
            kinds[kind] += energy
    split: dict[str, dict[str, float]] = {ACTUATORS: {}, JOINTS: {}}
    stretched = springs.energies(moved[own.coordinates] * state.scales[:, None])
    for kind, name, energy in zip(springs.kinds, springs.names, stretched.tolist(), strict=True):
        kinds[kind] += energy
        owners = split[JOINTS if kind == JOINTS else ACTUATORS]
        owners[name] = owners.get(name, 0.0) + energy
    links |= {whole: sum(owners.values()) for whole, owners in split.items() if owners}
    actuators, joints = (_shares(owners) for owners in split.values())
    return EnergyShares(_shares(links), _shares(kinds), actuators, joints, sum(kinds.values()))


def _shares(energies: Mapping[str, float]) -> dict[str, float]:
    whole = sum(energies.values())
    return {name: energy / whole if whole else 0.0 for name, energy in energies.items()}
