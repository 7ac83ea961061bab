"""The answer of a topology: what `--json` prints, and what a program reads."""

from __future__ import annotations

import dataclasses
from typing import Any

from assur.results.answers.solution_order import PlanAnswer
from assur.results.answers.topology import (
    ActuationAnswer,
    LimbAnswer,
    PlatformPoc,
    PocDirection,
    PreloadSpace,
    Replacement,
    RulesRefusal,
    TopologyAnswer,
    WrittenPoc,
)
from assur.topology.facts import Known, LimbFacts, Topology
from assur.topology.poc import Mark, PocSet


def answers(topology: Topology) -> TopologyAnswer:
    """The facts at the border; what does not exist is None.

    `loops` are in the order that attains the coupling degree, and `loops` inside `assur_chains` are indices into
    it. `decoupling[i][j]` says whether output i of `outputs` depends on input j of `inputs`.
    """
    decoupling = topology.decoupling
    return TopologyAnswer(
        name=topology.name,
        title=topology.title,
        source=topology.source,
        mode=topology.mode,
        poc=PlatformPoc(**_poc(topology.poc), **_known(topology.known)),
        limbs=tuple(_limb(limb) for limb in topology.limbs),
        motion_type=topology.motion_type,
        parasitic=topology.parasitic,
        freedom_type=topology.freedom_type,
        dof=topology.dof,
        internal_freedoms=topology.internal_freedoms,
        internal_joints=topology.internal_joints,
        passive_joints=topology.passive_joints,
        idle_joints=topology.idle_joints,
        alike=topology.alike,
        conditions=topology.conditions,
        loops=topology.loops,
        assur_chains=topology.assur_chains,
        coupling_degree=topology.coupling_degree,
        coupling_refusal=topology.coupling_refusal,
        redundant_constraints=topology.redundant_constraints,
        redundant_by_loop=dict(topology.redundant_by_loop),
        inputs=decoupling.inputs if decoupling else topology.inputs,
        inputs_by=topology.inputs_by,
        outputs=decoupling.outputs if decoupling else (),
        decoupling=decoupling.depends if decoupling else None,
        decoupling_refusal=topology.decoupling_refusal,
        actuation=_actuation(topology),
        relaxation=topology.relaxation,
        plan=PlanAnswer(topology.plan.search, topology.plan.words, topology.plan.parts),
        routes_agree=topology.routes_agree,
        refusals=refusals(topology),
        derivation=tuple(line for derivation in topology.derivations for line in derivation.text().splitlines()),
        operation_modes=topology.modes,
        notes=topology.notes,
    )


def refusals(topology: Topology) -> tuple[RulesRefusal, ...]:
    """Where the rules gave no answer, and why: the limbs in order, then the platform."""
    named = [*((limb.text, limb.known) for limb in topology.limbs), ("platform", topology.known)]
    return tuple(RulesRefusal(name, known.refusal) for name, known in named if known.refusal)


def replacements_by_kind(topology: Topology) -> list[tuple[Replacement, tuple[str, ...]]]:
    """Replacements that remove redundant constraints by themselves: one of each kind, and all joints that allow it."""
    kinds: dict[Replacement, list[Replacement]] = {}
    for replacement in topology.relaxation.single:
        kinds.setdefault(dataclasses.replace(replacement, joint=""), []).append(replacement)
    return [(items[0], tuple(replacement.joint for replacement in items)) for items in kinds.values()]


def mark_text(mark: Mark) -> str:
    """A direction mark alone, empty where there is nothing to say.

    >>> mark_text(Mark("perpendicular", ("R1",)))
    '⊥R1'
    """
    inside = str(PocSet(1, 0, 1, t_mark=mark))[len("t¹") : -len(" r⁰")]
    return inside[1:-1]


def written_poc(poc: PocSet) -> WrittenPoc:
    """A POC set, as numbers and as it is written."""
    return WrittenPoc(**_poc(poc))


def _poc(poc: PocSet) -> dict[str, Any]:
    return {"text": str(poc), "t": poc.t, "r": poc.r, "dim": poc.dim, "dependent": poc.dependent}


def _known(known: Known) -> dict[str, Any]:
    """The directions of a POC set, none of a part that has none or all of them; and by what it is known."""
    poc = known.poc
    directions = tuple(
        PocDirection(part, mark_text(mark), mark.axes)
        for part, mark in (("t", poc.t_mark), ("r", poc.r_mark))
        if mark.relation != "none"
    )
    return {"directions": directions, "route": known.route, "refusal": known.refusal}


def _limb(limb: LimbFacts) -> LimbAnswer:
    poc = limb.poc
    numbers = (poc.t, poc.r, poc.dim, poc.dependent)
    return LimbAnswer(*numbers, limb.text, limb.symbolic, limb.freedoms, str(poc), **_known(limb.known))


def _actuation(topology: Topology) -> ActuationAnswer:
    asked = topology.actuation
    degrees = tuple(part.coupling_degree for part in topology.determining) or (topology.coupling_degree,)
    return ActuationAnswer(
        verdict=asked.verdict,
        needed=asked.needed,
        hint=asked.hint,
        redundancy=asked.redundancy,
        admissible=asked.determining,
        coupling_degrees=degrees[: len(asked.determining)],
        preload=PreloadSpace(asked.redundancy, asked.superfluous),
        drivable=asked.in_some,
        indispensable=asked.in_every,
        sets=asked.sets,
        complete=asked.complete,
    )
