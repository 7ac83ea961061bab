"""Whether a drafted file has the topology of its chains: the facts that must be equal."""

from __future__ import annotations

from typing import Any

from assur.topology.facts import Topology


def facts(found: Topology) -> dict[str, Any]:
    """What must not depend on dimensions, by the name under which a person knows it.

    >>> from assur.kinematics.structure import linkage
    >>> from assur.model.registry import load_record
    >>> from assur.topology.analysis import analyse
    >>> facts(analyse(linkage(load_record("zeng2019"))))["coupling degree"]
    1
    """
    redundant = found.redundant_constraints
    return {
        "POC set": (found.poc.t, found.poc.r, found.poc.dim),
        "degree of freedom": found.dof,
        "internal freedoms": found.internal_freedoms,
        "equations of the loops": tuple(sorted(found.xi)),
        "coupling degree": found.coupling_degree,
        "redundant constraints": (redundant.collapsed, redundant.joint_graph),
        "POC sets of the limbs": tuple(sorted((limb.poc.t, limb.poc.r, limb.poc.dim) for limb in found.limbs)),
    }


def differences(wanted: Topology, found: Topology) -> tuple[str, ...]:
    """Each fact of a file that is not that of its chains, in words."""
    asked, given = facts(wanted), facts(found)
    return tuple(
        f"{name} {given[name]}, that of the chains is {value}" for name, value in asked.items() if given[name] != value
    )
