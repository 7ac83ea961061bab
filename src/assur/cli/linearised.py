"""Small motions about a pose as data and as a person reads them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray
from rich.console import RenderableType

from assur.cli import exit_codes
from assur.cli.forced import SAID
from assur.cli.options import Outcome
from assur.cli.output import heading, table
from assur.cli.quantities import mode_words
from assur.kinematics.answers.at_border import mechanism_header, pose_at_border
from assur.kinematics.answers.style import style_of
from assur.kinematics.status import Status
from assur.machine.dynamics.small_motions import small_motions
from assur.machine.forces.actuator_forces import force_units
from assur.machine.motion.screws import pose_metres
from assur.mechanism import Mechanism
from assur.model.pose import LENGTHS, rate_names
from assur.results.answers.dynamics import LinearMotionAnswer
from assur.results.json_text import plain
from assur.results.plain_text import short

ROUNDED = 1e-9
"""Share of the largest number of a matrix below which one is zero to a reader."""


def outcome(record: Mechanism, pose: NDArray[np.float64], mode: str, acting: tuple[Sequence[float], bool]) -> Outcome:
    """About a pose (m,), under a load and gravity (`acting`)."""
    load, gravity = acting
    solved = small_motions(record, pose, mode, load, gravity=gravity)
    status = Status(int(solved.answer.status[0])).name
    known = bool(np.all(np.isfinite(solved.poles)))
    answer = LinearMotionAnswer(
        **mechanism_header(record),
        pose=(pose * pose_metres(record)).tolist(),
        mode=mode,
        status=status,
        input_names=tuple(item.name for item in record.drives),
        load=[*load, *[0.0] * (6 - len(load))],
        under_gravity=gravity,
        actuator_forces=plain(solved.answer.forces[0]),
        mass_matrix=plain(solved.mass),
        damping_matrix=plain(solved.damping),
        stiffness_matrix=plain(solved.stiffness),
        poles=plain(np.column_stack([solved.poles.real, solved.poles.imag])),
        frequencies=plain(solved.frequencies),
        stable=solved.stable if known else None,
        notes=(SAID[status],) if status in SAID else (),
        units=_units(record),
    )
    return Outcome(answer, lambda: _shown(record, answer, pose), exit_codes.of_status(status))


def _units(record: Mechanism) -> dict[str, str]:
    names = record.platform.pose
    return {
        "pose": ", ".join("m" if name in LENGTHS else "1" if name.startswith("q") else "rad" for name in names),
        "load": "N, N, N, N m, N m, N m",
        "actuator_forces": ", ".join(force_units(record)),
        "mass_matrix": "kg, kg m between a length and an angle, kg m2 between angles",
        "damping_matrix": "N s/m, N s between a length and an angle, N m s between angles",
        "stiffness_matrix": "N/m, N between a length and an angle, N m between angles",
        "poles": "1/s",
        "frequencies": "Hz",
    }


def _shown(record: Mechanism, answer: LinearMotionAnswer, pose: NDArray[np.float64]) -> Iterable[RenderableType]:
    end = {True: "stable", False: "not stable", None: answer.status}[answer.stable]
    yield heading(f"{answer.mechanism}, small motions: {end}")
    place = style_of(record).pose(answer.coordinates, pose_at_border(record, pose).tolist())
    yield f"about {place}, {mode_words(record, answer.mode)}, held by forces that stay as they are"
    yield from (f"note: {note}" for note in answer.notes)
    if answer.stable is None:
        return
    names = rate_names(answer.coordinates)
    for title, matrix in (
        ("M", answer.mass_matrix),
        ("C, of viscous friction", answer.damping_matrix),
        ("K", answer.stiffness_matrix),
    ):
        yield ""
        rows = np.array(matrix, dtype=float)
        rows[np.abs(rows) <= ROUNDED * np.abs(rows).max()] = 0.0
        yield table(
            (title, *names), [(name, *map(short, row)) for name, row in zip(names, rows, strict=True)], left=(title,)
        )
    yield ""
    yield "M a + C v + K x = 0 per rate of the pose, in SI units"
    poles = [complex(real or 0.0, imaginary or 0.0) for real, imaginary in answer.poles]
    yield f"poles [1/s]: {', '.join(_pole(pole) for pole in poles if pole.imag >= 0.0)}"
    swings = ", ".join(short(value) for value in answer.frequencies)
    yield f"swings, friction left aside, at {swings} Hz" if swings else "nothing swings"
    growing = max(pole.real for pole in poles)
    if growing > 0.0:
        yield f"it runs away: what is off grows {np.e:.3g} times in {short(1.0 / growing)} s"


def _pole(pole: complex) -> str:
    return f"{pole.real:.4g} ± {pole.imag:.4g} i" if pole.imag else f"{pole.real:.4g}"
