"""The answers about regions of poses: `assur workspace`, its proofs, `assur aspects` and `assur collisions`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

from assur.results.answers.answer import ABSENT, Absent, Answer, spread
from assur.results.answers.position import Numbers

Pair = Numbers
"""(low, high)."""


@dataclass(frozen=True)
class SingularSurface:
    """Where a parallel factor vanishes inside; without an area where that is everywhere."""

    meaning: str
    area: float | None
    area_error: float | None
    faces: int
    everywhere: bool


@dataclass(frozen=True)
class ParallelSingular:
    """The surfaces of each parallel factor, and the share of the volume within `near` of one, null if not known."""

    factors: Mapping[str, SingularSurface]
    near: float
    share: float | None


@dataclass(frozen=True)
class SectionArea:
    """A cut across the last coordinate, whose name and value stand beside its area."""

    area: float
    area_error: float
    at: Mapping[str, float] = spread()


@dataclass(frozen=True)
class LargestCoordinate:
    """The largest value in size of a coordinate that the pose leaves out, and the pose there."""

    value: float
    at: Mapping[str, float]


@dataclass(frozen=True)
class WorkspaceAnswer(Answer):
    """The workspace of one working mode, estimated.

    `nowhere` are the parallel factors that are proved to vanish nowhere inside, `empty` is how it is known that nothing
    is reached, null where something is.
    """

    mechanism: str
    volume: float
    volume_error: float
    unit: str
    mode: str
    how: str
    coordinates: tuple[str, ...]
    box: tuple[Pair, ...]
    held: Mapping[str, float]
    parallel_singular: ParallelSingular
    sections: tuple[SectionArea, ...]
    resolution: int
    strokes: Mapping[str, Pair]
    limits_stated: bool
    joint_limits: tuple[str, ...]
    parasitic: Mapping[str, LargestCoordinate]
    nowhere: tuple[str, ...]
    empty: Literal["proved", "sampled"] | None


@dataclass(frozen=True)
class RegionProof(Answer):
    """What is said of every proof about a region."""

    mechanism: str
    mode: str
    held: Mapping[str, float]
    stopped: str
    limits_stated: bool
    joint_limits: tuple[str, ...]


@dataclass(frozen=True)
class SectionBounds:
    """Proved bounds of the area of a cut across the last coordinate."""

    area: Pair
    unit: str
    stopped: str
    at: Mapping[str, float] = spread()


@dataclass(frozen=True)
class PavedBoxes:
    """How many boxes are inside, outside and about the boundary."""

    coordinates: tuple[str, ...]
    inside: int
    outside: int
    boundary: int


@dataclass(frozen=True)
class CertifiedVolume(RegionProof):
    """Proved bounds of a workspace's volume, and of its sections."""

    volume: Pair
    unit: str
    how: str
    gap: float | None
    gap_reached: float | None
    coordinates: tuple[str, ...]
    box: tuple[Pair, ...]
    sections: tuple[SectionBounds, ...]
    boxes: PavedBoxes
    note: str


@dataclass(frozen=True)
class FailingPose:
    """A pose that fails, and why."""

    pose: Mapping[str, float]
    why: str


@dataclass(frozen=True)
class ProvedParts:
    """How many boxes are proved, failed and undecided, and the largest of the last two kinds."""

    coordinates: tuple[str, ...]
    proved: int
    failed: int
    doubtful: int
    largest_failed: tuple[tuple[Pair, ...], ...]
    largest_doubtful: tuple[tuple[Pair, ...], ...]


@dataclass(frozen=True)
class CertifiedBox(RegionProof):
    """Whether a box of poses is reached all over, and free of singularities."""

    what: tuple[str, ...]
    status: str
    coordinates: tuple[str, ...]
    box: tuple[Pair, ...]
    share_proved: float
    witness: FailingPose | None
    boxes: ProvedParts


@dataclass(frozen=True)
class CertifiedShape(RegionProof):
    """The largest cube, cylinder or ball about a point of which that is proved."""

    what: tuple[str, ...]
    shape: str
    centre: Mapping[str, float]
    size: float
    height: float | None
    refuted: float | None
    witness: FailingPose | None


@dataclass(frozen=True)
class ListedAspect:
    """A part of the workspace without singularities: its signs, proved bounds of its volume."""

    label: str
    signs: Mapping[str, int]
    volume: Pair
    boxes: int
    perhaps: tuple[str, ...]


@dataclass(frozen=True)
class PathCheck:
    """What a check of a path found.

    Attributes:
        covered: every piece lies in its box, compared exactly.
        samples: poses at which the closed form was asked.
        reached: it reaches all of them, within the strokes that were given.
        kept: every factor has one sign at all of them.
        followed: the joint graph can be moved along the path; None where that was not tried.
        stopped: what stopped it; "" where nothing did.
    """

    derived: ClassVar = ("passed",)

    covered: bool
    samples: int
    reached: bool
    kept: bool
    followed: bool | None
    stopped: str

    @property
    def passed(self) -> bool:
        """Whether nothing speaks against the path."""
        return self.covered and self.reached and self.kept and self.followed is not False


@dataclass(frozen=True)
class ListedPath:
    """Whether two poses lie in one aspect, and a path between them."""

    status: str
    why: str
    aspects: tuple[str, str]
    coordinates: tuple[str, ...]
    points: tuple[Numbers, ...]
    paved: tuple[str, ...]
    boxes: tuple[tuple[Pair, ...], ...]
    check: PathCheck | None


@dataclass(frozen=True)
class PlacedPose:
    """In which aspect a pose lies."""

    status: str
    aspect: str
    signs: Mapping[str, int]
    why: str


@dataclass(frozen=True)
class AspectsOfMode:
    """The aspects of one working mode."""

    mechanism: str
    mode: str
    how: str
    coordinates: tuple[str, ...]
    box: tuple[Pair, ...]
    held: Mapping[str, float]
    unit: str
    naming: tuple[str, ...]
    aspects: tuple[ListedAspect, ...]
    told_apart: bool
    paved: tuple[str, ...]
    turning: tuple[str, ...]
    finest: Mapping[str, float]
    undecided: int
    stopped: str
    note: str


@dataclass(frozen=True)
class AspectsAnswer(AspectsOfMode, Answer):
    """The aspects of one working mode; where a pose lies, or a path from one to another."""

    path: ListedPath | Absent = ABSENT
    place: PlacedPose | Absent = ABSENT


@dataclass(frozen=True)
class AspectsOfModes(Answer):
    """The aspects of every working mode."""

    mechanism: str
    modes: tuple[AspectsOfMode, ...]


@dataclass(frozen=True)
class NearestLinks:
    """How near two links come to one another, where, and at how many poses they meet."""

    links: tuple[str, str]
    clearance: float
    parts: tuple[str, str]
    meeting: int
    because: str | None
    pose: Numbers


@dataclass(frozen=True)
class CollisionsAnswer(Answer):
    """Which links come how near to one another, known at sampled poses alone; `file` is the picture that was drawn."""

    mechanism: str
    unit: str
    over: str
    drawn_from: str
    mode: str | None
    poses: int
    known: Literal["sampled"]
    thickness: float
    coordinates: tuple[str, ...]
    pairs: tuple[NearestLinks, ...]
    file: str | Absent = ABSENT
