"""What ends a motion that runs by itself: limits of the file, and singularities that are passed from one moment on."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.following.locked import general_ranks, locked, matrices, smallest
from assur.kinematics.following.path import WORDS
from assur.kinematics.following.ranks import SINGULAR
from assur.kinematics.following.stopping import NAMES
from assur.kinematics.limits import Limit, limits
from assur.kinematics.pose import pose_of
from assur.kinematics.turns import joint_units
from assur.machine.dynamics.departure import Departure
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
KINDS = {"inputs": "parallel", "poses": "serial"}
"""What is singular where a matrix with these locked loses its rank."""
NEARBY = 0.1
"""So far joint values move at most between two looks, in rad or characteristic lengths."""
RETURNING = 1e-5
"""Smallest singular value up to which a rank that comes back is lost where another one is: there joint values are known
to the root of rounding alone, as where parallelograms are flat."""
HALVINGS = 40
"""Of the time in which an event lies: to rounding."""


@dataclass(frozen=True, eq=False)
class Watch:
    """What is watched of a motion that began at an assembly.

    Attributes:
        record: the mechanism.
        bounds: that must not be broken.
        ranks: of the joint graph with inputs or platform locked, in general.
    """

    record: MechanismRecord
    bounds: tuple[Limit, ...]
    ranks: Mapping[str, int]

    def at_start(self, time: float, values: FloatArray) -> Departure | None:
        """What forbids to begin at joint values (n,)."""
        limit = self._broken(values)
        if limit is not None:
            return self._departure(limit, time, values)
        return self._singular([], time, values)

    def event(self, at: Callable[[float], FloatArray], low: float, high: float) -> Departure | None:
        """The first event of a motion `at` (n,) between two times."""
        way = np.linalg.norm((at(high) - at(low)) / joint_units(self.record))
        looks = np.linspace(low, high, 2 + int(way / NEARBY)).tolist()
        for before, after in pairwise(looks):
            start = at(before)
            if not self._passed(start, at(after)):
                continue
            for _ in range(HALVINGS):
                middle = 0.5 * (before + after)
                before, after = (before, middle) if self._passed(start, at(middle)) else (middle, after)
            limit, values = self._broken(at(after)), at(before)
            if limit is not None:
                return self._departure(limit, before, values)
            return self._singular(self._lost(start, at(after)), before, values)
        return None

    def _passed(self, before: FloatArray, after: FloatArray) -> bool:
        return self._broken(after) is not None or bool(self._lost(before, after))

    def _broken(self, values: FloatArray) -> Limit | None:
        """The limit that joint values (n,) break most."""
        rooms = {float(limit.margin(values)): limit for limit in self.bounds}
        least = min(rooms, default=0.0)
        return rooms[least] if least < 0.0 else None

    def _lost(self, before: FloatArray, after: FloatArray) -> list[str]:
        """Of the matrices those that lose their rank between two configurations (n,) that are near to each other."""
        first, second = matrices(self.record, before), matrices(self.record, after)
        return [name for name, rank in self.ranks.items() if locked(first[name], rank).kept(second[name]) <= 0.0]

    def _singular(self, passed: list[str], time: float, values: FloatArray) -> Departure | None:
        """With the rank of these matrices that of others may be lost, which comes back: none where all are kept."""
        sizes = smallest(self.record, values, self.ranks)
        most = RETURNING if passed else SINGULAR
        lost = [name for name, size in sizes.items() if name in passed or size <= most]
        if not lost:
            return None
        kinds = [kind for name, kind in KINDS.items() if name in lost]
        kind = "constraint" if "closure" in lost else kinds[0] if len(kinds) == 1 else "comprehensive"
        return self._departure((kind, "closure" if "closure" in lost else lost[0]), time, values)

    def _departure(self, what: Limit | tuple[str, str], time: float, values: FloatArray) -> Departure:
        if isinstance(what, Limit):
            kind, quantity, value = "limit", f"the room to the {what.name}", float(what.margin(values))
        else:
            kind, quantity = what[0], NAMES[what[1]]
            value = float(smallest(self.record, values, self.ranks)[what[1]])
        text = f"at {time:.6g} s it comes to {WORDS[kind]}; {quantity} is {value:.3g}"
        return Departure(kind, time, pose_of(self.record, values), quantity, value, text)


def too_fast(record: MechanismRecord, time: float, values: FloatArray) -> Departure:
    """Of a motion that speeds up beyond what steps can follow, after joint values (n,)."""
    text = f"at {time:.6g} s it speeds up without bound"
    return Departure("undecided", time, pose_of(record, values), "the step", 0.0, text)


def watch(record: MechanismRecord, values: FloatArray, *, use_limits: bool = True) -> Watch:
    """The watch of motions that begin at an assembly (n,)."""
    bounds = limits(record, values) if use_limits else ()
    return Watch(record, bounds, general_ranks(record, values))
