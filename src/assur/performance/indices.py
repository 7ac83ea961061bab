"""Indices of a mechanism, pose by pose: what papers print of its Jacobian, and how it transmits motion and force.

All are of J_L, the Jacobian J = Jp^-1 Jq with lengths divided by the characteristic length L where units mix
(`assur.performance.scaling`), with singular values s1 >= ... >= sk, and of the transmission wrenches
(`assur.performance.transmission`):

- condition: s_k / s_1 = 1/cond2, 0 singular, 1 isotropic (Salisbury and Craig 1982; Gosselin and Angeles 1991);
- frobenius: k / (|J|_F |J^-1|_F), as condition with the Frobenius norm;
- manipulability: sqrt(det(J J^T)) = s_1 s_2 ... s_k (Yoshikawa 1985);
- largest, smallest: s_1 and s_k, the velocity factors in the fastest and slowest direction;
- input_transmission, output_transmission, transmission: the least of each kind, and the least of all (Wang, Wu and
  Liu 2010).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UnknownNameError
from assur.kinematics import border
from assur.kinematics.closed_form.branches import Branches
from assur.kinematics.closed_form.mode_reading import ModeReading
from assur.kinematics.position import branches_at, inverse
from assur.kinematics.rates.acceleration import reached_in_mode
from assur.kinematics.rates.units import factor_unit, scaled
from assur.kinematics.rates.velocity import VelocityMap, velocity_map_at, velocity_map_of
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.performance.scaling import Length, chosen_length
from assur.performance.transmission import Transmission, transmission_at
from assur.results.notebook import Entries, Tabulated

FloatArray = NDArray[np.float64]
BLOCK = 2**13


@dataclass(frozen=True, eq=False)
class Indices(Tabulated):
    """Indices at poses or configurations (...).

    Attributes:
        record: the mechanism.
        joints: (..., n) joint values there; NaN out of reach.
        status: (...) `Status` of each; it says why a number is missing.
        length: the characteristic length that lengths are divided by, in the mechanism's unit; None where none is.
        unit: of a velocity factor, as "mm/rad"; "" where it is a number.
        velocity_factors: (..., k) singular values of J_L, largest first; NaN out of reach and where Jp is singular.
        singular: (...) whether Jp or Jq is singular.
    """

    record: MechanismRecord
    joints: FloatArray
    status: NDArray[np.int8]
    length: float | None
    unit: str
    velocity_factors: FloatArray
    singular: NDArray[np.bool_]

    @cached_property
    def transmission(self) -> Transmission:
        """Transmission indices of each input; NaN out of reach, 0 where Jp or Jq is singular."""
        known = np.all(np.isfinite(self.joints), axis=-1)[..., None]
        at = transmission_at(self.record, np.where(known, self.joints, 0.0))
        at_singular = np.where(known, 0.0, np.nan)
        usable = known & ~self.singular[..., None]
        return Transmission(*(np.where(usable, values, at_singular) for values in (at.inputs, at.outputs)))

    def __getitem__(self, name: str) -> FloatArray:
        """One index (...) by its name in `INDICES`."""
        return index_named(name).of(self)

    def _title(self) -> str:
        return f"indices of {self.record.name}"

    def _entries(self) -> Entries:
        columns = {name: self[name].ravel().tolist() for name in INDICES}
        status = [Status(code).name for code in self.status.ravel().tolist()]
        rows = [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]
        return [row | {"status": name} for row, name in zip(rows, status, strict=True)]

    @property
    def condition_number(self) -> FloatArray:
        """Condition number (...) of J_L in the 2-norm, one over the index "condition"; infinite where that is 0.

        The same as `assur.kinematics.rates.velocity.VelocityMap.condition` where no other length is asked for.
        """
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(1.0 / self["condition"])


@dataclass(frozen=True)
class Index:
    """A kind of index: its symbol in LaTeX, what it is in words, its values, and how it counts in `Indices.unit`.

    `formula` is in letters, `zero` and `one` are what these values mean, and `source` where the index comes from.
    `power` is 1 for a velocity factor, 0 for a number between 0 and 1; the product of all factors has None. `unbounded`
    says that it grows without bound towards a parallel singularity.
    """

    symbol: str
    meaning: str
    power: int | None
    of: Callable[[Indices], FloatArray]
    unbounded: bool = False
    formula: str = ""
    zero: str = "nothing special"
    one: str = "nothing special"
    source: str = ""

    def unit(self, indices: Indices) -> str:
        """Its unit, as "mm/rad" or "(mm/rad)^2"; "" for a number."""
        power = indices.velocity_factors.shape[-1] if self.power is None else self.power
        if not indices.unit or power == 0:
            return ""
        return indices.unit if power == 1 else f"({indices.unit})^{power}"


def _condition(indices: Indices) -> FloatArray:
    largest = indices.velocity_factors[..., 0]
    # a J without any motion at all has index 0
    return np.asarray(indices.velocity_factors[..., -1] / np.where(largest == 0.0, 1.0, largest))


def _frobenius(indices: Indices) -> FloatArray:
    factors = indices.velocity_factors
    singular = factors[..., -1:] == 0.0
    safe = np.where(singular, 1.0, factors)
    sizes = np.linalg.norm(safe, axis=-1) * np.linalg.norm(1.0 / safe, axis=-1)
    return np.where(singular[..., 0], 0.0, factors.shape[-1] / sizes)


INDICES: Mapping[str, Index] = {
    "condition": Index(
        r"1/\kappa(J)",
        "local condition index: 0 singular, 1 isotropic",
        0,
        _condition,
        formula="c = s_r / s₁ = 1/κ₂",
        zero="singular",
        one="isotropic: the same in all directions",
        source="Salisbury and Craig 1982; Gosselin and Angeles 1991",
    ),
    "frobenius": Index(
        r"1/\kappa_F(J)",
        "the same with the Frobenius norm",
        0,
        _frobenius,
        formula="c_F = r / (‖J‖_F ‖J⁻¹‖_F)",
        zero="singular",
        one="isotropic",
        source="Angeles, Fundamentals of Robotic Mechanical Systems",
    ),
    "manipulability": Index(
        r"\mu",
        "manipulability, the product of the velocity factors",
        None,
        lambda at: np.prod(at.velocity_factors, axis=-1),
        unbounded=True,
        formula="μ = √det(J Jᵀ) = s₁ s₂ ... s_r",
        zero="the ellipsoid is flat",
        source="Yoshikawa 1985",
    ),
    "largest": Index(
        r"\sigma_{\max}",
        "largest velocity factor",
        1,
        lambda at: at.velocity_factors[..., 0],
        unbounded=True,
        formula="s₁",
        zero="no motion",
    ),
    "smallest": Index(
        r"\sigma_{\min}",
        "smallest velocity factor",
        1,
        lambda at: at.velocity_factors[..., -1],
        formula="s_r",
        zero="serial singularity",
    ),
    "input_transmission": Index(
        r"\mathrm{ITI}",
        "least input transmission index: how well inputs drive their limbs",
        0,
        lambda at: np.min(at.transmission.inputs, axis=-1),
        formula="least of |$ᵢ ∘ $ₜ| / |$ᵢ ∘ $ₜ|max over the inputs",
        zero="an input does not drive its limb",
        one="every input drives its limb fully",
        source="Wang, Wu and Liu 2010",
    ),
    "output_transmission": Index(
        r"\mathrm{OTI}",
        "least output transmission index: how well limbs drive the platform",
        0,
        lambda at: np.min(at.transmission.outputs, axis=-1),
        formula="least of |$ₜ ∘ $ₒ| / |$ₜ ∘ $ₒ|max over the inputs",
        zero="a limb does not drive the platform",
        one="all drive it fully",
        source="Wang, Wu and Liu 2010",
    ),
    "transmission": Index(
        r"\mathrm{LTI}",
        "local transmission index, the least of all",
        0,
        lambda at: at.transmission.local,
        formula="the least of both kinds",
        zero="singular",
        one="all motion and force are transmitted",
        source="Wang, Wu and Liu 2010",
    ),
}
"""Every index by its name, in the order in which they are printed."""


def index_named(name: str) -> Index:
    """The index of that name, or a clear refusal."""
    if name not in INDICES:
        raise UnknownNameError("index", name, INDICES)
    return INDICES[name]


def indices(
    record: MechanismRecord, poses: ArrayLike, mode: str | None = None, characteristic_length: Length = None
) -> Indices:
    """Every index at poses (..., m) in a working mode (the file's default), by the closed form where there is one.

    Args:
        record: the mechanism. Without a closed form home is followed to each pose, and where a mode is named joint
            values are searched for, pose by pose: that is slow, and a workspace that was followed knows them
            (`overall.overall`, or `indices_at` of its `joints`).
        poses: (..., m), lengths in the mechanism's unit and rad.
        mode: signs of the working mode.
        characteristic_length: a length; "isotropic" for the one that makes J_L most isotropic over these poses; None
            for the mechanism's own where lengths and angles mix, and for none elsewhere.

    Errors:
        UsageError: a length that is none, poses of the wrong shape, an unknown mode.

    Example: at the corner Q1 of its cube the Orthoglide's velocity factors are 2, 4/5, 4/5, and its local transmission
    index is 1/sqrt(1.98).

    >>> from assur.model.registry import load_record
    >>> here = indices(load_record("orthoglide"), [73.2050807568877] * 3)
    >>> here.velocity_factors.round(6), round(float(here["condition"]), 6), round(float(here["transmission"]), 6)
    (array([2. , 0.8, 0.8]), 0.4, 0.710669)
    """
    given = border.checked_poses(record, poses)
    flat = given.reshape(-1, given.shape[-1])
    mode = mode or record.modes.default_working
    parts = [_at_poses(record, flat[start : start + BLOCK], mode) for start in range(0, max(1, len(flat)), BLOCK)]
    return _gathered(record, parts, given.shape[:-1], characteristic_length)


def indices_where(
    record: MechanismRecord,
    poses: FloatArray,
    mode: str,
    holds: Callable[[ModeReading], NDArray[np.bool_]],
    characteristic_length: Length = None,
) -> tuple[NDArray[np.bool_], Indices]:
    """Where something holds (N,) of a mechanism with a closed form at poses (N, m), and every index at those poses.

    Args:
        record: with a closed form.
        poses: (N, m), lengths in the mechanism's unit and rad.
        mode: signs of the working mode.
        characteristic_length: as of `indices`.
        holds: (N,) of the kernel's one reading at N poses, of which the indices are made too.

    >>> from assur.model.registry import load_record
    >>> record, poses = load_record("fivebar"), np.array([[0.0, 200.0], [0.0, 900.0]])
    >>> inside, found = indices_where(record, poses, "-+", lambda read: read.exists)
    >>> inside, found["condition"].shape
    (array([ True, False]), (1,))
    """
    inside, parts = [], []
    for start in range(0, max(1, len(poses)), BLOCK):
        solved = branches_at(record, poses[start : start + BLOCK], mode)
        inside.append(np.broadcast_to(holds(solved.reading), solved.batch_shape))
        parts.append(_of_branches(solved, inside[-1]))
    kept = np.concatenate(inside)
    return kept, _gathered(record, parts, (int(np.sum(kept)),), characteristic_length)


def indices_at(record: MechanismRecord, joints: ArrayLike, characteristic_length: Length = None) -> Indices:
    """Every index at joint values (..., n), from the joint graph alone: see `indices`.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("tripteron")
    >>> float(indices_at(record, home_values(record))["condition"].round(9))
    1.0
    """
    values = np.asarray(joints, dtype=float)
    batch = values.shape[:-1]
    flat = values.reshape(-1, values.shape[-1])
    parts = [_at_joints(record, flat[start : start + BLOCK]) for start in range(0, max(1, len(flat)), BLOCK)]
    return _gathered(record, parts, batch, characteristic_length)


Part = tuple[NDArray[np.int8], FloatArray, FloatArray, NDArray[np.bool_]]
"""Status (N,), J (N, k, n), joint values (N, n), NaN where they are missing, and where Jp or Jq is singular (N,)."""


def _at_poses(record: MechanismRecord, poses: FloatArray, mode: str) -> Part:
    if record.closed_form is None:
        if not mode or mode == record.modes.default_working:
            return _of_home(record, poses)
        return _at_joints(record, inverse(record, poses, mode).first_joints)
    solved = branches_at(record, poses, mode)
    return _of_branches(solved, np.ones(len(poses), dtype=bool))


def _of_branches(solved: Branches, kept: NDArray[np.bool_]) -> Part:
    """Those poses of a batch (N,) in one mode that are kept: every number is a column of one reading."""
    velocity = velocity_map_of(solved.reading, solved.batch_shape).rows(kept)
    return _part(solved.status[kept, 0], velocity, solved.joints[kept, 0])


def _of_home(record: MechanismRecord, poses: FloatArray) -> Part:
    """Home's mode at poses (N, m), followed from home; undecided where no path leads there, unreachable where it is
    proved that none does.
    """
    joints, lost = reached_in_mode(record, poses)
    absent = lost != Status.regular
    status, matrices, joints, singular = _at_joints(record, np.where(absent[:, None], np.nan, joints))
    return np.where(absent, lost, status), matrices, joints, singular


def _at_joints(record: MechanismRecord, joints: FloatArray) -> Part:
    known = np.all(np.isfinite(joints), axis=-1)
    velocity = velocity_map_at(record, np.where(known[:, None], joints, 0.0))
    status = np.where(known, status_of(velocity), Status.unreachable).astype(np.int8)
    return _part(status, velocity, joints)


def status_of(velocity: VelocityMap) -> NDArray[np.int8]:
    """`Status` (...) of configurations by what is singular there; unreachable where loops are open.

    Undecided where nothing is singular but the coordinates of the pose have no rates (`VelocityMap.no_rates`).
    """
    kinds = 2 * velocity.singular_input + 3 * velocity.singular_output
    of_kind = np.array([Status.regular, 0, Status.serial, Status.parallel, 0, Status.comprehensive], dtype=np.int8)
    status = np.where((kinds == 0) & velocity.no_rates, Status.undecided, of_kind[kinds])
    return np.where(velocity.exists, status, Status.unreachable).astype(np.int8)


def _part(status: NDArray[np.int8], velocity: VelocityMap, joints: FloatArray) -> Part:
    missing = (status == Status.unreachable) | ~np.all(np.isfinite(joints), axis=-1)
    missing |= (status == Status.undecided) & ~velocity.no_rates
    matrix = np.where((missing | velocity.singular_output | velocity.no_rates)[:, None, None], np.nan, velocity.matrix)
    singular = velocity.singular_output | velocity.singular_input
    return status, matrix, np.where(missing[:, None], np.nan, joints), singular


def _gathered(record: MechanismRecord, parts: list[Part], batch: tuple[int, ...], length: Length) -> Indices:
    status, matrices, joints, singular = (np.concatenate(column) for column in zip(*parts, strict=True))
    unit_length = chosen_length(record, length, matrices)
    known = np.all(np.isfinite(matrices), axis=(-1, -2))
    safe = scaled(record, np.where(known[:, None, None], matrices, 0.0), unit_length)
    factors = np.where(known[:, None], np.linalg.svd(safe, compute_uv=False), np.nan)
    return Indices(
        record=record,
        joints=joints.reshape(*batch, joints.shape[-1]),
        status=status.reshape(batch),
        length=unit_length,
        unit=factor_unit(record, unit_length),
        velocity_factors=factors.reshape(*batch, factors.shape[-1]),
        singular=singular.reshape(batch),
    )
