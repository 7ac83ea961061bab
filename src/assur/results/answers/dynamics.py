"""The answers of `assur dynamics`, in SI units: rows by moments, columns by inputs or by coordinates of the pose."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import AnswerOfMechanism
from assur.results.answers.forces import Row
from assur.results.answers.position import Numbers

Rows = tuple[Numbers, ...]


@dataclass(frozen=True)
class StoppedMotion:
    """What a motion comes to, when, and at which pose; `quantity` goes to zero there, `margin` is what it is."""

    kind: str
    time: float
    pose: Numbers
    quantity: str
    margin: float | None
    text: str


@dataclass(frozen=True)
class UsedShares:
    """Shares of each actuator's largest force, speed, and of their product as its power; null without a limit."""

    force: Row
    speed: Row
    power: Row


@dataclass(frozen=True)
class DynamicsAnswer(AnswerOfMechanism):
    """A motion in time and the actuators' forces: those that it asks for, or, `forward`, the motion by given ones.

    Friction stands apart: `friction` is what is to be added. A prescribed motion that leaves the workspace or its mode
    is refused: all rows are empty, and `stopped` says when and why; a motion by forces has rows up to there. `loop_gap`
    in characteristic lengths, `energy_drift` as a share of the largest kinetic energy, and `deviation` from the
    prescribed motion are of `forward`, else null.
    """

    mode: str
    status: str
    forward: bool
    input_names: tuple[str, ...]
    load: Numbers
    under_gravity: bool
    t: Numbers
    pose: Rows
    velocity: Rows
    acceleration: Rows
    inputs: Rows
    input_rates: Rows
    actuator_forces: Rows
    friction: Rows
    power: Rows
    kinetic_energy: Numbers
    potential_energy: Numbers
    peak: Row
    rms: Row
    utilisation: UsedShares
    utilisation_with_friction: UsedShares | None
    loop_gap: float | None
    energy_drift: float | None
    deviation: float | None
    stopped: StoppedMotion | None
    notes: tuple[str, ...]
    files: tuple[str, ...]
    units: Mapping[str, str]


@dataclass(frozen=True)
class LinearMotionAnswer(AnswerOfMechanism):
    """Small motions about a pose with the actuators' forces held: M a + C v + K x = 0 per rate of the pose.

    `frequencies` are of those that swing, in Hz, ascending, C left aside; `stable` whether none grows. `poles` are
    pairs of real and imaginary part in 1/s. All are null where there is no such equation.
    """

    pose: Numbers
    mode: str
    status: str
    input_names: tuple[str, ...]
    load: Numbers
    under_gravity: bool
    actuator_forces: Row
    mass_matrix: tuple[Row, ...]
    damping_matrix: tuple[Row, ...]
    stiffness_matrix: tuple[Row, ...]
    poles: tuple[Row, ...]
    frequencies: Numbers
    stable: bool | None
    notes: tuple[str, ...]
    units: Mapping[str, str]
