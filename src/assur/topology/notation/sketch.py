"""A chain between its text and its axes: every axis a slot, and conditions between slots.

What the signs say about two axes is a condition; what shares a point is a meeting. `placing` finds the
directions, `building` makes the chain.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from assur.topology.chains import BASE, PLATFORM
from assur.topology.notation.errors import Source
from assur.topology.notation.syntax import WrittenDirection, WrittenJoint

ConditionKind = Literal["parallel", "perpendicular", "different"]


@dataclass
class Slot:
    """An axis.

    Attributes:
        tied: a condition says something about it, so that its direction is not general.
        auxiliary: no axis of the chain, such as the normal of a diamond: placed after the axes.
    """

    placed: WrittenDirection | None = None
    tied: bool = False
    auxiliary: bool = False


@dataclass(frozen=True)
class Condition:
    """What holds between two slots, where and why it is said; "different" means not parallel."""

    kind: ConditionKind
    slots: tuple[int, int]
    at: int
    why: str


@dataclass(frozen=True)
class JointSketch:
    """A joint whose axes are slots."""

    joint: WrittenJoint
    slots: tuple[int, ...]


@dataclass(frozen=True)
class LoopSketch:
    """An inner loop; `name` is that of the rotation which a tagged loop stands for."""

    branches: tuple[tuple[ElementSketch, ...], ...]
    name: str = ""


ElementSketch = JointSketch | LoopSketch


@dataclass
class Sketch:
    """A chain whose axes are not placed yet.

    Attributes:
        names: names that are written, and where.
        meetings: two joints (by their places in the text) that share a point, and where that is said.
        first: slots of which one must be placed where the literature's form stands beside other limbs.
    """

    source: Source
    literature: bool
    elements: tuple[ElementSketch, ...] = ()
    slots: list[Slot] = field(default_factory=list)
    conditions: list[Condition] = field(default_factory=list)
    meetings: list[tuple[int, int, int]] = field(default_factory=list)
    labels: dict[int, str] = field(default_factory=dict)
    written_labels: set[str] = field(default_factory=set)
    names: dict[str, int] = field(default_factory=dict)
    first: list[int] = field(default_factory=list)
    ends: tuple[str, str] = (BASE, PLATFORM)

    def slot(self, placed: WrittenDirection | None = None, *, auxiliary: bool = False) -> int:
        """A new slot."""
        self.slots.append(Slot(placed, auxiliary=auxiliary))
        return len(self.slots) - 1

    def require(self, kind: ConditionKind, slots: tuple[int, int], at: int, why: str, *, ties: bool = True) -> None:
        """A condition between two slots, which are then no longer general."""
        self.conditions.append(Condition(kind, slots, at, why))
        for slot in slots:
            self.slots[slot].tied |= ties
