"""Capacity at a pose as data and as a person reads it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import RenderableType

from assur.cli import exit_codes
from assur.cli.forced import SAID
from assur.cli.lost import why_lost
from assur.cli.options import Outcome
from assur.cli.output import heading, table
from assur.cli.quantities import mode_words
from assur.kinematics.answers.at_border import mechanism_header, pose_at_border
from assur.kinematics.answers.style import style_of
from assur.kinematics.status import Status
from assur.machine.forces.actuator_forces import force_units
from assur.machine.forces.capacity import capacity
from assur.machine.motion.screws import pose_metres
from assur.mechanism import Mechanism
from assur.model.pose import LENGTHS
from assur.results.answers.forces import CapacityAnswer
from assur.results.json_text import plain
from assur.results.plain_text import short


def outcome(record: Mechanism, pose: NDArray[Any], mode: str) -> Outcome:
    """What is held at a pose (m,), in lengths and rad."""
    held = capacity(record, pose, mode)
    status = Status(int(held.answer.status[0])).name
    lost = why_lost(record, pose, mode, Status[status])
    notes = [*lost.notes] or ([SAID[status]] if status in SAID else [])
    if np.any(held.utilisation > 1.0):
        notes.append("gravity alone asks for more than the actuators can")
    elif not len(held.vertices) and not notes:
        notes.append("the forces that are held are not bounded: no actuator feels some of them")
    answer = CapacityAnswer(
        **mechanism_header(record),
        pose=(pose * pose_metres(record)).tolist(),
        mode=mode,
        status=status,
        input_names=tuple(item.name for item in record.drives),
        limits=held.limits.tolist(),
        utilisation=plain(held.utilisation),
        per_axis={name: plain(pair) for name, pair in zip(held.axes, held.per_axis, strict=True)},
        largest_sphere=plain(held.sphere),
        limiting=held.limiting,
        polytope_vertices=plain(held.vertices),
        notes=tuple(notes),
        units={
            "pose": ", ".join("m" if name in LENGTHS else "rad" for name in record.platform.pose),
            "limits": ", ".join(force_units(record)),
            "per_axis": "N",
            "largest_sphere": "N",
            "polytope_vertices": "N",
        },
    )
    return Outcome(answer, lambda: _shown(record, answer, pose), exit_codes.of_status(status))


def _shown(record: Mechanism, answer: CapacityAnswer, pose: NDArray[Any]) -> Iterable[RenderableType]:
    yield heading(f"{answer.mechanism}, forces that are held: {answer.status}")
    place = style_of(record).pose(answer.coordinates, pose_at_border(record, pose).tolist())
    yield f"at {place}, {mode_words(record, answer.mode)}, at rest under gravity"
    yield from (f"note: {note}" for note in answer.notes)
    yield ""
    rows = [
        (name, short(limit), unit, "-" if share is None else f"{share:.1%}")
        for name, limit, unit, share in zip(
            answer.input_names, answer.limits, force_units(record), answer.utilisation, strict=True
        )
    ]
    yield table(("actuator", "limit", "in", "for gravity"), rows, left=("actuator", "in"))
    if answer.largest_sphere is not None:
        yield ""
        pairs = [(name, *map(_force, pair)) for name, pair in answer.per_axis.items()]
        yield table(("force on the platform", "against it [N]", "along it [N]"), pairs, left=("force on the platform",))
        yield f"in every direction: {short(answer.largest_sphere)} N, then {answer.limiting} is at its limit"
        corners = len(answer.polytope_vertices)
        yield f"polytope of forces with {corners} corners (--json lists them)" if corners else "no polytope"


def _force(value: float | None) -> str:
    return "no limit" if value is None else short(value)
