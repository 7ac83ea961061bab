"""Parallelograms of a linkage: which of them must be held, and which have crossed over."""

from __future__ import annotations

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from assur.topology.screws.linkage import Group, Linkage
from assur.topology.screws.screws import screw_tree

FloatArray = NDArray[np.float64]


CROSSED = 1e-6
"""Unit vectors along the short links of a parallelogram differ by more, where it has crossed over."""

UNSTEADY = ("P(4S)", "P(2US)")
"""Parallelograms that their own loop does not keep such."""


def crossed(linkage: Linkage, value: FloatArray) -> tuple[str, ...]:
    """Names of the parallelograms whose short links are not parallel at an assembly (n,): they have crossed over."""
    tree = screw_tree(linkage)
    frames = tree.at(value[None] / tree.scales).frames[0, :, :3, :3]

    def skew(group: Group) -> float:
        turned = frames[tree.frames[group.child]] - frames[tree.frames[group.parent]]
        return float(np.linalg.norm(turned @ short_side(linkage, group)))

    return tuple(group.name for group in linkage.groups.values() if skew(group) > CROSSED)


def held_parallelograms(linkage: Linkage, hold: bool) -> list[Group]:
    """The parallelograms that must be held such: if that is asked for, or if a single limb carries the platform."""
    groups = [group for group in linkage.groups.values() if group.kind in UNSTEADY]
    return groups if groups and (hold or _single_limb(linkage)) else []


def _single_limb(linkage: Linkage) -> bool:
    """Whether some joint, or some parallelogram as one joint, is the only connection of platform and base."""
    inside = {name for group in linkage.groups.values() for name in group.joints}
    ends = [(joint.parent, joint.child) for name, joint in linkage.joints.items() if name not in inside]
    ends += [(group.parent, group.child) for group in linkage.groups.values()]
    built: nx.MultiGraph[str] = nx.MultiGraph(ends)
    bridges = {frozenset(pair) for pair in nx.bridges(built)}
    rest: nx.Graph[str] = nx.Graph([pair for pair in ends if frozenset(pair) not in bridges])
    rest.add_nodes_from((linkage.base, linkage.platform))
    return not nx.has_path(rest, linkage.base, linkage.platform)


def short_side(linkage: Linkage, group: Group) -> FloatArray:
    """Unit vector (3,) from one hinge to the other on the near link, at home."""
    near = [name for name in group.joints if group.parent in (linkage.joints[name].parent, linkage.joints[name].child)]
    side: FloatArray = linkage.joints[near[1]].point - linkage.joints[near[0]].point
    return side / np.linalg.norm(side)
