"""What an instrument reads of the platform: coordinates of its point, turns, a distance, in a frame of its own.

Readings of angles count by a length, so that all that is off is a length.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.joint_graph.frames import Frame
from assur.joint_graph.geometry import characteristic_length
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
TURNS = ("rx", "ry", "rz")
DISTANCE = "distance"
READ = (*LENGTHS, *TURNS, *ANGLES, DISTANCE)
"""What can be measured: the point; the rotation vector; the pose's angles; how far the point is from a centre."""
FRAME = tuple(f"frame.{name}" for name in (*LENGTHS, *TURNS))
"""Where the measuring frame is in the base, and its rotation vector."""
STEP = 1e-6
AT_BASE: Frame = (np.eye(3), np.zeros(3))


@dataclass(frozen=True)
class Measured:
    """What is measured, in the mechanism's unit and rad.

    Attributes:
        names: of `READ`.
        length: that angles count by.
        centre: from which distances are, in the measuring frame.
    """

    names: tuple[str, ...]
    length: float
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def read(self, platform: Frame, frame: Frame = AT_BASE) -> FloatArray:
        """Readings (N, k) where the platform stands, (N, 3, 3) and (N, 3), in a measuring frame."""
        turn, point = seen(platform, frame)
        known = dict(zip(LENGTHS, point.T, strict=True))
        if set(self.names) & set(TURNS):
            known |= dict(zip(TURNS, rotations.to_vector(turn).T, strict=True))
        if set(self.names) & set(ANGLES):
            known |= dict(zip(ANGLES, rotations.to_angles(turn), strict=True))
        known[DISTANCE] = np.linalg.norm(point - self.centre, axis=-1)
        return np.stack([known[name] for name in self.names], axis=-1)

    def off(self, measured: FloatArray, read: FloatArray) -> FloatArray:
        """What is measured less what should be read (N, k), as lengths; angles by the shorter way round."""
        return self.weights * (measured - read - self._rounds * np.round((measured - read) / (2.0 * np.pi)))

    @property
    def weights(self) -> FloatArray:
        """(k,) lengths that one of each reading is."""
        return np.where(self._rounds > 0.0, self.length, 1.0)

    @property
    def _rounds(self) -> FloatArray:
        """A whole turn of angles, none of lengths (k,)."""
        return np.array([0.0 if name in LENGTHS or name == DISTANCE else 2.0 * np.pi for name in self.names])

    def slopes(self, platform: Frame, frame: Frame = AT_BASE) -> FloatArray:
        """Change (k, 6) of readings, as lengths, per displacement and turn of the platform at (3, 3) and (3,).

        Along the base's axes, by central differences over a small displacement or turn.
        """
        turn, point = platform
        small = STEP * np.eye(3)
        shifts = np.concatenate([small * self.length, np.zeros((3, 3))])
        turned = rotations.from_vector(np.concatenate([np.zeros((3, 3)), small])) @ turn
        back = rotations.from_vector(np.concatenate([np.zeros((3, 3)), -small])) @ turn
        above, below = self.read((turned, point + shifts), frame), self.read((back, point - shifts), frame)
        sizes = np.repeat([2.0 * STEP * self.length, 2.0 * STEP], 3)
        return np.asarray((self.off(above, below) / sizes[:, None]).T)


def measured_of(
    record: MechanismRecord, names: Sequence[str] = (), centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> Measured:
    """What is measured of a mechanism: the lengths of its pose without names.

    Errors:
        UnknownNameError: what cannot be measured.
        UsageError: nothing, or something twice; a centre of no distance.

    >>> from assur.model.registry import load_record
    >>> measured_of(load_record("fivebar")).names
    ('x', 'y')
    """
    own = tuple(names) or tuple(name for name in LENGTHS if name in record.platform.pose)
    for name in own:
        if name not in READ:
            raise UnknownNameError("measured coordinate", name, READ)
    if not own:
        raise UsageError("nothing is measured", hint="say what, as --measure rx,ry,rz")
    if len(set(own)) < len(own):
        raise UsageError(f"measured twice: {', '.join(own)}")
    if DISTANCE not in own and any(centre):
        raise UsageError("centre: no distance is measured", hint="measure the distance, or leave the centre out")
    return Measured(own, characteristic_length(record), centre)


def seen(platform: Frame, frame: Frame) -> Frame:
    """The platform's frames (N, 3, 3) and (N, 3) in a measuring frame."""
    turn, point = frame
    return np.swapaxes(turn, -1, -2) @ platform[0], (platform[1] - point) @ turn


def of_frame(point: FloatArray) -> FloatArray:
    """Displacement and turn (6, 6) of a platform at a point (3,) of the frame that do what moving the frame would."""
    change = -np.eye(6)
    change[:3, 3:] = rotations.skew(point)
    return change


def aligned(points: FloatArray, readings: FloatArray) -> Frame:
    """The frame in which points (N, 3) of the base are nearest to readings (N, 3) (Kabsch 1976).

    >>> points, readings = np.diag([1.0, 2.0, 3.0]), np.array([[0.0, -1, 0], [2, 0, 0], [0, 0, 3]])
    >>> turn, place = aligned(points, readings)
    >>> bool(np.allclose(turn, [[0, -1, 0], [1, 0, 0], [0, 0, 1]])), bool(np.allclose(place, 0.0))
    (True, True)
    """
    middle, read = points.mean(axis=0), readings.mean(axis=0)
    left, _, right = np.linalg.svd((points - middle).T @ (readings - read))
    hand = np.diag([1.0, 1.0, np.linalg.det(left @ right)])
    turn = left @ hand @ right
    return turn, middle - turn @ read
