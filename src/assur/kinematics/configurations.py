"""Configurations: which joint values are one, told by where joints are and which way slides point.

A leg may stand in two ways about the line through its joints' centres. Where its slide lies along that line both look
alike, and are one; where the slide is beside it, it points elsewhere, and they are two. Where on its line a file draws
a slide says nothing. What spins while inputs and platform stand, as a rod between ball joints, makes no other one.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames, screws
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.kinematics.turns import counted, periodic
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
SAME = 1e-5
"""Configurations whose joints are all nearer than this share of the characteristic length, or rad, are one."""

STEP, TURNED = 1e-6, 1e-9
"""A step along a spin, and by how much it turns a slide: in between are squares of the one and rounding."""


def distinct(record: MechanismRecord, joints: FloatArray) -> NDArray[np.intp]:
    """Indices of the first of each group of joint values (N, coordinates) that are one configuration."""
    return np.unique(numbered(record, joints), return_index=True)[1]


def numbered(record: MechanismRecord, joints: FloatArray) -> NDArray[np.intp]:
    """Which configuration (N,) each of joint values (N, coordinates) is, from 0 on in the order in which they are met.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> home = home_values(record)
    >>> numbered(record, np.stack([home, home + 0.1, home + 2.0 * np.pi])).tolist()
    [0, 1, 0]
    """
    where = places(record, joints)
    number = np.zeros(len(where), dtype=np.intp)
    if not len(where):
        return number
    widest = where[:, np.argmax(np.ptp(where, axis=0))]  # tells most of them apart alone
    firsts, count = np.zeros(len(where), dtype=np.intp), 0
    for k, place in enumerate(where):
        near = np.flatnonzero(~(np.abs(widest[firsts[:count]] - widest[k]) > SAME))
        gaps = np.max(np.abs(where[firsts[near]] - place), axis=-1)
        alike = near[gaps <= SAME]
        number[k] = alike[0] if len(alike) else count
        if not len(alike):
            firsts[count] = k
            count += 1
    return number


def places(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """Places (N, k) of all joints that turn and of the platform, directions of slides, inputs, counted turns.

    Lengths are in units of the characteristic length.
    """
    placed, length = frames(record, joints), characteristic_length(record)
    columns = []
    for joint in record.joints.values():
        if joint.type.turning:
            rotation, origin = placed[joint.parent]
            columns.append((rotation @ joint.at + origin) / length)
    rotation, origin = placed[record.platform.link]
    columns += [(rotation @ record.platform.point + origin) / length, rotation.reshape(len(joints), 9)]
    columns += [*np.moveaxis(_directions(record, joints)[:, :, _unspun_slides(record)], 2, 0)]
    for driven in record.drives:
        index = driven.coordinate.index
        value = joints[:, [index]]
        same = periodic(record)[index]
        columns += [np.cos(value), np.sin(value)] if same else [value / joint_scales(record)[index]]
    columns.append(joints[:, counted(record)])
    return np.concatenate(columns, axis=-1)


def _directions(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """Unit vectors (N, 3, s) of all slides, of cylindrical and planar joints too, in the base frame."""
    slides = [item.index for item in record.coordinates if item.kind == "length"]
    return screws(record, joints)[:, 3:, slides]


@lru_cache(maxsize=64)
def _unspun_slides(record: MechanismRecord) -> NDArray[np.intp]:
    """Places among the slides of those that no motion turns in which inputs and platform stand: without balls all."""
    count = sum(item.kind == "length" for item in record.coordinates)
    if not count or not any(joint.type.ball for joint in record.joints.values()):
        return np.arange(count)
    from assur.kinematics.rates.motions import SINGULAR, around_home, general, motions  # which others do without

    usual, near = general(record), around_home(record)
    if not int(usual.internal):
        return np.arange(count)
    ranks = motions(record, near).ranks
    near = near[(ranks.internal == usual.internal) & (ranks.closure == usual.closure)][:1]
    own = motions(record, near[0])
    _, sizes, right = np.linalg.svd(np.concatenate([own.twists, own.inputs]))
    standing = np.pad(sizes, (0, len(right) - len(sizes))) <= SINGULAR
    before, turned = _directions(record, near), np.zeros(count, dtype=bool)
    for spin in (own.null @ right[standing].T).T:
        after = _directions(record, near + STEP * own.scale * spin)
        turned |= np.max(np.abs(after - before), axis=(0, 1)) > TURNED
    return np.flatnonzero(~turned)
