"""The topology of a shaky linkage: what its finite motion is, where the second order of its loops proves that.

F, the POC set, the inputs and the joints at rest are those of the finite motion. Loops with their ξ, and redundant
constraints, are ranks of the closure, so of the first order. No coupling degree, decoupling or relaxation is told:
those count on ranks that are those of the motion.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from assur.results.answers.topology import OperationModeFacts, RedundantConstraints, Relaxation
from assur.results.plain_text import count as plural
from assur.topology.alike import alike_limbs
from assur.topology.analysis import (
    ADMISSIBLE,
    Sample,
    driven_words,
    input_names,
    known_limbs,
    limb_facts,
    of_loops,
    of_parallelograms,
    refuse_rigid,
)
from assur.topology.chains import Chain
from assur.topology.counting.actuation import actuation
from assur.topology.counting.coupling import coupling
from assur.topology.counting.drives import admissible_drives
from assur.topology.counting.mobility import driven_joints, mobility, motions, passive_joints
from assur.topology.counting.solution_plan import SolutionPlan
from assur.topology.facts import InputsBy, Known, Topology
from assur.topology.poc import PocSet
from assur.topology.routes import KnownLimb, Rules, as_the_limbs_are, by_rules, limb_alone
from assur.topology.screws.edges import Edge, along
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.parallelograms import UNSTEADY
from assur.topology.screws.recognition import recognised
from assur.topology.screws.second_order import FiniteMotion, finite_motion
from assur.topology.screws.twists import UnclearRankError, edges
from assur.topology.symbolic.refusals import Refusal
from assur.work import stage

FloatArray = NDArray[np.float64]


@stage("finite motion of a shaky mechanism")
def analyse_shaky(
    linkage: Linkage, chains: Sequence[Chain] | None = None, *, inputs_by: InputsBy = "given"
) -> Topology | None:
    """What is true of a linkage that `analyse` refuses as shaky or immobile; None where nothing is proved.

    Args:
        linkage: assembled at home, with its inputs.
        chains: as for `analyse`.
        inputs_by: as for `analyse`; where nobody gave inputs, an admissible set of the finite motion is taken.

    Errors:
        UsageError: inputs of what does not move.

    >>> from assur.topology.screws.placing import place
    >>> from assur.topology.notation import parse_chains
    >>> print(analyse_shaky(place(parse_chains(["C[z] C[1,0,2]", "C[x] C[1,0,2]"]))).poc)
    t² r⁰
    """
    if any(group.kind in UNSTEADY for group in linkage.groups.values()):
        return None
    motion = finite_motion(linkage)
    if motion is None:
        return None
    chains = recognised(linkage) if chains is None else tuple(chains)
    base, platform = linkage.base, linkage.platform
    joints, collapsed = (edges(linkage, motion.values, part) for part in (False, True))
    finite = _of_generalised_joints(collapsed, joints, motion.finite)
    notes = [_met(motion)]
    if inputs_by != "given":
        drives = admissible_drives(collapsed, linkage, chains or (), finite) or ()
        notes.append(driven_words(linkage, drives))
        linkage, inputs_by = dataclasses.replace(linkage, inputs=drives), ADMISSIBLE
        joints, collapsed = (edges(linkage, motion.values, part) for part in (False, True))
    home = Sample(linkage, motion.values, joints, collapsed, np.zeros((1, 6, 0)), motion.poc, special=True)
    moving = mobility(collapsed, base, platform, finite)
    refuse_rigid(linkage, moving)
    order = coupling(collapsed, motions(collapsed, base, platform, finite=finite).internal)
    inside = of_parallelograms(home)
    redundant = sum(loop.redundant_constraints for loop in order.loops)
    reason = _said(motion)
    rules = by_rules(chains, still=False, held=False)
    limbs = _known_limbs(home, chains or (), rules)
    rules = as_the_limbs_are(dataclasses.replace(rules, platform=Refusal(reason)), limbs)
    poc = PocSet(*motion.poc)
    return Topology(
        mode="home",
        limbs=tuple(limb_facts(chain, limb.known) for chain, limb in zip(chains or (), limbs, strict=True)),
        known=Known(poc, "twists", reason),
        dof=motion.freedoms,
        internal_freedoms=moving.internal_freedoms,
        internal_joints=tuple(part.joints for part in mobility(joints, base, platform, motion.finite).internal),
        idle_joints=moving.idle,
        loops=order.loops,
        assur_chains=(),
        coupling_degree=None,
        redundant_constraints=RedundantConstraints(redundant, redundant + sum(count for _, count in inside)),
        redundant_by_loop=(*of_loops(order.loops), *inside),
        inputs=input_names(home),
        inputs_by=inputs_by,
        decoupling=None,
        decoupling_refusal=reason,
        plan=SolutionPlan((), shaky=reason),
        linkage=linkage,
        passive_joints=passive_joints(collapsed, moving),
        alike=alike_limbs(chains or (), driven_joints(collapsed)),
        modes=(OperationModeFacts(motion.freedoms, *motion.poc, False, str(poc)),),
        notes=tuple(notes),
        derive=rules.derivations,
        actuate=partial(actuation, collapsed, base, platform, finite=finite),
        relax=partial(Relaxation, redundant, (), ()),
    )


def _known_limbs(home: Sample, chains: Sequence[Chain], rules: Rules) -> list[KnownLimb]:
    """The limbs as the mechanism has them; where it holds one so that its rank is not clear, as they are alone."""
    try:
        return known_limbs(home, chains, rules)
    except UnclearRankError:
        return [
            limb_alone(f"limb {number}", motion, home.linkage, chain)
            for number, (chain, motion) in enumerate(zip(chains, rules.free, strict=True), 1)
        ]


def _of_generalised_joints(collapsed: Sequence[Edge], joints: Sequence[Edge], finite: FloatArray) -> FloatArray:
    """Motions (N, n, F) of all joints as orthonormal rates (N, c, F) of edges in which parallelograms are one."""
    start = np.cumsum([0, *(edge.freedoms for edge in joints)])
    columns = {edge.name: np.arange(start[i], start[i + 1]) for i, edge in enumerate(joints)}
    place = {edge.name: edge for edge in joints}
    rates = []
    for edge in collapsed:
        inner = [place[name] for name in edge.joints]
        chosen = np.concatenate([columns[name] for name in edge.joints])
        moves = along(inner, edge.parent, edge.child) @ finite[:, chosen]
        rates.append(np.linalg.pinv(edge.twists) @ moves)
    basis: FloatArray = np.linalg.qr(np.concatenate(rates, axis=1))[0]
    return basis


def _said(motion: FiniteMotion) -> str:
    """Why facts that count on ranks are not told."""
    return f"the mechanism is shaky: {plural(motion.instantaneous, 'instantaneous freedom')} for F = {motion.freedoms}"


def _met(motion: FiniteMotion) -> str:
    return (
        f"{_said(motion)}; one of them leads nowhere, which the second order of its loops proves. F, the POC set "
        "and the inputs are those of its finite motion; Σf - Σξ counts all. Other directions of axes avoid that"
    )
