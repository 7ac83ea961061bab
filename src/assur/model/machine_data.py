"""What a mechanism's file says of the machine: materials, cross-sections, weights, actuators, tolerances. Frozen data.

All is in SI units, but for places, which are in the mechanism's unit. What the file does not say is None.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
RIGID = 1e-9
"""Eigenvalue of a compliance whose diagonal is brought to 1 below which it is zero: it is written with digits."""


@dataclass(frozen=True)
class Material:
    """Density in kg/m3, modulus of elasticity in Pa, Poisson's ratio."""

    name: str
    density: float | None = None
    elasticity: float | None = None
    poisson: float | None = None


@dataclass(frozen=True, eq=False)
class Profile:
    """The cross-section of a bar that runs along its own x axis; y is `up`.

    Attributes:
        kind: how it is given; "moments" are the numbers themselves.
        sizes: diameter; outer and inner diameter; width along `up` and across it: in m.
        area: in m2.
        iy, iz, torsion: second moments about y and z, and the constant of torsion, in m4.
        shear_y, shear_z: shear areas in m2 of a profile that is given by its moments; None for no shear.
        up: (3,) direction in the link's frame, None where the section is alike all round.
    """

    name: str
    kind: Literal["round", "tube", "box", "moments"]
    sizes: tuple[float, ...]
    area: float
    iy: float
    iz: float
    torsion: float
    shear_y: float | None = None
    shear_z: float | None = None
    up: FloatArray | None = None

    @property
    def polar(self) -> float:
        """Polar second moment in m4: times density and length it is the inertia of a bar about its own axis."""
        return self.iy + self.iz


@dataclass(frozen=True, eq=False)
class Gravity:
    """The direction (3,) in which things fall, a unit vector in the base frame, and how fast, in m/s2."""

    direction: FloatArray = field(default_factory=lambda: np.array([0.0, 0.0, -1.0]))
    value: float = 9.81


@dataclass(frozen=True, eq=False)
class LinkData:
    """What weighs, and what bends, of one link.

    Attributes:
        mass: in kg.
        centre: (3,) centre of mass in the link's frame, in the mechanism's unit.
        inertia: (3, 3) tensor about it in the link's axes, in kg m2.
        kg_per_m: of its bars.
        profile, material: names.
        rigid: whether it is said not to bend.
        up: (3,) direction of its profile, where it is another than the profile's own.
        bars: pairs of joints between which bars run; empty where the file does not say.
        compliance: (6, 6) of the second of two joints while the first is held, in the link's axes and SI units,
            displacement before rotation, force before moment.
    """

    mass: float | None = None
    centre: FloatArray | None = None
    inertia: FloatArray | None = None
    kg_per_m: float | None = None
    profile: str | None = None
    material: str | None = None
    rigid: bool = False
    up: FloatArray | None = None
    bars: tuple[tuple[str, str], ...] = ()
    compliance: FloatArray | None = None

    @property
    def weighs(self) -> bool:
        """Whether anything is said of its weight."""
        return any(item is not None for item in (self.mass, self.kg_per_m, self.profile, self.material))


@dataclass(frozen=True)
class Gear:
    """What stands between a motor and its input.

    Attributes:
        ratio: by how many rad, or m, the motor moves when the input moves by one rad or m.
        stiffness: of the gear at the input, the motor held, in N/m or N m/rad; None of one that does not yield.
        rotor: kg m2, or kg, of the motor, at the motor.
    """

    ratio: float
    stiffness: float | None = None
    rotor: float = 0.0


@dataclass(frozen=True)
class Actuator:
    """What drives an input.

    Attributes:
        stiffness: of the actuator that holds its position, at the input, N/m or N m/rad.
        force, speed: the largest, N or N m and m/s or rad/s.
        rotor: what turns or moves with the input beside the links, kg or kg m2, counted at the input.
        coulomb, viscous: friction at any speed, N or N m, and per speed.
    """

    stiffness: float | None = None
    force: float | None = None
    speed: float | None = None
    rotor: float = 0.0
    coulomb: float = 0.0
    viscous: float = 0.0
    gear: Gear | None = None

    @property
    def inertia(self) -> float:
        """Of the rotor, and of that behind the gear by the square of its ratio, at the input, in kg or kg m2."""
        return self.rotor + (self.gear.ratio**2 * self.gear.rotor if self.gear else 0.0)


@dataclass(frozen=True)
class Tolerance:
    """By how much a size is off at most, and its standard deviation: in the mechanism's unit, or rad."""

    bound: float
    sigma: float


@dataclass(frozen=True, eq=False)
class MachineData:
    """All of it: links by their names, actuators by the joint coordinate of their input, the rest by its name.

    `gravity` is what the file says, else downwards along -z with 9.81 m/s2. The payload is None where there is none;
    its centre is in the platform's frame. `clearances` are radii of joints, in the mechanism's unit. `compliances`
    (6, 6) are of joints, at their point on the child and in its axes, in SI units, displacement before rotation.
    """

    materials: Mapping[str, Material] = field(default_factory=dict)
    profiles: Mapping[str, Profile] = field(default_factory=dict)
    gravity: Gravity = field(default_factory=Gravity)
    payload: LinkData | None = None
    links: Mapping[str, LinkData] = field(default_factory=dict)
    actuators: Mapping[str, Actuator] = field(default_factory=dict)
    tolerances: Mapping[str, Tolerance] = field(default_factory=dict)
    clearances: Mapping[str, float] = field(default_factory=dict)
    compliances: Mapping[str, FloatArray] = field(default_factory=dict)
