"""Why something cannot be reached: the limit, the singularity by what it means, and which legs miss by how much."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.kinematics.answers.at_border import quantity_text
from assur.kinematics.border import held_inputs
from assur.kinematics.closure import assemble, residuals
from assur.kinematics.following.path import Path, Stop
from assur.kinematics.limits import Limit, limits
from assur.model.mechanism import MechanismRecord
from assur.view.missing import Miss, misses

FloatArray = NDArray[np.float64]
MOST = 3
"""Legs that miss, or limits that are met, and are named, at most."""

MET = 1e-6
"""Limits whose room is no more than this share of theirs larger than the least are met together."""


@dataclass(frozen=True)
class Reason:
    """Why a change stopped.

    Attributes:
        kind: "limit", "dimension", "input", or the kind of a singularity (`assur.kinematics.following.path.Stop`).
        text: one line for a person.
    """

    kind: str
    text: str

    def __str__(self) -> str:
        return self.text


def explain(path: Path, target: FloatArray) -> Reason | None:
    """Why a path ended before the inputs or the pose (k,) that were wanted; None where it did not.

    >>> from assur.kinematics.home import home_values
    >>> from assur.kinematics.following.following import follow
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> path = follow(record, home_values(record), poses=[0.0, 300.0])
    >>> str(explain(path, np.array([0.0, 300.0]))).split("; ")[::2]
    ['serial singularity: A1, B1, P are collinear', 'leg1 is 14.1 mm too short, leg2 is 14.1 mm too short']
    """
    stop = path.stopped
    if stop is None:
        return None
    if stop.kind == "limit":
        return Reason("limit", _limit(path.record, stop))
    if stop.kind == "unreachable":
        return Reason(stop.kind, "no motion of the mechanism does this")
    name = stop.kind.replace("_", "-")
    head = (
        "the steps became too small"
        if stop.kind == "undecided"
        else f"{name} singularity"
        if name != "self-motion"
        else name
    )
    said = [f"{head}: {stop.meaning}" if stop.meaning else head]
    missing = gap(path, target)
    if missing:
        said.append(missing)
    return Reason(stop.kind, "; ".join(said))


def _limit(record: MechanismRecord, stop: Stop) -> str:
    """Which bounds are met, and their values."""
    bounds = limits(record, stop.joints)
    margins = np.array([float(bound.margin(stop.joints)) for bound in bounds])
    room = margins - np.min(margins)
    met = [bound for bound, left in zip(bounds, room, strict=True) if left <= MET * (bound.high - bound.low)]
    return _first(f"{bound.name} ends at {_end(record, bound, stop.joints)}" for bound in met)


def _end(record: MechanismRecord, bound: Limit, joints: FloatArray) -> str:
    value = float(bound.value(joints))
    return _number(record, bound, bound.low if abs(value - bound.low) < abs(value - bound.high) else bound.high)


def _number(record: MechanismRecord, bound: Limit, value: float) -> str:
    return (
        quantity_text(record, value, "angle", digits=4) if bound.angular else quantity_text(record, value, "length", 5)
    )


def gap(path: Path, target: FloatArray) -> str:
    """Which legs or which loop stay open at what was wanted, and by how much; "" where all of them close."""
    record, start = path.record, path.joints[-1]
    if path.prescribed == "poses":
        return listed(record.unit, misses(record, start, target))
    held = held_inputs(record, start, target)
    nearest = assemble(record, held, held=record.input_indices)
    if bool(nearest.closed):
        return ""
    gaps = np.linalg.norm(residuals(record, nearest.values)[:, :3], axis=-1)
    joint = joint_graph(record).cut[int(np.argmax(gaps))]
    return f"the loop closed by {joint.name} stays open by {float(nearest.residual):.3g} {record.unit}"


def listed(unit: str, missed: Sequence[Miss]) -> str:
    """The first legs that miss, with amounts, and how many there are beside them.

    >>> listed("mm", [Miss("leg1", 14.0583, "too short"), Miss("leg2", 3.0, "off")])
    'leg1 is 14.1 mm too short, leg2 is 3 mm off'
    """
    return _first(f"{miss.leg} is {miss.amount:.3g} {unit} {miss.sense}" for miss in missed)


def _first(said: Iterable[str]) -> str:
    """The first of what is said, and how much there is beside it."""
    parts = list(said)
    more = [f"and {len(parts) - MOST} more"] if len(parts) > MOST else []
    return ", ".join([*parts[:MOST], *more])
