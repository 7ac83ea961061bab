"""The answer of `assur topology`.

The keys are a contract: `poc`, `limbs`, `dof`, `loops`, `assur_chains`, `coupling_degree`, `redundant_constraints`,
`decoupling` and `routes_agree` keep their meaning; others may be added.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from assur.results.answers.answer import ABSENT, Absent, Answer
from assur.results.answers.solution_order import AssurChain, Loop, Names, PlanAnswer


@dataclass(frozen=True)
class PocNumbers:
    """A POC set: elements t and r, how many are independent and how many dependent."""

    t: int
    r: int
    dim: int
    dependent: int


@dataclass(frozen=True)
class WrittenPoc(PocNumbers):
    """A POC set as it is written."""

    text: str


@dataclass(frozen=True)
class PocDirection:
    """What is said of the directions of "t" or "r"."""

    part: str
    mark: str
    axes: tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class PlatformPoc(WrittenPoc):
    """The platform's POC set, by which route it is known, and why the rules gave no answer where they gave none."""

    directions: tuple[PocDirection, ...]
    route: str
    refusal: str


@dataclass(frozen=True)
class LimbAnswer(PocNumbers):
    """A limb: its text in the plain form and in the literature's, and its POC set."""

    text: str
    symbolic: str
    freedoms: int
    poc_text: str
    directions: tuple[PocDirection, ...]
    route: str
    refusal: str


@dataclass(frozen=True)
class PreloadSpace:
    """Input forces that hold each other with the platform free: dimension of the space, inputs that act in it."""

    dimension: int
    inputs: Names


@dataclass(frozen=True)
class ActuationAnswer:
    """Whether the inputs determine the mechanism, and which joints may be actuated instead.

    `redundancy`: inputs less their rank; `admissible`: the sets of inputs that determine the mechanism, each with its
    `coupling_degrees`; `preload`: how many ways they can be preloaded against each other, and which of them act in it.
    `drivable`, `indispensable`: joints in some admissible set of all joints, in every; and these `sets` themselves.
    """

    verdict: str
    needed: int
    hint: str
    redundancy: int
    admissible: tuple[Names, ...]
    coupling_degrees: tuple[int | None, ...]
    preload: PreloadSpace
    drivable: Names
    indispensable: Names
    sets: tuple[Names, ...]
    complete: bool


@dataclass(frozen=True)
class OperationModeFacts:
    """A motion that starts at home: F, the platform's POC set, and whether its freedoms are real or it is shaky.

    `poc` is the set as text, with the directions that a real motion keeps.
    """

    dof: int
    t: int
    r: int
    dim: int
    real: bool
    poc: str

    def __str__(self) -> str:
        shaky = "" if self.real else " (shaky: singular all along, with instantaneous freedoms that lead nowhere)"
        return f"F = {self.dof}, {self.poc} with dim {self.dim}{shaky}"


@dataclass(frozen=True)
class ModeMeeting:
    """Where a mode meets another one, by its name: at home, or at an assembly on a random path, as in `MetMode`."""

    mode: str
    at_home: bool
    example: Mapping[str, tuple[float, ...]]


@dataclass(frozen=True)
class MetMode:
    """A kind of operation mode that was met among a mechanism's assemblies.

    `name` counts the independent elements of its POC set, as 3T, 2T1R; kinds of one name have a letter after it.
    `coupling_degree` is null where the drives do not fix it. `crossed` are parallelograms that have crossed over.
    `example` is an assembly: for each joint how far each of its freedoms is from home, in rad and lengths. `meets` are
    other modes that were entered from this one.
    """

    name: str
    poc: WrittenPoc
    dof: int
    coupling_degree: int | None
    at_home: bool
    crossed: Names
    example: Mapping[str, tuple[float, ...]]
    meets: tuple[ModeMeeting, ...] = ()

    def __str__(self) -> str:
        return f"{self.name}: F = {self.dof}, {self.poc.text} with dim {self.poc.dim}"


@dataclass(frozen=True)
class RedundantConstraints:
    """6 v - rank of the closure: with parallelograms as generalised joints, and with all joints."""

    collapsed: int
    joint_graph: int


@dataclass(frozen=True)
class Replacement:
    """A joint in the place of another.

    Attributes:
        joint: its name.
        old, new: letters, R or P before and C, U or S after.
        removed: redundant constraints that it removes.
        internal: internal freedoms that it adds.
    """

    joint: str
    old: str
    new: str
    removed: int
    internal: int

    def __str__(self) -> str:
        spin = f", {self.internal} internal freedom{'s' if self.internal > 1 else ''} more" if self.internal else ""
        return f"{self.joint}: {self.old} to {self.new} removes {self.removed}{spin}"


@dataclass(frozen=True)
class Relaxation:
    """Replacements that keep the platform's motion and the inputs.

    Attributes:
        redundant: redundant constraints before any replacement.
        single: every replacement that removes some, by itself.
        together: replacements one after the other, each that removes most; `removed` is what it removes in its turn.
    """

    derived: ClassVar = ("left",)

    redundant: int
    single: tuple[Replacement, ...]
    together: tuple[Replacement, ...]

    @property
    def left(self) -> int:
        """Redundant constraints that remain after all of `together`."""
        return self.redundant - sum(replacement.removed for replacement in self.together)


@dataclass(frozen=True)
class Improvement:
    """A mechanism with one thing changed that moves the same way, and what of it is `better`.

    `zeros` counts pairs of an output and an input that have nothing to do with each other.
    """

    change: str
    chains: Names
    actuate: Names
    coupling_degree: int | None
    redundant_constraints: RedundantConstraints
    zeros: int
    better: Names


@dataclass(frozen=True)
class RulesRefusal:
    """Of what the rules gave no answer, and why."""

    of: str
    reason: str


@dataclass(frozen=True)
class TopologyAnswer(Answer):
    """The facts of a topology; what does not exist is null.

    `motion_type` counts independent elements, translations and rotations, `parasitic` those of the others that no point
    of the platform is without; `freedom_type` is full, partial or separable. `alike` are limbs with the same joints,
    drives and relations, `conditions` the geometric ones that F and the POC set need.
    `decoupling[i][j]` says whether output i of `outputs` depends on input j of `inputs`. `graph` and `sketch` are
    the drawings that were written, `latex` a fragment for a paper; `modes` and `improvements` are there where they
    are asked for.
    """

    name: str
    title: str
    source: str
    mode: str
    poc: PlatformPoc
    limbs: tuple[LimbAnswer, ...]
    motion_type: str
    parasitic: int | None
    freedom_type: str | None
    dof: int
    internal_freedoms: int
    internal_joints: tuple[Names, ...]
    passive_joints: Names
    idle_joints: Names
    alike: tuple[tuple[int, ...], ...]
    conditions: Names | None
    loops: tuple[Loop, ...]
    assur_chains: tuple[AssurChain, ...]
    coupling_degree: int | None
    coupling_refusal: str
    redundant_constraints: RedundantConstraints
    redundant_by_loop: Mapping[str, int]
    inputs: Names
    inputs_by: str
    outputs: Names
    decoupling: tuple[tuple[bool, ...], ...] | None
    decoupling_refusal: str
    actuation: ActuationAnswer
    relaxation: Relaxation
    plan: PlanAnswer
    routes_agree: bool | None
    refusals: tuple[RulesRefusal, ...]
    derivation: Names
    operation_modes: tuple[OperationModeFacts, ...]
    notes: Names
    modes: tuple[MetMode, ...] | Absent = ABSENT
    improvements: tuple[Improvement, ...] | Absent = ABSENT
    graph: str | Absent = ABSENT
    sketch: str | Absent = ABSENT
    latex: str | Absent = ABSENT
