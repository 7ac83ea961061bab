"""Excess: by how much a solution lies outside strokes, joint limits and cones, and which loop it leaves open.

Nothing is dropped for it: a solution outside the limits is one of the equations, not one of the machine.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.answers.at_border import angle_at_border
from assur.kinematics.closure import CLOSED, residuals
from assur.kinematics.limits import Limit, stated_limits, turns_to
from assur.kinematics.modes import Problem
from assur.kinematics.validation.gaps import loops
from assur.model.mechanism import MechanismRecord
from assur.results.answers.position import ExceededLimit, KeptLimits, OpenLoop

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
TURN = 2 * np.pi


@dataclass(frozen=True)
class Excess:
    """One limit that is exceeded.

    Attributes:
        limit: as a person reads it: "stroke of q1", "limit of leg1.A", "cone of B".
        joint: the input or the joint value that it bounds.
        value, low, high: where it stands and what is allowed, in rad or lengths; angles as near to it as whole turns
            can bring them where turns do not count.
        by: how far outside, positive.
        angular: whether these are angles.
    """

    limit: str
    joint: str
    value: float
    low: float
    high: float
    by: float
    angular: bool


def limits_at_border(record: MechanismRecord, within: bool | None, excesses: Iterable[Excess]) -> KeptLimits:
    """Whether a solution keeps the limits of the file, and each that it does not keep, in the file's units."""
    outside = []
    for each in excesses:
        value, low, high, by = (
            float(angle_at_border(record, number) if each.angular else number)
            for number in (each.value, each.low, each.high, each.by)
        )
        unit = record.angle if each.angular else record.unit
        outside.append(ExceededLimit(each.limit, each.joint, value, low, high, by, unit))
    return KeptLimits(within, tuple(outside))


def beyond(record: MechanismRecord, problem: Problem, given: FloatArray, joints: FloatArray) -> FloatArray:
    """How far (N, l) solutions with joint values (N, n) lie beyond each of the l stated limits; negative within them.

    Angles count but for whole turns, except those that count (`assur.joint_graph.turns`), and given inputs (N, k) of a
    direct problem whose stroke is longer than a turn: such a stroke says that turns are meant.
    """
    columns = [_beyond(limit, _value(record, problem, given, limit, joints)) for limit in stated_limits(record)]
    return np.stack(columns, axis=-1) if columns else np.zeros((len(joints), 0))


def within(record: MechanismRecord, amounts: FloatArray) -> BoolArray:
    """Whether solutions keep all limits (N,), by how far (N, l) they lie beyond each."""
    return np.asarray(np.all(amounts <= _spare(record), axis=-1))


def excesses(record: MechanismRecord, problem: Problem, given: FloatArray, joints: FloatArray) -> tuple[Excess, ...]:
    """Every stroke, limit of a joint and cone of the file that a solution with joint values (n,) exceeds.

    >>> from assur.model.registry import load_record
    >>> from assur.kinematics.position import direct
    >>> found = direct(load_record("three_rps"), [400.0, 400.0, 400.0])
    >>> [(item.joint, round(item.by, 6)) for item in excesses(found.record, "direct", found.given, found.joints[0])]
    [('rho1', 80.0), ('rho2', 80.0), ('rho3', 80.0)]
    """
    amounts = beyond(record, problem, given[None], joints[None])[0]
    exceeded = []
    for limit, by, spare in zip(stated_limits(record), amounts.tolist(), _spare(record), strict=True):
        if by > spare:
            value = float(_value(record, problem, given[None], limit, joints[None])[0])
            exceeded.append(Excess(limit.name, limit.of, value, limit.low, limit.high, by, limit.angular))
    return tuple(exceeded)


def _value(
    record: MechanismRecord, problem: Problem, given: FloatArray, limit: Limit, joints: FloatArray
) -> FloatArray:
    """What a limit bounds (N,), whole turns added where they do not count."""
    turns_meant = limit.what == "stroke" and limit.angular and limit.high - limit.low > TURN
    places = [item.coordinate.index for item in record.drives[: given.shape[-1]]]
    if problem == "direct" and turns_meant and limit.index in places:
        return np.asarray(given[..., places.index(limit.index)])
    value = limit.value(joints)
    return value + turns_to(record, limit, value)


def _beyond(limit: Limit, value: FloatArray) -> FloatArray:
    return np.maximum(limit.low - value, value - limit.high)


def _spare(record: MechanismRecord) -> FloatArray:
    """What rounding may make of each limit (l,): the share within which loops count as closed."""
    length = characteristic_length(record)
    return CLOSED * np.array([1.0 if limit.angular else length for limit in stated_limits(record)])


def open_loop(record: MechanismRecord, joints: FloatArray) -> OpenLoop | None:
    """The loop that joint values (n,) leave open most; None where all are closed.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> found = open_loop(record, home_values(record) + [0.1, 0.0, 0.0, 0.0, 0.0])
    >>> found.loop, found.joint, found.gap > 1
    ('the loop through A1, B1, P, B2, A2', 'P', True)
    """
    sizes = np.max(np.linalg.norm(residuals(record, joints).reshape(-1, 2, 3), axis=-1), axis=-1)
    if not len(sizes) or np.max(sizes) <= CLOSED * characteristic_length(record):
        return None
    worst = int(np.argmax(sizes))
    return OpenLoop(str(loops(record)[worst]), joint_graph(record).cut[worst].name, float(sizes[worst]))
