"""A pose that changes on a complex line, as conditions on the platform's frame."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.programs import Outputs, program
from assur.kinematics.pose import platform_moves, platform_numbers
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

ROWS = {"phi": ((1, 0), (0, 0)), "psi": ((2, 1), (2, 2))}
"""Entries of the platform's orientation whose ratio is the tangent of an angle."""


@dataclass(frozen=True, eq=False)
class PoseLine:
    """A pose (m,) at t = 0, lengths p + v t, angles p + 2 atan(v t); without quaternions.

    An angle is told by its tangent, theta by its sine, so that it may also be another one with the same.
    """

    record: MechanismRecord
    pose: FloatArray
    direction: ComplexArray

    def conditions(self, state: ComplexArray, t: ComplexArray) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
        """What is zero (N, m) where the platform of states (k, N) stands as at t (N,), and its change by joints and t.

        Returns:
            values (N, m), derivative (N, m, n) by the joints, lengths in characteristic lengths, and (N, m) by t.
        """
        frame = program(self.record, _platform)
        numbers = frame.at_state(self.record, state)
        length, count = characteristic_length(self.record), len(self.record.coordinates)
        rotation = np.moveaxis(numbers[frame.rows("platform")][:9].reshape(3, 3, len(t)), -1, 0)
        place = numbers[frame.rows("platform")][9:].T / length
        moves = frame.matrix("move", numbers, (6, count))
        turned = np.cross(
            moves[:, None, :3], rotation.swapaxes(1, 2)[..., None], axisa=2, axisb=2, axisc=2
        )  # (N, j, i, n)
        gaps, slopes, rates = [], [], []
        for name, value, rate in zip(self.record.platform.pose, self._values(t), self._rates(t), strict=True):
            if name in LENGTHS:
                k = LENGTHS.index(name)
                gaps.append(place[:, k] - value)
                slopes.append(moves[:, 3 + k] / length)
                rates.append(-rate)
                continue
            cosine, sine = np.cos(value), np.sin(value)
            if name == "theta":
                gaps.append(rotation[:, 2, 0] + sine)
                slopes.append(turned[:, 0, 2])
                rates.append(rate * cosine)
                continue
            (i, j), (k, m) = ROWS[name]
            gaps.append(rotation[:, i, j] * cosine - rotation[:, k, m] * sine)
            slopes.append(turned[:, j, i] * cosine[:, None] - turned[:, m, k] * sine[:, None])
            rates.append(-rate * (rotation[:, i, j] * sine + rotation[:, k, m] * cosine))
        return np.stack(gaps, axis=1), np.stack(slopes, axis=1), np.stack(rates, axis=1)

    def _values(self, t: ComplexArray) -> ComplexArray:
        moved = self.direction[:, None] * t
        values = np.where(
            self._angles, self.pose[:, None] + 2 * np.arctan(moved), self.pose[:, None] / self._units + moved
        )
        return np.asarray(values, dtype=complex)

    def _rates(self, t: ComplexArray) -> ComplexArray:
        own = self.direction[:, None] * np.ones(len(t))
        return np.asarray(
            np.where(self._angles, 2 * own / (1 + (self.direction[:, None] * t) ** 2), own), dtype=complex
        )

    @cached_property
    def _angles(self) -> NDArray[np.bool_]:
        return np.array([[name in ANGLES] for name in self.record.platform.pose])

    @cached_property
    def _units(self) -> FloatArray:
        return np.where(self._angles, 1.0, characteristic_length(self.record))


def _platform(configuration: Configuration) -> Outputs:
    return {**platform_numbers(configuration), **platform_moves(configuration)}
