"""What looks like a number in another unit: kilograms, metres and pascals are meant, and nobody builds so."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

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


def slips(record: MechanismRecord, carried: Mapping[str, RigidBody]) -> Iterator[str]:
    """Sentences about numbers of a file; none where they can be meant.

    >>> from assur.model.registry import load_record
    >>> list(slips(load_record("fivebar"), {}))
    []
    """
    data, length = record.machine, METRES[record.unit] * characteristic_length(record)
    for name, body in carried.items():
        if body.mass >= HEAVY:
            yield f"{name} weighs {body.mass:g} kg; masses are in kg"
        turning = float(np.linalg.eigvalsh(body.inertia)[-1])
        if body.mass < HEAVY and turning > body.mass * (FAR * length) ** 2:
            yield f"{name} has the inertia {turning:g} kg m2, as of its mass some metres away; inertia is in kg m2"
    for material in data.materials.values():
        if material.density is not None and not DENSITIES[0] <= material.density <= DENSITIES[1]:
            yield f"{material.name} has the density {material.density:g} kg/m3; densities are in kg/m3"
        if material.elasticity is not None and material.elasticity < SOFT:
            yield f"{material.name} has E = {material.elasticity:g} Pa; moduli are in Pa"
    for profile in data.profiles.values():
        if profile.sizes and max(profile.sizes) > length:
            yield f"{profile.name} is {max(profile.sizes):g} m wide; sizes of profiles are in m"
