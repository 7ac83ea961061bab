"""What a certificate says: solutions with bounds, proved one by one; what is undecided; whether that is all."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border, position
from assur.kinematics.answers.at_border import inputs_at_border, pose_at_border, power
from assur.kinematics.answers.excess import limits_at_border
from assur.kinematics.border import drive_names
from assur.kinematics.limits import limits_stated
from assur.kinematics.modes import Problem
from assur.kinematics.turns import periodic_drives
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, QUATERNION, is_angle
from assur.numerics import rotations
from assur.numerics.intervals.functions import TURN
from assur.numerics.intervals.interval import Interval
from assur.results.answers.certified import (
    Bounds,
    CertifiedDirect,
    CertifiedInverse,
    ProvedInputs,
    ProvedPose,
    UndecidedPlace,
)
from assur.results.answers.position import KeptLimits
from assur.results.notebook import Entries, Tabulated

FloatArray = NDArray[np.float64]
THERE = 1e-6
"""A solution in floating point this near to the middle of proved bounds, in rad or characteristic lengths, is it."""


@dataclass(frozen=True, eq=False)
class ProvedSolution:
    """A solution that certainly exists, and is the only one of its modes within these bounds.

    Attributes:
        pose, inputs: bounds (m,) and (n,), lengths and rad; what was given as far as it is known, exact or converted.
        mode: the signs that name it among the solutions of its problem.
        working_mode, assembly_mode: both names of the configuration, as the float answer has them.
        how: by what it is proved.
        left: what the equations that are no part of the proof come to at most, in lengths or rad: those of an
            overconstrained mechanism that depend on the others in exact numbers. 0 where every equation is proved.
    """

    pose: Interval
    inputs: Interval
    mode: str
    working_mode: str
    assembly_mode: str
    how: str
    left: float = 0.0

    @property
    def width(self) -> float:
        """The widest of its bounds, lengths and rad alike."""
        return float(np.max([np.max(self.pose.width, initial=0.0), np.max(self.inputs.width, initial=0.0)]))


@dataclass(frozen=True, eq=False)
class Doubt:
    """Where nothing is proved: a margin whose bounds hold zero, or a box of poses.

    Attributes:
        name: of the margin, or "pose".
        low, high: (1,) bounds of the margin, or (m,) of the poses, lengths and rad.
        meaning: what it means, in one phrase.
        unit: power of the length unit of a margin.
        branches: how many branches are in doubt for this reason.
    """

    name: str
    low: FloatArray
    high: FloatArray
    meaning: str
    unit: int = 0
    branches: int = 1


@dataclass(frozen=True, eq=False)
class CertifiedSolutions(Tabulated):
    """The proved answer to one direct or inverse problem, as far as it could be proved.

    Attributes:
        problem: "direct" or "inverse".
        given: (n,) inputs or (m,) a pose, angles in rad; `assur.kinematics.certified.given` says what they count as.
        solutions: proved one by one, no two the same.
        undecided: where there may be others, or none.
        complete: whether it is proved that outside of `undecided` there is no other solution.
        complete_for: for which model: "joint_graph" or "reduced".
        right: by what right it is complete, or why it is not.
        excluded: margin -> how many branches it excludes.
    """

    record: MechanismRecord
    problem: Problem
    given: FloatArray
    solutions: tuple[ProvedSolution, ...]
    undecided: tuple[Doubt, ...]
    complete: bool
    complete_for: Literal["joint_graph", "reduced"]
    right: str
    excluded: dict[str, int] = field(default_factory=dict)

    def __repr__(self) -> str:
        return f"<{self.problem} certificate of {self.record.name}: {self.headline}>"

    def _title(self) -> str:
        return f"{self.headline}, {self.problem} of {self.record.name}: bounds as lengths and in rad"

    def _entries(self) -> Entries:
        names = [*self.record.platform.pose, *drive_names(self.record)]
        return [
            {
                "mode": item.mode,
                **{
                    f"{name} {side}": float(value)
                    for side in ("low", "high")
                    for name, value in zip(
                        names, np.concatenate([getattr(item.pose, side), getattr(item.inputs, side)]), strict=True
                    )
                },
            }
            for item in self.solutions
        ]

    def __len__(self) -> int:
        return len(self.solutions)

    def __iter__(self) -> Iterator[ProvedSolution]:
        return iter(self.solutions)

    @property
    def proved(self) -> bool:
        """Whether these are proved to be all solutions; where it is false the answer is undecided, never a guess."""
        return self.complete and not self.undecided

    @property
    def headline(self) -> str:
        """The answer in one phrase; it says where only independent equations are proved."""
        count = f"{len(self.solutions)} solution{'' if len(self.solutions) == 1 else 's'}"
        left = max((item.left for item in self.solutions), default=0.0)
        if left:
            count += " of the independent equations"
        if self.proved:
            return f"proved, {count} and no other" if self.solutions else "proved, no solution"
        places = f"{len(self.undecided)} place{'' if len(self.undecided) == 1 else 's'}"
        where = f"undecided in {places}" if self.undecided else "whether there are others is not"
        but = f" (the dependent ones hold to {at_most(left)})" if left else ""
        return f"{count} proved{but}, {where}"


def undetermined(record: MechanismRecord, pose: Interval) -> tuple[str, ...]:
    """The coordinates of a proved pose (m,) that no bounds can tell: phi and psi at theta = 90 deg, signs at qw = 0.

    >>> from assur.model.registry import load_record
    >>> record = load_record("planar_3rpr")
    >>> undetermined(record, Interval.of([0.0, 0.0, -4.0], [0.0, 0.0, 4.0]))
    ('phi',)
    """
    names = record.platform.pose
    either_sign = QUATERNION[0] in names and bool(pose.low[names.index(QUATERNION[0])] <= 0.0)
    whole_turn = pose.width >= TURN.low
    return tuple(
        name
        for name, turn in zip(names, whole_turn, strict=True)
        if (is_angle(name) and turn) or (either_sign and name in QUATERNION[1:])
    )


def at_most(size: float) -> str:
    """An upper bound as text of two digits, at most a tenth above the size.

    >>> at_most(1.21e-13), at_most(0.0)
    ('1.3e-13', '0.0e+00')
    """
    return f"{1.05 * size:.1e}"


def answer(solutions: CertifiedSolutions) -> CertifiedDirect | CertifiedInverse:
    """A certificate at the border, angles in the mechanism's angle unit.

    Bounds in degrees are rounded outwards.

    >>> from assur.kinematics.certified.certify import certified_direct
    >>> from assur.model.registry import load_record
    >>> said = answer(certified_direct(load_record("zeng2019"), [162.6907, -143.3209, -24.6776]))
    >>> said.proved, len(said.solutions), said.solutions[0].mode
    (True, 4, '+++')
    """
    record = solutions.record
    shared: dict[str, Any] = {
        "mechanism": record.name,
        "unit": record.unit,
        "angle": record.angle,
        "coordinates": record.platform.pose,
        "input_names": border.drive_names(record),
        "proved": solutions.proved,
        "complete": solutions.complete,
        "complete_for": solutions.complete_for,
        "right": solutions.right,
        "limits_stated": limits_stated(record),
        "undecided": tuple(_doubt(record, item) for item in solutions.undecided),
        "excluded": solutions.excluded,
    }
    kept = zip(solutions.solutions, _limits(solutions), strict=True)
    if solutions.problem == "direct":
        poses = tuple(_proved_pose(record, item, limits) for item, limits in kept)
        return CertifiedDirect(**shared, inputs=inputs_at_border(record, solutions.given).tolist(), solutions=poses)
    inputs = tuple(_proved_inputs(record, item, limits) for item, limits in kept)
    return CertifiedInverse(**shared, pose=pose_at_border(record, solutions.given).tolist(), solutions=inputs)


def _limits(solutions: CertifiedSolutions) -> list[KeptLimits]:
    """Which limits of the file each solution exceeds, of the solution in floating point that lies at it.

    That is no proof; `within` is None where the file states no limits, and where no such solution was found.
    """
    record, direct = solutions.record, solutions.problem == "direct"
    none = KeptLimits(None, ())
    if not limits_stated(record) or not solutions.solutions:
        return [none] * len(solutions.solutions)
    floats = list((position.direct if direct else position.inverse)(record, solutions.given))
    rows = np.array([one.pose if direct else one.inputs for one in floats])
    names = record.platform.pose
    same = np.array([is_angle(name) for name in names]) if direct else periodic_drives(record)
    lengths = [name in LENGTHS for name in names] if direct else [k.coordinate.kind == "length" for k in record.drives]
    sizes = np.where(lengths, characteristic_length(record), 1.0)
    kept = []
    for item in solutions.solutions:
        change = rows - (item.pose if direct else item.inputs).middle
        change = np.where(same, rotations.nearest_turn(change), change)
        away = np.max(np.abs(change) / sizes, axis=-1) if len(rows) else np.array([np.inf])
        k = int(np.argmin(away))
        kept.append(limits_at_border(record, floats[k].within_limits, floats[k].excesses) if away[k] < THERE else none)
    return kept


def _proved_pose(record: MechanismRecord, solution: ProvedSolution, limits: KeptLimits) -> ProvedPose:
    bounds, free = _pose_bounds(record, solution.pose.low, solution.pose.high), undetermined(record, solution.pose)
    return ProvedPose(solution.mode, solution.how, solution.left, limits, bounds, free, solution.working_mode)


def _proved_inputs(record: MechanismRecord, solution: ProvedSolution, limits: KeptLimits) -> ProvedInputs:
    low, high = (inputs_at_border(record, end) for end in (solution.inputs.low, solution.inputs.high))
    angular = [one.coordinate.kind == "angle" for one in record.drives]
    bounds = _outward(record, low, high, angular)
    return ProvedInputs(solution.mode, solution.how, solution.left, limits, bounds, solution.assembly_mode)


def _doubt(record: MechanismRecord, doubt: Doubt) -> UndecidedPlace:
    bounds = Bounds(doubt.low.tolist(), doubt.high.tolist())
    if doubt.name == "pose":
        bounds = _pose_bounds(record, doubt.low, doubt.high)
    unit = power(record.unit, doubt.unit)
    return UndecidedPlace(bounds.low, bounds.high, doubt.name, unit, doubt.meaning, doubt.branches)


def _pose_bounds(record: MechanismRecord, low: FloatArray, high: FloatArray) -> Bounds:
    angular = [is_angle(name) for name in record.platform.pose]
    return _outward(record, pose_at_border(record, low), pose_at_border(record, high), angular)


def _outward(record: MechanismRecord, low: FloatArray, high: FloatArray, angular: list[bool]) -> Bounds:
    """Bounds at the border, wider where an angle was converted to degrees: by more than the rounding of that."""
    more = np.where(np.array(angular) & (record.angle == "deg"), 2.0**-51, 0.0)
    return Bounds((low - more * np.abs(low)).tolist(), (high + more * np.abs(high)).tolist())
