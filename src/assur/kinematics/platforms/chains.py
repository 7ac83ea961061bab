"""A chain closed by its middle link: what either half leaves of this link, and then each half alone.

So a limb closes of which no point stays in place, and a single loop; six turns in general have sixteen ways (H.-Y. Lee,
C.-G. Liang 1988; M. Husty, M. Pfurner, H.-P. Schröcker 2007).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.kinematics.limbs.point_closure import MovingLimbError
from assur.kinematics.limbs.serial import (
    ElementaryMotion,
    NotSerialError,
    SerialLimb,
    composed,
    displacement,
    inverted,
)
from assur.kinematics.limbs.solving import LimbSolutions, limb_solutions, size_of, told_apart
from assur.kinematics.platforms.conditions import joined, series_conditions
from assur.kinematics.platforms.poses import poses_under
from assur.numerics.rotations import cross

FloatArray = NDArray[np.float64]
FREEDOMS = 6
STRAIGHT = 1e-9
"""Sine or cosine of an angle between axes up to which it is rounding."""


def closed_series(limb: SerialLimb, platform: Frame, driven: Collection[int] = ()) -> LimbSolutions:
    """All ways in which a limb closes at a frame of the platform: about a point of it, else by its middle link.

    Errors:
        NotSerialError: it has more than six freedoms or a single motion, or a half of it closes in neither way.
        MovingLimbError: it closes in infinitely many ways.
        UncertainConditionsError: what a half allows cannot be told from rounding.

    >>> from assur.kinematics.limbs.networks import limbs_of
    >>> from assur.model.registry import load_record
    >>> limb = limbs_of(load_record("planar_3rrr"))[0]
    >>> len(closed_series(limb, (np.eye(3), np.zeros(3))).values)
    2
    """
    advanced = _screw_that_shifts(limb, platform)
    if advanced:
        ((index, value),) = advanced.items()
        return closed_series(held_series(limb, advanced), platform, driven).with_value(limb, index, value)
    try:
        return limb_solutions(limb, platform, driven)
    except NotSerialError:
        if sum(map(freedoms, limb.motions)) > FREEDOMS or len(limb.motions) < 2:
            raise
    return _by_middle(limb, platform, driven)


def _screw_that_shifts(limb: SerialLimb, platform: Frame) -> dict[int, float]:
    """Index -> value of its one screw, if nothing else shifts the platform along the screw's axis."""
    screws = [motion for motion in limb.motions if motion.kind == "screw"]
    if len(screws) != 1:
        return {}
    (screw,) = screws
    if not all(_keeps_along(motion, screw.axis) for motion in limb.motions if motion is not screw):
        return {}
    rotation, shift = composed(platform, inverted(limb.zero))
    away = rotation @ screw.point + shift - screw.point
    return {screw.index: float(screw.sense * (away @ screw.axis) / screw.advance)}


def _keeps_along(motion: ElementaryMotion, axis: FloatArray) -> bool:
    """Whether a motion shifts nothing along an axis."""
    if motion.kind == "slide":
        return bool(abs(motion.axis @ axis) < STRAIGHT)
    return motion.kind == "turn" and bool(np.linalg.norm(cross(motion.axis, axis)) < STRAIGHT)


def held_series(limb: SerialLimb, held: Mapping[int, float]) -> SerialLimb:
    """A limb with held joint values, as one of its other motions alone."""
    motions: list[ElementaryMotion] = []
    before: Frame = (np.eye(3), np.zeros(3))
    for motion in limb.motions:
        if motion.index in held:
            before = composed(before, displacement(motion, np.asarray(held[motion.index])))
        else:
            motions.append(motion.moved(*before))
    return replace(limb, motions=tuple(motions), zero=composed(before, limb.zero))


def loop_of(first: SerialLimb, second: SerialLimb) -> SerialLimb:
    """Two limbs as one from the base to the platform and back, which closes where its end is at the base."""
    zero = composed(first.zero, inverted(second.zero))
    back = [motion.moved(*zero).back for motion in reversed(second.motions)]
    length = max(first.length, second.length)
    return SerialLimb(first.joints + second.joints[::-1], (*first.motions, *back), zero, length)


def freedoms(motion: ElementaryMotion) -> int:
    """How many joint values a motion has."""
    return 3 if motion.kind == "ball" else 1


def _by_middle(limb: SerialLimb, platform: Frame, driven: Collection[int]) -> LimbSolutions:
    motions = limb.motions
    whole, size = [freedoms(motion) for motion in motions], size_of(motions, limb.length)
    cut = min(range(1, len(motions)), key=lambda k: max(sum(whole[:k]), sum(whole[k:])))
    halves = (
        replace(limb, motions=motions[:cut], zero=(np.eye(3), np.zeros(3))),
        replace(limb, motions=motions[cut:]).from_platform(platform),
    )
    poses = poses_under(joined(series_conditions(half, size) for half in halves), size)
    if poses is None:
        raise MovingLimbError
    if not poses.sure:
        raise NotSerialError(f"{', '.join(limb.joints)}: roots are too near to tell them")
    indices = sorted(index for motion in motions for index in motion.indices)
    rows, bent = [np.zeros(0)][:0], list[float]()
    for frame in poses.frames:
        sets = [limb_solutions(half, frame) for half in halves]
        for near, far in product(*(range(len(own.values)) for own in sets)):
            rows.append(_row(indices, sets, (near, far)))
            bent.append(max(own.bent[k] for own, k in zip(sets, (near, far), strict=True)))
    values = np.array(rows).reshape(len(rows), len(indices))
    kept = told_apart(limb, values, np.array(bent), driven)
    return LimbSolutions(limb, tuple(indices), values[kept], np.array(bent)[kept], poses.complex)


def _row(indices: Sequence[int], sets: Sequence[LimbSolutions], chosen: Sequence[int]) -> FloatArray:
    row = np.empty(len(indices))
    for own, k in zip(sets, chosen, strict=True):
        row[[indices.index(index) for index in own.indices]] = own.values[k]
    return row
