"""Accuracy: how dimensions and inputs that are off move the platform where it is drawn, and what tolerances allow."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from assur.figures.accuracy import drawn_errors
from assur.machine.accuracy.pose_errors import COORDINATES, PoseErrors
from assur.model.pose import LENGTHS
from assur.report.findings import Findings
from assur.results.kinds import FLOATING, PROVED, Result, Scalar, Section, Table
from assur.results.typeset_text import short

PICTURES = ("accuracy", "errors")
ROUNDED = 1e-8
"""What is less is rounding: a home that no closed form solves is known to some 1e-10 of its size."""
SAID = (
    "How far an error of one in a dimension or an input moves the platform in the configuration that is drawn, while"
    " the inputs are held: of first order, displacements along the base’s axes and a rotation vector."
)


def accuracy(findings: Findings) -> Section:
    """Sensitivities, what tolerances add to, and proved bounds.

    Errors:
        UsageError: a pose that the inputs do not hold.
    """
    solved = drawn_errors(findings)
    inputs = {item.name for item in findings.record.drives}
    whole = [name for name in solved.sensitivity if "." not in name or name in inputs]
    copies = [name for name in solved.sensitivity if name not in whole]
    results: list[Result] = [_sensitivities(solved, "Dimensions and inputs", whole)]
    if copies:
        results.append(_sensitivities(solved, "Dimensions of one limb or of one link", copies))
    if findings.record.machine.tolerances:
        results += [_summed(solved), *_proved(solved)]
    results += findings.picture(*PICTURES)
    return Section("Accuracy", SAID, results)


def _columns(solved: PoseErrors) -> tuple[str, ...]:
    return tuple(f"{name} ({solved.record.unit if name in LENGTHS else 'rad'})" for name in COORDINATES)


def _sensitivities(solved: PoseErrors, title: str, names: list[str]) -> Table:
    rows = tuple(
        (f"{name}{'' if solved.compatible(name) else '*'}", solved.units[name], *_numbers(solved.sensitivity[name]))
        for name in names
    )
    starred = any(not solved.compatible(name) for name in names)
    caption = "*: alone it does not assemble; the number, if any, is where links that bend settle." if starred else ""
    columns = ("error of one", "in", *_columns(solved))
    return Table(title, columns, rows, caption, folded=len(rows) > 16, known_by=FLOATING)


def _numbers(row: np.ndarray) -> tuple[str | None, ...]:
    return tuple(
        short(0.0 if abs(value) < ROUNDED else float(value), 4) if np.isfinite(value) else None for value in row
    )


def _summed(solved: PoseErrors) -> Table:
    rows = (
        ("worst case", *_numbers(solved.worst_case)),
        ("root sum square", *_numbers(solved.root_sum_square)),
        ("standard deviation", *_numbers(np.sqrt(np.diag(solved.covariance)))),
    )
    caption = f"With tolerances of {', '.join(solved.record.machine.tolerances)}; of first order, no bounds."
    return Table("What the tolerances add to", ("", *_columns(solved)), rows, caption, known_by=FLOATING)


def _proved(solved: PoseErrors) -> Iterator[Scalar]:
    """Bounds of each coordinate of the pose; none where the test resists."""
    for name, (low, high) in solved.proved.bounds.items():
        unit = solved.record.unit if name in LENGTHS else "rad"
        note = "for all dimensions within the tolerances that assemble"
        yield Scalar(name, None, unit, PROVED, low=low, high=high, note=note)
