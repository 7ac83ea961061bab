"""Turns around loops of parallel axes: there the angles add up to whole turns, and to as many on every motion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.model.mechanism import Joint, MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
PARALLEL = 1e-9
"""Sine below which an axis is along a direction: both are written, or turned by a limb's angle."""


@lru_cache(maxsize=64)
def turn_relations(record: MechanismRecord) -> FloatArray:
    """Sums (r, n) of angles of screws and inputs that no motion changes, as rows of -1, 0 and 1.

    Each runs around a loop of axes that stay parallel; sliding joints turn nothing. Sums in which a passive joint
    without pitch occurs are left out: its whole turns are free, so that the sum says nothing.
    """
    rows = [row for name, joint in record.joints.items() if joint.type.screw for row in _Parallel(record, name).sums]
    matrix = np.array(rows).reshape(len(rows), len(record.coordinates))
    driven = np.isin(np.arange(matrix.shape[1]), record.input_indices)
    return _frozen(_without(matrix, np.flatnonzero(~screws_among(record) & ~driven)))


def screws_among(record: MechanismRecord) -> BoolArray:
    """Which joint values (n,) are those of screws.

    >>> from assur.model.registry import load_record
    >>> bool(np.any(screws_among(load_record("fivebar"))))
    False
    """
    return np.array([record.joints[item.joint].type.screw for item in record.coordinates], dtype=bool)


@dataclass(frozen=True)
class _Reached:
    """A link that only turns about a direction (3,), given in its frame, and the angles (n,) added up on the way."""

    direction: FloatArray
    angles: FloatArray


class _Parallel:
    """Links that hang on a screw by sliding joints and by axes along its own: the sums of angles around their loops."""

    def __init__(self, record: MechanismRecord, screw: str) -> None:
        self.record = record
        self.sums: list[FloatArray] = []
        joint = record.joints[screw]
        self._reached = {joint.parent: _Reached(joint.axes[0], np.zeros(len(record.coordinates)))}
        used: set[str] = set()
        waiting = [joint.parent]
        for link in waiting:
            for name, other in record.joints.items():
                if name not in used and link in (other.parent, other.child):
                    used.add(name)
                    self._cross(link, other, waiting)

    def _cross(self, link: str, joint: Joint, waiting: list[str]) -> None:
        start, forward = self._reached[link], joint.parent == link
        along = start.direction if forward else joint.turn @ start.direction  # in the parent's frame, as the axis
        turned = self._turned(joint, along)
        if turned is None:
            return
        far = joint.child if forward else joint.parent
        angles = start.angles + (turned if forward else -turned)
        direction = joint.turn.T @ along if forward else along
        known = self._reached.get(far)
        if known is None:
            self._reached[far] = _Reached(direction, angles)
            waiting.append(far)
        elif np.linalg.norm(known.direction - direction) < PARALLEL:
            self.sums.append(angles - known.angles)

    def _turned(self, joint: Joint, along: FloatArray) -> FloatArray | None:
        """What a joint adds (n,) to the angle about a direction; None where it turns about another."""
        angles = np.zeros(len(self.record.coordinates))
        if not joint.type.turning:
            return angles
        if joint.type.turns != 1 or np.linalg.norm(np.cross(joint.axes[0], along)) > PARALLEL:
            return None
        angles[joint_graph(self.record).slices[joint.name].stop - 1] = np.sign(joint.axes[0] @ along)
        return angles


def _without(rows: FloatArray, columns: NDArray[np.intp]) -> FloatArray:
    """Independent combinations (r, n) of rows of -1, 0 and 1 in which some columns do not occur."""
    left = rows.copy()
    for column in columns:
        places = np.flatnonzero(left[:, column])
        if not len(places):
            continue
        pivot = left[places[0]] / left[places[0], column]
        left = np.delete(left - left[:, [column]] * pivot, places[0], axis=0)
    kept: list[FloatArray] = []
    for row in left:
        if np.linalg.matrix_rank(np.array([*kept, row])) > len(kept):
            kept.append(row)
    return np.array(kept).reshape(len(kept), rows.shape[1])


def _frozen(array: NDArray[Any]) -> NDArray[Any]:
    array.flags.writeable = False
    return array
