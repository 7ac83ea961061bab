"""Forces of the actuators for gravity, a load and a motion: by virtual work over all links.

With joint rates u = B v for rates v of the pose, D the rates of the inputs per v, J the platform's twist per v:

    D^T tau = M(x) a + c(x, v) + g(x) - J^T w,    M = B^T (sum over links) B

The sum runs over all links of the joint graph; it asks for no closed form, and constraints that say the same twice
do no harm. With more drives than freedoms tau is the one of least norm; the rest is preload.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.kinematics import border
from assur.kinematics.home import home_values
from assur.kinematics.rates.acceleration import joints_in_mode
from assur.kinematics.rates.instantaneous import Instant, instantaneous
from assur.kinematics.status import NEAR_SINGULAR, Status
from assur.kinematics.validation.check import METRES
from assur.machine.inertia import link_inertia
from assur.machine.loads import Load, load_of
from assur.machine.masses import all_masses, masses
from assur.machine.motion import ClosedMotion, closed_motion, drive_units
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, rate_names

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
ROUNDED = 1e-10
"""Share of the fastest joint's rate below which an input's rate is rounding, and the input at rest."""
STILL = 1e-6
"""In rad/s2: slower a rod begins to spin by rounding alone."""


@dataclass(frozen=True, eq=False)
class ActuatorForces:
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
        mass_matrix: (N, k, k), bias: (N, k) and gravity: (N, k), per rate of the pose; NaN where masses are not known,
            and where the pose's rates are not free.
        growth: (N,) newtons (newton metres) of an actuator per newton (newton metre) at the platform, the largest.
        preload: (N, d, d - k) forces of redundant drives that balance one another, orthonormal columns.
        unbalanced: (N,) whether at rest a freedom that nothing drives, as a rod's spin, is left to fall.
        motion: of the joints, with all that forces are made of.
        joint_rates, joint_accelerations: (N, n) of all joints.
        load: what acts on the platform.
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
    mass_matrix: FloatArray
    bias: FloatArray
    gravity: FloatArray
    growth: FloatArray
    preload: FloatArray
    unbalanced: BoolArray
    motion: ClosedMotion
    joint_rates: FloatArray
    joint_accelerations: FloatArray
    load: Load

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
        not tell, `unreachable`.

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
    units = np.array([METRES[record.unit] if name in LENGTHS else 1.0 for name in names])

    def rates(numbers: ArrayLike | None, what: str) -> FloatArray | None:
        if numbers is None:
            return None
        checked = border.checked(numbers, names, f"{what} of {record.name}") * units
        return np.broadcast_to(checked, (*given.shape[:-1], len(units))).reshape(-1, len(units))

    joints = joints_in_mode(record, flat, mode)
    lost = ~np.all(np.isfinite(joints), axis=-1)
    values = np.where(lost[:, None], home_values(record), joints)
    moving = rates(velocity, "velocity"), rates(acceleration, "acceleration")
    return forces_at(record, values, load_of(load, gravity), *moving, lost=lost)


def forces_at(
    record: MechanismRecord,
    values: FloatArray,
    load: Load,
    velocity: FloatArray | None = None,
    acceleration: FloatArray | None = None,
    *,
    lost: BoolArray | None = None,
) -> ActuatorForces:
    """Forces at joint values (N, n), for rates and accelerations (N, k) of the pose in SI units; at rest without.

    Where `lost` (N,) is true the joint values stand in for a pose that is not reached.

    Errors:
        UsageError: gravity or motion, and links of which the file says no mass.
    """
    moves = velocity is not None or acceleration is not None
    known = all_masses(record) if load.gravity or moves else masses(record)
    inertia = link_inertia(record, values, known)
    motion = closed_motion(inertia, values)
    instant = instantaneous(record, values)
    count = (len(values), motion.pose.shape[1])
    rates = np.zeros(count) if velocity is None else np.broadcast_to(velocity, count)
    speeding = np.zeros(count) if acceleration is None else np.broadcast_to(acceleration, count)
    joint_rates = motion.rates(rates)
    still = motion.second(joint_rates, np.zeros(count))
    second = motion.second(joint_rates, speeding)
    weight = inertia.weight if load.gravity else np.zeros_like(second)
    applied = load.wrench_at(motion.point)
    pushed = np.einsum("nkj,nk->nj", motion.platform, applied)
    idle = motion.idle_accelerations(inertia.needed(joint_rates, second) + weight - pushed)
    second = second + idle
    needed = inertia.needed(joint_rates, second) + weight - pushed
    status = _status(instant, moves)
    if lost is not None:
        status[lost] = int(Status.unreachable)
    tau, preload = _balanced(motion, needed)
    none = np.isin(status, _NO_FORCES)
    unknown = np.isin(status, (Status.not_closed, Status.unreachable)) | bool(known.lacking)
    unrated = unknown | instant.singular_input | instant.no_rates
    gravity = inertia.weight
    across = np.swapaxes(motion.of_pose, -1, -2)
    input_rates = joint_rates @ motion.drives.T
    input_rates[np.abs(input_rates) <= ROUNDED * np.abs(joint_rates).max(axis=-1, keepdims=True)] = (
        0.0  # friction holds
    )
    band, friction = _friction(record, input_rates)
    missing = np.where(unknown, np.nan, 0.0)
    at_pose = {
        "mass_matrix": across @ inertia.matrix @ motion.of_pose,
        "bias": (across @ inertia.needed(joint_rates, still)[..., None])[..., 0],
        "gravity": (across @ gravity[..., None])[..., 0],
    }
    shapes = {name: part.shape for name, part in at_pose.items()}
    hidden = {name: np.where(_like(unrated, shapes[name]), np.nan, part) for name, part in at_pose.items()}
    tau = np.where(none[:, None], np.nan, tau)
    return ActuatorForces(
        record=record,
        values=values,
        status=status,
        forces=tau,
        friction=friction,
        friction_band=band,
        input_rates=input_rates,
        kinetic_energy=inertia.kinetic(joint_rates) + missing,
        potential_energy=inertia.potential + missing,
        power=np.einsum("nd,nd->n", tau, input_rates),
        growth=_growth(motion),
        preload=preload,
        unbalanced=(np.linalg.norm(idle, axis=-1) > STILL) & (not moves),
        motion=motion,
        joint_rates=joint_rates,
        joint_accelerations=second,
        load=load,
        **hidden,
    )


_NO_FORCES = (
    Status.parallel,
    Status.comprehensive,
    Status.constraint,
    Status.self_motion,
    Status.not_closed,
    Status.unreachable,
    Status.undecided,
)


def _like(rows: BoolArray, shape: tuple[int, ...]) -> BoolArray:
    return np.broadcast_to(rows.reshape(-1, *[1] * (len(shape) - 1)), shape)


def _status(instant: Instant, moves: bool) -> NDArray[np.int8]:
    """Of each configuration; one that moves where the pose's rates are not free is not determined."""
    output, given = instant.singular_output, instant.singular_input
    status = np.full(output.shape, int(Status.regular), dtype=np.int8)
    for name in ("output", "closure"):
        near = np.nan_to_num(instant.measures[name], nan=1.0) < NEAR_SINGULAR
        status[near] = int(Status.near_singular)
    status[given] = int(Status.serial)
    if moves:
        status[given | instant.no_rates] = int(Status.undecided)
    status[output] = int(Status.parallel)
    status[output & given] = int(Status.comprehensive)
    status[instant.ranks.freedoms > instant.general.freedoms] = int(Status.constraint)
    status[~instant.closed] = int(Status.not_closed)
    return status


def _balanced(motion: ClosedMotion, needed: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Forces (N, d) of the drives for forces (N, n) of the joint rates, and preload (N, d, r)."""
    units = drive_units(motion.record)
    free = np.swapaxes(motion.free, -1, -2)
    driven = free @ (motion.drives / units[:, None]).T  # (N, n, d)
    own = (free @ needed[..., None])[..., 0]
    _, sizes, right = np.linalg.svd(driven, full_matrices=True)
    rank = np.sum(sizes > 1e-9, axis=-1)
    usual = int(np.max(rank)) if len(rank) else 0
    inverse = np.linalg.pinv(driven, rcond=1e-9)
    tau = (inverse @ own[..., None])[..., 0] / units
    if driven.shape[-1] > usual:  # least norm in newtons, not in units of the drives
        scaled = free @ motion.drives.T
        tau = (np.linalg.pinv(scaled, rcond=1e-9) @ own[..., None])[..., 0]
        right = np.linalg.svd(scaled, full_matrices=True)[2]
    preload = np.swapaxes(right[:, usual:], -1, -2)
    return tau, preload


def _growth(motion: ClosedMotion) -> FloatArray:
    """Largest force (N,) of an actuator per unit force at the platform, moments over the characteristic length."""
    units = np.repeat([motion.length, 1.0], 3)
    free = np.swapaxes(motion.free, -1, -2)
    per_load = np.linalg.pinv(free @ motion.drives.T, rcond=1e-9) @ free @ np.swapaxes(motion.platform, -1, -2) * units
    return np.asarray(np.max(np.linalg.norm(per_load, axis=-1), axis=-1))


def _friction(record: MechanismRecord, rates: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The band (d,) at rest, and what is added (N, d) at rates (N, d) of the inputs."""
    labels = [record.coordinate_label(item.coordinate) for item in record.drives]
    known = [record.machine.actuators.get(label) for label in labels]
    coulomb, viscous = (
        np.array([getattr(item, name) if item else 0.0 for item in known]) for name in ("coulomb", "viscous")
    )
    return coulomb, coulomb * np.sign(rates) + viscous * rates
