"""What measured poses tell of dimensions: rank, what acts together, and how well a set of poses shows the rest.

Known are the inputs as they were meant and the measured coordinates. Unknown are the dimensions, an offset of each
input, and where the measuring frame is, if that is asked. To first order the measured coordinates are off by a matrix
times these; its null space is what no measurement of them tells.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.pose import platform_frame, pose_of
from assur.kinematics.rates.acceleration import joints_in_mode
from assur.kinematics.status import Status
from assur.machine.accuracy.pose_errors import COORDINATES, pose_errors_at
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS

FloatArray = NDArray[np.float64]
FRAME = tuple(f"frame.{name}" for name in COORDINATES)
RANK = 1e-9
"""Share of the largest singular value below which one is zero; angles count by the characteristic length."""
ROUNDED = 1e-6
"""Share of the largest coefficient below which a dimension has no part in a combination."""
DRAWN = 40
"""Poses that are tried for each that is wanted."""


@dataclass(frozen=True, eq=False)
class Unidentifiable:
    """A combination of dimensions that moves nothing that is measured, and what it means in words."""

    words: str
    combination: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class Identification:
    """What a set of poses tells.

    Attributes:
        parameters: names of dimensions, of inputs for their offsets, and of the measuring frame.
        measured: names of coordinates.
        poses: (N, m) in the mechanism's unit and rad.
        matrix: (N k, p) change of the measured coordinates, rotations times the characteristic length, per unit.
        scales: (p,) what one is of each parameter, so that angles count by the characteristic length.
    """

    parameters: tuple[str, ...]
    measured: tuple[str, ...]
    poses: FloatArray
    matrix: FloatArray
    scales: FloatArray

    @cached_property
    def _parts(self) -> tuple[FloatArray, FloatArray]:
        _, sizes, right = np.linalg.svd(self.matrix * self.scales, full_matrices=True)
        return sizes, right

    @property
    def rank(self) -> int:
        """How many combinations of the parameters the poses tell."""
        return matrix_rank(self._parts[0])

    @cached_property
    def unidentifiable(self) -> tuple[Unidentifiable, ...]:
        """A basis of what they do not tell, of as few parameters each as elimination finds."""
        rows, _ = reduced(self._parts[1][self.rank :])
        rows = rows * self.scales
        kept = []
        for row in rows:
            clean = np.where(np.abs(row) > ROUNDED * np.abs(row).max(), row, 0.0)
            clean = clean / clean[np.flatnonzero(clean)[0]]
            own = {name: float(value) for name, value in zip(self.parameters, clean, strict=True) if value}
            kept.append(Unidentifiable(_words(own), own))
        return tuple(kept)

    @property
    def observability(self) -> dict[str, float]:
        """O1 to O5 of what is told (Sun and Hollerbach 2008): larger is better."""
        told = self._parts[0][: self.rank]
        if not len(told):
            return dict.fromkeys(("O1", "O2", "O3", "O4", "O5"), 0.0)
        return {
            "O1": float(np.exp(np.mean(np.log(told))) / np.sqrt(len(self.poses))),
            "O2": float(told[-1] / told[0]),
            "O3": float(told[-1]),
            "O4": float(told[-1] ** 2 / told[0]),
            "O5": float(1.0 / np.sum(1.0 / told)),
        }

    def __str__(self) -> str:
        lines = [f"{self.rank} of {len(self.parameters)} told by {len(self.poses)} poses, {', '.join(self.measured)}"]
        return "\n".join([*lines, *(part.words for part in self.unidentifiable)])


def identification(
    record: MechanismRecord,
    poses: FloatArray,
    measured: Sequence[str] = (),
    *,
    frame: bool = False,
    mode: str | None = None,
) -> Identification:
    """What poses (N, m), in the mechanism's unit and rad, tell of its dimensions.

    Args:
        record: the mechanism.
        poses: (N, m) at which coordinates are measured.
        measured: of x, y, z, rx, ry, rz; the lengths of the pose without.
        frame: whether the measuring frame's place is unknown too.
        mode: the working mode.

    Errors:
        UsageError: a pose that is not reached, or at which the inputs do not hold the platform; nothing measured.
        UnknownNameError: a coordinate that there is not.

    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> told = identification(record, random_poses(record, 12))
    >>> [own.words for own in told.unidentifiable if "l7" in own.combination or "b" in own.combination]
    ['b and d act by their difference', 'l7 and l8 act by their sum']
    """
    names = tuple(measured) or tuple(name for name in LENGTHS if name in record.platform.pose)
    for name in names:
        if name not in COORDINATES:
            raise UnknownNameError("measured coordinate", name, COORDINATES)
    if not names:
        raise UsageError("nothing is measured", hint="say what, as --measure rx,ry,rz")
    values = joints_in_mode(record, poses, mode)
    length = characteristic_length(record)
    rows: list[FloatArray] = []
    parameters: tuple[str, ...] = ()
    units: dict[str, str] = {}
    for number, joints in enumerate(values):
        errors = pose_errors_at(record, joints) if np.all(np.isfinite(joints)) else None
        if errors is None or errors.status != Status.regular:
            why = "is not reached" if errors is None else "is not held by the inputs"
            raise UsageError(f"pose {number + 1} of {record.name} {why}", hint="leave it out")
        inputs = [item.name for item in record.drives]
        parameters = tuple(name for name in errors.sensitivity if "." not in name or name in inputs)
        units = dict(errors.units)
        own = np.array([errors.sensitivity[name] for name in parameters]).T  # (6, p)
        if frame:
            own = np.concatenate([own, _frame(pose_point(record, joints))], axis=1)
        own = own * np.repeat([1.0, length], 3)[:, None]
        rows.append(own[[COORDINATES.index(name) for name in names]])
    matrix = np.concatenate(rows)
    lost = [name for name, column in zip(parameters, matrix.T, strict=False) if np.any(np.isnan(column))]
    if lost:
        raise UsageError(f"{lost[0]} of {record.name} alone does not assemble", hint="assur errors says what bears it")
    turned = [units[name] in ("rad", "deg") for name in parameters]
    scales = np.array([1.0 / length if turn else 1.0 for turn in turned] + [1.0, 1.0, 1.0, *[1.0 / length] * 3] * frame)
    return Identification((*parameters, *(FRAME if frame else ())), names, poses, matrix, scales)


def pose_point(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """The platform's point (3,) in the base frame."""
    return np.asarray(platform_frame(record, joints[None])[1][0])


def _frame(point: FloatArray) -> FloatArray:
    """Change (6, 6) of what is measured where the measuring frame is moved and turned."""
    change = np.zeros((6, 6))
    change[:3, :3], change[3:, 3:] = -np.eye(3), -np.eye(3)
    change[:3, 3:] = -np.cross(np.eye(3), point).T
    return change


def random_poses(record: MechanismRecord, count: int, mode: str | None = None, seed: int = 0) -> FloatArray:
    """Poses (count, m) that a working mode reaches and its inputs hold, anywhere in the file's box, else about home.

    Errors:
        UsageError: so many are not met.
    """
    random = np.random.default_rng(seed)
    home = pose_of(record, home_values(record))
    size = 0.2 * characteristic_length(record)
    kept: list[FloatArray] = []
    for _ in range(DRAWN):
        drawn = np.tile(home, (count, 1))
        for place, name in enumerate(record.platform.pose):
            about = (home[place] - size, home[place] + size)
            low, high = record.box.get(name, about if name in LENGTHS else (home[place], home[place]))
            drawn[:, place] = random.uniform(low, high, size=count)
        joints = joints_in_mode(record, drawn, mode)
        for pose, values in zip(drawn, joints, strict=True):
            if np.all(np.isfinite(values)) and pose_errors_at(record, values).status == Status.regular:
                kept.append(pose)
        if len(kept) >= count:
            return np.array(kept[:count])
    raise UsageError(f"{record.name}: {len(kept)} of {count} poses are met", hint="give poses in a file: --poses FILE")


def matrix_rank(sizes: FloatArray) -> int:
    """How many singular values count."""
    return int(np.sum(sizes > RANK * sizes[0])) if len(sizes) and sizes[0] > 0 else 0


def reduced(rows: FloatArray) -> tuple[FloatArray, list[int]]:
    """The same span of rows, by elimination from the last columns, and these: each has a one in one row alone."""
    own = rows.copy()
    used: list[int] = []
    for row in range(len(own)):
        left = np.abs(own[row:]).max(axis=0) > 1e-7
        left[used] = False
        column = int(np.flatnonzero(left)[-1])
        used.append(column)
        best = row + int(np.argmax(np.abs(own[row:, column])))
        own[[row, best]] = own[[best, row]]
        own[row] /= own[row, column]
        others = np.arange(len(own)) != row
        own[others] -= np.outer(own[others, column], own[row])
    return own[::-1], used


def _words(combination: Mapping[str, float]) -> str:
    names = list(combination)
    if len(names) == 1:
        return f"{names[0]} does not act"
    if len(names) == 2 and abs(abs(combination[names[1]]) - 1.0) < ROUNDED:
        return f"{names[0]} and {names[1]} act by their {'sum' if combination[names[1]] < 0 else 'difference'}"
    parts = [f"{value:+.4g} {name}" if abs(abs(value) - 1.0) > ROUNDED else f"{'+' if value > 0 else '-'} {name}"
             for name, value in combination.items()]  # fmt: skip
    return f"together they do not act: {' '.join(parts).lstrip('+ ')}"
