"""One solution, and one reason why there is none."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.excess import Excess
from assur.kinematics.status import Status
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
    """One solution of the direct or the inverse problem.

    Attributes:
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
        coordinates, drives: names of the pose and of the inputs.

    >>> import assur
    >>> print(assur.load("fivebar").inverse([0.0, 200.0], "-+")[0])  # doctest: +ELLIPSIS
    solution -+: regular, gap ...; lengths and rad
    what   name    value
    pose   x       0
    pose   y       200
    input  theta1  2.38535
    ...
    """

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
    coordinates: tuple[str, ...] = ()
    drives: tuple[str, ...] = ()

    def _title(self) -> str:
        return f"solution {self.mode}: {self.status.name}, gap {self.residual:.1e}; lengths and rad"

    def _entries(self) -> Entries:
        blocks = {
            "pose": zip(self.coordinates, self.pose.tolist(), strict=True),
            "input": zip(self.drives, self.inputs.tolist(), strict=True),
            "joint": self.joints.items(),
        }
        return [{"what": what, "name": name, "value": value} for what, own in blocks.items() for name, value in own]
