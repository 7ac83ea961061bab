"""Evidence on Eqs. (1)-(6) and the joint graph itself: E10, E12, E13."""

from __future__ import annotations

import numpy as np

from assur.audit.audit import reference_entry, reference_of
from assur.audit.configurations import configurations, random_assemblies
from assur.audit.parts import called, sampled
from assur.audit.rows import Evidence
from assur.audit.topology import decomposition_rows
from assur.derived_topology import topology
from assur.joint_graph.points import quantity
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import closure_error, mobility
from assur.kinematics.position import direct
from assur.model.formula import parse
from assur.topology.analysis import sample
from assur.topology.counting.coupling import coupling_of
from assur.topology.counting.mobility import mobility as counted
from assur.topology.screws.edges import closure, rank
from assur.topology.screws.recognition import recognised

CLOSE = 1e-9


def loop_numbers(record):
    """E10: each dim of Eq. (4) is one xi, not their sum; Delta = -3 occurs."""
    xis = [row.computed for row in _numbers(record) if row.quantity.startswith("xi")]
    ours = [row.computed for row in _numbers(record) if row.quantity.startswith("Delta")]
    tripod = topology("three_ups_up")
    deltas = _limb_by_limb(tripod.linkage)
    return Evidence(
        len(xis) == 2
        and sum(xis) not in xis
        and sum(ours) == 0
        and -3 in deltas
        and sum(deltas) == 0
        and tripod.internal_freedoms == 0,
        f"By rank of twists the two loops have ξ = {xis[0]} and {xis[1]}; the right side of Eq. (4) is "
        f"{xis[1]} for the second one, the sum on its left would be {sum(xis)}. A platform on three UPS "
        f"limbs and a passive UP limb, added in this order, has Δ = {', '.join(map(str, deltas))} (rank "
        "of twists), with sum 0: -3 occurs.",
        {"xi": xis, "delta": deltas},
    )


def coupling_is_a_heuristic(record):
    """E12: kappa > 0 does not forbid a closed form: this mechanism has both."""
    kappa = next(row.computed for row in _numbers(record) if row.quantity == "kappa")
    here = configurations(record).values
    found = direct(record, here[:, list(record.input_indices)])
    worst = float(np.max(found.residuals[found.exists]))
    poses = quantity(record, parse("O'.x"), here)
    nearest = np.min(np.where(found.exists, np.abs(found.poses[..., 0] - poses[:, None]), np.inf), axis=1)
    return Evidence(
        kappa > 0 and worst < 1e-6 and float(np.max(nearest)) < 1e-5,
        f"κ = {kappa:g} by rank of twists, and yet the direct problem has a closed form: at the inputs of "
        f"{len(here)} random configurations of the joint graph its branches close the whole joint graph "
        "and each configuration's own pose is among them.",
        {"kappa": kappa},
    )


def joint_graph_counts(record):
    """E13: links, loops, rank, freedoms and redundant constraints, with parallelograms as loops and collapsed."""
    graph, free = joint_graph(record), mobility(record, configurations(record).values[0])
    here = sampled(record)
    ends = here.linkage.base, here.linkage.platform
    collapsed, whole = (counted(edges, *ends) for edges in (here.collapsed, here.joints))
    counts = (len(record.joints), len(record.links), len(graph.cut), int(free.rank), 6 * len(graph.cut))
    loops = [_decomposition(record).loops[0].joints, *(item.joints for item in record.generalised.values())]
    xis = [_rank(record, joints) for joints in loops]
    xis.append(_rank(record, record.joints) - sum(xis))
    inputs = [item.value for item in reference_entry(record, "direct", "Table 1").given]
    values = random_assemblies(record, tuple(inputs))
    crossed = [
        float(
            np.min(closure_error(record, values[np.abs(np.exp(1j * quantity(record, parse(gap), values)) - 1) > 0.1]))
        )
        for gap in ("B3a - B3b", "D3a - D3b")
    ]
    return Evidence(
        counts == (17, 14, 4, 14, 24)
        and sum(xis) == counts[3]
        and int(free.freedoms) == collapsed.dof == whole.dof == 3
        and int(free.redundant) == whole.redundant_constraints == 10
        and xis == [3, 3, 3, 5]
        and collapsed.redundant_constraints == 4
        and max(crossed) < 1e-6,
        f"{counts[0]} joints, {counts[1]} links, {counts[2]} independent loops with ξ = "
        f"{', '.join(map(str, xis))}; the closure has rank {counts[3]} of {counts[4]} rows, F = "
        f"{whole.dof}, {whole.redundant_constraints} redundant constraints, and "
        f"{collapsed.redundant_constraints} with the parallelograms collapsed. At the inputs of Table 1 "
        "random search finds assemblies with parallelogram ① crossed and with parallelogram ② crossed; "
        "they close the joint graph like the others.",
        {
            "xi": xis,
            "redundant": whole.redundant_constraints,
            "collapsed_redundant": collapsed.redundant_constraints,
        },
    )


def _decomposition(record):
    """The printed decomposition into loops."""
    return reference_of(record).entries["decomposition"][0]


def _rank(record, joints):
    """Rank of the closure of some joints, the sum of the xi of their loops."""
    names = called(record, joints)
    return rank(closure([edge for edge in sampled(record).joints if edge.name in names]))


def _numbers(record):
    return decomposition_rows(record, _decomposition(record))


def _limb_by_limb(linkage):
    """Delta of the loops of a linkage whose limbs are added in their order."""
    first, *later = [[joint.name for joint in chain.joints] for chain in recognised(linkage) or ()]
    order = [first + later[0], *later[1:]]
    return [loop.delta for loop in coupling_of(sample(linkage).collapsed, order).loops]
