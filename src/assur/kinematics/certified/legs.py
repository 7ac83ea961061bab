"""The direct problem as equations of the pose: the inputs that the inverse kernel gives are those that are given.

In each working mode the kernel says which inputs hold the platform at a pose; its radicands must not be negative. Its
algebra is the legs' own, so what is proved with it owes nothing to the closed form of the direct problem.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.certified.given import joint_inputs, parameters, pose_numbers
from assur.kinematics.modes import sign_names, sign_rows
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.numerics.krawczyk import Equations

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Legs:
    """Conditions for poses at printed inputs (n,); a label is a row of `modes`, the working modes.

    They are what `assur.numerics.branch_and_prune` asks for: as many equations as coordinates of the pose, and the
    margins of the kernel, which must not be negative.
    """

    record: MechanismRecord
    inputs: FloatArray

    @cached_property
    def modes(self) -> FloatArray:
        """Signs (2^s, s) of every working mode."""
        return sign_rows(self.record, "inverse")

    @cached_property
    def _given(self) -> tuple[Any, ...]:
        return joint_inputs(self.record, self.inputs)

    @cached_property
    def _parameters(self) -> SimpleNamespace:
        return parameters(self.record)

    def __call__(self, ns: Any, numbers: tuple[Any, ...], labels: IntArray) -> tuple[Sequence[Any], Sequence[Any]]:
        """Equations and inequalities at poses of any number type, (N,) per coordinate, angles in rad."""
        names = sign_names(self.record, "inverse")
        sign = SimpleNamespace(**{name: self.modes[labels, k] for k, name in enumerate(names)})
        pose = pose_numbers(self.record, numbers)
        return conditions_of(self.record, ns, self._parameters, pose, sign, self._given)

    def equations(self, labels: IntArray) -> Equations:
        """The equations alone, of poses whose labels (N,) are known."""
        return lambda ns, numbers: self(ns, numbers, labels)[0]


def conditions_of(
    record: MechanismRecord, ns: Any, p: Any, pose: tuple[Any, ...], sign: Any, given: Sequence[Any]
) -> tuple[list[Any], list[Any]]:
    """What is zero and what is not negative at a kernel's pose with given inputs, numbers of any type."""
    form = closed_form_of(record)
    branch = form.inverse(ns, p, pose, sign)
    zero: list[Any] = []
    positive = [branch.margins[margin.name] for margin in form.inverse_margins if margin.zero == "merge"]
    for value, asked in zip(branch.inputs, given, strict=True):
        if isinstance(asked, tuple):  # an angle: the sine of the difference is zero, its cosine is positive
            zero.append(value[1] * asked[0] - value[0] * asked[1])
            positive.append(value[0] * asked[0] + value[1] * asked[1])
        else:
            zero.append(value - asked)
    return zero, positive
