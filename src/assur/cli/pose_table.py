"""Tables that somebody measured, in the file's units: a line of names, then a line for each pose."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from assur.cli.numbers import NUMBER
from assur.errors import UsageError
from assur.kinematics.answers.at_border import pose_from_border
from assur.machine.calibration.measured import DISTANCE, READ, TURNS, Measured, measured_of
from assur.mechanism import Mechanism
from assur.model.pose import LENGTHS


def pose_table(record: Mechanism, path: str) -> NDArray[np.float64]:
    """Poses (N, m) in lengths and rad, of a .csv whose first line names the coordinates of the pose in any order.

    Errors:
        UsageError: columns that are not the pose's, and what `table` refuses.
    """
    return _poses(record, path, ())[1]


def timed_poses(record: Mechanism, path: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Times (N,) in s, of a column `t`, and poses (N, m) as of `pose_table`."""
    times, poses = _poses(record, path, ("t",))
    return times[:, 0], poses


def _poses(record: Mechanism, path: str, others: tuple[str, ...]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Other columns (N, k) of a table, and poses (N, m)."""
    names, rows = table(path)
    wanted = (*others, *record.platform.pose)
    if sorted(names) != sorted(wanted):
        told = " and ".join([*others, "the pose"])
        raise UsageError(
            f"{path}:1: columns {', '.join(names) or 'none'} are not those of {told}",
            hint=f"the first line: {','.join(wanted)}",
        )
    order = [names.index(name) for name in record.platform.pose]
    poses = np.array([pose_from_border(record, row[order]) for row in rows])
    return rows[:, [names.index(name) for name in others]], poses


def measurements(
    record: Mechanism, path: str, centre: tuple[float, float, float]
) -> tuple[NDArray[np.float64], Measured, NDArray[np.float64]]:
    """Inputs (N, n) in lengths and rad, what is measured, and readings (N, k) of it, of a .csv.

    Errors:
        UsageError: a column of an input that is not there, one that is named twice or is none of what can be measured,
            and what `table` refuses.
    """
    names, rows = table(path)
    inputs = [item.name for item in record.inputs]
    lengths = [name for name in LENGTHS if name in record.platform.pose] or TURNS
    hint = f"the first line: {','.join([*inputs, *lengths])}; to be measured are {', '.join(READ)}"
    lacking = [name for name in inputs if name not in names]
    others = [name for name in names if name not in inputs]
    wrong = [name for name in others if name not in READ]
    twice = [name for place, name in enumerate(names) if name in names[:place]]
    if lacking or wrong or not others or twice:
        told = f"no column {lacking[0]}, an input" if lacking else "no column of what is measured"
        told = f"column {names.index(wrong[0]) + 1} is '{wrong[0]}'" if wrong else told
        told = f"column {twice[0]} twice" if twice else told
        raise UsageError(f"{path}:1: {told}", hint=hint)
    units = [record.angle_unit if item.coordinate.kind == "angle" else 1.0 for item in record.inputs]
    read_units = [1.0 if name in (*LENGTHS, DISTANCE) else record.angle_unit for name in others]
    given = rows[:, [names.index(name) for name in inputs]] * units
    measured = measured_of(record, others, centre)
    return given, measured, rows[:, [names.index(name) for name in others]] * read_units


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
        hint = "numbers with a decimal point, commas between them"
        raise UsageError(f"{path}:{number}: {len(line)} values, {len(names)} columns are named", hint=hint)
    row: list[float] = []
    for name, text in zip(names, line, strict=True):
        if not NUMBER.fullmatch(text.strip()):
            raise UsageError(
                f"{path}:{number}: column {len(row) + 1}, {name} = '{text.strip()}', is not a finite number",
                hint="numbers alone, in the file's units",
            )
        row.append(float(text))
    return row
