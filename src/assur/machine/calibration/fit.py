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
from assur.kinematics import position
from assur.kinematics.closure import assemble
from assur.kinematics.home import home_values
from assur.kinematics.pose import platform_frame
from assur.machine.calibration.identification import matrix_rank, reduced, slopes_at
from assur.machine.calibration.measured import AT_BASE, FRAME, Measured, aligned, seen
from assur.model.dimensions import with_parameters
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS
from assur.numerics.rotations import from_vector, to_vector, vector_rates_matrix

FloatArray = NDArray[np.float64]
STEPS, ENOUGH = 50, 1e-9
"""Steps at most, and the step, as a share of the characteristic length, after which there are no more."""
DAMPED, MOST = 1e-3, 1e6
"""Shares of the squares of a column that are added to it: at first, and beyond which no step is better."""
WAY, SAME = 10, 0.1
"""Steps from home to the inputs, and the share of the characteristic length by which a pose so met may be off."""
BESIDE, AGAIN = 5.0, 8
"""Times the spread of the others by which a measurement is off that does not count; how often that is asked."""


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


@dataclass(frozen=True, eq=False)
class _Guess:
    """Dimensions, joint values (N, n) of each measurement, what is added to inputs (n,), the measuring frame."""

    record: MechanismRecord
    values: FloatArray
    added: FloatArray
    frame: Frame

    def of(self, rows: FloatArray) -> _Guess:
        return replace(self, values=self.values[rows])


@dataclass(frozen=True, eq=False)
class _Fit:
    """Measurements of a mechanism: printed inputs (N, n), what is measured, and the readings (N, k)."""

    record: MechanismRecord
    inputs: FloatArray
    measured: Measured
    readings: FloatArray
    framed: bool

    def of(self, rows: FloatArray) -> _Fit:
        return replace(self, inputs=self.inputs[rows], readings=self.readings[rows])

    def off(self, guess: _Guess) -> FloatArray:
        """What is measured less what should be read (N, k), as lengths."""
        return self.measured.off(self.readings, self.measured.read(self._platform(guess), guess.frame))

    def _platform(self, guess: _Guess) -> Frame:
        return platform_frame(guess.record, guess.values)

    def first(self) -> _Guess:
        """With the file's dimensions: of all assemblies those next to what is measured."""
        near = None if self.record.closed_form else self._from_home()
        if near is not None:
            guess = _Guess(self.record, near, np.zeros(len(self.record.inputs)), AT_BASE)
            guess = self._framed(guess) if self.framed else guess
            if np.linalg.norm(self.off(guess), axis=1).max() <= SAME * self.measured.length:
                return guess
        answers = []
        for number, printed in enumerate(self.inputs, 1):
            answer = position.direct(self.record, printed)
            if not answer.exists.any():
                raise UsageError(
                    f"measurement {number}: no pose of {self.record.name} at these inputs", hint="leave it out"
                )
            answers.append(answer.joints)
        record = self.record.without_closed_form
        guesses = [_Guess(record, self._nearest(answers, AT_BASE), np.zeros(len(record.inputs)), AT_BASE)]
        if self.framed:  # where the frame is says one assembly of all poses
            for place in range(max(map(len, answers))):
                same = [joints[min(place, len(joints) - 1)] for joints in answers]
                if np.all(np.isfinite(same)):
                    guesses.append(replace(guesses[0], values=np.array(same)))
            guesses = [self._framed(guess) for guess in guesses]
            best = min(guesses, key=lambda guess: float(np.linalg.norm(self.off(guess))))
            guesses = [self._framed(replace(best, values=self._nearest(answers, best.frame)))]
        return guesses[0]

    def _from_home(self) -> FloatArray | None:
        """Joint values (N, n), followed from home to the inputs; None where a pose is lost on the way."""
        values = np.tile(home_values(self.record), (len(self.inputs), 1))
        held = self.record.input_indices
        ends = values[:, list(held)].copy()
        for place, item in enumerate(self.record.inputs):
            ends[:, place] = item.joint_value(self.inputs[:, place])
        begins = values[:, list(held)].copy()
        for share in np.linspace(0.0, 1.0, WAY + 1)[1:]:
            values[:, list(held)] = begins + share * (ends - begins)
            assembled = assemble(self.record, values, held=held, near=True)
            if not assembled.closed.all():
                return None
            values = assembled.values
        return values

    def _nearest(self, answers: Sequence[FloatArray], frame: Frame) -> FloatArray:
        chosen = []
        for joints, row in zip(answers, self.readings, strict=True):
            kept = joints[np.isfinite(joints).all(axis=1)]
            read = self.measured.read(platform_frame(self.record, kept), frame)
            chosen.append(kept[np.argmin(np.linalg.norm(self.measured.off(row, read), axis=1))])
        return np.array(chosen)

    def _framed(self, guess: _Guess) -> _Guess:
        """The measuring frame that fits the lengths best; those that are not measured stay as they are."""
        names = [name for name in LENGTHS if name in self.measured.names]
        if len(names) < 2:
            return guess
        own = [LENGTHS.index(name) for name in names]
        points, read = (np.zeros((len(self.inputs), 3)) for _ in range(2))
        points[:, own] = seen(self._platform(guess), AT_BASE)[1][:, own]
        read[:, own] = self.readings[:, [self.measured.names.index(name) for name in names]]
        return replace(guess, frame=aligned(points, read))

    def moved(self, guess: _Guess, step: Mapping[str, float]) -> _Guess:
        """The guess with steps of parameters, each pose solved again.

        Errors:
            UsageError: a measurement that does not assemble so.
        """
        sizes = {name: item.value + step.get(name, 0.0) for name, item in guess.record.parameters.items()}
        record = with_parameters(guess.record, **sizes)
        added = guess.added + [step[item.name] for item in record.inputs]
        start = guess.values.copy()
        for place, item in enumerate(record.inputs):
            start[:, item.coordinate.index] = item.joint_value(self.inputs[:, place] + added[place])
        assembled = assemble(record, start, held=record.input_indices, near=True)
        if not assembled.closed.all():
            raise UsageError(f"measurement {int(np.argmin(assembled.closed)) + 1} does not assemble on the way")
        turn, point = guess.frame
        shift = np.array([step.get(name, 0.0) for name in FRAME])
        return _Guess(record, assembled.values, added, (from_vector(shift[3:]) @ turn, point + shift[:3]))

    def slopes(self, guess: _Guess) -> tuple[tuple[str, ...], FloatArray, FloatArray]:
        """Names, change (N k, p) of what is measured, and what one is of each parameter; the frame's first."""
        rows: list[FloatArray] = []
        names: tuple[str, ...] = ()
        scales = np.zeros(0)
        for number, joints in enumerate(guess.values, 1):
            named = f"measurement {number}"
            names, row, scales = slopes_at(guess.record, joints, self.measured, named, guess.frame, frame=self.framed)
            rows.append(row)
        order = sorted(range(len(names)), key=lambda k: names[k] not in FRAME)
        return tuple(names[k] for k in order), np.concatenate(rows)[:, order], scales[order]


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
    whole = _Fit(record, inputs, measured, readings, frame)
    first = whole.first()
    kept = np.ones(len(readings), dtype=bool)
    least = 1e-9 * characteristic_length(record)
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


def _everywhere(whole: _Fit, first: _Guess, best: _Guess) -> _Guess:
    """The best guess at all measurements, those among them that were left out."""
    own = [item.name for item in whole.record.inputs]
    step = {name: item.value - first.record.parameters[name].value for name, item in best.record.parameters.items()}
    return replace(whole.moved(first, step | dict(zip(own, best.added, strict=True))), frame=best.frame)


def _fitted(
    fit: _Fit, guess: _Guess, hold: Sequence[str]
) -> tuple[tuple[str, ...], _Guess, FloatArray, tuple[str, ...]]:
    """Names of what is told, the best guess, the covariance (p, p), and what is held."""
    start, length, damping = guess, characteristic_length(fit.record), DAMPED
    names, slopes, scales = fit.slopes(guess)
    free = _told(slopes * scales, names, hold)
    if guess.values.shape[0] * len(fit.measured.names) <= len(free):
        size = guess.values.shape[0] * len(fit.measured.names)
        raise UsageError(f"{size} numbers are measured, {len(free)} are unknown", hint="measure more poses")
    for _ in range(STEPS):
        narrow, off = slopes[:, free] * scales[free], fit.off(guess)
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


def _better(fit: _Fit, guess: _Guess, moved: Mapping[str, float], size: float) -> _Guess | None:
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
