"""Printed search ranges: which part of each can be reached at all, in a working mode, without limits on the inputs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.audit.configurations import AROUND, random_poses
from assur.audit.printed import Printed
from assur.audit.reference import Digits
from assur.audit.rows import Row
from assur.errors import UnknownNameError, UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.model.file.schema import Entry
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
SAMPLES = 3000
ROUNDS = 90
SHRINK = 0.75


class PrintedRange(Entry):
    """An interval in which the source looks for a coordinate of the workspace."""

    source: str
    quantity: str
    low: Digits
    high: Digits
    mode: str = ""
    erratum: str = ""


def range_rows(record: MechanismRecord, entry: PrintedRange) -> list[Row]:
    """Two rows, low and high end: wrong where the range cuts off poses that can be reached."""
    if entry.quantity not in record.platform.pose:
        raise UnknownNameError(f"pose coordinate of {record.name}", entry.quantity, record.platform.pose)
    mode = entry.mode or record.modes.default_working
    return [
        _row(record, entry, "low", entry.low, -1.0, mode),
        _row(record, entry, "high", entry.high, 1.0, mode),
    ]


def _row(record: MechanismRecord, entry: PrintedRange, end: str, digits: Printed, side: float, mode: str) -> Row:
    computed = extreme(record, entry.quantity, side, mode)
    off = None if computed is None else digits.value - computed
    cuts = off is not None and side * off < -digits.half_unit
    if computed is None:
        note = f"a choice: {entry.quantity} has no bound in mode {mode} but strokes, and none are stated"
    elif cuts:
        note = f"cuts off what mode {mode} reaches"
    elif abs(off or 0.0) > digits.half_unit:
        note = f"nothing beyond {computed:.4f} is reached in mode {mode}"
    else:
        note = f"the end of what mode {mode} reaches"
    return Row(
        source=entry.source,
        quantity=f"{entry.quantity} {end}",
        printed=digits.text,
        computed=computed,
        verdict="wrong" if cuts else "ok",
        erratum=entry.erratum,
        tolerance=digits.half_unit,
        off_by=off,
        unit=record.unit,
        note=note,
    )


def extreme(record: MechanismRecord, name: str, side: float, mode: str, seed: int = 0) -> float | None:
    """The least (side -1) or greatest (side 1) value of a pose coordinate that a working mode reaches.

    Random search: poses around the best one so far, closer and closer. None where poses are found as far as
    it looks (three characteristic lengths from home), so that the coordinate has no bound.

    >>> from assur.model.registry import load_record
    >>> round(extreme(load_record("zeng2019"), "x", 1.0, "++-++"), 6)
    80.0
    """
    rng = np.random.default_rng(seed)
    index = record.platform.pose.index(name)
    poses = random_poses(record, 10 * SAMPLES, rng)
    bound = float(np.max(side * poses[:, index]))
    best = _furthest(record, poses, index, side, mode)
    spread = AROUND * characteristic_length(record)
    for _ in range(ROUNDS):
        step = rng.uniform(-spread, spread, size=(SAMPLES, poses.shape[1]))
        step[:, index] = side * np.abs(step[:, index])
        best = _furthest(record, np.vstack([best, best + step]), index, side, mode)
        spread *= SHRINK
    reached = float(best[0, index])
    return None if side * reached >= bound else reached


def _furthest(record: MechanismRecord, poses: FloatArray, index: int, side: float, mode: str) -> FloatArray:
    """The pose (1, m) that exists in a mode and lies furthest along a coordinate."""
    real = inverse_sweep(record, list(poses.T), mode, want=("exists",))["exists"]
    if not np.any(real):
        raise UsageError(f"{record.name}: no pose of mode {mode} was found near home")
    furthest = int(np.argmax(side * poses[real, index]))
    return np.asarray(poses[real][furthest : furthest + 1])
