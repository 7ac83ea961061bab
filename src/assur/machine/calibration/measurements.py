"""Measurements of a mechanism: where it stands with dimensions that are thought, and what is off of the readings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.frames import Frame
from assur.kinematics import position
from assur.kinematics.closure import assemble
from assur.kinematics.home import home_values
from assur.kinematics.pose import platform_frame
from assur.machine.calibration.identification import slopes_at
from assur.machine.calibration.measured import AT_BASE, FRAME, Measured, aligned, seen
from assur.model.dimensions import with_parameters
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS
from assur.numerics.rotations import from_vector

FloatArray = NDArray[np.float64]
WAY, SAME = 10, 0.1
"""Steps from home to the inputs, and the share of the characteristic length by which a pose so met may be off."""


@dataclass(frozen=True, eq=False)
class Guess:
    """Dimensions, joint values (N, n) of each measurement, what is added to inputs (n,), the measuring frame."""

    record: MechanismRecord
    values: FloatArray
    added: FloatArray
    frame: Frame

    def of(self, rows: NDArray[np.bool_]) -> Guess:
        """At some of the measurements."""
        return replace(self, values=self.values[rows])


@dataclass(frozen=True, eq=False)
class Measurements:
    """Measurements of a mechanism: printed inputs (N, n), what is measured, and the readings (N, k)."""

    record: MechanismRecord
    inputs: FloatArray
    measured: Measured
    readings: FloatArray
    framed: bool

    def of(self, rows: NDArray[np.bool_]) -> Measurements:
        """Some of them."""
        return replace(self, inputs=self.inputs[rows], readings=self.readings[rows])

    def off(self, guess: Guess) -> FloatArray:
        """What is measured less what should be read (N, k), as lengths."""
        return self.measured.off(self.readings, self.measured.read(self._platform(guess), guess.frame))

    def _platform(self, guess: Guess) -> Frame:
        return platform_frame(guess.record, guess.values)

    def first(self) -> Guess:
        """With the file's dimensions: of all assemblies those next to what is measured."""
        near = None if self.record.closed_form else self._from_home()
        if near is not None:
            guess = Guess(self.record, near, np.zeros(len(self.record.inputs)), AT_BASE)
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
        guesses = [Guess(record, self._nearest(answers, AT_BASE), np.zeros(len(record.inputs)), AT_BASE)]
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

    def _framed(self, guess: Guess) -> Guess:
        """The measuring frame that fits the lengths best; those that are not measured stay as they are."""
        names = [name for name in LENGTHS if name in self.measured.names]
        if len(names) < 2:
            return guess
        own = [LENGTHS.index(name) for name in names]
        points, read = (np.zeros((len(self.inputs), 3)) for _ in range(2))
        points[:, own] = seen(self._platform(guess), AT_BASE)[1][:, own]
        read[:, own] = self.readings[:, [self.measured.names.index(name) for name in names]]
        return replace(guess, frame=aligned(points, read))

    def moved(self, guess: Guess, step: Mapping[str, float]) -> Guess:
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
        return Guess(record, assembled.values, added, (from_vector(shift[3:]) @ turn, point + shift[:3]))

    def slopes(self, guess: Guess) -> tuple[tuple[str, ...], FloatArray, FloatArray]:
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
