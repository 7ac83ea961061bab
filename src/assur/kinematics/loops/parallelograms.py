"""Parallelograms of rods: those that the file names, and pairs of equal rods between the same two links.

Two rods on ball joints, or on universal joints at one end, that join the same two links and are equal and parallel at
home have another assembly, in which they cross; both a file's parallelograms and those recognised here are taken to
stay such unless crossed ones are asked for.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import lru_cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import point, points
from assur.kinematics.home import home_values
from assur.model.mechanism import GeneralisedJoint, Joint, MechanismRecord
from assur.numerics.rotations import cross

FloatArray = NDArray[np.float64]
PARALLEL = 1e-9
"""Share of the characteristic length by which equal vectors between joints may differ at home."""
CROSSED = 1e-5
"""Share of it by which the four joints of a parallelogram may differ from one: more than assemblies are off."""


@lru_cache(maxsize=64)
def parallelograms(record: MechanismRecord) -> Mapping[str, GeneralisedJoint]:
    """The file's generalised joints, and the pairs of rods that are parallelograms at home, called "rod1/rod2".

    >>> from assur.model.registry import load_record
    >>> list(parallelograms(load_record("delta_4s")))
    ['leg1.Pa', 'leg2.Pa', 'leg3.Pa']
    """
    known = {joint for group in record.generalised.values() for joint in group.joints}
    found = dict(record.generalised)
    for first, second in combinations(_rods(record), 2):
        group = _pair(record, first, second)
        if group is not None and not known & {*group.joints}:
            found[group.name] = group
    return found


def crossed_parallelograms(record: MechanismRecord, joints: FloatArray) -> tuple[str, ...]:
    """Names of the parallelograms whose four joints are none at joint values (n,).

    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> crossed_parallelograms(record, home_values(record))
    ()
    """
    shares = _open(record, parallelograms(record).values(), joints)
    return tuple(name for name, share in zip(parallelograms(record), shares, strict=True) if share > CROSSED)


def some_crossed(record: MechanismRecord, joints: FloatArray) -> NDArray[np.bool_]:
    """Whether a parallelogram's four joints are none (N,) at joint values (N, n)."""
    return np.asarray(np.any(_open(record, parallelograms(record).values(), joints) > CROSSED, axis=-1))


def _open(record: MechanismRecord, groups: Collection[GeneralisedJoint], joints: FloatArray) -> FloatArray:
    """By how much four joints of each miss being a parallelogram (..., k) at joint values (..., n), in lengths."""
    placed = points(record, {name for group in groups for name in group.joints}, joints)
    corners = [[placed[name] for name in group.joints] for group in groups]
    gaps = np.array([first - second + third - fourth for first, second, third, fourth in corners])
    shares = np.linalg.norm(gaps.reshape(len(corners), *joints.shape[:-1], 3), axis=-1) / characteristic_length(record)
    return np.moveaxis(shares, 0, -1)


Rod = tuple[str, tuple[Joint, Joint]]


def _rods(record: MechanismRecord) -> list[Rod]:
    """Links, in the order of their names, on two joints that leave nothing but a direction and a spin."""
    found = []
    for link in sorted(record.links):
        joints = [joint for joint in record.joints.values() if link in (joint.parent, joint.child)]
        balls = sum(joint.type.ball for joint in joints)
        if len(joints) == 2 and balls and all(joint.type.ball or joint.type.turns == 2 for joint in joints):
            found.append((link, (joints[0], joints[1])))
    return found


def _pair(record: MechanismRecord, first: Rod, second: Rod) -> GeneralisedJoint | None:
    """Two rods that are opposite sides of a parallelogram at home."""
    ends = [{_other(joint, link): joint for joint in joints} for link, joints in (first, second)]
    if len(ends[0]) < 2 or ends[0].keys() != ends[1].keys():
        return None
    near, far = ends[0]
    around = (ends[0][near], ends[0][far], ends[1][far], ends[1][near])
    if around[0].type.ball != around[3].type.ball or around[1].type.ball != around[2].type.ball:
        return None
    kind = "P(4S)" if all(joint.type.ball for joint in around) else "P(2US)"
    group = GeneralisedJoint(f"{first[0]}/{second[0]}", kind, tuple(joint.name for joint in around), near, far)
    home = home_values(record)
    corner, along, _, across = (point(record, joint.name, home) for joint in around)
    area = np.linalg.norm(cross(along - corner, across - corner)) / characteristic_length(record) ** 2
    return group if area > PARALLEL and _open(record, (group,), home)[0] < PARALLEL else None


def _other(joint: Joint, link: str) -> str:
    return joint.child if joint.parent == link else joint.parent
