"""The factors of det Jp along rays: their values and signs at poses that are moved, the orientation held."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closed_form.filling import Engine
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.kinematics.status import closed_form_of, scale
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True)
class ParallelFactors:
    """The parallel factors of one working mode.

    Attributes:
        record, mode: whose.
        columns: coordinates of the pose that are lengths; along these it moves.
        engine: of the sweeps.
    """

    record: MechanismRecord
    mode: str
    columns: Sequence[int]
    engine: Engine = "auto"

    @cached_property
    def names(self) -> list[str]:
        """Names (F)."""
        return [closed_form_of(self.record).factor_list[row].name for row in self._rows]

    def at(self, poses: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Factors (F, N) as shares of their scales at poses (N, m), and whether the mode reaches them (N,)."""
        columns = np.ascontiguousarray(poses.T)
        sweep = inverse_sweep(self.record, columns, self.mode, ("exists", "factors"), engine=self.engine)
        return sweep["factors"][self._rows] / self._scales, sweep["exists"]

    def signs(self, poses: FloatArray) -> tuple[NDArray[np.int_], BoolArray]:
        """Signs of all factors as bits of a number (...) at poses (..., m), and whether the mode reaches them (...)."""
        values, reached = self.at(poses.reshape(-1, poses.shape[-1]))
        return packed(values).reshape(poses.shape[:-1]), reached.reshape(poses.shape[:-1])

    def moved(self, poses: FloatArray, directions: FloatArray, lengths: FloatArray) -> FloatArray:
        """Poses (..., m) moved by lengths (...) in directions (..., k) of the coordinates that are lengths."""
        moved = np.array(np.broadcast_to(poses, (*lengths.shape, poses.shape[-1])))
        moved[..., self.columns] += lengths[..., None] * directions
        return moved

    @cached_property
    def _rows(self) -> list[int]:
        return [row for row, factor in enumerate(closed_form_of(self.record).factor_list) if factor.kind == "parallel"]

    @cached_property
    def _scales(self) -> FloatArray:
        factors = closed_form_of(self.record).factor_list
        return np.array([scale(self.record, factors[row].scale) for row in self._rows]).reshape(-1, 1)  # (F, 1)


def packed(values: FloatArray) -> NDArray[np.int_]:
    """Signs of factors (F, N) as bits of one number (N,).

    >>> packed(np.array([[1.0, -1.0], [-2.0, -3.0]]))
    array([2, 3])
    """
    return np.asarray(2 ** np.arange(len(values)) @ np.signbit(values).astype(int))
