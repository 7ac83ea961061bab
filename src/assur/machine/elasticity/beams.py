"""Uniform beams: how one end gives way beside the other, where strain energy goes, and how the beam's mass follows.

Numbers are in the beam's own axes: x from its first end to its second, y along `up`. A twist or a strain is a rotation,
then a displacement, of the second end; a wrench the moment, then the force, at the second end. Timoshenko's beam: the
sections stay plane and shear against the axis; without shear it is Euler's and Bernoulli's.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.model.machine_data import Material, Profile

FloatArray = NDArray[np.float64]
KINDS = ("bending", "torsion", "axial", "shear")
"""Kinds of strain, in the order of their flexibilities."""
GIVEN = "given"
"""The kind of what gives way by a compliance that the file gives."""


@dataclass(frozen=True, eq=False)
class Beam:
    """A beam in SI units.

    Attributes:
        length: in m.
        parts: (k, 6, 6) flexibilities of the second end while the first is held, one for each of `kinds`.
        kinds: of strain.
        slender: the beam whose points move as this one's where only its flexibility is known.
    """

    length: float
    parts: FloatArray
    kinds: tuple[str, ...] = KINDS
    slender: Beam | None = None

    @property
    def stiffness(self) -> FloatArray:
        """Wrench (6, 6) at the second end per strain."""
        scale = 1.0 / np.sqrt(np.diag(self.parts.sum(axis=0)))  # radians and metres brought to one size
        inverse = np.linalg.inv(self.parts.sum(axis=0) * scale * scale[:, None])
        symmetric = 0.5 * (inverse + inverse.T)
        return np.asarray(symmetric * scale * scale[:, None])

    def displaced(self, places: FloatArray) -> FloatArray:
        """Displacement, and rotation (P, 6, 6) of the section at places (P,) from the first end, per strain, it held.

        The shape is that of a beam that bears loads at its ends alone.
        """
        if self.slender is not None:
            return self.slender.displaced(places)
        s, length = places, self.length
        if length == 0.0:
            return np.zeros((len(s), 6, 6))
        _, torsion, axial, shear = self.parts
        bend_y, bend_z = self.parts[0, 2, 2] / length, self.parts[0, 1, 1] / length  # 1 / (E I)
        shape = np.zeros((len(s), 6, 6))
        shape[:, 0, 3] = s * axial[3, 3] / length
        shape[:, 1, 4] = (length * s**2 / 2 - s**3 / 6) * bend_y + s * shear[4, 4] / length
        shape[:, 1, 2] = s**2 / 2 * bend_y
        shape[:, 2, 5] = (length * s**2 / 2 - s**3 / 6) * bend_z + s * shear[5, 5] / length
        shape[:, 2, 1] = -(s**2) / 2 * bend_z
        shape[:, 3, 0] = s * torsion[0, 0] / length
        shape[:, 4, 1], shape[:, 4, 5] = s * bend_z, -(length * s - s**2 / 2) * bend_z
        shape[:, 5, 2], shape[:, 5, 4] = s * bend_y, (length * s - s**2 / 2) * bend_y
        return np.asarray(shape @ self.stiffness)

    def carried(self, places: FloatArray) -> FloatArray:
        """The same (P, 6, 12) per twist of the first end and strain: what moves with the first end, and the strain."""
        moved = np.zeros((len(places), 6, 12))
        moved[:, range(6), [3, 4, 5, 0, 1, 2]] = 1.0
        moved[:, 1, 2], moved[:, 2, 1] = places, -places
        moved[..., 6:] = self.displaced(places)
        return moved


def beam(profile: Profile, material: Material, length: float, *, shear: bool = True) -> Beam:
    """A beam of a profile and a material that says E and nu.

    >>> from assur.model.machine_data import Material, Profile
    >>> square = Profile("square", "moments", (), area=1e-4, iy=1e-9, iz=1e-9, torsion=2e-9)
    >>> own = beam(square, Material("steel", 7850, 210e9, 0.3), 0.5)
    >>> float((own.parts[0, 4, 4] * 3 * 210e9 * 1e-9 / 0.5**3).round(12))  # a cantilever gives way by F L^3 / (3 E I)
    1.0
    """
    elasticity, poisson = float(material.elasticity or 0.0), float(material.poisson or 0.0)
    rigidity = elasticity / (2.0 * (1.0 + poisson))
    parts = np.zeros((4, 6, 6))
    for turn, push, second, sense in ((2, 4, profile.iz, 1.0), (1, 5, profile.iy, -1.0)):
        bend = 1.0 / (elasticity * second)
        parts[0, turn, turn] = length * bend
        parts[0, push, push] = length**3 / 3.0 * bend
        parts[0, turn, push] = parts[0, push, turn] = sense * length**2 / 2.0 * bend
    parts[1, 0, 0] = length / (rigidity * profile.torsion)
    parts[2, 3, 3] = length / (elasticity * profile.area)
    if shear:
        for push, area in zip((4, 5), shear_areas(profile, poisson), strict=True):
            parts[3, push, push] = 0.0 if area is None else length / (rigidity * area)
    return Beam(length, parts)


def given_beam(compliance: FloatArray, length: float) -> Beam:
    """A beam of which only the compliance (6, 6) of its second end is known, in its axes, displacement before rotation.

    Between its ends it bends as a slender uniform beam.

    >>> float(given_beam(np.diag([1e-8, 2e-8, 2e-8, 1e-6, 1e-6, 1e-6]), 0.5).stiffness[3, 3].round())
    100000000.0
    """
    unit = Profile("", "moments", (), 1.0, 1.0, 1.0, 1.0)
    slender = beam(unit, Material("", None, 1.0, 0.0), length, shear=False)
    return Beam(length, np.roll(compliance, 3, axis=(0, 1))[None], (GIVEN,), slender)


def shear_areas(profile: Profile, poisson: float) -> tuple[float | None, float | None]:
    """Areas in m2 that bear shear along y and z; None where none gives way.

    After Cowper 1966, who averages the displacements of the section: round bars, tubes; 5/6 of a box.

    >>> from assur.model.machine_data import Profile
    >>> shear_areas(Profile("bar", "round", (0.02,), 1.0, 1.0, 1.0, 1.0), 0.0)[0] == 6 / 7
    True
    """
    if profile.kind == "moments":
        return profile.shear_y, profile.shear_z
    if profile.kind == "box":
        factor = 5.0 / 6.0
    else:
        hollow = profile.sizes[1] / profile.sizes[0] if profile.kind == "tube" else 0.0
        size = (1.0 + hollow**2) ** 2
        factor = 6.0 * (1.0 + poisson) * size / ((7.0 + 6.0 * poisson) * size + (20.0 + 12.0 * poisson) * hollow**2)
    return factor * profile.area, factor * profile.area


def consistent_mass(own: Beam, per_metre: float, polar: float) -> FloatArray:
    """Mass (12, 12) for the twist of the first end and the strain.

    Args:
        own: the beam.
        per_metre: kg.
        polar: kg m2 of a metre about the beam's axis; sections do not resist tilting, as of slender bars.
    """
    places, weights = _gauss(own.length)
    moved = own.carried(places)[:, :4]
    sizes = np.array([per_metre, per_metre, per_metre, polar])
    return np.asarray(np.einsum("p,pai,a,paj->ij", weights, moved, sizes, moved))


def consistent_load(own: Beam) -> FloatArray:
    """Loads (2, 12, 4) for force (N/m) and moment about the axis (N m/m): that are constant, and that grow by 1 per m.

    Loads work on the twist of the first end, and on the strain.
    """
    places, weights = _gauss(own.length)
    moved = own.carried(places)[:, :4]
    return np.stack([np.einsum("p,pai->ia", weights * grown, moved) for grown in (np.ones_like(places), places)])


def _gauss(length: float) -> tuple[FloatArray, FloatArray]:
    """Places and weights that integrate products of two cubics exactly."""
    points, weights = np.polynomial.legendre.leggauss(4)
    return 0.5 * length * (points + 1.0), 0.5 * length * weights
