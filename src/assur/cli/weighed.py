"""Masses as data and as a person reads them."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from rich.console import RenderableType

from assur.cli.options import Outcome
from assur.cli.output import heading, table
from assur.kinematics.answers.at_border import mechanism_header
from assur.machine.masses.link_masses import masses
from assur.machine.masses.rigid_body import RigidBody
from assur.mechanism import Mechanism
from assur.results.answers.masses import MassesAnswer, ShownBody
from assur.results.plain_text import short

UNITS = {"mass": "kg", "centre": "m", "inertia": "kg m2", "total": "kg", "gravity": "m/s2"}
NAMES = ("xx", "yy", "zz", "xy", "xz", "yz")
ROUNDING = 1e-12
"""What is below this share of the largest number beside it is zero."""
ENTRIES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
"""Of a tensor, in the order of files."""


def outcome(record: Mechanism) -> Outcome:
    """What the links of a mechanism weigh."""
    known = masses(record)
    answer = MassesAnswer(
        **mechanism_header(record),
        links=tuple(_row(link, body) for link, body in known.bodies.items()),
        payload=None if known.payload is None else _row("payload", known.payload),
        lacking=known.lacking,
        total=known.total,
        gravity=known.gravity.tolist(),
        notes=known.notes,
        units=UNITS,
    )
    return Outcome(answer, lambda: _shown(answer))


def _row(link: str, body: RigidBody) -> ShownBody:
    tensor = [float(body.inertia[place]) for place in ENTRIES]
    return ShownBody(link, body.mass, body.centre.tolist(), tensor, body.source)


def _shown(answer: MassesAnswer) -> Iterable[RenderableType]:
    yield heading(f"{answer.mechanism}: masses")
    rows = [*answer.links, *([answer.payload] if answer.payload else [])]
    if rows:
        yield table(
            ("link", "mass [kg]", "centre [m]", "from"),
            [(row.link, short(row.mass), _list(row.centre), row.source) for row in rows],
            left=("link", "from"),
        )
        yield ""
    turning = [row for row in rows if any(row.inertia)]
    if turning:
        yield table(
            ("link", *(f"{entry} [kg m2]" if entry == "xx" else entry for entry in NAMES)),
            [(row.link, *_rounded(row.inertia)) for row in turning],
            left=("link",),
        )
        yield ""
    if answer.lacking:
        yield f"no mass is stated of {', '.join(answer.lacking)}"
    yield f"total    {short(answer.total)} kg{', what is not stated left out' * bool(answer.lacking)}"
    yield f"gravity  ({_list(answer.gravity)}) m/s2"
    for note in answer.notes:
        yield f"note     {note}"


def _list(values: Iterable[float]) -> str:
    return ", ".join(_rounded(values))


def _rounded(values: Iterable[float]) -> list[str]:
    """Four digits, none of what rounding left of a zero."""
    numbers = np.array([*values])
    largest = np.max(np.abs(numbers))
    return [f"{value:.4g}" for value in np.where(np.abs(numbers) > ROUNDING * largest, numbers, 0.0)]
