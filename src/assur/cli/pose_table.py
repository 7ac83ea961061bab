"""Tables of poses: a line of names, then a line for each pose, in the file's units or in those beside the names."""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from assur.cli.numbers import NUMBER
from assur.errors import UsageError
from assur.kinematics.answers.at_border import pose_from_border
from assur.kinematics.validation.check import METRES
from assur.machine.calibration.measured import DISTANCE, READ, TURNS, Measured, measured_of
from assur.mechanism import Mechanism
from assur.model.pose import ANGLES, LENGTHS

TITLE = re.compile(r"(.*?)\s*(?:\[(.*)\])?", re.DOTALL)
ANGLE_UNITS = {"deg": math.radians(1.0), "rad": 1.0}


def pose_table(record: Mechanism, path: str) -> NDArray[np.float64]:
    """Poses (N, m) in lengths and rad, of a .csv whose first line names the coordinates of the pose in any order.

    Other columns are left aside.

    Errors:
        UsageError: no column of a coordinate, one that is named twice, and what `table` refuses.
    """
    return _poses(record, path, ())[1]


def timed_poses(record: Mechanism, path: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Times (N,) in s, of a column `t`, and poses (N, m) as of `pose_table`."""
    times, poses = _poses(record, path, ("t",))
    return times[:, 0], poses


def _poses(record: Mechanism, path: str, others: tuple[str, ...]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Other columns (N, k) of a table, and poses (N, m)."""
    names, rows = table(record, path)
    wanted = (*others, *record.platform.pose)
    if any(names.count(name) != 1 for name in wanted):
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
    names, rows = table(record, path)
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


def table(record: Mechanism, path: str) -> tuple[list[str], NDArray[np.float64]]:
    """Names, and numbers (N, columns) in the file's units; empty lines do not count.

    A unit may stand beside a name, as "x [m]" or "theta1 [rad]"; without one a column is in the file's unit.

    Errors:
        UsageError: a file that cannot be read, a line of another length, what is no finite number, no lines, a unit
            that is none of the column's kind.
    """
    try:
        lines = list(csv.reader(Path(path).read_text(encoding="utf-8-sig").splitlines()))
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"cannot read {path}: {getattr(error, 'strerror', None) or 'no text in UTF-8'}") from error
    names, sizes = _columns(record, path, lines[0] if lines else [])
    rows = [_row(path, number, line, names) for number, line in enumerate(lines[1:], 2) if any(map(str.strip, line))]
    if not rows:
        raise UsageError(f"{path}: no poses", hint="one line each, after the names")
    return names, np.array(rows) * sizes


def _columns(record: Mechanism, path: str, titles: list[str]) -> tuple[list[str], list[float]]:
    """Names of columns, and how many of the file's units one of each column's is."""
    inputs = {item.name: item.coordinate.kind == "length" for item in record.inputs}
    lengths = {**dict.fromkeys((*LENGTHS, DISTANCE), True), **dict.fromkeys((*TURNS, *ANGLES), False), **inputs}
    names, sizes = [], []
    for place, title in enumerate(titles, 1):
        name, unit = TITLE.fullmatch(title.strip()).groups()  # type: ignore[union-attr]  # every text matches
        known, own = (METRES, record.unit) if lengths.get(name) else (ANGLE_UNITS, record.angle)
        if name not in lengths:
            known, own = {"s" if name == "t" else str(unit): 1.0}, unit
        if unit is not None and unit not in known:
            hint = f"one of {', '.join(known)}, or the name alone: the file's unit"
            raise UsageError(f"{path}:1: column {place}, {name}, cannot be in '{unit}'", hint=hint)
        names.append(name)
        sizes.append(1.0 if unit in (None, own) else known[str(unit)] / known[own])
    return names, sizes


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
