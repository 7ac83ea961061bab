"""What a synthesis found, as plain data and as topology files."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any

from assur.model.file.topology_text import topology_text
from assur.model.topology_description import Declared, TopologyDescription
from assur.synthesis.assembly import MEMBERS
from assur.synthesis.designs import Design
from assur.synthesis.positions import in_words
from assur.synthesis.synthesis import ANY, Synthesis
from assur.topology.notation import symbolic_text
from assur.topology.poc import PocSet


def answers(synthesis: Synthesis, top: int | None = None) -> dict[str, Any]:
    """Numbers, texts, lists and dictionaries only.

    Args:
        synthesis: of one question.
        top: how many mechanisms, the best ones; all where it is None.
    """
    asked, tally = synthesis.asked, synthesis.tally
    return {
        "asked": {
            "motion": asked.motion.name,
            "limbs": asked.limbs,
            "max_joints": asked.max_joints,
            "coupling": None if asked.coupling == ANY else list(asked.coupling),
            "symmetric": asked.symmetric,
            "actuators": asked.actuators,
        },
        "positions": in_words(asked.motion, asked.limbs),
        "limb_types": {
            "with_motion": len(synthesis.limbs),
            "by_poc": dict(sorted(Counter(_numbers(limb.known.poc) for limb in synthesis.limbs).items())),
            "left_out": dict(sorted(synthesis.left_out.items())),
        },
        "combinations": {
            "all": tally.combinations,
            "with_motion": tally.with_motion,
            "by_coupling_degree": {str(key): value for key, value in sorted(tally.coupling_degrees.items())},
            "tried_one_by_one": tally.tried,
            "not_fixed_by_actuators": tally.unfixed,
            "listed_of_each_class_of_different_limbs": MEMBERS,
        },
        "found": len(synthesis.designs),
        "mechanisms": [_design(rank, design) for rank, design in enumerate(synthesis.designs[:top], 1)],
    }


def _design(rank: int, design: Design) -> dict[str, Any]:
    return {
        "rank": rank,
        "names": list(design.names),
        "chains": [chain.text for chain in design.chains],
        "actuate": [f"{limb}.{joint}" for limb, joint in design.actuated],
        "mode": design.mode,
        "limbs": [
            {
                "text": limb.chains[place].text,
                "symbolic": symbolic_text(limb.chains[place]),
                "poc": _poc(limb.known.poc),
                "freedoms": limb.type.freedoms,
                "route": limb.known.route,
            }
            for place, limb in enumerate(design.limbs)
        ],
        "symmetric": design.symmetric,
        "poc": _poc(design.known.poc),
        "dof": design.dof,
        "xi": list(design.xi),
        "delta": [loop.delta for loop in design.loops.loops],
        "coupling_degree": design.coupling_degree,
        "redundant_constraints": {
            "collapsed": design.redundant.collapsed,
            "joint_graph": design.redundant.joint_graph,
        },
        "joints": design.joints,
        "route": design.known.route,
        "reason": design.reason,
    }


def _poc(poc: PocSet) -> dict[str, Any]:
    return {"text": str(poc), "t": poc.t, "r": poc.r, "dim": poc.dim, "dependent": poc.dependent}


def _numbers(poc: PocSet) -> str:
    return f"t{poc.t} r{poc.r}"


def skeletons(synthesis: Synthesis, top: int | None = None) -> Mapping[str, str]:
    """Names and texts of topology files, one for each of the best mechanisms, as `assur.topology` reads them."""
    width = len(str(len(synthesis.designs)))
    return {
        f"{synthesis.asked.motion.name.lower()}-{rank:0{width}}.toml": _skeleton(synthesis, rank, width, design)
        for rank, design in enumerate(synthesis.designs[:top], 1)
    }


def _skeleton(synthesis: Synthesis, rank: int, width: int, design: Design) -> str:
    poc = design.known.poc
    known = f", with the limbs of {' and '.join(design.names)}" if design.names else ""
    described = TopologyDescription(
        name=f"{synthesis.asked.motion.name.lower()}-{rank:0{width}}",
        chains=design.chains,
        title=f"{synthesis.asked.motion.name} mechanism {rank} of {len(synthesis.designs)}{known}",
        source="assur synthesize",
        note=design.reason,
        actuate=design.actuated,
        mode=design.mode,
        declared=Declared(
            poc=(poc.t, poc.r),
            dim=poc.dim,
            dof=design.dof,
            xi=design.xi,
            coupling_degree=design.coupling_degree,
            limbs=tuple((limb.known.poc.t, limb.known.poc.r) for limb in design.limbs),
            limb_dims=tuple(limb.known.poc.dim for limb in design.limbs),
            redundant_constraints=(design.redundant.collapsed, design.redundant.joint_graph),
            source="rules of POC theory and ranks of twists",
        ),
    )
    return topology_text(described)
