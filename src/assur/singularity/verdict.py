"""The verdict on one configuration: its kind, every factor, and the rank of the whole joint graph."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.border import Named, checked_joints, checked_poses
from assur.kinematics.closure import mobility
from assur.kinematics.following.home_mode import home_mode_at
from assur.kinematics.position import inverse, modes_at
from assur.kinematics.rates.finite_motion import sides, status_of
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.rates.motions import general
from assur.kinematics.rates.velocity import VelocityMap, velocity_map
from assur.kinematics.status import Status, closed_form_of, relative_factors
from assur.model.mechanism import MechanismRecord
from assur.results.notebook import Entries, Tabulated
from assur.work import stage

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Verdict(Tabulated):
    """What a configuration is.

    Attributes:
        kind: regular, serial, parallel, comprehensive, constraint or self_motion; unreachable where the
            mode does not reach the pose; not_closed where the joint values do not close the loops.
        near: whether a factor is within `NEAR_SINGULAR` of zero without being zero.
        reduced_kind: the kind by the factors of det Jp and det Jq alone (serial, parallel, comprehensive).
        closest: name of the factor that is closest to zero, relative to its scale; empty where there is none.
        factors, relative: those of the closed form, and divided by their scales. Judged on the joint graph: its
            measures, output, input and closure (`assur.kinematics.rates.instantaneous.Instant`).
        det_jp, det_jq, condition: of the regular form; the condition number is None where singular, with lengths
            divided by the characteristic length where units mix (`assur.kinematics.rates.units`). On the joint graph
            the determinants are known up to a factor of both, and only the sign of their product means anything.
        rank, generic_rank: of the closure of the whole joint graph, here and in general.
        freedoms: mobility of the joint graph here, by that rank.
        types: Zlatanov's types, on the joint graph (`Instant.types`).
        platform_gains: whether the platform has more freedoms than in general, all inputs free; None where not asked.
        home: without a closed form, whether the configuration belongs to home's mode, as paths from home decide; None
            where there is a closed form, or joint values were given. `home_by` says by what.
        known_modes: where the mode that was asked for does not reach the pose, the modes of the solutions that are
            known there.
        gap: of the ranks on the joint graph, the least ratio of a singular value kept to the largest dropped.
    """

    kind: str
    near: bool
    reduced_kind: str
    closest: str
    factors: Mapping[str, float]
    relative: Mapping[str, float]
    det_jp: float | None
    det_jq: float | None
    condition: float | None
    rank: int | None
    generic_rank: int | None
    freedoms: int | None
    types: tuple[str, ...] = ()
    platform_gains: bool | None = None
    gap: float | None = None
    home: bool | None = None
    home_by: str = ""
    known_modes: tuple[str, ...] = ()

    def _title(self) -> str:
        return f"{self.kind}, near a singularity" if self.near else self.kind

    def _entries(self) -> Entries:
        numbers = {"det Jp": self.det_jp, "det Jq": self.det_jq, "condition": self.condition, "freedoms": self.freedoms}
        return [
            {"what": name, "value": value, "share of its scale": self.relative.get(name, "")}
            for name, value in [*numbers.items(), *self.factors.items()]
        ]


@stage("verdict on the pose")
def verdict(record: MechanismRecord, pose: ArrayLike, mode: str | None = None) -> Verdict:
    """Judge one pose (m,) in a working mode (the file's default where none is given).

    The kind is the most severe of what the factors say and what the rank of the joint graph says. A mechanism without
    closed form is followed from home to the pose where no mode is named; where no path leads there the kind is
    undecided, or unreachable where it is proved that home's mode does not reach it (`home_by` says by what). Of another
    mode the one assembly is found by a search and judged by `verdict_at`, and `home` says whether it is that of home's
    mode.

    >>> from assur.model.registry import load_record
    >>> verdict(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315], "++-++").kind
    'regular'
    """
    named = mode
    mode = mode or record.modes.default_working or None
    if record.closed_form is None and (not named or named == record.modes.default_working):
        return _of_home(record, checked_pose(record, pose))
    solutions = inverse(record, pose, mode)
    if solutions.batch_shape:
        raise UsageError(f"one pose is judged at a time, not a batch of shape {solutions.batch_shape}")
    if record.closed_form is None:
        return _of_the_one(record, solutions)
    status = Status(int(solutions.status[0]))
    if status is Status.unreachable:
        return replace(_nothing(status), known_modes=modes_at(record, "inverse", solutions.given))
    if status in (Status.not_closed, Status.undecided):
        return _nothing(status)
    free = mobility(record, solutions.joints[0])
    usual = max(int(general(record).closure), int(free.rank))
    factors = {name: value[..., 0] for name, value in solutions.factors.items()}
    relative = {name: float(value) for name, value in relative_factors(record, factors).items()}
    dividing = [factor.name for factor in closed_form_of(record).factor_list if factor.kind != "other"]
    kind = status
    if int(free.rank) < usual:
        kind = max(kind, Status.constraint)
    velocities = velocity_map(record, pose, mode)
    return Verdict(
        kind="regular" if kind == Status.near_singular else kind.name,
        near=kind == Status.near_singular,
        reduced_kind=_reduced_kind(bool(velocities.singular_input), bool(velocities.singular_output)),
        closest=min(dividing, key=lambda name: abs(relative[name]), default=""),
        factors={name: float(value) for name, value in factors.items()},
        relative=relative,
        det_jp=float(velocities.det_jp),
        det_jq=float(velocities.det_jq),
        condition=_finite(velocities.condition),
        rank=int(free.rank),
        generic_rank=usual,
        freedoms=int(free.freedoms),
    )


def verdict_at(record: MechanismRecord, joints: Named) -> Verdict:
    """Judge one configuration of the joint graph, joint values (n,), of a mechanism with or without a closed form.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> found = verdict_at(record, home_values(record))
    >>> found.kind, found.freedoms, sorted(found.factors)
    ('regular', 2, ['closure', 'input', 'output'])
    """
    values = checked_joints(record, joints)
    if values.ndim != 1:
        raise UsageError(f"one configuration is judged at a time, not a batch of shape {values.shape[:-1]}")
    instant = instantaneous(record, values)
    status = Status(int(status_of(record, values, instant)))
    if status == Status.not_closed:
        return _nothing(status)
    velocities = VelocityMap.of(record, instant)
    measures = {name: float(value) for name, value in instant.measures.items()}
    serial, parallel = sides(instant)
    return Verdict(
        kind="regular" if status == Status.near_singular else status.name,
        near=status == Status.near_singular,
        reduced_kind=_reduced_kind(bool(serial), bool(parallel)),
        closest=min(measures, key=lambda name: measures[name]),
        factors=measures,
        relative=measures,
        det_jp=_finite(velocities.det_jp),
        det_jq=_finite(velocities.det_jq),
        condition=_finite(velocities.condition),
        rank=int(instant.ranks.closure),
        generic_rank=int(instant.general.closure),
        freedoms=int(instant.ranks.freedoms),
        types=tuple(name for name, holds in instant.types.items() if holds),
        platform_gains=bool(instant.platform_gains),
        gap=_finite(instant.gap),
    )


def checked_pose(record: MechanismRecord, pose: ArrayLike) -> FloatArray:
    """One pose (m,) in lengths and rad, or a clear refusal."""
    given = checked_poses(record, pose)
    if given.ndim != 1:
        raise UsageError(f"one pose is judged at a time, not a batch of shape {given.shape[:-1]}")
    return given


def _of_home(record: MechanismRecord, pose: FloatArray) -> Verdict:
    """The verdict on home's mode at a pose (m,)."""
    at_pose = home_mode_at(record, pose)
    if at_pose.joints is not None:
        return replace(verdict_at(record, at_pose.joints), home=True, home_by=at_pose.words)
    return replace(_nothing(at_pose.status), home=False, home_by=at_pose.words, known_modes=at_pose.others)


def _of_the_one(record: MechanismRecord, solutions: SolutionSet) -> Verdict:
    """The verdict on the only solution of a set that was found by a search."""
    joints = solutions.joints[solutions.exists]
    if not len(joints):
        known = modes_at(record, "inverse", solutions.given)
        return replace(_nothing(Status(int(solutions.overall_status))), known_modes=known)
    if len(joints) > 1:
        several = ", ".join(solutions.labels[solutions.exists])
        raise UsageError(
            f"{record.name}: {len(joints)} assemblies at this pose", hint=f"name a working mode: {several}"
        )
    at_pose = home_mode_at(record, solutions.given)
    same = at_pose.is_home(record, joints[0])
    said = at_pose.words if same else at_pose.other_words
    return replace(verdict_at(record, joints[0]), home=same, home_by=said)


def _nothing(status: Status) -> Verdict:
    return Verdict(status.name, False, status.name, "", {}, {}, None, None, None, None, None, None)


def _finite(number: ArrayLike) -> float | None:
    value = float(np.asarray(number))
    return value if np.isfinite(value) else None


def _reduced_kind(serial: bool, parallel: bool) -> str:
    if serial and parallel:
        return "comprehensive"
    return "serial" if serial else "parallel" if parallel else "regular"
