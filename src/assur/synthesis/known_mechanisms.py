"""Known mechanisms among those that were found: the limbs of the catalogue's topologies in canonical form."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import cycle, permutations

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.structure import linkage
from assur.model.registry import load_record, names, topology_names
from assur.model.topologies import load_topology, means_topology
from assur.synthesis.home_constraints import constraints_of, home_twists
from assur.synthesis.isomorphism import Key, limb_key, mechanism_key
from assur.synthesis.limb_motions import CandidateLimb
from assur.synthesis.required import RequiredMotion
from assur.synthesis.shared_axes import sharing_ends, without_labels
from assur.synthesis.words import AXES
from assur.topology.chains import Chain, ChainJoint, Element
from assur.topology.counting.inputs import default_inputs, numbered_inputs
from assur.topology.directions import EXACT, NAMED
from assur.topology.screws.recognition import recognised


@cache
def known_mechanisms(motion: RequiredMotion) -> Mapping[Key, tuple[str, ...]]:
    """Names of built-in mechanisms by the canonical form of their limbs; how the limbs are placed makes no difference.

    Axes that a limb leaves general are taken along x, y and z in turn, as a synthesis writes them.

    One with an inner loop that does not stand first in its limb is left out.

    >>> from assur.synthesis.required import MOTIONS
    >>> sorted(name for names in known_mechanisms(MOTIONS["3T"]).values() for name in names if "glide" in name)
    ['orthoglide']
    """
    names_by_key: dict[Key, list[str]] = defaultdict(list)
    for name in dict.fromkeys((*topology_names(), *names())):
        key = _key(limbs_of(name), motion)
        if key is not None:
            names_by_key[key].append(name)
    return {key: tuple(names) for key, names in names_by_key.items()}


@dataclass(frozen=True)
class PlacedLimbs:
    """A built-in mechanism, with how its limbs stand to each other.

    Attributes:
        name: of the mechanism.
        chains: its limbs.
        keys: canonical form of each limb, without what it shares with others.
    """

    name: str
    chains: tuple[Chain, ...]
    keys: tuple[Key, ...]

    @property
    def key(self) -> Key:
        """Canonical form of all limbs."""
        return mechanism_key(self.keys)

    def is_like(self, limbs: Sequence[CandidateLimb], chains: Sequence[Chain]) -> bool:
        """Whether limbs, that stand as chains, are the same, at the same angles to each other, on the same lines."""
        keys = [limb.type.key for limb in limbs]
        if mechanism_key(keys) != self.key:
            return False
        orders = permutations(range(len(keys)))
        fitting = (order for order in orders if tuple(keys[place] for place in order) == self.keys)
        return any(_stand_alike(self.chains, [chains[place] for place in order]) for order in fitting)


@cache
def known_by_directions(motion: RequiredMotion) -> tuple[PlacedLimbs, ...]:
    """Built-in mechanisms whose limbs are series, to be compared with others also by how the limbs are placed.

    >>> from assur.synthesis.required import PARASITIC
    >>> "three_rps" in [known.name for known in known_by_directions(PARASITIC["1T2R"])]
    True
    """
    found = []
    for name in dict.fromkeys((*topology_names(), *names())):
        limbs = limbs_of(name)
        if all(isinstance(joint, ChainJoint) for limb in limbs for joint in limb.chain.elements):
            found.append(placed_limbs(name, limbs, motion))
    return tuple(found)


def placed_limbs(name: str, limbs: Sequence[DrivenLimb], motion: RequiredMotion) -> PlacedLimbs:
    """Limbs as they stand, to be compared with those of a motion."""
    keys = tuple(limb_key(upright_axes(without_labels(limb.chain)), motion, limb.driven) for limb in limbs)
    return PlacedLimbs(name, tuple(limb.chain for limb in limbs), keys)


def _stand_alike(first: Sequence[Chain], second: Sequence[Chain]) -> bool:
    """Whether the constraints of limbs have the same angles, senses forgotten, and the same limbs share lines."""
    shared = [[sharing_ends(chain) for chain in chains] for chains in (first, second)]
    return shared[0] == shared[1] and np.allclose(_angles(first), _angles(second), atol=EXACT)


def _angles(chains: Sequence[Chain]) -> NDArray[np.float64]:
    """How far forces and couples of each limb at home are along those of each other one, (2, n, n)."""
    at_home = [constraints_of(home_twists(without_labels(chain), np.eye(3), 1)) for chain in chains]
    bases = ([one.forces for one in at_home], [one.couples for one in at_home])
    return np.array([[[np.linalg.norm(mine.T @ other) for other in kind] for mine in kind] for kind in bases])


@dataclass(frozen=True)
class DrivenLimb:
    """A limb, and the indices of its driven joints, branches flattened."""

    chain: Chain
    driven: tuple[int, ...]


def limbs_of(name: str) -> tuple[DrivenLimb, ...]:
    """The limbs of a topology or of a mechanism, by its name or file, as they are driven there.

    Errors:
        UnknownNameError, UsageError, MechanismFileError: as `load_topology` and `load_record`.

    >>> [limb.driven for limb in limbs_of("three_upu")], [limb.driven for limb in limbs_of("zeng2019")]
    ([(1,), (1,), (1,)], [(0, 3), (0,)])
    """
    if means_topology(name):
        described = load_topology(name)
        numbers = [f"{limb}.{joint}" for limb, joint in described.actuate]
        return limbs_driven_by(described.chains, numbers)
    built = linkage(load_record(name))
    hinges = {joint: group.name for group in built.groups.values() for joint in group.joints}
    return _driven(recognised(built) or (), [hinges.get(joint, joint) for joint, _ in built.inputs])


def limbs_driven_by(chains: Sequence[Chain], numbers: Sequence[str] = ()) -> tuple[DrivenLimb, ...]:
    """Chains with the joints driven that are numbered "limb.joint", or else the first ones of each branch."""
    return _driven(chains, numbered_inputs(chains, numbers) if numbers else default_inputs(chains))


def _driven(chains: Sequence[Chain], names: Sequence[str]) -> tuple[DrivenLimb, ...]:
    return tuple(
        DrivenLimb(chain, tuple(place for place, joint in enumerate(chain.joints) if joint.name in names))
        for chain in chains
    )


def upright_axes(chain: Chain) -> Chain:
    """The chain with its general axes along x, y and z in turn."""
    turn = cycle(NAMED[name] for name in AXES)

    def joint(old: Element) -> Element:
        if isinstance(old, ChainJoint) and old.general:
            return replace(old, axes=tuple(next(turn) for _ in old.axes))
        return old

    return Chain(tuple(map(joint, chain.elements)), chain.text)


def _key(limbs: Sequence[DrivenLimb], motion: RequiredMotion) -> Key | None:
    try:
        return (
            mechanism_key(limb_key(upright_axes(limb.chain), motion, limb.driven) for limb in limbs) if limbs else None
        )
    except UsageError:  # an inner loop that does not stand first
        return None
