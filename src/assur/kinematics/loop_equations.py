"""Loop closure of the joint graph over folded numbers: gaps, their derivative, and turning by a small angle.

The same equations as in `closure`, for a recorder: a length enters as itself, an angle as its cosine and sine, a ball
joint as a unit quaternion, so that no trigonometry is left inside. Planar and parallel structure folds away.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from assur.kinematics.loop_state import state_names
from assur.model.joint_graph import joint_graph
from assur.model.mechanism import Joint, MechanismRecord
from assur.numerics.recording.folding import Folding
from assur.topology.joints import CYLINDRICAL, PRISMATIC, SPHERICAL, UNIVERSAL

ROUNDED = 1e-15
"""What is smaller than this in a unit vector is rounding."""


class LoopEquations:
    """Frames, gaps and screws of a mechanism's loops.

    Attributes:
        state: the numbers of each coordinate, as `loop_state` has them.
        gaps: six per cut joint: three lengths and the sine vector of the rotation between its two frames.
        squares: two per cut joint: squared distance, and squared rotation in rad (by the chord).
        derivative: (row, coordinate) -> entry, where it is not zero beforehand; for the three coordinates of a ball
            joint along the parent's axes.

    Example: a planar loop has six rows, of which three vanish identically.

    >>> from assur.model.registry import load_record
    >>> equations = LoopEquations(load_record("fivebar"), Folding())
    >>> len(equations.gaps), sum(isinstance(gap, float) for gap in equations.gaps)
    (6, 3)
    """

    def __init__(self, record: MechanismRecord, folding: Folding) -> None:
        self.record, self.folding, self.graph = record, folding, joint_graph(record)
        self.state = {k: tuple(map(folding.varying, names)) for k, names in state_names(record).items()}
        self.gaps: list[Any] = []
        self.squares: list[tuple[Any, Any]] = []
        self.derivative: dict[tuple[int, int], Any] = {}
        self._placed = {record.base: (_plain(np.eye(3)), _plain(np.zeros(3)))}
        for joint, forward in self.graph.tree:
            self._place(joint, forward)
        for row, (joint, loop) in enumerate(zip(self.graph.cut, self.graph.loops, strict=True)):
            self._close(6 * row, joint, loop)

    def _place(self, joint: Joint, forward: bool) -> None:
        """The frame of the far link, as `joint_graph.child_frame` and `parent_frame` have it."""
        turn, at = self._motion(joint)
        rotation, origin = self._placed[joint.parent if forward else joint.child]
        if forward:
            far = rotation @ turn
            self._placed[joint.child] = far, origin + rotation @ at - far @ _plain(joint.child_at)
        else:
            far = rotation @ turn.T
            self._placed[joint.parent] = far, origin + rotation @ _plain(joint.child_at) - far @ at

    def _motion(self, joint: Joint) -> tuple[Any, Any]:
        """Orientation of the child in the parent, and the joint's point there."""
        first = self.graph.slices[joint.name].start
        at, turn = _plain(joint.at), _plain(np.eye(3))
        if joint.type is SPHERICAL:
            turn = _from_quaternion(*self.state[first])
        elif joint.type is UNIVERSAL:
            turn = about(joint.axes[0], *self.state[first]) @ about(joint.axes[1], *self.state[first + 1])
        elif joint.type is PRISMATIC:
            at = at + _unit(joint.axes[0]) * self.state[first][0]
        elif joint.type is CYLINDRICAL:
            at = at + _unit(joint.axes[0]) * self.state[first][0]
            turn = about(joint.axes[0], *self.state[first + 1])
        else:
            turn = about(joint.axes[0], *self.state[first])
        return (turn @ _unit(joint.turn) if joint.turned else turn), at

    def _close(self, row: int, joint: Joint, loop: Mapping[str, int]) -> None:
        turn, at = self._motion(joint)
        rotation, origin = self._placed[joint.parent]
        reached, there = rotation @ turn, origin + rotation @ at
        own, own_origin = self._placed[joint.child]
        point = own_origin + own @ _plain(joint.child_at)
        error = [[sum(reached[i] * own[j]) if i != j else 0.0 for j in range(3)] for i in range(3)]
        gap = there - point
        self.gaps += [*gap, *(0.5 * (error[k - 1][k - 2] - error[k - 2][k - 1]) for k in range(3))]
        chord = (reached - own).reshape(-1)
        self.squares.append((sum(gap * gap), 0.5 * sum(chord * chord)))
        for name, sense in ((joint.name, 1), *loop.items()):
            for coordinate, angular, velocity in self._columns(self.record.joints[name], point):
                for k, entry in enumerate((*velocity, *angular)):
                    if not (isinstance(entry, float) and entry == 0.0):
                        self.derivative[row + k, coordinate] = sense * entry

    def _columns(self, joint: Joint, point: Any) -> list[tuple[int, Any, Any]]:
        """Coordinate, angular velocity, and velocity at a point, of a joint's unit rates."""
        first = self.graph.slices[joint.name].start
        rotation, origin = self._placed[joint.parent]
        still = _plain(np.zeros(3))
        if joint.type is PRISMATIC:
            return [(first, still, rotation @ _unit(joint.axes[0]))]
        if joint.type is CYLINDRICAL:
            axis = rotation @ _unit(joint.axes[0])
            arm = point - (origin + rotation @ _plain(joint.at))
            return [(first, still, axis), (first + 1, axis, _crossed(axis, arm))]
        arm = point - (origin + rotation @ _plain(joint.at))
        if joint.type is SPHERICAL:
            axes = list(rotation.T)
        elif joint.type is UNIVERSAL:
            second = about(joint.axes[0], *self.state[first]) @ _unit(joint.axes[1])
            axes = [rotation @ _unit(joint.axes[0]), rotation @ second]
        else:
            axes = [rotation @ _unit(joint.axes[0])]
        return [(first + k, axis, _crossed(axis, arm)) for k, axis in enumerate(axes)]

    def moved(self, changes: Mapping[int, Any]) -> dict[int, tuple[Any, ...]]:
        """Coordinates' numbers after changes of lengths and angles; angles by the rational rotation.

        A pair (c, s) is turned by (1 - d^2/4, d) / (1 + d^2/4), d radians but for d^3/12; it stays of unit length.
        """
        found: dict[int, tuple[Any, ...]] = {}
        kinds = [item.kind for item in self.record.coordinates]
        for k, numbers in self.state.items():
            if len(numbers) == 4:
                parts = [0.5 * changes[k + i] if k + i in changes else 0.0 for i in range(3)]
                if any(k + i in changes for i in range(3)):
                    found[k] = self._turned_ball(numbers, parts)
            elif k in changes and kinds[k] == "length":
                found[k] = (numbers[0] + changes[k],)
            elif k in changes:
                half = 0.5 * changes[k]
                share = 2.0 / (1.0 + half * half)
                turned, slipped = share * half, share * half * half
                cosine, sine = numbers
                found[k] = cosine - slipped * cosine - turned * sine, sine - slipped * sine + turned * cosine
        return found

    def _turned_ball(self, numbers: tuple[Any, ...], half: list[Any]) -> tuple[Any, ...]:
        """The quaternion turned about the parent's axes; of unit length again."""
        w, vector = numbers[0], np.array(numbers[1:], dtype=object)
        turn = np.array(half, dtype=object)
        raw = [w - sum(turn * vector), *(vector + turn * w + _crossed(turn, vector))]
        size = 1.0 / self.folding.sqrt(sum(part * part for part in raw))
        return tuple(part * size for part in raw)


def about(axis: Any, cosine: Any, sine: Any) -> Any:
    """Rotation (3, 3) about a unit axis; zeros and ones stay plain."""
    unit = _unit(axis)
    along = np.outer(unit, unit)
    x, y, z = unit
    across = _plain(np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]], dtype=float))
    return along + _unit(np.eye(3) - along) * cosine + across * sine


def _from_quaternion(w: Any, x: Any, y: Any, z: Any) -> Any:
    xx, yy, zz = 2.0 * x * x, 2.0 * y * y, 2.0 * z * z
    xy, xz, yz = 2.0 * x * y, 2.0 * x * z, 2.0 * y * z
    wx, wy, wz = 2.0 * w * x, 2.0 * w * y, 2.0 * w * z
    return np.array(
        [[1.0 - (yy + zz), xy - wz, xz + wy], [xy + wz, 1.0 - (xx + zz), yz - wx], [xz - wy, yz + wx, 1.0 - (xx + yy)]],
        dtype=object,
    )


def _crossed(a: Any, b: Any) -> Any:
    return np.array([a[k - 2] * b[k - 1] - a[k - 1] * b[k - 2] for k in range(3)], dtype=object)


def _plain(numbers: Any) -> Any:
    return np.asarray(numbers, dtype=float).astype(object)


def _unit(numbers: Any) -> Any:
    """Parts of unit vectors without the rounding of their zeros and ones."""
    values = np.asarray(numbers, dtype=float)
    whole = np.round(values)
    return np.where(np.abs(values - whole) <= ROUNDED, whole + 0.0, values).astype(object)
