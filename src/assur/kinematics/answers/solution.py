"""One solution, and one reason why there is none."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.at_border import angle_at_border
from assur.kinematics.answers.excess import Excess
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.model.pose import kind_of
from assur.results.answers.position import OpenLoop
from assur.results.notebook import Entries, Tabulated

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Failure:
    """Why there is no solution: the first quantity that fails, at the branch that comes nearest to existing.

    `value` is negative, in the length unit to the power `unit`; `branches` counts those that fail here.
    """

    quantity: str
    value: float
    unit: int
    meaning: str
    branches: int


@dataclass(frozen=True, eq=False)
class Solution(Tabulated):
    """One solution of the direct or the inverse problem; printed it is a table in the file's units.

    Attributes:
        record: the mechanism.
        pose, inputs: (m,) and (n,), lengths and rad; redundant inputs follow those that determine the mechanism.
        mode: the signs that name it among the solutions of its problem; `working_mode` and
            `assembly_mode` give both names of the configuration.
        joints: every joint coordinate's value, in rad or length, by name.
        residual: closure error of the full joint graph, in length units.
        factors: factors of det Jp and det Jq by name.
        quantities: what the source names on its way, angles in rad.
        within_limits: whether it keeps every stroke, joint limit and cone of the file; None where none is stated.
        excesses: the limits that it does not keep, and by how much.
        open_loop: of a solution that is `not_closed`, the loop that stays open most.

    >>> import assur
    >>> print(assur.load("fivebar").inverse([0.0, 200.0], "-+")[0])  # doctest: +ELLIPSIS
    solution -+ of fivebar: regular, gap ...
    what   name    value     unit
    pose   x       0         mm
    pose   y       200       mm
    input  theta1  136.67    deg
    ...
    """

    record: MechanismRecord = field(repr=False)
    pose: FloatArray
    inputs: FloatArray
    mode: str
    working_mode: str
    assembly_mode: str
    joints: Mapping[str, float]
    residual: float
    status: Status
    factors: Mapping[str, float]
    quantities: Mapping[str, float]
    within_limits: bool | None = None
    excesses: tuple[Excess, ...] = ()
    open_loop: OpenLoop | None = None

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the pose's coordinates."""
        return self.record.platform.pose

    @property
    def drives(self) -> tuple[str, ...]:
        """Names of the inputs."""
        return tuple(item.name for item in self.record.drives)

    def _title(self) -> str:
        return f"solution {self.mode} of {self.record.name}: {self.status.name}, gap {self.residual:.1e}"

    def _entries(self) -> Entries:
        record = self.record
        kinds = [kind_of(name) for name in self.coordinates]
        drives = [item.coordinate.kind for item in record.drives]
        joints = [item.kind for item in record.coordinates]
        blocks = [
            ("pose", self.coordinates, self.pose.tolist(), kinds),
            ("input", self.drives, self.inputs.tolist(), drives),
            ("joint", self.joints, self.joints.values(), joints),
        ]
        units = {"length": record.unit, "angle": record.angle}
        return [
            {
                "what": what,
                "name": name,
                "value": float(angle_at_border(record, value)) if kind == "angle" else value,
                "unit": units.get(kind, ""),
            }
            for what, *columns in blocks
            for name, value, kind in zip(*columns, strict=True)
        ]

    def _picture(self) -> Any:
        """The mechanism as it stands in this solution."""
        return import_module("assur.figures.solutions").pictured(self.record, (self,), numbered=False)
