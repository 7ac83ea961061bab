"""Known mechanisms among those that were found: the limbs of the catalogue's topologies in canonical form."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence

from assur.errors import UsageError
from assur.kinematics.structure import linkage
from assur.model.mechanism import MechanismRecord
from assur.model.registry import load_record, names, topology_names
from assur.model.topologies import load_topology
from assur.model.topology_description import TopologyDescription
from assur.synthesis.isomorphism import Key, limb_key, mechanism_key
from assur.synthesis.required import RequiredMotion
from assur.topology.chains import Chain
from assur.topology.counting.inputs import default_inputs, numbered_inputs
from assur.topology.screws.recognition import recognised


def known_mechanisms(motion: RequiredMotion) -> Mapping[Key, tuple[str, ...]]:
    """Names of built-in mechanisms by the canonical form of their limbs; how the limbs are placed makes no difference.

    One with an inner loop that does not stand first in its limb is left out.

    >>> from assur.synthesis.required import MOTIONS
    >>> sorted(name for names in known_mechanisms(MOTIONS["3T"]).values() for name in names if "glide" in name)
    ['orthoglide']
    """
    names_by_key: dict[Key, list[str]] = defaultdict(list)
    described = {name: _of_topology(load_topology(name)) for name in topology_names()}
    described |= {name: _of_record(load_record(name)) for name in names() if name not in described}
    for name, (chains, driven) in described.items():
        key = _key(chains, driven, motion)
        if key is not None:
            names_by_key[key].append(name)
    return {key: tuple(names) for key, names in names_by_key.items()}


_Driven = tuple[Sequence[Chain], Sequence[str]]
"""Limbs, and the names of their driven joints."""


def _of_topology(described: TopologyDescription) -> _Driven:
    numbers = [f"{limb}.{joint}" for limb, joint in described.actuate]
    inputs = numbered_inputs(described.chains, numbers) if numbers else default_inputs(described.chains)
    return described.chains, inputs


def _of_record(record: MechanismRecord) -> _Driven:
    built = linkage(record)
    hinges = {joint: group.name for group in built.groups.values() for joint in group.joints}
    return recognised(built) or (), [hinges.get(joint, joint) for joint, _ in built.inputs]


def _key(chains: Sequence[Chain], driven: Sequence[str], motion: RequiredMotion) -> Key | None:
    try:
        return mechanism_key(
            limb_key(chain, motion, [place for place, joint in enumerate(chain.joints) if joint.name in driven])
            for chain in chains
        )
    except UsageError:  # an inner loop that does not stand first
        return None
