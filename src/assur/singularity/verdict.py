"""The verdict on one configuration: its kind, every factor, and the rank of the whole joint graph."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from assur.errors import UsageError
from assur.kinematics.closure import mobility
from assur.kinematics.home import home_values
from assur.kinematics.position import inverse
from assur.kinematics.status import Status, closed_form_of, relative_factors
from assur.kinematics.velocity import velocity_map
from assur.model.mechanism import MechanismRecord

SAMPLES = 40


@dataclass(frozen=True)
class Verdict:
    """What a configuration is.

    Attributes:
        kind: regular, serial, parallel, comprehensive, constraint or self_motion; unreachable where the
            mode does not reach the pose.
        near: whether a factor is within `NEAR_SINGULAR` of zero without being zero.
        reduced_kind: the kind by the factors of det Jp and det Jq alone (serial, parallel, comprehensive).
        closest: name of the factor that is closest to zero, relative to its scale.
        det_jp, det_jq, condition: of the regular form; the condition number is None where singular.
        rank, generic_rank: of the closure of the whole joint graph, here and in general.
        freedoms: mobility of the joint graph here, by that rank.
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


@lru_cache(maxsize=64)
def generic_rank(record: MechanismRecord) -> int:
    """Rank of the closure of the joint graph in general: the largest over solutions at poses of the file's box.

    Where the box holds no solution, at the assembled home.
    """
    if record.closed_form and all(name in record.box for name in record.platform.pose):
        low, high = np.array([record.box[name] for name in record.platform.pose]).T
        poses = np.random.default_rng(0).uniform(low, high, size=(SAMPLES, len(low)))
        found = inverse(record, poses)
        solutions = found.joints[found.exists][:SAMPLES]
        if len(solutions):
            return int(np.max(mobility(record, solutions).rank))
    return int(mobility(record, home_values(record)).rank)


def verdict(record: MechanismRecord, pose: ArrayLike, mode: str | None = None) -> Verdict:
    """Judge one pose (m,) in a working mode (the file's default where none is given).

    The kind is the most severe of what the factors say and what the rank of the joint graph says.

    >>> from assur.model.registry import load_record
    >>> verdict(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315], "++-++").kind
    'regular'
    """
    mode = mode or record.modes.default_working
    found = inverse(record, pose, mode)
    if found.batch_shape:
        raise UsageError(f"one pose is judged at a time, not a batch of shape {found.batch_shape}")
    status = Status(int(found.status[0]))
    if status in (Status.unreachable, Status.undecided):
        return Verdict(status.name, False, status.name, "", {}, {}, None, None, None, None, None, None)
    free = mobility(record, found.joints[0])
    general = max(generic_rank(record), int(free.rank))
    factors = {name: value[..., 0] for name, value in found.factors.items()}
    relative = {name: float(value) for name, value in relative_factors(record, factors).items()}
    dividing = [item.name for item in closed_form_of(record).factor_list if item.kind != "other"]
    kind = status
    if int(free.rank) < general:
        kind = max(kind, Status.constraint)
    here = velocity_map(record, pose, mode)
    condition = float(here.condition)
    return Verdict(
        kind="regular" if kind == Status.near_singular else kind.name,
        near=kind == Status.near_singular,
        reduced_kind=_reduced_kind(bool(here.singular_input), bool(here.singular_output)),
        closest=min(dividing, key=lambda name: abs(relative[name])),
        factors={name: float(value) for name, value in factors.items()},
        relative=relative,
        det_jp=float(here.det_jp),
        det_jq=float(here.det_jq),
        condition=condition if np.isfinite(condition) else None,
        rank=int(free.rank),
        generic_rank=general,
        freedoms=int(free.freedoms),
    )


def _reduced_kind(serial: bool, parallel: bool) -> str:
    if serial and parallel:
        return "comprehensive"
    return "serial" if serial else "parallel" if parallel else "regular"
