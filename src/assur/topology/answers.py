"""The answers of a topology as plain data: what `--json` prints, and what a program reads.

The keys are a contract: `poc`, `limbs`, `dof`, `loops`, `assur_chains`, `coupling_degree`, `redundant_constraints`,
`decoupling` and `routes_agree` keep their meaning; others may be added.
"""

from __future__ import annotations

import dataclasses
from typing import Any

from assur.topology.counting.coupling import Loop
from assur.topology.counting.relaxation import Replacement
from assur.topology.counting.solution_plan import AssurPlan
from assur.topology.facts import Known, LimbFacts, Topology
from assur.topology.poc import Mark, PocSet


def answers(topology: Topology) -> dict[str, Any]:
    """The facts as numbers, texts, lists and dictionaries; what does not exist is None.

    `loops` are in the order that attains the coupling degree, and `loops` inside `assur_chains` are indices into
    it. `decoupling[i][j]` says whether output i of `outputs` depends on input j of `inputs`.
    """
    decoupling = topology.decoupling
    return {
        "name": topology.name,
        "title": topology.title,
        "source": topology.source,
        "mode": topology.mode,
        "poc": {**_poc(topology.poc), "directions": _directions(topology.poc), **_route(topology.known)},
        "limbs": [_limb(limb) for limb in topology.limbs],
        "dof": topology.dof,
        "internal_freedoms": topology.internal_freedoms,
        "internal_joints": [list(joints) for joints in topology.internal_joints],
        "idle_joints": list(topology.idle_joints),
        "loops": [_loop(loop) for loop in topology.loops],
        "assur_chains": [
            {"loops": list(chain.loops), "coupling_degree": chain.coupling_degree} for chain in topology.assur_chains
        ],
        "coupling_degree": topology.coupling_degree,
        "coupling_refusal": topology.coupling_refusal,
        "redundant_constraints": {
            "collapsed": topology.redundant_constraints.collapsed,
            "joint_graph": topology.redundant_constraints.joint_graph,
        },
        "redundant_by_loop": dict(topology.redundant_by_loop),
        "inputs": list(decoupling.inputs if decoupling else topology.inputs),
        "inputs_by": topology.inputs_by,
        "outputs": list(decoupling.outputs) if decoupling else [],
        "decoupling": [list(row) for row in decoupling.depends] if decoupling else None,
        "decoupling_refusal": topology.decoupling_refusal,
        "actuation": _actuation(topology),
        "relaxation": _relaxation(topology),
        "plan": {
            "search": topology.plan.search,
            "words": list(topology.plan.words),
            "assur_chains": [_plan(part) for part in topology.plan.parts],
        },
        "routes_agree": topology.routes_agree,
        "refusals": refusals(topology),
        "derivation": [line for derivation in topology.derivations for line in derivation.text().splitlines()],
        "operation_modes": [dataclasses.asdict(mode) for mode in topology.modes],
        "notes": list(topology.notes),
    }


def refusals(topology: Topology) -> list[dict[str, str]]:
    """Where the rules gave no answer, and why: the limbs in order, then the platform."""
    named = [*((limb.text, limb.known) for limb in topology.limbs), ("platform", topology.known)]
    return [{"of": name, "reason": known.refusal} for name, known in named if known.refusal]


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


def _poc(poc: PocSet) -> dict[str, Any]:
    return {"text": str(poc), "t": poc.t, "r": poc.r, "dim": poc.dim, "dependent": poc.dependent}


def _route(known: Known) -> dict[str, str]:
    return {"route": known.route, "refusal": known.refusal}


def _directions(poc: PocSet) -> list[dict[str, Any]]:
    """What is said of directions; nothing of a part that has none or all of them."""
    return [
        {"part": part, "mark": mark_text(mark), "axes": [list(axis) for axis in mark.axes]}
        for part, mark in (("t", poc.t_mark), ("r", poc.r_mark))
        if mark.relation != "none"
    ]


def _limb(limb: LimbFacts) -> dict[str, Any]:
    poc = {key: value for key, value in _poc(limb.poc).items() if key != "text"}
    return {
        "text": limb.text,
        **poc,
        "symbolic": limb.symbolic,
        "freedoms": limb.freedoms,
        "poc_text": str(limb.poc),
        "directions": _directions(limb.poc),
        **_route(limb.known),
    }


def _loop(loop: Loop) -> dict[str, Any]:
    return {
        "xi": loop.xi,
        "delta": loop.delta,
        "joints": list(loop.edges),
        "freedoms": loop.freedoms,
        "inputs": loop.inputs,
        "internal": loop.internal,
    }


def _actuation(topology: Topology) -> dict[str, Any]:
    asked = topology.actuation
    return {
        "verdict": asked.verdict,
        "needed": asked.needed,
        "hint": asked.hint,
        "admissible": list(asked.in_some),
        "indispensable": list(asked.in_every),
        "sets": [list(names) for names in asked.sets],
        "complete": asked.complete,
    }


def _relaxation(topology: Topology) -> dict[str, Any]:
    asked = topology.relaxation
    return {
        "redundant": asked.redundant,
        "left": asked.left,
        "single": [_replacement(replacement) for replacement in asked.single],
        "together": [_replacement(replacement) for replacement in asked.together],
    }


def _replacement(replacement: Replacement) -> dict[str, Any]:
    return dataclasses.asdict(replacement)


def _plan(part: AssurPlan) -> dict[str, Any]:
    return {
        "coupling_degree": part.coupling_degree,
        "search": part.search,
        "reason": part.reason,
        "steps": [
            {key: getattr(step, key) for key in ("loop", "delta", "virtual", "equations", "left")}
            for step in part.steps
        ],
    }
