"""The answer of `assur stiffness`, in SI units: displacement before rotation, force before moment, the base's axes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import AnswerOfMechanism
from assur.results.answers.position import NegativeQuantity, Numbers

Row = tuple[float | None, ...]


@dataclass(frozen=True)
class ShownCompliance:
    """How the platform gives way at its point: 6 x 6 matrices, and translations where no moment is applied.

    `stiffness` is null where the compliance has not rank 6: rigid links leave ways in which nothing gives way.
    `translational_eigenvalues` ascend, null where nothing gives way; `directions` are theirs. All are null where the
    platform is not held, or the pose not reached.
    """

    compliance: tuple[Row, ...] | None
    stiffness: tuple[Row, ...] | None
    rank: int | None
    translational_eigenvalues: Row
    directions: tuple[Row, ...]


@dataclass(frozen=True)
class ShownShares:
    """Shares of the strain energy under unit forces along x, y and z, summed; each split sums to 1.

    Among `links` "actuators" stands for all of them with their gears, and "joints" for all that have a compliance;
    `actuators` and `joints` split these. `kinds` are bending, torsion, axial, shear, given (links with a compliance),
    joints, gears and actuators; the given ones, joints and gears where there are such.
    """

    links: Mapping[str, float]
    kinds: Mapping[str, float]
    actuators: Mapping[str, float]
    joints: Mapping[str, float]


@dataclass(frozen=True)
class ShownMovedLink:
    """Points of a link at rest in the base frame, and their displacements: sections of beams, a rigid link's joints."""

    points: tuple[Numbers, ...]
    displacements: tuple[Numbers, ...]


@dataclass(frozen=True)
class ShownModeShape:
    """A natural vibration at its largest: of all points that which moves most has gone one metre.

    `platform` is the displacement of the platform's point, then its rotation; `shares` of the strain energy by links,
    "actuators" and "joints" standing for all of them.
    """

    frequency: float
    platform: Numbers
    shares: Mapping[str, float]
    links: Mapping[str, ShownMovedLink]


@dataclass(frozen=True)
class StiffnessAnswer(AnswerOfMechanism):
    """Stiffness at a pose while the actuators hold their inputs.

    `actuator_only` is what remains if no link bent. `frequencies` are the slowest natural vibrations in Hz, empty
    where a link's mass is not known, `mode_shapes` how each moves; `units` are by field.
    """

    pose: Numbers
    mode: str
    status: str
    input_names: tuple[str, ...]
    shear: bool
    compliance: tuple[Row, ...] | None
    stiffness: tuple[Row, ...] | None
    rank: int | None
    translational_eigenvalues: Row
    directions: tuple[Row, ...]
    actuator_only: ShownCompliance
    shares: ShownShares | None
    frequencies: Numbers
    mode_shapes: tuple[ShownModeShape, ...]
    failures: tuple[NegativeQuantity, ...]
    notes: tuple[str, ...]
    units: Mapping[str, str]
