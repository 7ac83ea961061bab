"""Tables that somebody measured, in the file's units: a line of names, then a line for each pose."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.answers.at_border import pose_from_border
from assur.mechanism import Mechanism


def pose_table(record: Mechanism, path: str) -> NDArray[np.float64]:
    """Poses (N, m) in lengths and rad, of a .csv whose first line names the coordinates of the pose in any order.

    Errors:
        UsageError: columns that are not the pose's, and what `table` refuses.
    """
    names, rows = table(path)
    if sorted(names) != sorted(record.platform.pose):
        hint = f"the first line: {','.join(record.platform.pose)}"
        raise UsageError(f"{path}:1: columns {', '.join(names) or 'none'} are not those of the pose", hint=hint)
    order = [names.index(name) for name in record.platform.pose]
    return np.array([pose_from_border(record, row[order]) for row in rows])


def measurements(record: Mechanism, path: str) -> tuple[NDArray[np.float64], list[str], NDArray[np.float64]]:
    """Inputs (N, n) in lengths and rad, names of measured coordinates, and these (N, k), of a .csv.

    Errors:
        UsageError: a column of an input that is not there, or one that is no length of the pose, and what `table`
            refuses.
    """
    names, rows = table(path)
    inputs = [item.name for item in record.inputs]
    lengths = [name for name in ("x", "y", "z") if name in record.platform.pose]
    hint = f"the first line: {','.join([*inputs, *lengths])}"
    lacking = [name for name in inputs if name not in names]
    others = [name for name in names if name not in inputs]
    wrong = [name for name in others if name not in lengths]
    if lacking or wrong or not others or len(set(names)) < len(names):
        told = f"no column {lacking[0]}" if lacking else f"column {wrong[0]}" if wrong else "columns"
        raise UsageError(f"{path}:1: {told}; inputs and measured lengths of the pose are wanted", hint=hint)
    units = [record.angle_unit if item.coordinate.kind == "angle" else 1.0 for item in record.inputs]
    given = rows[:, [names.index(name) for name in inputs]] * units
    return given, others, rows[:, [names.index(name) for name in others]]


def table(path: str) -> tuple[list[str], NDArray[np.float64]]:
    """Names, and numbers (N, columns); empty lines do not count.

    Errors:
        UsageError: a file that cannot be read, a line of another length, what is no finite number, no lines.
    """
    try:
        lines = list(csv.reader(Path(path).read_text(encoding="utf-8-sig").splitlines()))
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"cannot read {path}: {getattr(error, 'strerror', None) or 'no text in UTF-8'}") from error
    names = [name.strip() for name in lines[0]] if lines else []
    rows = [_row(path, number, line, names) for number, line in enumerate(lines[1:], 2) if any(map(str.strip, line))]
    if not rows:
        raise UsageError(f"{path}: no poses", hint="one line each, after the names")
    return names, np.array(rows)


def _row(path: str, number: int, line: list[str], names: list[str]) -> list[float]:
    if len(line) != len(names):
        raise UsageError(f"{path}:{number}: {len(line)} values, {len(names)} columns are named")
    row = []
    for name, text in zip(names, line, strict=True):
        try:
            value = float(text)
        except ValueError:
            value = float("nan")
        if not np.isfinite(value):
            raise UsageError(f"{path}:{number}: {name} = '{text.strip()}' is not a finite number")
        row.append(value)
    return row
