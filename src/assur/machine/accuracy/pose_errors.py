"""How errors of dimensions and of inputs move the platform while the inputs are held, and what these add to.

To first order. Where an error alone does not assemble, the elastic structure says where the platform settles, if links
bend by profiles.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border
from assur.kinematics.pose import platform_frame, twist_rates
from assur.kinematics.rates.acceleration import reached_in_mode
from assur.kinematics.rates.motions import motions
from assur.kinematics.status import Status
from assur.kinematics.validation.check import METRES
from assur.machine.accuracy.elastic_errors import elastic_errors
from assur.machine.accuracy.error_closure import FITS, ErrorClosure, error_closure
from assur.machine.accuracy.geometry_errors import geometry_errors
from assur.machine.accuracy.proved_poses import ProvedPoses, proved_poses
from assur.machine.accuracy.sampled_poses import COUNT, SEED, SampledPoses, sampled_poses
from assur.machine.elasticity.structure import yields
from assur.machine.forces.reactions import child_points
from assur.model.mechanism import MechanismRecord
from assur.results.notebook import Entries, Tabulated
from assur.work import Progress

FloatArray = NDArray[np.float64]
ROUNDED = 1e-9
"""Share of the largest error, lengths over the characteristic one, below which what is left of one is rounding."""
COORDINATES = ("x", "y", "z", "rx", "ry", "rz")


@dataclass(frozen=True, eq=False)
class PoseErrors(Tabulated):
    """First-order errors of the platform at a pose: displacement in the mechanism's unit, then rotation vector in rad.

    Attributes:
        record: the mechanism.
        values: (n,) joint values; NaN where the pose is not reached.
        status: `regular`; `parallel` where the inputs do not hold the platform; `unreachable`.
        sensitivity: (6,) per unit of each copy of a dimension, and of each input; NaN where it does not assemble.
        units: what each of these is per.
        stresses: of what does not assemble: the wrenches (6,) of joints, force and moment at the child's point, that
            balance themselves and bear it, the largest force 1; joints that bear nothing are left out.
        settled: of these, those whose sensitivity is where the elastic structure settles.
        clearances: (6,) of each joint with a clearance, the largest error of each coordinate, as far as loops close.
    """

    record: MechanismRecord
    values: FloatArray
    status: Status
    sensitivity: Mapping[str, FloatArray]
    units: Mapping[str, str]
    stresses: Mapping[str, Mapping[str, FloatArray]]
    settled: tuple[str, ...]
    clearances: Mapping[str, FloatArray]

    def compatible(self, name: str) -> bool:
        """Whether an error of that name alone assembles.

        >>> import assur
        >>> assur.load("fivebar").errors([0.0, 224.0]).compatible("l1")
        True
        """
        return name not in self.stresses

    @property
    def bounds(self) -> dict[str, float]:
        """Tolerances of the file, in the units of the sensitivities."""
        return {name: item.bound / self._unit(name) for name, item in self.record.machine.tolerances.items()}

    def _unit(self, name: str) -> float:
        """What one unit of a sensitivity is as the file's tolerances are kept."""
        return float(np.radians(1.0)) if self.units.get(name) == "deg" else 1.0

    @property
    def worst_case(self) -> FloatArray:
        """The largest error (6,) of each coordinate if every tolerance is at its bound."""
        own = [np.abs(self.sensitivity[name]) * bound for name, bound in self.bounds.items()]
        return np.asarray(np.sum(own, axis=0)) if own else np.full(6, np.nan)

    @property
    def root_sum_square(self) -> FloatArray:
        """The root of the sum of squares (6,) of what each tolerance at its bound does."""
        own = [(self.sensitivity[name] * bound) ** 2 for name, bound in self.bounds.items()]
        return np.sqrt(np.sum(own, axis=0)) if own else np.full(6, np.nan)

    @property
    def covariance(self) -> FloatArray:
        """(6, 6) of errors that are independent of each other, with the file's standard deviations."""
        tolerances = self.record.machine.tolerances
        own = [self.sensitivity[name] * item.sigma / self._unit(name) for name, item in tolerances.items()]
        return np.asarray(np.sum([np.outer(part, part) for part in own], axis=0)) if own else np.full((6, 6), np.nan)

    @cached_property
    def _made_up(self) -> tuple[FloatArray, FloatArray]:
        """What is added to inputs (d, e) so that errors leave the pose where it is, and what is left (6, e) of them."""
        if not self.sensitivity:
            return np.zeros((len(self.record.drives), 0)), np.zeros((6, 0))
        length, names = characteristic_length(self.record), self.record.platform.pose
        size = np.repeat([length, 1.0], 3)[:, None]
        errors = np.array([self.sensitivity[name] for name in self._dimensions]).reshape(-1, 6).T / size
        own = motions(self.record, self.values)  # of redundant drives too, none of which moves alone
        twists = np.roll(own.twists, 3, axis=0)
        turn = platform_frame(self.record, self.values)[0]
        rates = np.roll(twist_rates(names, turn, np.eye(6)), 3, axis=1)  # of displacements before rotations
        along = -np.linalg.pinv(rates @ twists, rcond=FITS) @ rates @ errors
        left = errors + twists @ along
        left[np.abs(left) < ROUNDED * np.nanmax(np.abs(errors), initial=0.0)] = 0.0
        joints = own.scale[:, None] * (own.null @ along)
        added = [item.sign * joints[item.coordinate.index] for item in self.record.drives]
        return np.array(added), left * size

    @property
    def _dimensions(self) -> list[str]:
        inputs = {item.name for item in self.record.drives}
        return [name for name in self.sensitivity if name not in inputs]

    @property
    def corrections(self) -> dict[str, FloatArray]:
        """What has to be added to the inputs (d,), per unit of each dimension, to bring the pose back.

        A calibrated controller does so: what it cannot take away is `uncompensated`.

        >>> import assur
        >>> errors = assur.load("fivebar").errors([0.0, 224.0])
        >>> (errors.corrections["crank1.l1"].round(4) + 0.0).tolist()
        [0.002, 0.0]
        """
        return dict(zip(self._dimensions, self._made_up[0].T, strict=True))

    @property
    def uncompensated(self) -> dict[str, FloatArray]:
        """What is left (6,) of the error of each dimension when the inputs bring the pose back.

        Calibration can tell of it and do nothing about it, as about the tilt of a platform that only translates.

        >>> import assur
        >>> left = assur.load("delta_4s").errors([0.0, 0.1, -0.9]).uncompensated
        >>> left["leg1.L"].tolist(), left["leg1.rod1.l"].round(2).tolist()
        ([0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0, -5.43, -5.51])
        """
        return dict(zip(self._dimensions, self._made_up[1].T, strict=True))

    @cached_property
    def proved(self) -> ProvedPoses:
        """Bounds of the pose with every tolerance of the file, proved: see `assur.machine.accuracy.proved_poses`."""
        own = self.off
        return proved_poses(self.record, self.values, own) if own else ProvedPoses({}, "no tolerances are stated")

    @property
    def off(self) -> dict[str, float]:
        """Tolerances of the file that are not zero, in lengths and rad."""
        return {name: item.bound for name, item in self.record.machine.tolerances.items() if item.bound > 0.0}

    def sampled(self, count: int = COUNT, seed: int = SEED, progress: Progress | None = None) -> SampledPoses:
        """Poses of mechanisms drawn at random within the file's tolerances: `assur.machine.accuracy.sampled_poses`.

        Args:
            count: how many are drawn.
            seed: of the generator that draws them.
            progress: told how many are done.

        Errors:
            UsageError: there are no tolerances.

        >>> import assur
        >>> reached = assur.load("delta_4s").errors([0, 0, -0.9]).sampled(1000)
        >>> low, high = reached.bounds["z"]
        >>> reached.count, reached.assembled >= 1000, -0.901 < low < -0.9 < high < -0.899
        (1000, True, True)
        """
        if not self.off:
            raise UsageError(f"{self.record.name} states no tolerances", hint="there is nothing to draw from")
        return sampled_poses(self.record, self.values, self.off, self.sensitivity, count, seed, progress)

    def _title(self) -> str:
        return f"errors of the platform of {self.record.name} per unit ({self.status.name})"

    def _entries(self) -> Entries:
        return [
            {"name": name, **dict(zip(COORDINATES, row.tolist(), strict=True))}
            for name, row in self.sensitivity.items()
        ]

    def __str__(self) -> str:
        rows = [
            f"{name}: {', '.join(f'{number + 0.0:.6g}' for number in row)}" for name, row in self.sensitivity.items()
        ]
        head = f"{', '.join(COORDINATES)} of {self.record.name} per unit ({self.status.name})"
        return "\n".join([head, *rows])


def pose_errors(record: MechanismRecord, pose: ArrayLike, mode: str | None = None) -> PoseErrors:
    """Errors at a pose (m,), in the mechanism's unit and rad, in a working mode (the file's default without one).

    Errors:
        UsageError: a pose of another shape; a tolerance of what is not written in any joint.

    Example: `l7` and `l8` of the paper's mechanism act by their sum, `b` and `d` by their difference.

    >>> from assur.model.registry import load_record
    >>> errors = pose_errors(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315])
    >>> [(errors.sensitivity[name][:3].round(4) + 0.0).tolist() for name in ("l7", "l8")]
    [[-0.8989, 0.0, 0.4782], [-0.8989, 0.0, 0.4782]]
    >>> bool(abs(errors.sensitivity["b"] + errors.sensitivity["d"]).max() < 1e-9)
    True
    """
    flat = border.checked_poses(record, pose).reshape(-1, len(record.platform.pose))
    if len(flat) != 1:
        raise UsageError(f"{len(flat)} poses", hint="errors are of one pose at a time")
    values, lost = reached_in_mode(record, flat, mode)
    if lost[0] != Status.regular:
        return PoseErrors(record, np.full_like(values[0], np.nan), Status(int(lost[0])), {}, {}, {}, (), {})
    return pose_errors_at(record, values[0])


def pose_errors_at(record: MechanismRecord, values: FloatArray, *, bent: bool = True) -> PoseErrors:
    """Errors at joint values (n,) that close the loops; `bent`: with where links settle that do not assemble."""
    own = error_closure(record, values)
    if not own.held:
        return PoseErrors(record, values, Status.parallel, {}, {}, {}, (), {})
    errors = geometry_errors(record, values)
    _check_tolerances(record, errors.names)
    twists = errors.twists.reshape(len(errors.names), 6 * len(errors.joints)).T
    moved, left_open = own.answer(twists)
    moved[:3] += errors.point.T
    lost = np.flatnonzero(np.linalg.norm(left_open, axis=0) > FITS * own.sizes(twists))
    points = child_points(record, values[None])
    stresses = {errors.names[place]: _borne(own, left_open[:, place], points) for place in lost}
    moved[:, lost] = np.nan
    settled: tuple[str, ...] = ()
    if bent and len(lost) and yields(record):
        try:
            moved[:, lost] = elastic_errors(record, values, errors.twists[lost].transpose(1, 2, 0))
            moved[:3, lost] += errors.point[lost].T
            settled = tuple(errors.names[place] for place in lost if np.all(np.isfinite(moved[:, place])))
        except UsageError:
            pass  # the file says too little of profiles or actuators
    sensitivity = {name: moved[:, place] for place, name in enumerate(errors.names)}
    units = dict(zip(errors.names, errors.units, strict=True))
    for item in record.drives:
        drive = np.zeros((len(values), 1))
        drive[item.coordinate.index] = item.sign
        row, drive_open = own.answer(np.zeros((own.of_twists.shape[1], 1)), drive)
        fits = np.linalg.norm(drive_open) <= FITS * np.linalg.norm(own.loops @ drive)
        sensitivity[item.name] = row[:, 0] if fits else np.full(6, np.nan)
        units[item.name] = record.unit if item.coordinate.kind == "length" else "rad"
        if not fits:
            stresses[item.name] = _borne(own, drive_open[:, 0], points)
    return PoseErrors(record, values, Status.regular, sensitivity, units, stresses, settled, _clearances(own))


def _check_tolerances(record: MechanismRecord, names: tuple[str, ...]) -> None:
    inputs = {item.name for item in record.drives}
    lacking = [name for name in record.machine.tolerances if name not in names and name not in inputs]
    if lacking:
        raise UsageError(
            f"{record.name}: a tolerance of {lacking[0]}, which no joint is written with",
            hint=f"there are: {', '.join(names)}",
        )


def _borne(own: ErrorClosure, left_open: FloatArray, points: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Wrenches (6,) of the joints that bear a stress, at their children's points, moments in m."""
    metre, length = METRES[own.record.unit], characteristic_length(own.record)
    borne = {}
    for joint, wrench in zip(own.record.joints, own.stress(left_open), strict=True):
        if np.max(np.abs(wrench)) > FITS:
            force, moment = wrench[:3], wrench[3:] * length * metre
            borne[joint] = np.concatenate([force, moment + np.cross(own.point * metre - points[joint], force)])
    return borne


def _clearances(own: ErrorClosure) -> dict[str, FloatArray]:
    """The largest error (6,) of each coordinate, of each joint whose point is free within a ball."""
    record = own.record
    names, largest = list(record.joints), dict[str, FloatArray]()
    for joint, radius in record.machine.clearances.items():
        shifts = np.zeros((6, 3))
        shifts[3:] = np.eye(3)
        twists = np.zeros((6 * len(names), 3))
        twists[6 * names.index(joint) : 6 * names.index(joint) + 6] = shifts
        moved, left_open = own.answer(twists)
        _, sizes, right = np.linalg.svd(left_open, full_matrices=True)
        rank = int(np.sum(sizes > FITS * own.sizes(twists).max()))
        largest[joint] = radius * np.linalg.norm(moved @ right[rank:].T, axis=1)
    return largest
