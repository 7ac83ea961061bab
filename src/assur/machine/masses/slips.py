"""What looks like a number in another unit: kilograms, metres and pascals are meant, and nobody builds so."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.validation.check import METRES
from assur.machine.masses.rigid_body import RigidBody
from assur.model.mechanism import MechanismRecord

HEAVY = 1e5
"""A mass in kg above which one may have been meant in another unit."""
DENSITIES = (10.0, 30_000.0)
"""In kg/m3, from the lightest foam to the heaviest metal."""
SOFT = 1e5
"""A modulus of elasticity in Pa below that of any foam."""
FAR = 10.0
"""Characteristic lengths beyond which nothing is expected that belongs to a link."""


@dataclass(frozen=True)
class Slip:
    """A number of an entry of a file's table: what it says, and in which unit such numbers are."""

    table: str
    name: str
    given: str
    meant: str

    def __str__(self) -> str:
        return f"{self.name} {self.given}; {self.meant}"


def slips(record: MechanismRecord, carried: Mapping[str, RigidBody]) -> Iterator[Slip]:
    """Numbers of a file, and of bodies by their links, that look so; none where they can be meant.

    >>> from assur.model.registry import load_record
    >>> list(slips(load_record("fivebar"), {}))
    []
    """
    data, length = record.machine, METRES[record.unit] * characteristic_length(record)
    for name, body in carried.items():
        if body.mass >= HEAVY:
            yield Slip("links", name, f"weighs {body.mass:g} kg", "masses are in kg")
        turning = float(np.linalg.eigvalsh(body.inertia)[-1])
        if body.mass < HEAVY and turning > body.mass * (FAR * length) ** 2:
            given = f"has the inertia {turning:g} kg m2, as of its mass some metres away"
            yield Slip("links", name, given, "inertia is in kg m2")
    for material in data.materials.values():
        if material.density is not None and not DENSITIES[0] <= material.density <= DENSITIES[1]:
            given = f"has the density {material.density:g} kg/m3"
            yield Slip("materials", material.name, given, "densities are in kg/m3")
        if material.elasticity is not None and material.elasticity < SOFT:
            yield Slip("materials", material.name, f"has E = {material.elasticity:g} Pa", "moduli are in Pa")
    for profile in data.profiles.values():
        if profile.sizes and max(profile.sizes) > length:
            given = f"is {max(profile.sizes):g} m wide"
            yield Slip("profiles", profile.name, given, "sizes of profiles are in m")
