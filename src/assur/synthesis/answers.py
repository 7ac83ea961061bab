"""What a synthesis found, as an answer and as topology files."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from assur.model.file.topology_text import topology_text
from assur.model.topology_description import Declared, TopologyDescription
from assur.results.answers.synthesis import (
    AskedSynthesis,
    CombinationCounts,
    DesignAnswer,
    DesignFamily,
    DesignFront,
    DesignLimb,
    ExplanationAnswer,
    LimbTypeCounts,
    SynthesisAnswer,
)
from assur.synthesis.designs import Design
from assur.synthesis.filters.explained import Explanation
from assur.synthesis.front import FrontPoint, front
from assur.synthesis.known_mechanisms import DrivenLimb
from assur.synthesis.positions import ABOUT_Z, AS_WRITTEN, in_words
from assur.synthesis.question import ANY, SynthesisQuestion
from assur.synthesis.synthesis import Synthesis
from assur.topology.answers import written_poc
from assur.topology.notation import plain_text, symbolic_text


def answers(synthesis: Synthesis, top: int | None = None) -> SynthesisAnswer:
    """What a synthesis comes to.

    Args:
        synthesis: of one question.
        top: how many mechanisms, the best ones; all where it is None.
    """
    asked, tally = synthesis.asked, synthesis.tally
    ranks = {id(design): rank for rank, design in enumerate(synthesis.designs, 1)}
    families = {id(design): rank for rank, family in enumerate(synthesis.families, 1) for design in family.designs}
    return SynthesisAnswer(
        asked=_asked(asked),
        positions=_positions(asked),
        limb_types=LimbTypeCounts(
            len(synthesis.limbs),
            dict(sorted(Counter(f"t{limb.known.poc.t} r{limb.known.poc.r}" for limb in synthesis.limbs).items())),
            dict(sorted(synthesis.left_out.items())),
        ),
        combinations=CombinationCounts(
            tally.combinations,
            tally.with_motion,
            {str(key): value for key, value in sorted(tally.coupling_degrees.items())},
            tally.tried,
            tally.unfixed,
            asked.members,
        ),
        count=len(synthesis.designs),
        mechanisms=tuple(
            _design(rank, families[id(design)], design) for rank, design in enumerate(synthesis.designs[:top], 1)
        ),
        families=tuple(
            DesignFamily(
                rank,
                family.members,
                tuple(ranks[id(design)] for design in family.designs),
                family.designs[0].coupling_degree,
                family.designs[0].redundant.collapsed,
                tuple(name for design in family.designs for name in design.names),
            )
            for rank, family in enumerate(synthesis.families, 1)
        ),
        front=tuple(_front(point, families[id(point.design)], synthesis) for point in front(synthesis.designs)),
    )


def _front(point: FrontPoint, family: int, synthesis: Synthesis) -> DesignFront:
    design = point.design
    return DesignFront(
        ranks=point.ranks,
        family=family,
        coupling_degree=design.coupling_degree,
        redundant_constraints=design.redundant.collapsed,
        joints=design.joints,
        zeros=design.zeros if design.decoupling else None,
        names=tuple(name for rank in point.ranks for name in synthesis.designs[rank - 1].names),
        reason=point.reason,
    )


def explanation_answer(
    explained: Explanation, asked: SynthesisQuestion, limbs: Sequence[DrivenLimb]
) -> ExplanationAnswer:
    """What became of a mechanism in a synthesis."""
    whole = explained.synthesis if explained.synthesis and explained.synthesis.whole else None
    rank = whole.designs.index(explained.design) + 1 if whole and explained.design else None
    families = whole.families if whole else ()
    return ExplanationAnswer(
        asked=_asked(asked),
        chains=tuple(plain_text(limb.chain) for limb in limbs),
        dropped_by=explained.dropped_by or None,
        reason=explained.reason,
        rank=rank,
        family=next((n for n, family in enumerate(families, 1) if explained.design in family.designs), None),
        listed_as=tuple(chain.text for chain in explained.design.chains) if explained.design else (),
        names=explained.design.names if explained.design else (),
    )


def _positions(asked: SynthesisQuestion) -> str:
    if asked.parasitic:
        return ABOUT_Z
    return AS_WRITTEN if asked.rows else in_words(asked.motion, asked.limbs)


def _asked(asked: SynthesisQuestion) -> AskedSynthesis:
    return AskedSynthesis(
        asked.motion.name,
        tuple(row.row for row in asked.rows),
        asked.limbs,
        asked.max_joints,
        None if asked.coupling == ANY else asked.coupling,
        asked.symmetric,
        asked.actuators,
        asked.members,
        asked.parasitic,
        asked.idle,
        asked.passive_slides,
        asked.joints,
        asked.novelty,
        asked.redundant,
    )


def _design(rank: int, family: int, design: Design) -> DesignAnswer:
    limbs = (
        DesignLimb(
            chain.text,
            symbolic_text(chain),
            written_poc(limb.known.poc),
            limb.type.freedoms,
            limb.known.route,
        )
        for limb, chain in zip(design.limbs, design.chains, strict=True)
    )
    actuate = tuple(f"{limb}.{joint}" for limb, joint in design.actuated)
    return DesignAnswer(
        rank=rank,
        family=family,
        names=tuple(design.names),
        row=design.row,
        chains=tuple(chain.text for chain in design.chains),
        actuate=actuate,
        mode=design.mode,
        limbs=tuple(limbs),
        symmetric=design.symmetric,
        poc=written_poc(design.known.poc),
        dof=design.dof,
        xi=tuple(design.xi),
        delta=tuple(loop.delta for loop in design.loops.loops),
        coupling_degree=design.coupling_degree,
        redundant_constraints=design.redundant,
        joints=design.joints,
        joint_kinds=design.joint_kinds,
        passive_slides=design.passive_slides,
        drives_on_base=design.drives_on_base,
        outputs=design.decoupling.outputs if design.decoupling else (),
        decoupling=design.decoupling.depends if design.decoupling else (),
        zeros=design.zeros if design.decoupling else None,
        admissible=tuple(tuple(actuate[index] for index in some.drives) for some in design.determining),
        coupling_degrees=tuple(some.coupling_degree for some in design.determining),
        route=design.known.route,
        reason=design.reason,
    )


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
            poc=None if design.row else (poc.t, poc.r),  # O' is the common point where limbs end there
            dim=poc.dim,
            dof=design.dof,
            xi=None if design.determining else design.xi,
            coupling_degree=None if design.determining else design.coupling_degree,
            limbs=tuple((limb.known.poc.t, limb.known.poc.r) for limb in design.limbs),
            limb_dims=tuple(limb.known.poc.dim for limb in design.limbs),
            redundant_constraints=(design.redundant.collapsed, design.redundant.joint_graph),
            source="rules of POC theory and ranks of twists",
        ),
    )
    return topology_text(described)
