"""The equation of motion as a file, and what is said of it."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import RenderableType

from assur.cli.options import Outcome
from assur.cli.output import heading
from assur.cli.paths import output_file
from assur.errors import AssurError
from assur.kinematics.answers.at_border import mechanism_header
from assur.machine.forces.motion_formulas import POSES, difference, motion_formulas
from assur.machine.forces.motion_latex import document
from assur.mechanism import Mechanism
from assur.results.answers.forces import MotionFormulasAnswer
from assur.results.files import write_whole

ROUNDING = 1e-9


def outcome(record: Mechanism, mode: str, path: str) -> Outcome:
    """Write the formulas of a working mode, held against the numbers first."""
    target = output_file(path, (".tex",))
    formulas = motion_formulas(record, mode)
    off = difference(formulas)
    if not off <= ROUNDING:
        raise AssurError(f"{record.name}: the formulas differ from the numbers by {off:.1e}; nothing is written")
    write_whole(target, document(formulas))
    answer = MotionFormulasAnswer(
        **mechanism_header(record),
        mode=mode,
        operations=len(formulas.tape.operations),
        difference=off,
        written=str(target),
    )
    return Outcome(answer, lambda: _shown(answer))


def _shown(answer: MotionFormulasAnswer) -> Iterable[RenderableType]:
    yield heading(f"{answer.mechanism}, equation of motion{f' of working mode {answer.mode}' if answer.mode else ''}")
    yield f"actuator forces, mass matrix, bias and gravity in {answer.operations} operations, by the closed form"
    yield f"held against the numbers in {POSES} motions: they differ by {answer.difference:.1e} of the largest"
    yield f"written: {answer.written}"
