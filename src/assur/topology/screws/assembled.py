"""A linkage seen from another of its assemblies: the same joints, with that one for home."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from assur.topology.screws.linkage import Linkage, LinkageJoint
from assur.topology.screws.screws import screw_tree

FloatArray = NDArray[np.float64]


def assembled_at(linkage: Linkage, values: FloatArray, crossed: Collection[str] = ()) -> Linkage:
    """The linkage whose home is the assembly at joint values (n,), rad and lengths from the old home.

    Args:
        linkage: any.
        values: of its joints, in their order; the loops must be closed there.
        crossed: parallelograms that have crossed over there; their joints then count each by itself.

    Example: a crank a quarter turn on, and its rod's hinge with it.

    >>> from assur.topology.screws.placing import place
    >>> from assur.topology.notation import parse_chains
    >>> built = place(parse_chains(["R[z] R[z] R[z]"] * 2))
    >>> moved = assembled_at(built, np.zeros(6))
    >>> bool(np.allclose(moved.joints["R2"].screws, built.joints["R2"].screws))
    True
    """
    tree = screw_tree(linkage)
    placed = tree.at((values / tree.scales)[None])
    omega, velocity = placed.twists[0, :3].T, placed.twists[0, 3:].T  # (n, 3) each, at O' of home, in lengths
    turning = np.any(omega != 0.0, axis=1, keepdims=True)
    at_origin = np.where(turning, linkage.length * velocity - np.cross(omega, linkage.point), velocity)
    screws = np.concatenate([omega, at_origin], axis=1)

    def moved(link: str, point: FloatArray) -> FloatArray:
        frame = placed.frames[0, tree.frames[link]]
        away = frame[:3, :3] @ ((point - linkage.point) / linkage.length) + frame[:3, 3]
        return np.asarray(linkage.point + linkage.length * away)

    joints: dict[str, LinkageJoint] = {}
    for name, joint in linkage.joints.items():
        point = moved(joint.parent, joint.point)
        own = screws[linkage.slices[name]]
        if joint.type.ball:  # about three axes at right angles again
            own = np.hstack([np.eye(3), np.cross(point, np.eye(3))])
        joints[name] = replace(joint, screws=own, point=point)
    groups = {name: group for name, group in linkage.groups.items() if name not in crossed}
    return replace(linkage, joints=joints, point=moved(linkage.platform, linkage.point), groups=groups)
