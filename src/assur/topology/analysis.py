"""The topology of a linkage: POC sets by both routes, then the counting. One function, from a linkage to its facts."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.results.answers.solution_order import Loop
from assur.results.answers.topology import OperationModeFacts, RedundantConstraints
from assur.results.plain_text import count as plural
from assur.topology.agreement import RoutesDisagreeError, by_twists
from assur.topology.alike import alike_limbs
from assur.topology.chains import Chain
from assur.topology.conditions import needed_conditions
from assur.topology.counting.actuation import actuation
from assur.topology.counting.coupling import Decomposition, coupling
from assur.topology.counting.decoupling import Decoupling, JudgedPattern, by_jacobian, judged
from assur.topology.counting.decoupling import by_rules as decoupled_by_rules
from assur.topology.counting.drives import admissible_drives
from assur.topology.counting.freedom_type import freedom_type
from assur.topology.counting.mobility import Mobility, driven_joints, mobility, motions, passive_joints
from assur.topology.counting.parasitic import parasitic_elements
from assur.topology.counting.redundant_drives import DeterminingDrives, determining_drives, driven_by
from assur.topology.counting.relaxation import relaxation
from assur.topology.counting.solution_plan import SolutionPlan, solution_plan
from assur.topology.facts import InputsBy, Known, LimbFacts, Topology
from assur.topology.notation import plain_text, symbolic_text
from assur.topology.poc import PocSet
from assur.topology.routes import KnownLimb, Rules, as_the_limbs_are, both, by_rules, check_xi, limb_known
from assur.topology.screws.assembly_equations import Hold
from assur.topology.screws.configurations import home_is_special
from assur.topology.screws.edges import Edge, closure, rank
from assur.topology.screws.limb_linkage import is_seen_at_end
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.modes import OperationMode, operation_modes
from assur.topology.screws.recognition import recognised
from assur.topology.screws.shared_points import point_of_platform
from assur.topology.screws.twists import dimensions, edges, motion_space
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.refusals import Refusal
from assur.work import stage

FloatArray = NDArray[np.float64]
Mode = Literal["home", "translation"]

ADMISSIBLE: InputsBy = "admissible set"

COUNT = 4
"""Configurations, at least, at which ranks are taken."""

SEVERAL = "the inputs are redundant, so that no output is a function of them all"

SPECIAL = "home is special: it has instantaneous freedoms that are lost on the way, and operation modes may meet there"


@dataclass(frozen=True, eq=False)
class Sample:
    """A linkage at some configurations of one operation mode.

    Attributes:
        values: (N, n) joint values.
        joints: every joint as an edge.
        collapsed: the same with parallelograms as one edge each.
        space: (N, 6, k) motion space of the platform.
        poc: its (t, r, dim).
        special: whether home has instantaneous freedoms that these configurations have lost.
        modes: the operation modes that meet at home, this one first.
    """

    linkage: Linkage
    values: FloatArray
    joints: tuple[Edge, ...]
    collapsed: tuple[Edge, ...]
    space: FloatArray
    poc: tuple[int, int, int]
    special: bool
    modes: tuple[OperationMode, ...] = ()

    @property
    def is_branch_point(self) -> bool:
        """Whether several operation modes meet at home."""
        return len(self.modes) > 1

    @property
    def keeps_orientation(self) -> bool:
        """Whether the platform moves and does not turn."""
        return self.poc[1] == 0 < self.poc[2]


@stage("twists at home and on the way")
def sample(linkage: Linkage, mode: Mode = "home") -> Sample:
    """A linkage at configurations displaced from home, the platform kept from turning in translation mode.

    A P(4S) or P(2US) is kept a parallelogram, as the theory takes it, also where the mechanism does not see to that.
    Where operation modes meet at home it is the one with most freedoms.

    Errors:
        ShakyError: loops that close only where they are singular. ImmobileError: home cannot be left.
    """
    hold = held_in(linkage, mode)
    modes = operation_modes(linkage, COUNT, hold=hold)
    values = modes[0].values
    collapsed = edges(linkage, values)
    space = motion_space(collapsed, linkage.base, linkage.platform)
    special = home_is_special(linkage, values, hold)
    joints = edges(linkage, values, collapsed=False)
    return Sample(linkage, values, joints, collapsed, space, dimensions(space), special, modes)


def held_in(linkage: Linkage, mode: Mode) -> Hold | None:
    """What is held while a linkage is displaced."""
    if mode == "translation":
        return "orientation"
    skewing = any(group.kind in ("P(4S)", "P(2US)") for group in linkage.groups.values())
    return "parallelograms" if skewing else None


@stage("topology")
def analyse(
    linkage: Linkage,
    chains: Sequence[Chain] | None = None,
    *,
    mode: Mode = "home",
    inputs_by: InputsBy = "given",
) -> Topology:
    """Everything that the theory says of a linkage.

    Args:
        linkage: assembled at home, with its inputs.
        chains: its limbs, with the names of its joints; recognised in the linkage where they are not given.
        mode: "home" for the motion that is reached from home, "translation" for a platform that keeps its orientation.
        inputs_by: whether somebody gave the inputs, or they are the first joints of the branches. Where these do not
            determine a mechanism, an admissible set takes their place, and a note says so.

    Errors:
        RoutesDisagreeError: rules and twists differ, with the chain's name.
        UsageError: links that nothing connects, inputs of what does not move, a platform that turns in translation
            mode.
    """
    chains = recognised(linkage) if chains is None else tuple(chains)
    home = sample(linkage, mode)
    base, platform = linkage.base, linkage.platform
    collapsed = mobility(home.collapsed, base, platform)
    whole = mobility(home.joints, base, platform)
    if inputs_by == "first joints" and collapsed.loops and not _are_valid(home):
        inputs = admissible_drives(home.collapsed, linkage, chains or ())
        if inputs is not None:
            driven = analyse(dataclasses.replace(linkage, inputs=inputs), chains, mode=mode, inputs_by=ADMISSIBLE)
            return dataclasses.replace(driven, notes=(driven_words(linkage, inputs), *driven.notes))
    refuse_rigid(linkage, collapsed)
    if mode == "translation" and len(chains or ()) != 1 and home.poc[1]:
        raise UsageError(
            "there is no translation mode: where the platform keeps its orientation, it can turn as well",
            hint="leave out the mode",
        )
    still, held = home.keeps_orientation, mode == "translation"
    at = point_of_platform(linkage, chains or ())
    at_end = len(chains or ()) == 1 and is_seen_at_end(linkage, *(chains or ()))
    rules = by_rules(chains, still=still, held=held, at=at, at_end=at_end)
    limbs = known_limbs(home, chains or (), rules)
    rules = as_the_limbs_are(rules, limbs)
    internal = motions(home.collapsed, base, platform).internal
    order = coupling(home.collapsed, internal)
    asked = cache(partial(actuation, home.collapsed, base, platform))
    determining = determining_drives(home.collapsed, asked(), internal) if order.remainder < 0 else ()
    if not home.is_branch_point:  # the rules may speak of another mode
        check_xi(chains or (), [limb.motion for limb in limbs], order.loops, held=held)
    decoupling = _decoupling(by_jacobian(home.collapsed, base, platform), chains, rules.platform, still=still)
    plan = _plan(order, determining, home, internal)
    solvable = not (plan.free or determining)
    determined = solvable and sum(len(edge.inputs) for edge in home.collapsed) == collapsed.controlled
    modes = tuple(_mode_facts(linkage, values) for values in home.modes)
    return Topology(
        mode=mode,
        limbs=tuple(limb_facts(chain, limb.known) for chain, limb in zip(chains or (), limbs, strict=True)),
        known=_platform_known(rules.platform, home),
        dof=collapsed.dof,
        internal_freedoms=collapsed.internal_freedoms,
        internal_joints=tuple(freedom.joints for freedom in whole.internal),
        idle_joints=collapsed.idle,
        loops=order.loops,
        assur_chains=order.assur_chains if solvable else (),
        coupling_degree=order.coupling_degree if solvable else None,
        redundant_constraints=RedundantConstraints(collapsed.redundant_constraints, whole.redundant_constraints),
        redundant_by_loop=(*of_loops(order.loops), *of_parallelograms(home)),
        freedom_type=freedom_type(home.collapsed, order.loops, order.assur_chains) if determined else None,
        inputs=input_names(home),
        inputs_by=inputs_by,
        decoupling=decoupling.decoupling,
        decoupling_refusal=SEVERAL if determining else decoupling.refusal,
        plan=plan,
        determining=determining,
        linkage=linkage,
        modes=modes,
        notes=(_met_at_home(modes),) if home.special or home.is_branch_point else (),
        derive=rules.derivations,
        actuate=asked,
        passive_joints=passive_joints(home.collapsed, collapsed),
        alike=alike_limbs(chains or (), driven_joints(home.collapsed)),
        relax=partial(relaxation, home.joints, base, platform),
        count_parasitic=partial(parasitic_elements, linkage, home.values, home.space),
        break_conditions=partial(needed_conditions, chains or (), (collapsed.dof, home.poc), held_in(linkage, mode)),
    )


def _plan(
    order: Decomposition, determining: Sequence[DeterminingDrives], home: Sample, internal: FloatArray
) -> SolutionPlan:
    """How the direct problem is solved; with redundant drives by the first ones that determine it."""
    base, platform = home.linkage.base, home.linkage.platform
    if not determining:
        return solution_plan(order, home.collapsed, base, platform)
    drives = determining[0].drives
    first = driven_by(home.collapsed, drives)
    return dataclasses.replace(solution_plan(coupling(first, internal), first, base, platform), drives=drives)


def _platform_known(rules: Motion | Refusal, home: Sample) -> Known:
    """The platform's POC set; where operation modes meet at home the rules may speak of another one than this."""
    try:
        return both("the platform", rules, home.space)
    except RoutesDisagreeError as error:
        if not home.is_branch_point:
            raise
        reason = f"operation modes meet at home, and the rules speak of another one than the twists ({error.message})"
        return Known(by_twists(home.space), "twists", reason)


def _mode_facts(linkage: Linkage, mode: OperationMode) -> OperationModeFacts:
    """The numbers of a mode; of a real one also the directions that its configurations have in common."""
    poc = PocSet(*mode.poc)
    if mode.real:
        poc = by_twists(motion_space(edges(linkage, mode.values), linkage.base, linkage.platform))
    return OperationModeFacts(mode.freedoms, *mode.poc, mode.real, str(poc))


def _met_at_home(modes: Sequence[OperationModeFacts]) -> str:
    """What is special about home."""
    if len(modes) == 1:
        return SPECIAL
    others = "; ".join(f"({number}) {mode}" for number, mode in enumerate(modes[1:], 2))
    translating = any(mode.r == 0 < mode.dim for mode in modes[1:])
    ask = "; mode translation asks for one that does not turn" if translating else ""
    return (
        f"home is a branch point, where {len(modes)} operation modes meet; all this is said of (1) "
        f"{modes[0]}; the others: {others}{ask}"
    )


def _decoupling(
    twists: Decoupling | None, chains: Sequence[Chain] | None, platform: Motion | Refusal, *, still: bool
) -> JudgedPattern:
    """The Jacobian's pattern, and why the theory does not confirm it where it does not.

    Where the rules do not know how the whole mechanism moves, they do not know it with joints locked either.
    """
    if twists is None:
        return JudgedPattern(None)
    if chains is None or not still:
        return JudgedPattern(twists, "the platform turns" if chains else "the joint graph has no limbs")
    if isinstance(platform, Refusal):
        return JudgedPattern(twists, platform.reason)
    return judged(decoupled_by_rules(chains, twists.inputs), twists)


def known_limbs(home: Sample, chains: Sequence[Chain], rules: Rules) -> list[KnownLimb]:
    """Every limb by both routes, at the configurations of a sample."""
    return [
        limb_known(f"limb {number}, {_text(chain)}", motions, home.linkage, chain, home.values)
        for number, (chain, *motions) in enumerate(zip(chains, rules.still, rules.free, strict=True), 1)
    ]


def limb_facts(chain: Chain, known: Known) -> LimbFacts:
    """A limb for the reader."""
    return LimbFacts(_text(chain), symbolic_text(chain), sum(joint.freedoms for joint in chain.joints), known)


def _text(chain: Chain) -> str:
    return chain.text or plain_text(chain)


def of_loops(loops: Sequence[Loop]) -> list[tuple[str, int]]:
    """Redundant constraints of each loop."""
    return [(f"loop {number}", loop.redundant_constraints) for number, loop in enumerate(loops, 1)]


def of_parallelograms(home: Sample) -> list[tuple[str, int]]:
    """Redundant constraints of the loop inside each parallelogram."""
    place = {edge.name: edge for edge in home.joints}
    inside = {name: [place[joint] for joint in group.joints] for name, group in home.linkage.groups.items()}
    return [(name, 6 - rank(closure(joints))) for name, joints in inside.items()]


def input_names(home: Sample) -> tuple[str, ...]:
    """The inputs as joints, or "C1.1" where a joint has several components, in the order of the linkage."""
    names = []
    for joint, component in home.linkage.inputs:
        edge = next(edge for edge in home.collapsed if joint in edge.joints)
        names.append(edge.name if edge.freedoms == 1 else f"{edge.name}.{component + 1}")
    return tuple(names)


def _are_valid(home: Sample) -> bool:
    """Whether the inputs determine the mechanism, and none is too many."""
    return actuation(home.collapsed, home.linkage.base, home.linkage.platform, limit=0).verdict == "valid"


def driven_words(linkage: Linkage, inputs: Sequence[tuple[str, int]]) -> str:
    """What is driven in the place of the first joints of the branches."""
    firsts = ", ".join(joint for joint, _ in linkage.inputs) or "none that can be driven"
    groups = {name: group for group in linkage.groups.values() for name in group.joints}
    names = [groups[joint].name if joint in groups else joint for joint, _ in inputs]
    if not inputs:
        return f"actuated: nothing, for the platform does not move; the first joints of the branches: {firsts}"
    if set(inputs) <= set(linkage.inputs):
        count = plural(len(inputs), "degree")
        return f"actuated: only {', '.join(names)}, of {firsts}, the first joints of the branches; {count} of freedom"
    return (
        f"actuated: {', '.join(names)}, an admissible set near the base, because the first joints of the branches "
        f"({firsts}) do not determine the mechanism"
    )


def refuse_rigid(linkage: Linkage, mobility: Mobility) -> None:
    """UsageError where something is actuated and nothing can move."""
    if linkage.inputs and mobility.controlled <= 0:
        names = ", ".join(joint for joint, _ in linkage.inputs)
        internal = f" beside {plural(mobility.internal_freedoms, 'internal one')}" if mobility.internal_freedoms else ""
        raise UsageError(
            f"{plural(len(linkage.inputs), 'actuated joint')} ({names}) for 0 degrees of freedom{internal}",
            hint="the mechanism does not move: a limb has too few freedoms, or axes that do not go together",
        )
