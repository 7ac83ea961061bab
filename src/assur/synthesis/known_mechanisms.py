"""Known mechanisms among those that were found: the limbs of the catalogue's topologies in canonical form."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping

from assur.errors import UsageError
from assur.model.registry import topology_names
from assur.model.topologies import load_topology
from assur.model.topology_description import TopologyDescription
from assur.synthesis.isomorphism import Key, limb_key, mechanism_key
from assur.synthesis.required import RequiredMotion
from assur.topology.chains import Chain
from assur.topology.counting.inputs import default_inputs


def known_mechanisms(motion: RequiredMotion) -> Mapping[Key, tuple[str, ...]]:
    """Names of built-in topologies by the canonical form of their limbs; how the limbs are placed makes no difference.

    A topology with an inner loop, or driven otherwise than by one joint in each limb, is left out.

    >>> from assur.synthesis.required import MOTIONS
    >>> sorted(name for names in known_mechanisms(MOTIONS["3T"]).values() for name in names if "glide" in name)
    ['orthoglide']
    """
    names_by_key: dict[Key, list[str]] = defaultdict(list)
    for name in topology_names():
        key = _key(load_topology(name), motion)
        if key is not None:
            names_by_key[key].append(name)
    return {key: tuple(names) for key, names in names_by_key.items()}


def _key(described: TopologyDescription, motion: RequiredMotion) -> Key | None:
    driven = _driven(described)
    if driven is None:
        return None
    try:
        return mechanism_key(
            limb_key(chain, motion, index) for chain, index in zip(described.chains, driven, strict=True)
        )
    except UsageError:  # an inner loop
        return None


def _driven(described: TopologyDescription) -> list[int] | None:
    """Index of the driven joint of each limb, None unless there is one in each."""
    if described.actuate:
        places = {limb: joint - 1 for limb, joint in described.actuate}
        if len(places) < len(described.actuate):
            return None
        return [places[number] for number in sorted(places)] if len(places) == len(described.chains) else None
    driven = [_first_driven(chain) for chain in described.chains]
    return [index for index in driven if index is not None] if None not in driven else None


def _first_driven(chain: Chain) -> int | None:
    names = default_inputs([chain])
    places = [index for index, joint in enumerate(chain.joints) if joint.name in names]
    return places[0] if len(places) == 1 else None
