"""What a link weighs as the solid that is exported of it, where the thickness of what is drawn is stated."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.validation.check import METRES
from assur.machine.masses.rigid_body import RigidBody, spread
from assur.model.mechanism import MechanismRecord
from assur.scene.bodies import bodies, fused
from assur.scene.companion import companion
from assur.scene.sizes import thickness

FloatArray = NDArray[np.float64]


def of_solid(record: MechanismRecord, link: str, density: float, material: str) -> RigidBody:
    """A link of a density in kg/m3 as `assur export` has it, without the pins that are put into it.

    Errors:
        UsageError: no thickness is stated, so that sizes are drawn to look well; nothing is drawn of the link.
    """
    if record.thickness is None and not companion(record).thickness:
        raise UsageError(
            f"link {link} of {record.name}: made of {material}, but its sizes are not known",
            hint="give it a profile, kg_per_m or a mass; or state thickness in the figures.toml beside the file",
        )
    made = next((body for body in bodies(record) if body.link == link and body.fused), None)
    if made is None:
        raise UsageError(f"link {link} of {record.name}: nothing is drawn of it", hint="give it a mass")
    mesh = fused(made).to_mesh64()
    triangles = METRES[record.unit] * np.asarray(mesh.vert_properties[:, :3])[np.asarray(mesh.tri_verts)]
    volume, centre, inertia = moments(triangles)
    source = f"its solid, {thickness(record):.4g} {record.unit} thick, {material}"
    return RigidBody(density * volume, centre, density * inertia, source)


def moments(triangles: FloatArray) -> tuple[float, FloatArray, FloatArray]:
    """Volume, centre (3,) and inertia (3, 3) about it, per density, of what triangles (k, 3, 3) enclose.

    Each makes a tetrahedron with the origin; those that are seen from inside count as negative.

    >>> from assur.scene.shapes import Cuboid
    >>> volume, centre, inertia = moments(Cuboid(np.array([1.0, 0, 0]), np.eye(3)).mesh("#000000").corners)
    >>> float(round(volume, 12)), centre.round(12).tolist(), inertia.diagonal().round(12).tolist()
    (8.0, [1.0, 0.0, 0.0], [5.333333333333, 5.333333333333, 5.333333333333])
    """
    six_volumes = np.linalg.det(triangles)
    sums = triangles.sum(axis=1)
    volume = float(six_volumes.sum()) / 6.0
    centre = six_volumes @ sums / (24.0 * volume)
    squares = np.einsum("kai,kaj->kij", triangles, triangles) + np.einsum("ki,kj->kij", sums, sums)
    second = np.tensordot(six_volumes, squares, 1) / 120.0  # integral of x xT
    return volume, centre, np.trace(second) * np.eye(3) - second - volume * spread(centre)
