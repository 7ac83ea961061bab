"""Forces of the actuators for gravity, a load and a motion: by virtual work over all links.

With joint rates u = B v for rates v of the pose, D the rates of the inputs per v, J the platform's twist per v:

    D^T tau = M(x) a + c(x, v) + g(x) - J^T w,    M = B^T (sum over links) B

The sum runs over all links of the joint graph; it asks for no closed form, and constraints that say the same twice
do no harm. With more drives than freedoms tau is the one of least norm; the rest is preload.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.kinematics import border
from assur.kinematics.rates.acceleration import reached_in_mode
from assur.kinematics.status import Status
from assur.machine.forces.balance import AT_ONCE, NO_FORCES, Asked, balanced, growth, preload, redundant
from assur.machine.forces.batches import balanced_in_batches
from assur.machine.forces.loads import Load, load_of
from assur.machine.masses.link_masses import all_masses, masses
from assur.machine.motion.joint_motion import ClosedMotion
from assur.machine.motion.screws import rate_metres
from assur.model.mechanism import MechanismRecord
from assur.model.pose import rate_names
from assur.results.notebook import Entries, Tabulated

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
ROUNDED = 1e-10
"""Share of the fastest joint's rate below which an input's rate is rounding, and the input at rest."""
MANY = 400
"""So many configurations are worth a recorded program."""
STILL = 1e-6
"""In rad/s2: slower a rod begins to spin by rounding alone."""


@dataclass(frozen=True, eq=False)
class ActuatorForces(Tabulated):
    """Forces at N configurations, in SI units, in the order of the inputs, redundant ones last.

    Where the mechanism is singular in its inputs, or the configuration does not exist, forces are NaN.

    Attributes:
        record: the mechanism.
        values: (N, n) joint values.
        status: (N,) of `Status`.
        forces: (N, d) what each actuator exerts along its input's positive direction, N or N m.
        friction: (N, d) to be added where an input moves; 0 at rest.
        friction_band: (d,) what holds at rest, either way.
        input_rates: (N, d) m/s or rad/s.
        kinetic_energy, potential_energy, power: (N,) in J and W; NaN where masses are not known.
        joint_rates, joint_accelerations: (N, n) of all joints.
        load: what acts on the platform.
        rated: (N,) whether there are masses, and the pose's rates are free: else there is no mass matrix in them.
        moving: whether a motion was asked for.
    """

    record: MechanismRecord
    values: FloatArray
    status: NDArray[np.int8]
    forces: FloatArray
    friction: FloatArray
    friction_band: FloatArray
    input_rates: FloatArray
    kinetic_energy: FloatArray
    potential_energy: FloatArray
    power: FloatArray
    joint_rates: FloatArray
    joint_accelerations: FloatArray
    load: Load
    rated: BoolArray
    moving: bool

    @cached_property
    def motion(self) -> ClosedMotion:
        """Of the joints, with all that forces are made of: some hundred numbers for each configuration."""
        return self._asked.motion()

    @property
    def mass_matrix(self) -> FloatArray:
        """(N, k, k) per rate of the pose; NaN where masses are not known, and where the pose's rates are not free."""
        return self._terms[0]

    @property
    def bias(self) -> FloatArray:
        """(N, k) what the motion needs that goes on as it is, per rate of the pose; NaN as the mass matrix."""
        return self._terms[1]

    @property
    def gravity(self) -> FloatArray:
        """(N, k) what holds the links against gravity, per rate of the pose; NaN as the mass matrix."""
        return self._terms[2]

    @cached_property
    def growth(self) -> FloatArray:
        """(N,) newtons (newton metres) of an actuator per newton (newton metre) at the platform, the largest."""
        return np.concatenate([growth(part.motion()) for part in self._asked.parts(AT_ONCE)])

    @cached_property
    def preload(self) -> FloatArray:
        """(N, d, r) forces of redundant drives that balance one another, orthonormal columns."""
        if not redundant(self.record):
            return np.empty((len(self.values), len(self.record.drives), 0))
        return np.concatenate([preload(part.motion()) for part in self._asked.parts(AT_ONCE)])

    @property
    def unbalanced(self) -> BoolArray:
        """(N,) whether at rest a freedom that nothing drives, as a rod's spin, is left to fall."""
        return np.asarray((np.linalg.norm(self.joint_accelerations, axis=-1) > STILL) & (not self.moving))

    @cached_property
    def _terms(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        parts = []
        for asked, rates in zip(self._asked.parts(AT_ONCE), _few(self.joint_rates), strict=True):
            motion = asked.motion()
            across, inertia = np.swapaxes(motion.of_pose, -1, -2), motion.inertia
            steady = motion.second(rates, np.zeros(rates.shape[:1] + across.shape[1:2]))
            efforts = np.stack([inertia.needed(rates, steady), inertia.weight], axis=-1)
            parts.append((across @ inertia.matrix @ motion.of_pose, *np.moveaxis(across @ efforts, -1, 0)))
        mass, bias, weight = (np.concatenate(part) for part in zip(*parts, strict=True))
        for part in (mass, bias, weight):
            part[~self.rated] = np.nan
        return mass, bias, weight

    @property
    def _asked(self) -> Asked:
        return Asked(self.record, self.values, masses(self.record), self.load)

    def _title(self) -> str:
        return f"forces of the actuators of {self.record.name}"

    def _entries(self) -> Entries:
        units = force_units(self.record)
        names = [f"{own.name} [{unit}]" for own, unit in zip(self.record.drives, units, strict=True)]
        return [
            {**dict(zip(names, row.tolist(), strict=True)), "status": Status(int(code)).name}
            for row, code in zip(self.forces, self.status, strict=True)
        ]

    def __str__(self) -> str:
        rows = [
            f"{item.name}: {', '.join(f'{value:.6g}' for value in self.forces[:, place])} {unit}"
            for place, (item, unit) in enumerate(zip(self.record.drives, force_units(self.record), strict=True))
        ]
        said = sorted({Status(int(code)).name for code in self.status})
        return "\n".join([f"forces of the actuators of {self.record.name} ({', '.join(said)})", *rows])


def force_units(record: MechanismRecord) -> tuple[str, ...]:
    """Units of what actuators exert.

    >>> from assur.model.registry import load_record
    >>> force_units(load_record("fivebar"))
    ('N m', 'N m')
    """
    return tuple("N" if item.coordinate.kind == "length" else "N m" for item in record.drives)


def forces(
    record: MechanismRecord,
    poses: ArrayLike,
    velocity: ArrayLike | None = None,
    acceleration: ArrayLike | None = None,
    load: ArrayLike | None = None,
    *,
    gravity: bool = True,
    mode: str | None = None,
) -> ActuatorForces:
    """Forces of the actuators at poses (..., m) in a working mode (the file's default where none is given).

    Args:
        record: the mechanism.
        poses: (..., m) in the mechanism's unit and rad.
        velocity: (..., k) of the pose, in the mechanism's unit or rad, per s; at rest without.
        acceleration: (..., k), per s2.
        load: (..., 3) force in N on the platform at its point, or (..., 6) with a moment in N m, in the base frame.
        gravity: whether it acts.
        mode: the working mode.

    Returns:
        Answers in SI units, one for each pose of the flattened batch. A status says where there are none: `parallel`
        where the inputs do not hold the platform, `undecided` where a motion is asked for that the pose's rates do
        not tell, or no way from home was found (without a closed form); `unreachable`.

    Errors:
        UsageError: links without a mass, where gravity or a motion needs it; wrong shapes.

    Example: what holds 100 N at the platform of the paper's mechanism, its own weight left aside.

    >>> from assur.model.registry import load_record
    >>> answer = forces(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315], load=[0, 0, -100], gravity=False)
    >>> answer.forces.round(3).tolist()
    [[-11.712, 4.487, 7.225]]
    """
    given = border.checked_poses(record, poses)
    flat = given.reshape(-1, given.shape[-1])
    names = rate_names(record.platform.pose)
    units = rate_metres(record)

    def rates(numbers: ArrayLike | None, what: str) -> FloatArray | None:
        if numbers is None:
            return None
        checked = border.checked(numbers, names, f"{what} of {record.name}") * units
        return np.broadcast_to(checked, (*given.shape[:-1], len(units))).reshape(-1, len(units))

    values, lost = reached_in_mode(record, flat, mode)
    moving = rates(velocity, "velocity"), rates(acceleration, "acceleration")
    return forces_at(record, values, load_of(load, gravity), *moving, lost=lost)


def forces_at(
    record: MechanismRecord,
    values: FloatArray,
    load: Load,
    velocity: FloatArray | None = None,
    acceleration: FloatArray | None = None,
    *,
    joint_rates: FloatArray | None = None,
    lost: NDArray[np.int8] | None = None,
) -> ActuatorForces:
    """Forces at joint values (N, n), for rates and accelerations (N, k) of the pose in SI units; at rest without.

    Many configurations go through recorded programs, those near singularities through singular values, as few do, and
    those of which all joint rates (N, n) are known.
    Where `lost` (N,) is not `regular` the joint values stand in for a pose that is not reached, and this is its status.

    Errors:
        UsageError: gravity or motion, and links of which the file says no mass.
    """
    moves = velocity is not None or acceleration is not None
    known = all_masses(record) if load.gravity or moves else masses(record)
    shape = len(values), len(rate_names(record.platform.pose))
    first, second = (None if part is None else np.broadcast_to(part, shape) for part in (velocity, acceleration))
    asked = Asked(record, values, known, load, first, second, joint_rates)
    answer = balanced(asked) if len(values) < MANY or joint_rates is not None else balanced_in_batches(asked)
    status, rated = answer.status, answer.rated & (not known.lacking)
    absent = np.zeros(len(values), dtype=bool) if lost is None else lost != Status.regular
    status = status if lost is None else np.where(absent, lost, status)
    rated &= ~absent
    tau = np.where(np.isin(status, NO_FORCES)[:, None], np.nan, answer.forces)
    input_rates = _input_rates(record, answer.joint_rates)
    band, friction = _friction(record, input_rates)
    unknown = absent | (status == Status.not_closed) | bool(known.lacking)
    missing = np.where(unknown, np.nan, 0.0)
    return ActuatorForces(
        record=record,
        values=values,
        status=status,
        forces=tau,
        friction=friction,
        friction_band=band,
        input_rates=input_rates,
        kinetic_energy=answer.kinetic_energy + missing,
        potential_energy=answer.potential_energy + missing,
        power=np.einsum("nd,nd->n", tau, input_rates),
        joint_rates=answer.joint_rates,
        joint_accelerations=answer.joint_accelerations,
        load=load,
        rated=rated,
        moving=moves,
    )


def _input_rates(record: MechanismRecord, joint_rates: FloatArray) -> FloatArray:
    """Rates (N, d) of the inputs; one that moves by rounding alone rests, so that friction holds it."""
    columns = [item.coordinate.index for item in record.drives]
    rates: FloatArray = joint_rates[:, columns] * np.array([item.sign for item in record.drives])
    rates[np.abs(rates) <= ROUNDED * np.abs(joint_rates).max(axis=-1, keepdims=True)] = 0.0
    return rates


def _friction(record: MechanismRecord, rates: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The band (d,) at rest, and what is added (N, d) at rates (N, d) of the inputs."""
    labels = [record.coordinate_label(item.coordinate) for item in record.drives]
    known = [record.machine.actuators.get(label) for label in labels]
    coulomb, viscous = (
        np.array([getattr(item, name) if item else 0.0 for item in known]) for name in ("coulomb", "viscous")
    )
    return coulomb, coulomb * np.sign(rates) + viscous * rates


def _few(rows: FloatArray) -> Iterator[FloatArray]:
    return (rows[first : first + AT_ONCE] for first in range(0, max(len(rows), 1), AT_ONCE))
