"""What a limb's tables in a file hold: dimensions, links, joints, parallelograms, a chain. Data alone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from assur.joints.joint_type import JointType
from assur.model.mechanism import GeneralisedJoint
from assur.synthesis.drafting.linear import Point
from assur.topology.directions import EXACT, Vector


@dataclass(frozen=True)
class Dimension:
    """A parameter of the file: its default value, what it means, what it may be, and its unit where it is no length.

    One with a `formula` of others has that value.
    """

    name: str
    value: float
    meaning: str
    sign: str = "any"
    unit: str = ""
    formula: str = ""


@dataclass(frozen=True)
class DraftLink:
    """A link and what it is."""

    name: str
    meaning: str


@dataclass(frozen=True)
class DraftJoint:
    """A joint; its axes as unit vectors, or one along the vector `leg` between two joints; `pitch` as a formula."""

    name: str
    type: JointType
    parent: str
    child: str
    at: Point
    child_at: Point
    axes: tuple[Vector, ...] = ()
    pitch: str = ""
    leg: Point | None = None


@dataclass(frozen=True)
class DraftChain:
    """A branch from base to platform: `serial`, or `loop`, `output` and `tail`."""

    serial: tuple[str, ...] = ()
    loop: tuple[str, ...] = ()
    output: str = ""
    tail: tuple[str, ...] = ()


@dataclass(frozen=True)
class Knee:
    """What names a branch: three points in turn and the axis about which they bend, or two and a direction."""

    points: tuple[str, ...]
    axis: tuple[float, float, float]


PLAIN = 15.0
"""Degrees whose multiples are numbers in a file, as their cosines are square roots; other angles are parameters."""


@dataclass(frozen=True)
class Template:
    """A limb as a template of a file.

    Attributes:
        name: of the template; the limbs are called by it and their number.
        angles: where the limbs stand around z, in degrees.
        members: places of the limbs among the chains.
        text: the limb at 0 degrees in notation.
        home: joint -> values in deg and mm, where they are not all zero.
        order: for each joint of the chain, branches flattened, the joint of the tables that stands for it.
    """

    name: str
    angles: tuple[float, ...]
    even: bool
    members: tuple[int, ...]
    text: str
    dimensions: tuple[Dimension, ...]
    links: tuple[DraftLink, ...]
    joints: tuple[DraftJoint, ...]
    groups: tuple[GeneralisedJoint, ...]
    chain: DraftChain | None
    order: tuple[str, ...]
    knee: Knee | None = None
    home: Mapping[str, tuple[float, ...]] = field(default_factory=dict)

    @property
    def turns(self) -> tuple[str, ...]:
        """For each limb the parameter that says where it stands around z; "" where a number does."""
        start = "gamma" if self.name == "leg" else f"gamma{self.name}"
        return tuple(
            "" if min(angle % PLAIN, -angle % PLAIN) < EXACT else f"{start}{number}"
            for number, angle in enumerate(self.angles, 1)
        )

    @property
    def turn_dimensions(self) -> tuple[Dimension, ...]:
        """These parameters."""
        return tuple(
            Dimension(turn, angle, f"limb {self.name}{number}: about Z, from limb {self.name}1", unit="deg")
            for number, (angle, turn) in enumerate(zip(self.angles, self.turns, strict=True), 1)
            if turn
        )
