"""Neighbours of a mechanism that move as it does, with a smaller κ, less redundancy or more decoupling."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from assur.derived_topology import topology
from assur.errors import AssurError, UsageError
from assur.model.mechanism import MechanismRecord
from assur.results.answers.topology import Improvement
from assur.topology.directions import span
from assur.topology.facts import Topology
from assur.topology.neighbours import neighbours
from assur.topology.poc import Mark
from assur.topology.screws.recognition import recognised
from assur.work import stage


@stage("neighbours")
def improvements(
    what: str | Path | MechanismRecord | Sequence[str],
    /,
    *,
    actuate: Sequence[str] | None = None,
    mode: str | None = None,
) -> tuple[Improvement, ...]:
    """What is better in one thing of a mechanism, with one change: the best in κ first, then in redundancy.

    A neighbour has the same F, less internal freedoms, and the same POC set. It may be worse in another thing.

    Args:
        what: as `assur.topology` takes it.
        actuate: actuated joints as "limb.joint", by default those of `what`.
        mode: as `assur.topology` takes it.

    Errors:
        UsageError: a joint graph without limbs. Others as `assur.topology`.

    Example: a planar five-bar has κ = 0; with a ball joint at its tip it loses two redundant constraints.

    >>> best = improvements(["R[z] R[z] R[z]", "R[z] R[z]"])[0]
    >>> best.change, best.better
    ('R2 to S', ('redundant 3 to 1',))
    """
    original = topology(what, actuate=actuate, mode=mode)
    chains = recognised(original.linkage)
    if chains is None:
        raise UsageError("the joint graph has no limbs, and neighbours are made of limbs")
    held = "translation" if original.mode == "translation" else None
    tried = (
        (near, _moved_alike(original, near.chains, near.actuate, held))
        for near in neighbours(chains, original.inputs, original.actuation.sets)
    )
    better = [
        Improvement(
            change=near.change,
            chains=near.chains,
            actuate=near.actuate,
            coupling_degree=found.coupling_degree,
            redundant_constraints=found.redundant_constraints,
            zeros=zeros(found),
            better=tuple(_better(original, found)),
        )
        for near, found in tried
        if found is not None and any(_better(original, found))
    ]
    return tuple(sorted(better, key=_rank))


def _rank(improvement: Improvement) -> tuple[int, int, int]:
    redundant = improvement.redundant_constraints.joint_graph
    return -1 if improvement.coupling_degree is None else improvement.coupling_degree, redundant, -improvement.zeros


def _moved_alike(
    original: Topology, chains: Sequence[str], actuate: Sequence[str], mode: str | None
) -> Topology | None:
    """A neighbour's topology; None where it moves otherwise, its drives do not fix it, or nothing is known of it."""
    try:
        found = topology(chains, actuate=actuate, mode=mode)
    except AssurError:
        return None
    numbers = [(own.poc.t, own.poc.r, own.poc.dim, own.dof - own.internal_freedoms) for own in (original, found)]
    alike = all(map(_same, *((own.poc.t_mark, own.poc.r_mark) for own in (original, found))))
    return found if numbers[0] == numbers[1] and alike and found.coupling_degree is not None else None


def _same(first: Mark, second: Mark) -> bool:
    """Whether marks name the same fixed directions, or one of them names none."""
    if not (first.axes and second.axes):
        return True
    rows = [span(mark.axes) for mark in (first, second)]
    return len(rows[0]) == len(rows[1]) == int(np.linalg.matrix_rank(np.concatenate(rows), tol=1e-6))


def zeros(facts: Topology) -> int:
    """How many pairs of an output and an input have nothing to do with each other."""
    return sum(not used for row in facts.decoupling.depends for used in row) if facts.decoupling else 0


def _better(before: Topology, after: Topology) -> Iterator[str]:
    """What is better, in words."""
    redundant = [own.redundant_constraints.joint_graph for own in (before, after)]
    pairs = (
        ("κ", before.coupling_degree, after.coupling_degree),
        ("redundant", redundant[0], redundant[1]),
    )
    for name, old, new in pairs:
        if old is not None and new is not None and new < old:
            yield f"{name} {old} to {new}"
    if zeros(after) > zeros(before):
        yield f"zeros {zeros(before)} to {zeros(after)}"
