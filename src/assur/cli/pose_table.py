"""Poses from a table that somebody measured: one line each, in the file's units."""

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
        UsageError: a file that cannot be read, columns that are not the pose's, a line of another length, what is no
            finite number, no lines.
    """
    try:
        lines = list(csv.reader(Path(path).read_text(encoding="utf-8-sig").splitlines()))
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"cannot read {path}: {getattr(error, 'strerror', None) or 'no text in UTF-8'}") from error
    names = [name.strip() for name in lines[0]] if lines else []
    if sorted(names) != sorted(record.platform.pose):
        hint = f"the first line: {','.join(record.platform.pose)}"
        raise UsageError(f"{path}:1: columns {', '.join(names) or 'none'} are not those of the pose", hint=hint)
    rows = [_row(path, number, line, names) for number, line in enumerate(lines[1:], 2) if any(map(str.strip, line))]
    if not rows:
        raise UsageError(f"{path}: no poses", hint="one line each, after the names")
    order = [names.index(name) for name in record.platform.pose]
    return np.array([pose_from_border(record, row[order]) for row in np.array(rows)])


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
