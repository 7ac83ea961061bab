"""Codac in a process of its own, because it changes how floats are rounded (see `with_codac`)."""

from __future__ import annotations

import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Any, NamedTuple

import numpy as np

from assur.kinematics.modes import mode_signs
from assur.model.mechanism import MechanismRecord


class Paved(NamedTuple):
    """Bounds of the volume in mm^3, boxes about the boundary, and middles (2, N) of boxes inside and outside."""

    low: float
    high: float
    boundary: int
    inside: np.ndarray
    outside: np.ndarray


class Codac:
    """What `with_codac` answers on one mechanism; every answer comes with the seconds of processor time it took.

    Attributes:
        version: of Codac, or None where it cannot be loaded.
        missing: why it cannot.
    """

    def __init__(self, record: MechanismRecord) -> None:
        self.process = ProcessPoolExecutor(1, mp_context=get_context("spawn"))
        self.lengths = {name: item.value for name, item in record.parameters.items()}
        self.signs = tuple(map(float, mode_signs(record, "inverse", record.modes.default_working)[:2]))
        self.box = {name: tuple(map(float, pair)) for name, pair in record.box.items()}
        self.version, self.missing = None, ""
        try:
            self.version, _ = self._ask("version")
        except (ImportError, OSError) as error:
            self.missing = str(error)

    def workspace(self, size: float) -> tuple[Paved, float]:
        """The paving down to boxes of `size` mm."""
        found, took = self._ask("workspace", self.lengths, self.signs, self.box, size)
        return Paved(*found), took

    def direct(self, inputs: Sequence[float]) -> tuple[tuple[np.ndarray, np.ndarray, int], float]:
        """Low and high ends (N, 3) of proved poses, and boxes looked at."""
        return self._ask("direct", self.lengths, inputs)

    def _ask(self, *asked: Any) -> tuple[Any, float]:
        return self.process.submit(_answer, *asked).result()


def _answer(name: str, *given: Any) -> tuple[Any, float]:
    """In the other process."""
    import with_codac

    start = time.process_time()
    found = getattr(with_codac, name)(*given)
    return found, time.process_time() - start
