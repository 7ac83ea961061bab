"""Before what a path stops: the kind of the singularity, its factor, and what lies beyond."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import held_inputs, inputs_of
from assur.kinematics.closure import Assembly, assemble
from assur.kinematics.following.course import Course
from assur.kinematics.following.locked import own
from assur.kinematics.following.path import Stop
from assur.kinematics.following.ranks import COARSE, SINGULAR, Blocked, PathPoint
from assur.kinematics.following.ways import Stretch, held_rows
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.kinematics.status import closed_form_of, relative_factors
from assur.kinematics.turns import unwrapped
from assur.model.closed_form import ClosedForm
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
LESS = 0.3
"""One that has come down to this share of its largest on the path is going to zero."""

DIGIT, HALF = 10.0, 0.5
"""What is halved or more, while the leading one falls to a tenth, goes to zero with it."""

BEYOND = 0.01
"""How much further on, as a share of the way, another assembly is looked for."""

PATIENCE = 80
"""Steps of least squares in which it may be met."""

NEAR = 1e-3
"""A group of factors, relative to their scales, that is smaller is taken for zero."""

ALIKE = 3.0
"""Factors up to so many times the smallest one are named with it."""

TRIED = 8
"""Points at the end of a path that are asked for their factors."""

NAMES = {
    "closure": "the smallest singular value of the closure",
    "inputs": "the smallest singular value with the inputs locked",
    "poses": "the smallest singular value with the platform locked",
}


def stop_at(stretch: Stretch, points: Sequence[PathPoint], blocked: Blocked, sizes: dict[str, FloatArray]) -> Stop:
    """The stop at the last of the points, given the smallest singular values (N,) at them."""
    record, way, last = stretch.record, stretch.course, points[-1]
    place: dict[str, Any] = {
        "share": last.share,
        "joints": last.joints,
        "pose": pose_of(record, last.joints),
        "inputs": inputs_of(record, last.joints),
    }
    if blocked.limit is not None:
        name, room = blocked.limit.name, float(blocked.limit.margin(last.joints))
        return Stop("limit", **place, quantity=f"the room to the {name}", value=room)
    if blocked.why == "interrupted":
        name = own(way.prescribed)[0]
        return Stop("interrupted", **place, quantity=NAMES[name], value=float(sizes[name][-1]))
    if blocked.why == "missed":
        kind, name, mine = "unreachable", own(way.prescribed)[0], False
    else:
        kind, name, mine = _kind(way, blocked, sizes)
    kind, factor, meaning, size = _nearest_factor(record, way, kind, points)
    turns_back = mine and last.own.needs(held_rows(record, stretch.rate(last.share)))
    gap = None
    if turns_back:
        beyond = _assembled(stretch, last.joints, last.share + BEYOND)
        gap = 0.0 if bool(beyond.closed) else float(beyond.residual)
    value = float(sizes[name][-1])
    return Stop(kind, **place, quantity=NAMES[name], value=value, turns_back=turns_back, gap=gap,
                factor=factor, meaning=meaning, size=size)  # fmt: skip


def _assembled(stretch: Stretch, start: FloatArray, share: float) -> Assembly:
    """The closest approach from joint values (n,) to the inputs or the pose at a share of the way."""
    record, target = stretch.record, stretch.course.at(share, stretch.segment)
    if stretch.course.prescribed == "poses":
        return assemble(record, start, poses=target, tolerance=COARSE, max_steps=PATIENCE)
    held = held_inputs(record, start, target)
    return assemble(record, held, held=record.input_indices, tolerance=COARSE, max_steps=PATIENCE)


def _kind(way: Course, blocked: Blocked, sizes: dict[str, FloatArray]) -> tuple[str, str, bool]:
    """The kind of singularity, which smallest singular value measures it, and whether that of what is prescribed goes.

    The one that has come down most leads; those that shrink with it, while it loses its last digit, vanish with it.
    """
    mine, other = own(way.prescribed)
    candidates = (mine, other) if blocked.why == "lost" else (mine,)
    begun = len(sizes[mine]) > 1
    leading = min(candidates, key=lambda name: float(sizes[name][-1] / (np.max(sizes[name]) if begun else 1.0)))
    value = sizes[leading]
    if value[-1] > max(LESS * float(np.max(value)) if begun else 0.0, SINGULAR):
        return "undecided", mine, False
    above = np.flatnonzero(value >= DIGIT * value[-1])
    since = int(above[-1]) if len(above) else int(np.argmax(value))
    zero = {name for name, item in sizes.items() if item[-1] <= max(HALF * item[since] if begun else 0.0, SINGULAR)} | {
        leading
    }
    if "closure" in zero:
        return "constraint", "closure", mine in zero
    if zero == {mine, other}:
        return "comprehensive", mine, True
    return ("parallel" if leading == "inputs" else "serial"), leading, leading == mine


def _nearest_factor(
    record: MechanismRecord, way: Course, kind: str, points: Sequence[PathPoint]
) -> tuple[str, str, str, float | None]:
    """Kind, name, meaning and relative size of the closed form's factor that is closest to zero, if one is known."""
    if record.closed_form is None or kind in ("undecided", "unreachable"):
        return kind, "", "", None
    # the last point may be a rounding outside what a closed form reaches: then the one before it
    found = (_factors(record, way, point.joints) for point in reversed(points[-TRIED:]))
    factors = next(filter(None, found), None)
    if factors is None:
        return kind, "", "", None
    form = closed_form_of(record)
    if kind != "serial":
        for group in form.self_motion_singular:
            if _largest(group, factors) <= NEAR:
                return "self_motion", *_named(form, group, factors)
    if kind == "constraint" and form.constraint_singular:
        group = min(form.constraint_singular, key=lambda names: _largest(names, factors))
        return kind, *_named(form, group, factors)
    kinds = (kind,) if kind in ("parallel", "serial") else ("parallel", "serial")
    names = [item.name for item in form.factor_list if item.kind in kinds]
    if not names:
        return kind, "", "", None
    least = min(abs(factors[name]) for name in names)
    return kind, *_named(form, tuple(name for name in names if abs(factors[name]) <= ALIKE * least), factors)


def _largest(names: Sequence[str], factors: Mapping[str, float]) -> float:
    return max(abs(factors[name]) for name in names)


def _named(form: ClosedForm, names: Sequence[str], factors: Mapping[str, float]) -> tuple[str, str, float]:
    meanings = {item.name: item.meaning for item in form.factor_list}
    return " = ".join(names), "; ".join(meanings[name] for name in names), _largest(names, factors)


def _factors(record: MechanismRecord, way: Course, joints: FloatArray) -> dict[str, float]:
    """Relative factors at joint values (n,), of the closed form's branch of the followed problem with these values."""
    if way.prescribed == "inputs" and closed_form_of(record).direct is not None:
        found = direct(record, inputs_of(record, joints))
    else:
        found = inverse(record, pose_of(record, joints))
    listed = np.flatnonzero(found.exists)
    if not len(listed):
        return {}
    away = unwrapped(record, found.joints[listed] - joints)
    nearest = listed[np.argmin(np.linalg.norm(away, axis=-1))]
    relative = relative_factors(record, {name: value[nearest] for name, value in found.factors.items()})
    return {name: float(value) for name, value in relative.items()}
