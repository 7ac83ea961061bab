"""The topology of a mechanism: every fact that the theory gives, and by which route it is known."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING, Literal

from assur.results.plain_text import signed
from assur.topology.counting.solution_plan import SolutionPlan
from assur.topology.poc import PocSet, motion_name

if TYPE_CHECKING:
    from assur.results.answers.solution_order import AssurChain, Loop
    from assur.results.answers.topology import OperationModeFacts, RedundantConstraints, Relaxation
    from assur.topology.counting.actuation import Actuation
    from assur.topology.counting.decoupling import Decoupling
    from assur.topology.counting.freedom_type import FreedomType
    from assur.topology.counting.redundant_drives import DeterminingDrives
    from assur.topology.screws.linkage import Linkage
    from assur.topology.symbolic.derivation import PocDerivation

Route = Literal["both", "twists"]
"""By which routes a POC set is known: rules and twists, which agree, or twists alone where the rules refuse."""

InputsBy = Literal["given", "first joints", "admissible set"]
"""Who chose the inputs: the user or the file; else the first joint of each branch, or where these do not determine the
mechanism an admissible set near the base, one joint for each limb where that is possible."""


@dataclass(frozen=True)
class Known:
    """A POC set and how it is known. `refusal` says why the rules gave no answer, where they gave none."""

    poc: PocSet
    route: Route
    refusal: str = ""


@dataclass(frozen=True)
class LimbFacts:
    """A limb: its text in the plain form and in the literature's, its freedoms, its POC set in its mechanism."""

    text: str
    symbolic: str
    freedoms: int
    known: Known

    @property
    def poc(self) -> PocSet:
        """The POC set of the limb's end link, O' on its last R axis or joint centre."""
        return self.known.poc


@dataclass(frozen=True, eq=False)
class Topology:
    """The facts. See `assur.topology` for how to ask for them.

    Attributes:
        mode: "home" (what is reached from the configuration as written), "translation" (the platform keeps its
            orientation), or "free" (one chain, displaced at will).
        limbs: in the order of the chains; empty where the graph has none.
        known: the platform's POC set.
        dof: F of Eq. (3), with parallelograms as generalised joints.
        internal_freedoms: those of F that leave the platform at rest, such as a rod's spin.
        loops: in the order that attains the coupling degree.
        assur_chains: each with the indices of its loops; none where the inputs do not determine the mechanism.
        coupling_degree: kappa of Eq. (6); None where the inputs do not determine the mechanism, for reasons that
            `coupling_refusal` has.
        redundant_by_loop: 6 - xi of each loop in that order, then of the loop inside each parallelogram, by name; all
            together are those of the joint graph.
        inputs_by: who chose the inputs.
        decoupling: None where the inputs do not determine the platform, or where the two routes differ on it.
        decoupling_refusal: why the theory does not confirm that pattern, or what each route says; empty where it does.
        determining: with redundant inputs the sets of them that determine the mechanism; else none.
        freedom_type: whether the drives belong to one Assur chain, to several that hang together, or to separate parts;
            None where they do not determine the mechanism.
        passive_joints: those that move and are not driven; idle ones never do.
        alike: numbers of the limbs, from 1, those together that have the same joints, drives and relations.
        linkage: what the twists were computed on.
        modes: the operation modes that meet at home, where there are several; all facts are those of the first.
    """

    mode: str
    limbs: tuple[LimbFacts, ...]
    known: Known
    dof: int
    internal_freedoms: int
    internal_joints: tuple[tuple[str, ...], ...]
    idle_joints: tuple[str, ...]
    loops: tuple[Loop, ...]
    assur_chains: tuple[AssurChain, ...]
    coupling_degree: int | None
    redundant_constraints: RedundantConstraints
    redundant_by_loop: tuple[tuple[str, int], ...]
    inputs: tuple[str, ...]
    decoupling: Decoupling | None
    plan: SolutionPlan
    linkage: Linkage
    name: str = ""
    title: str = ""
    source: str = ""
    freedom_type: FreedomType | None = None
    inputs_by: InputsBy = "given"
    decoupling_refusal: str = ""
    determining: tuple[DeterminingDrives, ...] = ()
    passive_joints: tuple[str, ...] = ()
    alike: tuple[tuple[int, ...], ...] = ()
    modes: tuple[OperationModeFacts, ...] = ()
    notes: tuple[str, ...] = ()
    derive: Callable[[], tuple[PocDerivation, ...]] = field(repr=False, default=tuple)
    actuate: Callable[[], Actuation] = field(repr=False, default=NotImplemented)
    relax: Callable[[], Relaxation] = field(repr=False, default=NotImplemented)
    count_parasitic: Callable[[], int | None] = field(repr=False, default=lambda: None)
    break_conditions: Callable[[], tuple[str, ...] | None] = field(repr=False, default=lambda: None)

    def __str__(self) -> str:
        loops = ", ".join(f"ξ = {loop.xi} Δ = {signed(loop.delta)}" for loop in self.loops) or "none"
        head = f"{self.name or 'mechanism'}: {self.poc}, F = {self.dof}, κ = {self.coupling_degree}; loops: {loops}"
        return "\n".join([head, *(derivation.text() for derivation in self.derivations), *self.plan.words])

    @property
    def poc(self) -> PocSet:
        """The platform's POC set at a general base point O'."""
        return self.known.poc

    @property
    def motion_type(self) -> str:
        """Independent elements of the POC set, dim - r translations and r rotations."""
        return motion_name(self.poc.dim, self.poc.r)

    @property
    def translating_type(self) -> str:
        """The other reading, as many translations of a general point as are independent: a planar five-bar's is 2T."""
        return motion_name(self.poc.dim, self.poc.dim - self.poc.t)

    @property
    def xi(self) -> tuple[int, ...]:
        """Independent equations of each loop, Eq. (4), in the order of the loops."""
        return tuple(loop.xi for loop in self.loops)

    @property
    def coupling_refusal(self) -> str:
        """Why there is no coupling degree; empty where there is one."""
        if self.determining:
            return f"the {len(self.inputs)} inputs are redundant, and each determining set of them has its own"
        return self.plan.refusal

    @property
    def coupling_words(self) -> str:
        """The coupling degree in words; with redundant inputs that of each set that determines the mechanism."""
        if self.coupling_degree is not None:
            return f"coupling degree {self.coupling_degree}"
        degrees = sorted({part.coupling_degree for part in self.determining if part.coupling_degree is not None})
        listed = ", ".join(str(degree) for degree in degrees)
        return f"coupling degree {listed} of the inputs that determine it" if degrees else "no coupling degree"

    def _repr_html_(self) -> str:
        """For a notebook: the table of characteristics, and the graph as a picture."""
        from assur.results.notebook import html_table, pictured

        rows = import_module("assur.topology.characteristics").characteristics(self)
        graph, style = (import_module(f"assur.figures.{name}") for name in ("graph", "style"))
        with style.styled():
            drawn = graph.graph_drawing(self.linkage, self.loops, self.assur_chains).figure
        return html_table(self.name, ("characteristic", "value"), rows, pictured(drawn))

    @property
    def is_shaky(self) -> bool:
        """Whether the loops close only where they are singular: F and the POC set are then those of finite motions."""
        return bool(self.plan.shaky)

    @property
    def delta(self) -> tuple[int, ...]:
        """Constraint degrees of the loops, Eq. (5)."""
        return tuple(loop.delta for loop in self.loops)

    @property
    def routes_agree(self) -> bool | None:
        """True where rules and twists both gave every POC set; None where the rules refused one, which says why.

        There is no False: where they give different answers an error is raised.
        """
        known = (self.known, *(limb.known for limb in self.limbs))
        return True if all(answer.route == "both" for answer in known) else None

    @cached_property
    def derivations(self) -> tuple[PocDerivation, ...]:
        """Of the platform with its limbs; of the limbs alone where the rules refuse the platform."""
        return self.derive()

    @cached_property
    def actuation(self) -> Actuation:
        """Whether the chosen inputs determine everything, and which other joints may be actuated."""
        return self.actuate()

    @cached_property
    def relaxation(self) -> Relaxation:
        """Which joints could be relaxed to remove redundant constraints; computed when first asked for."""
        return self.relax()

    @cached_property
    def parasitic(self) -> int | None:
        """How many elements of the platform's motion are parasitic; None of a shaky mechanism."""
        return self.count_parasitic()

    @cached_property
    def conditions(self) -> tuple[str, ...] | None:
        """Geometric conditions that F and the POC set need; None where dimensions decide too, or there are no limbs."""
        return self.break_conditions()
