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

from assur.errors import UsageError
from assur.joint_graph.frames import Frame
from assur.kinematics.pose import platform_frame
from assur.kinematics.rates.acceleration import joints_in_mode
from assur.kinematics.status import Status
from assur.machine.accuracy.pose_errors import pose_errors_at
from assur.machine.calibration.dimensions import Owner, dimensions
from assur.machine.calibration.measured import AT_BASE, FRAME, TURNS, Measured, measured_of, of_frame
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
RANK = 1e-9
"""Share of the largest singular value below which one is zero; angles count by the characteristic length."""
INDICES = ("O1", "O2", "O3", "O4", "O5")
ROUNDED = 1e-6
"""Share of the largest coefficient below which a dimension has no part in a combination."""


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
        matrix: (N k, p) change of what is measured, angles times the characteristic length, per one of each parameter.
        scales: (p,) what one is of each parameter, so that angles count by the characteristic length.
        strained: dimensions that are no parameters: alone they do not assemble.
    """

    parameters: tuple[str, ...]
    measured: tuple[str, ...]
    poses: FloatArray
    matrix: FloatArray
    scales: FloatArray
    strained: tuple[str, ...] = ()

    @cached_property
    def _parts(self) -> tuple[FloatArray, FloatArray]:
        _, sizes, right = np.linalg.svd(self.matrix * self.scales, full_matrices=True)
        return sizes, right

    @property
    def rank(self) -> int:
        """How many combinations of the parameters the poses tell."""
        return matrix_rank(self._parts[0])

    @cached_property
    def _untold(self) -> tuple[FloatArray, list[int]]:
        """Combinations (u, p) that are not told, and of each the parameter that the others can stand for."""
        rows, pivots = reduced(self._parts[1][self.rank :])
        rows = rows * self.scales
        rows = rows / rows[np.arange(len(rows)), pivots][:, None]
        return np.where(np.abs(rows) > ROUNDED * np.abs(rows).max(axis=1, initial=0.0)[:, None], rows, 0.0), pivots

    @cached_property
    def unidentifiable(self) -> tuple[Unidentifiable, ...]:
        """A basis of what they do not tell, of as few parameters each as elimination finds."""
        kept = []
        for row in self._untold[0]:
            own = self._named(row / row[np.flatnonzero(row)[0]])
            kept.append(Unidentifiable(_words(own), own))
        return tuple(kept)

    @cached_property
    def base_parameters(self) -> dict[str, dict[str, float]]:
        """By the parameters that can be told: what is told in truth, with what acts like it."""
        rows, pivots = self._untold
        told = [k for k in range(len(self.parameters)) if k not in pivots]
        return {self.parameters[k]: self._named(_with_others(len(self.parameters), k, rows, pivots)) for k in told}

    def _named(self, row: FloatArray) -> dict[str, float]:
        return {name: float(value) for name, value in zip(self.parameters, row, strict=True) if value}

    @property
    def observability(self) -> dict[str, float]:
        """O1 to O5 of what is told (Sun and Hollerbach 2008): larger is better."""
        return {name: float(value) for name, value in indices(self._parts[0][: self.rank], len(self.poses)).items()}

    def __str__(self) -> str:
        lines = [f"{self.rank} of {len(self.parameters)} told by {len(self.poses)} poses, {', '.join(self.measured)}"]
        return "\n".join([*lines, *(part.words for part in self.unidentifiable)])


def identification(
    record: MechanismRecord,
    poses: FloatArray,
    measured: Sequence[str] = (),
    *,
    frame: bool = False,
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0),
    mode: str | None = None,
    copies: Owner | None = None,
) -> Identification:
    """What poses (N, m), in the mechanism's unit and rad, tell of its dimensions.

    Args:
        record: the mechanism.
        poses: (N, m) at which coordinates are measured.
        measured: of x, y, z, rx, ry, rz, the pose's angles, and `distance`; the lengths of the pose without.
        frame: whether the measuring frame's place is unknown too.
        centre: from which a distance is measured, in the measuring frame, near the base's.
        mode: the working mode.
        copies: whose dimensions are unknown each by itself, every limb's or every link's; else they are alike in all.

    Errors:
        UsageError: a pose that is not reached, or at which the inputs do not hold the platform; nothing measured.
        UnknownNameError: a coordinate that there is not.

    >>> from assur.machine.calibration.chosen_poses import random_poses
    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> told = identification(record, random_poses(record, 12))
    >>> [own.words for own in told.unidentifiable if "l7" in own.combination or "b" in own.combination]
    ['b and d act by their difference', 'l7 and l8 act by their sum']
    >>> [combined(own) for own in told.base_parameters.values() if len(own) > 1]
    ['b - d', 'l3 + 2 yA2', 'l7 + l8', 'yA1 + yA2']
    """
    own = measured_of(record, measured, centre)
    rows: list[FloatArray] = []
    parameters: tuple[str, ...] = ()
    scales = np.zeros(0)
    for number, joints in enumerate(joints_in_mode(record, poses, mode), 1):
        parameters, row, scales = slopes_at(
            record, joints, own, f"pose {number} of {record.name}", frame=frame, copies=copies
        )
        rows.append(row)
    matrix = np.concatenate(rows)
    fit = ~np.isnan(matrix).any(axis=0)
    kept, strained = (tuple(np.array(parameters)[rows].tolist()) for rows in (fit, ~fit))
    return Identification(kept, own.names, poses, matrix[:, fit], scales[fit], strained)


def slopes_at(
    record: MechanismRecord,
    joints: FloatArray,
    measured: Measured,
    named: str,
    at: Frame = AT_BASE,
    *,
    frame: bool,
    copies: Owner | None = None,
) -> tuple[tuple[str, ...], FloatArray, FloatArray]:
    """Parameters (p), change (k, p) of what is measured, as lengths, per one of each, and what one of each is (p,).

    NaN for dimensions that alone do not assemble. A measuring frame moves from where it is, turned in the base.

    Args:
        record: the mechanism.
        joints: (n,) values; NaN where the pose is not reached.
        measured: what is measured.
        named: the pose, as errors name it.
        at: where the measuring frame is.
        frame: whether its place is a parameter.
        copies: whose dimensions are parameters each by itself.

    Errors:
        UsageError: a pose that is not reached, or at which the inputs do not hold the platform.
    """
    errors = pose_errors_at(record, joints, bent=False) if np.all(np.isfinite(joints)) else None
    if errors is None or errors.status != Status.regular:
        why = "is not reached" if errors is None else "is not held by the inputs"
        raise UsageError(f"{named} {why}", hint="leave it out")
    names = (*dimensions(record, copies), *(item.name for item in record.drives))
    turn, point = (part[0] for part in platform_frame(record, joints[None]))
    moved = np.array([errors.sensitivity[name] for name in names]).T
    plain = [errors.units[name] != record.unit for name in names]  # angles, and shares
    if frame:
        names = (*names, *FRAME)
        moved = np.concatenate([moved, of_frame(point - at[1])], axis=1)
        plain += [name.removeprefix("frame.") in TURNS for name in FRAME]
    return names, measured.slopes((turn, point), at) @ moved, np.where(plain, 1.0 / measured.length, 1.0)


def matrix_rank(sizes: FloatArray) -> int:
    """How many singular values count."""
    return int(np.sum(sizes > RANK * sizes[0])) if len(sizes) and sizes[0] > 0 else 0


def indices(sizes: FloatArray, poses: int) -> dict[str, FloatArray]:
    """O1 to O5 of singular values (..., r), the largest first, of so many poses; zero where nothing is told.

    >>> {name: round(float(value), 3) for name, value in indices(np.array([4.0, 1.0]), 4).items()}
    {'O1': 1.0, 'O2': 0.25, 'O3': 1.0, 'O4': 0.25, 'O5': 0.8}
    """
    if not sizes.shape[-1]:
        return dict.fromkeys(INDICES, np.zeros(sizes.shape[:-1]))
    first, last = sizes[..., 0], sizes[..., -1]
    with np.errstate(divide="ignore", invalid="ignore"):
        own = (
            np.exp(np.mean(np.log(sizes), axis=-1)) / np.sqrt(poses),
            last / first,
            last,
            last**2 / first,
            1.0 / np.sum(1.0 / sizes, axis=-1),
        )
    return {name: np.nan_to_num(np.asarray(value)) for name, value in zip(INDICES, own, strict=True)}


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
    return own[::-1], used[::-1]


def _with_others(count: int, place: int, rows: FloatArray, pivots: Sequence[int]) -> FloatArray:
    """A parameter (count,), less what acts like it does."""
    own = np.zeros(count)
    own[place] = 1.0
    own[list(pivots)] = -rows[:, place]
    return own


def _words(combination: Mapping[str, float]) -> str:
    names = list(combination)
    if len(names) == 1:
        return f"{names[0]} does not act"
    if len(names) == 2 and abs(abs(combination[names[1]]) - 1.0) < ROUNDED:
        return f"{names[0]} and {names[1]} act by their {'sum' if combination[names[1]] < 0 else 'difference'}"
    return f"together they do not act: {combined(combination)}"


def combined(combination: Mapping[str, float]) -> str:
    """A sum of parameters as it is written.

    >>> combined({"l3": 1.0, "yA1": 0.5, "yA2": -1.0})
    'l3 + 0.5 yA1 - yA2'
    """
    parts = [
        f"{'-' if value < 0 else '+'} {'' if abs(abs(value) - 1.0) <= ROUNDED else f'{abs(value):.4g} '}{name}"
        for name, value in combination.items()
    ]
    return " ".join(parts).removeprefix("+ ").replace("- ", "-", 1 if parts[0][0] == "-" else 0)
