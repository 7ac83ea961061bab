"""Calibration: the dimensions, offsets of inputs and place of the measuring frame with which measured poses agree best.

Least squares over all measurements by Levenberg's and Marquardt's steps, each pose solved again on the joint graph for
the dimensions of every step. What no measurement tells apart is held: of parameters that act together the last ones
keep their values, the measuring frame's come first. Measurements far beside the others are named and left out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.joint_graph.frames import Frame
from assur.joint_graph.geometry import characteristic_length
from assur.machine.calibration.identification import matrix_rank, reduced
from assur.machine.calibration.measured import FRAME, Measured
from assur.machine.calibration.measurements import SAME, Guess, Measurements
from assur.model.mechanism import MechanismRecord
from assur.numerics.rotations import to_vector, vector_rates_matrix

FloatArray = NDArray[np.float64]
STEPS, ENOUGH = 50, 1e-9
"""Steps at most, and the step, as a share of the characteristic length, after which there are no more."""
DAMPED, MOST = 1e-3, 1e6
"""Shares of the squares of a column that are added to it: at first, and beyond which no step is better."""
BESIDE, AGAIN = 5.0, 8
"""Times the spread of the others by which a measurement is off that does not count; how often that is asked."""
FAR = 20.0
"""Times the middle one of all before the fit: what a slip of the pen would draw the dimensions to."""


@dataclass(frozen=True, eq=False)
class Calibration:
    """What measurements say, in the mechanism's unit and rad.

    Attributes:
        parameters: the dimensions as they fit best, what is to be added to inputs, and where the measuring frame is,
            `frame.x` to `frame.rz`, its rotation vector.
        covariance: (p, p) of these, of the spread that is left.
        held: what the measurements do not tell, or was to be held.
        before, after: roots of the mean squares of what is off, outliers left out, angles by the characteristic length;
            before is with the file's dimensions, and the measuring frame where it fits these best.
        outliers: numbers of measurements that did not count, from 1.
    """

    parameters: Mapping[str, float]
    covariance: FloatArray
    held: tuple[str, ...]
    before: float
    after: float
    outliers: tuple[int, ...]

    @property
    def sigma(self) -> dict[str, float]:
        """Standard deviations of the parameters."""
        return dict(zip(self.parameters, np.sqrt(np.diag(self.covariance)).tolist(), strict=True))


def calibration(
    record: MechanismRecord,
    inputs: FloatArray,
    measured: Measured,
    readings: FloatArray,
    hold: Sequence[str] = (),
    *,
    frame: bool = False,
) -> Calibration:
    """The best fit of readings (N, k) at printed inputs (N, n), in the mechanism's unit and rad.

    Args:
        record: the mechanism.
        inputs: as they were meant.
        measured: what the readings are of.
        readings: in the order of its names.
        hold: parameters that keep their values.
        frame: whether the measuring frame's place is unknown; else it is the base's.

    Errors:
        UsageError: a measurement that is no pose, or too few of them.
        UnknownNameError: what is to be held is none of the parameters.
    """
    whole = Measurements(record, inputs, measured, readings, frame)
    first = whole.first()
    least = 1e-9 * characteristic_length(record)
    kept = _near(whole, first, least)
    for _ in range(AGAIN):
        fit, start = whole.of(kept), first.of(kept)
        names, best, covariance, held = _fitted(fit, start, hold)
        off = np.linalg.norm(whole.off(_everywhere(whole, first, best)), axis=1)
        counts = off <= max(BESIDE * 1.4826 * float(np.median(off)), least)
        if np.array_equal(counts, kept) or np.sum(counts) * len(measured.names) <= len(names):
            break
        kept = counts
    turn, point = best.frame
    inputs_added = zip((item.name for item in record.inputs), best.added, strict=True)
    now = {name: item.value for name, item in best.record.parameters.items()} | dict(inputs_added)
    now |= dict(zip(FRAME, [*point, *to_vector(turn)], strict=True))
    return Calibration(
        parameters={name: float(now[name]) for name in names},
        covariance=covariance,
        held=held,
        before=float(np.sqrt(np.mean(fit.off(start) ** 2))),
        after=float(np.sqrt(np.mean(fit.off(best) ** 2))),
        outliers=tuple(int(number) + 1 for number in np.flatnonzero(~kept)),
    )


def _near(whole: Measurements, first: Guess, least: float) -> NDArray[np.bool_]:
    """Which measurements (N,) a fit begins with: not those that the file's dimensions are far beside of all others.

    Errors:
        UsageError: half of them are so far away that units or the measuring frame are others.
    """
    off = np.linalg.norm(whole.off(first), axis=1)
    middle, record = float(np.median(off)), whole.record
    if not whole.framed and middle > SAME * characteristic_length(record):
        raise UsageError(
            f"half of the measurements are off by more than {middle:.4g} {record.unit} with the file's dimensions",
            hint=f"inputs and angles in {record.angle}, lengths in {record.unit}? else a frame of its own: --frame",
        )
    return np.asarray(off <= max(FAR * middle, least))


def _everywhere(whole: Measurements, first: Guess, best: Guess) -> Guess:
    """The best guess at all measurements, those among them that were left out."""
    own = [item.name for item in whole.record.inputs]
    step = {name: item.value - first.record.parameters[name].value for name, item in best.record.parameters.items()}
    return replace(whole.moved(first, step | dict(zip(own, best.added, strict=True))), frame=best.frame)


def _fitted(
    fit: Measurements, guess: Guess, hold: Sequence[str]
) -> tuple[tuple[str, ...], Guess, FloatArray, tuple[str, ...]]:
    """Names of what is told, the best guess, the covariance (p, p), and what is held."""
    start, length, damping = guess, characteristic_length(fit.record), DAMPED
    names, slopes, scales = fit.slopes(guess)
    free = _told(slopes * scales, names, hold)
    if guess.values.shape[0] * len(fit.measured.names) <= len(free):
        size = guess.values.shape[0] * len(fit.measured.names)
        raise UsageError(f"{size} numbers are measured, {len(free)} are unknown", hint="measure more poses")
    for _ in range(STEPS):
        narrow, off = slopes[:, free] * scales[free], fit.off(guess)
        if not (np.all(np.isfinite(narrow)) and np.all(np.isfinite(off))):
            raise UsageError("no dimensions near those of the file fit", hint="are all columns in the file's units?")
        trial = None
        while trial is None and damping <= MOST:
            step = _damped(narrow, off.ravel(), damping)
            if np.max(np.abs(step)) <= ENOUGH * length:
                break
            moved = dict.fromkeys(names, 0.0) | {
                names[k]: float(own) for k, own in zip(free, scales[free] * step, strict=True)
            }
            wrong = [name for name in moved if not _allowed(guess.record, name, moved[name])]
            if wrong:  # a length that would be negative stays as it is
                return _fitted(fit, start, [*hold, *wrong])
            trial = _better(fit, guess, moved, float(np.linalg.norm(off)))
            damping = damping * (10.0 if trial is None else 0.1)
        if trial is None:
            break
        guess = trial
        slopes = fit.slopes(guess)[1]
    narrow = slopes[:, free] * scales[free]
    variance = float(np.sum(fit.off(guess) ** 2)) / (len(narrow) - len(free))
    as_named = _of_rotation_vector(guess.frame, names)[np.ix_(free, free)] * scales[free]
    covariance = variance * as_named @ np.linalg.inv(narrow.T @ narrow) @ as_named.T
    told = tuple(names[k] for k in free)
    return told, guess, covariance, tuple(name for name in names if name not in told)


def _of_rotation_vector(frame: Frame, names: Sequence[str]) -> FloatArray:
    """Changes (p, p) of parameters per step of them: turns of the frame are steps about the base's axes."""
    change = np.eye(len(names))
    if FRAME[-1] in names:
        turns = [names.index(name) for name in FRAME[3:]]
        change[np.ix_(turns, turns)] = vector_rates_matrix(to_vector(frame[0]))
    return change


def _damped(narrow: FloatArray, off: FloatArray, damping: float) -> FloatArray:
    """Levenberg's and Marquardt's step (p,)."""
    more = np.diag(np.sqrt(damping) * np.linalg.norm(narrow, axis=0))
    padded = np.concatenate([off, np.zeros(narrow.shape[1])])
    return np.asarray(np.linalg.lstsq(np.concatenate([narrow, more]), padded)[0])


def _better(fit: Measurements, guess: Guess, moved: Mapping[str, float], size: float) -> Guess | None:
    """What a step leads to; None where less fits, or a pose does not assemble."""
    try:
        trial = fit.moved(guess, moved)
    except UsageError:
        return None
    return trial if float(np.linalg.norm(fit.off(trial))) < size else None


def _allowed(record: MechanismRecord, name: str, step: float) -> bool:
    item = record.parameters.get(name)
    return (
        item is None
        or item.sign == "any"
        or (size := item.value + step) > 0.0
        or (item.sign == "nonnegative" and size == 0.0)
    )


def _told(slopes: FloatArray, names: Sequence[str], hold: Sequence[str]) -> list[int]:
    """Columns that are told once the last of those that act together are held, and what alone does not assemble.

    Errors:
        UnknownNameError: none of the names is to be held.
    """
    for name in hold:
        if name not in names:
            raise UnknownNameError("parameter to hold", name, names)
    free = [k for k, name in enumerate(names) if name not in hold and not np.isnan(slopes[:, k]).any()]
    _, sizes, right = np.linalg.svd(slopes[:, free], full_matrices=True)
    _, pivots = reduced(right[matrix_rank(sizes) :])
    return [column for place, column in enumerate(free) if place not in pivots]
