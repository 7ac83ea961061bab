"""What a closed form claims and the joint graph denies: which part of it, where, and by how much."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.at_border import quantity_text
from assur.kinematics.modes import Problem
from assur.model.mechanism import MechanismRecord
from assur.model.pose import kind_of

FloatArray = NDArray[np.float64]
Part = Literal[
    "branch",
    "margin",
    "joint",
    "factor",
    "status",
    "mode sign",
    "Jp and Jq",
    "Jp",
    "Jq",
    "radicand",
    "divisor",
    "self-motion",
    "relation",
]


@dataclass(frozen=True)
class Mismatch:
    """One claim that does not hold.

    Attributes:
        part, name: of the closed form, as "margin" and "M3"; a branch has the name of its mode.
        problem: the problem whose kernel is meant.
        found: what is wrong, where and by how much.
        allowed: what the claim is.
        hint: what to look at.
        line: of the file, where it is known; else it is looked up by the name.
    """

    part: Part
    name: str
    problem: Problem
    observed: str
    allowed: str
    hint: str = ""
    line: int | None = None

    def __str__(self) -> str:
        return f"{self.title}: {self.observed}; {self.allowed}"

    @property
    def title(self) -> str:
        """What is at fault, as a message begins."""
        return f"{self.part} {self.name}" if self.name else self.part


def place_text(record: MechanismRecord, problem: Problem, given: FloatArray) -> str:
    """Where a problem (k,) is posed, in the file's units.

    >>> from assur.model.registry import load_record
    >>> place_text(load_record("fivebar"), "direct", np.array([np.pi / 2, 1.0]))
    'theta1 = 90 deg, theta2 = 57.2958 deg'
    """
    names: Sequence[tuple[str, str]]
    if problem == "direct":
        names = [(item.name, item.coordinate.kind) for item in record.inputs]
    else:
        names = [(name, kind_of(name)) for name in record.platform.pose]
    told = [
        f"{name} = {quantity_text(record, float(value), kind)}"
        for (name, kind), value in zip(names, given, strict=True)
    ]
    changed = [f"{name} = {value:.6g}" for name, value in record.overrides.items()]
    return ", ".join(told) + (f" (with {', '.join(changed)})" if changed else "")
