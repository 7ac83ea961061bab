"""Whether a drafted file has the topology of its chains: the facts that must be equal."""

from __future__ import annotations

from typing import Any

from assur.topology.facts import Topology

MOTION = "POC set"
"""The fact that special lengths decide, where loops close without them too."""


def facts(topology: Topology) -> dict[str, Any]:
    """What must not depend on dimensions, by the name under which a person knows it.

    >>> from assur.kinematics.structure import linkage
    >>> from assur.model.registry import load_record
    >>> from assur.topology.analysis import analyse
    >>> facts(analyse(linkage(load_record("zeng2019"))))["coupling degree"]
    1
    """
    redundant = topology.redundant_constraints
    return {
        MOTION: (topology.poc.t, topology.poc.r, topology.poc.dim),
        "degree of freedom": topology.dof,
        "internal freedoms": topology.internal_freedoms,
        "equations of the loops": tuple(sorted(topology.xi)),
        "coupling degree": topology.coupling_degree,
        "redundant constraints": (redundant.collapsed, redundant.joint_graph),
        "POC sets of the limbs": tuple(sorted((limb.poc.t, limb.poc.r, limb.poc.dim) for limb in topology.limbs)),
    }


def differences(of_chains: Topology, of_file: Topology) -> tuple[str, ...]:
    """Each fact of a file that is not that of its chains, in words."""
    asked, given = facts(of_chains), facts(of_file)
    return tuple(
        f"{name} {given[name]}, that of the chains is {value}" for name, value in asked.items() if given[name] != value
    )
