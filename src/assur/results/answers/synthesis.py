"""The answers of `assur synthesize`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import ABSENT, Absent, Answer, named
from assur.results.answers.solution_order import Names
from assur.results.answers.topology import RedundantConstraints, WrittenPoc


@dataclass(frozen=True)
class AskedSynthesis:
    """What was asked of a synthesis; `coupling` is null where any degree would do, `rows` are virtual chains.

    `joint_kinds` is empty where limbs may be made of all, `novelty` where known and new mechanisms are listed.
    """

    motion: str
    rows: Names
    limbs: int
    max_joints: int
    coupling: tuple[int, int] | None
    symmetric: bool
    actuators: str
    max_members: int
    parasitic: bool
    idle: bool
    passive_slides: bool
    joint_kinds: Names
    novelty: str
    redundant: int


@dataclass(frozen=True)
class LimbTypeCounts:
    """Limb types with the motion, by the numbers of their POC sets, and why others were left out."""

    with_motion: int
    by_poc: Mapping[str, int]
    left_out: Mapping[str, int]


@dataclass(frozen=True)
class CombinationCounts:
    """How large the search was."""

    all: int
    with_motion: int
    by_coupling_degree: Mapping[str, int]
    tried_one_by_one: int
    not_fixed_by_actuators: int
    listed_of_each_class_of_different_limbs: int


@dataclass(frozen=True)
class DesignLimb:
    """A limb of a mechanism that was found."""

    text: str
    symbolic: str
    poc: WrittenPoc
    freedoms: int
    route: str


@dataclass(frozen=True)
class DesignAnswer:
    """A mechanism with the motion, the rank of its family, and which of the motions with that name it has.

    `decoupling[i][j]` says whether output i of `outputs` depends on input j of `actuate`, and `zeros` how often not;
    none of them is told of redundant drives. Of these `admissible` are the sets that determine it, each with its
    `coupling_degrees`, of which the least is its `coupling_degree`.
    """

    rank: int
    family: int
    names: Names
    row: str
    chains: Names
    actuate: Names
    mode: str
    limbs: tuple[DesignLimb, ...]
    symmetric: bool
    poc: WrittenPoc
    dof: int
    xi: tuple[int, ...]
    delta: tuple[int, ...]
    coupling_degree: int
    redundant_constraints: RedundantConstraints
    joints: int
    joint_kinds: Names
    passive_slides: int
    drives_on_base: int
    outputs: Names
    decoupling: tuple[tuple[bool, ...], ...]
    zeros: int | None
    admissible: tuple[Names, ...]
    coupling_degrees: tuple[int, ...]
    route: str
    reason: str


@dataclass(frozen=True)
class DesignDraft:
    """A mechanism of a synthesis with dimensions.

    Attributes:
        rank: of the mechanism.
        file: its mechanism file; null where no default dimensions have its topology.
        refusal: why there is none, empty where there is one.
        direct: what solves its direct problem; empty without a file.
        inverse: the same of its inverse problem.
    """

    rank: int
    file: str | None
    refusal: str = ""
    direct: str = ""
    inverse: str = ""


@dataclass(frozen=True)
class DesignFamily:
    """Mechanisms whose limbs have the same motions, and inner loops that count alike.

    Attributes:
        members: so many of them have the motion; the drives are tried where they are listed.
        listed: ranks of those that are listed, the best first.
        names: known mechanisms among these.
    """

    rank: int
    members: int
    listed: tuple[int, ...]
    coupling_degree: int
    redundant_constraints: int
    names: Names


@dataclass(frozen=True)
class DesignFront:
    """Mechanisms of the same worth that no other beats: none is better in κ, redundant constraints, joints or zeros of
    the decoupling, and as good in the rest.

    Attributes:
        ranks: of all of them, the best first.
        family: that of the best.
    """

    ranks: tuple[int, ...]
    family: int
    coupling_degree: int
    redundant_constraints: int
    joints: int
    zeros: int | None
    names: Names
    reason: str


@dataclass(frozen=True)
class ExplanationAnswer(Answer):
    """Why a synthesis does not list a mechanism, or where it does.

    Attributes:
        chains: its limbs.
        dropped_by: the first filter that drops it, "limbs", "drives", "words", "limb", "motion", "arrangement",
            "actuation", "coupling", "symmetry" or "novelty"; null where it is listed.
        rank: among the mechanisms, and `family` that of its family; null where it is not listed, and where only
            the sets of limbs that may have it were looked at, as all would take long.
        listed_as: its limbs as they stand in the list; none where it is not listed.
    """

    asked: AskedSynthesis
    chains: Names
    dropped_by: str | None
    reason: str
    rank: int | None
    family: int | None
    listed_as: Names
    names: Names


@dataclass(frozen=True)
class SynthesisAnswer(Answer):
    """The mechanisms with a motion, the best first, and their families; `written` are their topology files.

    `front` are those that no other beats.
    """

    asked: AskedSynthesis
    positions: str
    limb_types: LimbTypeCounts
    combinations: CombinationCounts
    count: int = named("found")
    mechanisms: tuple[DesignAnswer, ...] = ()
    families: tuple[DesignFamily, ...] = ()
    front: tuple[DesignFront, ...] = ()
    written: Names | Absent = ABSENT
    drafts: tuple[DesignDraft, ...] | Absent = ABSENT
