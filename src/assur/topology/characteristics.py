"""The table of characteristics: what a reader compares mechanisms by, one short line each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from assur.results.plain_text import count, signed
from assur.topology.facts import Topology

FREEDOM = {
    "full": "one Assur chain has all drives",
    "partial": "several Assur chains that hang together have them",
    "separable": "drives of parts that do not hang together",
}

SETS = 3
"""Admissible sets that are written out."""

KINDS = {"full": "full", "partial": "partial", "none": "coupled throughout"}


class Characteristic(NamedTuple):
    """A row: its name, and what is said."""

    name: str
    text: str


def characteristics(topology: Topology) -> tuple[Characteristic, ...]:
    """The rows in the order of the theory; one that says nothing of this mechanism is left out."""
    rows = (
        ("POC set", _poc(topology)),
        ("motion", _motion(topology)),
        ("parasitic", _parasitic(topology)),
        ("DOF", _freedoms(topology)),
        ("loops", _loops(topology)),
        ("coupling", _coupling(topology)),
        ("Assur chains", _assur_chains(topology)),
        ("redundant", _redundant(topology)),
        ("relaxed", _relaxed(topology)),
        ("passive", _listed(topology.passive_joints)),
        ("idle", _listed(topology.idle_joints)),
        ("drives", _drives(topology)),
        ("decoupling", _decoupling(topology)),
        ("limbs alike", _alike(topology.alike)),
        ("conditions", _conditions(topology)),
    )
    return tuple(Characteristic(name, text) for name, text in rows if text)


def _poc(topology: Topology) -> str:
    poc = topology.poc
    dependent = f", {poc.dependent} of {poc.t + poc.r} dependent" if poc.dependent else ""
    return f"{poc}: dim {poc.dim}{dependent}"


def _motion(topology: Topology) -> str:
    other = topology.translating_type
    points = f"; {other} by the translations of a general point" if other != topology.motion_type else ""
    return f"{topology.motion_type}{points}"


def _parasitic(topology: Topology) -> str:
    number = topology.parasitic
    if number is None:
        return ""
    return f"{number}: at no point of the platform are fewer elements dependent" if number else "none"


def _freedoms(topology: Topology) -> str:
    """With Eq. (3) in numbers, where every joint is in a loop."""
    internal = f", {topology.internal_freedoms} of them internal" if topology.internal_freedoms else ""
    freedoms = [loop.freedoms for loop in topology.loops]
    if not topology.loops or sum(freedoms) - sum(topology.xi) != topology.dof:
        return f"F = {topology.dof}{internal}"
    if len(freedoms) == 1:
        return f"F = {topology.dof} = {freedoms[0]} - {topology.xi[0]}{internal}"
    sums = (" + ".join(map(str, numbers)) for numbers in (freedoms, topology.xi))
    return f"F = {topology.dof} = {' - '.join(f'({part})' for part in sums)}{internal}"


def _loops(topology: Topology) -> str:
    said = "; ".join(f"ξ{k} = {loop.xi}, Δ{k} = {signed(loop.delta)}" for k, loop in enumerate(topology.loops, 1))
    return f"{len(topology.loops)}" + (f": {said}" if said else "")


def _coupling(topology: Topology) -> str:
    if topology.coupling_degree is None:
        return f"none: {topology.coupling_refusal}"
    freedom = f"; {topology.freedom_type} freedom: {FREEDOM[topology.freedom_type]}" if topology.freedom_type else ""
    return f"κ = {topology.coupling_degree}{freedom}"


def _assur_chains(topology: Topology) -> str:
    return "; ".join(
        f"({number}) {'loop' if len(chain.loops) == 1 else 'loops'} "
        f"{', '.join(str(index + 1) for index in chain.loops)}, κ = {chain.coupling_degree}"
        for number, chain in enumerate(topology.assur_chains, 1)
    )


def _redundant(topology: Topology) -> str:
    constraints = topology.redundant_constraints
    return f"{constraints.collapsed} with parallelograms as one joint, {constraints.joint_graph} of all joints"


def _relaxed(topology: Topology) -> str:
    """How redundant constraints are removed."""
    if topology.is_shaky or not topology.relaxation.redundant:
        return ""
    asked = topology.relaxation
    steps = ", ".join(f"{step.joint} to {step.new}" for step in asked.together)
    return f"{steps}: leaves {asked.left} of {asked.redundant}" if steps else "by no joint"


def _listed(names: Sequence[str]) -> str:
    return ", ".join(names) or "none"


def _drives(topology: Topology) -> str:
    if not topology.loops and topology.decoupling is None:
        return ""
    asked = topology.actuation
    sets = [f"({', '.join(names)})" for names in asked.sets]
    more = f" and {len(sets) - SETS} more" if len(sets) > SETS else ""
    admissible = f"; admissible, near the base first: {', '.join(sets[:SETS])}{more}" if any(asked.sets) else ""
    return f"{_listed(asked.inputs)}: {asked.verdict}{admissible}"


def _decoupling(topology: Topology) -> str:
    matrix = topology.decoupling
    if matrix is None:
        return ""
    rows = zip(matrix.outputs, matrix.depends, strict=True)
    fewer = [f"{output} by {' '.join(matrix.inputs_of(output))}" for output, row in rows if not all(row)]
    return f"{KINDS[matrix.kind]}{': ' if fewer else ''}{', '.join(fewer)}"


def _alike(groups: Sequence[Sequence[int]]) -> str:
    several = [group for group in groups if len(group) > 1]
    if len(groups) == 1 and several:
        return f"all {count(len(several[0]), 'limb')}"
    return ", ".join(" and ".join(map(str, group)) for group in several)


def _conditions(topology: Topology) -> str:
    needed = topology.conditions
    return "" if needed is None else "; ".join(needed) or "none"
