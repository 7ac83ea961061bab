"""The answer of `assur forces`, in SI units: forces before moments, along x, y, z of the base."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import AnswerOfMechanism
from assur.results.answers.position import NegativeQuantity, Numbers

Row = tuple[float | None, ...]


@dataclass(frozen=True)
class ShownReaction:
    """What a joint's parent passes to its child, at the child's joint point; `indeterminate` are orthonormal wrenches.

    `elastic` is what a structure of elastic bars passes, null where that was not asked.
    """

    joint: str
    force: Numbers
    moment: Numbers
    unique: tuple[bool, ...]
    indeterminate: tuple[Numbers, ...]
    elastic: Numbers | None


@dataclass(frozen=True)
class ShownWeakness:
    """The motion of the platform that its actuators hold least.

    `twist` is the velocity of the platform's point, then the angular velocity times the characteristic length, of unit
    size; `moved` how fast the actuators move then (0: not at all); `actuators` in which ratio they bear a load against
    it; `joint` moves most.
    """

    twist: Numbers
    moved: float
    actuators: Numbers
    joint: str


@dataclass(frozen=True)
class ForcesAnswer(AnswerOfMechanism):
    """Forces of the actuators at a pose, energies, the terms of the equation of motion, reactions in the joints.

    Numbers that do not exist are null: those of masses where the file has none, all forces where the mechanism is
    singular. `growth` is the largest force of an actuator per unit force at the platform, `weakest` where they hold
    least; `units` are by field.
    """

    pose: Numbers
    mode: str
    status: str
    input_names: tuple[str, ...]
    load: Numbers
    under_gravity: bool
    velocity: Numbers
    acceleration: Numbers
    actuator_forces: Row
    least_norm: bool
    preload: tuple[Numbers, ...]
    friction: Row
    friction_band: Numbers
    input_rates: Row
    kinetic_energy: float | None
    potential_energy: float | None
    power: float | None
    mass_matrix: tuple[Row, ...]
    bias: Row
    gravity: Row
    growth: float | None
    weakest: ShownWeakness | None
    reactions: tuple[ShownReaction, ...]
    unknowns: int | None
    equations: int | None
    rank: int | None
    redundancy: int | None
    failures: tuple[NegativeQuantity, ...]
    notes: tuple[str, ...]
    units: Mapping[str, str]


@dataclass(frozen=True)
class CapacityAnswer(AnswerOfMechanism):
    """Forces on the platform that the actuators hold at rest within their limits, gravity included, in N.

    `per_axis` are the largest forces against and along each axis, null where no actuator feels them; `limiting` is the
    input whose limit `largest_sphere` is; `polytope_vertices` are empty where the polytope is not bounded.
    """

    pose: Numbers
    mode: str
    status: str
    input_names: tuple[str, ...]
    limits: Numbers
    utilisation: Row
    per_axis: Mapping[str, Row]
    largest_sphere: float | None
    limiting: str
    polytope_vertices: tuple[Numbers, ...]
    notes: tuple[str, ...]
    units: Mapping[str, str]


@dataclass(frozen=True)
class MotionFormulasAnswer(AnswerOfMechanism):
    """The equation of motion written as LaTeX; `difference` is the largest by which its numbers are off, as a share."""

    mode: str
    operations: int
    difference: float
    written: str
