"""What a limb says of the platform, and all ways in which it closes: a series of joints, or a network of parts."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial, reduce
from itertools import product
from math import prod

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.kinematics.limbs.networks import Limb, ParallelParts, SeriesParts, from_platform, series_changed
from assur.kinematics.limbs.point_closure import MovingLimbError
from assur.kinematics.limbs.serial import NotSerialError, SerialLimb
from assur.kinematics.limbs.solving import LimbSolutions
from assur.kinematics.platforms.chains import closed_series, held_series
from assur.kinematics.platforms.conditions import (
    SAMPLES,
    Conditions,
    conditions_of,
    joined,
    orientation_conditions,
    series_conditions,
    series_points,
)
from assur.kinematics.platforms.poses import poses_under
from assur.kinematics.platforms.soma import SIZE, composed_soma

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
MOST_SECTIONS = 2 * SAMPLES


def held_limb(limb: Limb, held: Mapping[int, float]) -> Limb:
    """A limb with held joint values."""
    return series_changed(limb, partial(held_series, held=held))


def limb_conditions(limb: Limb, size: float) -> Conditions:
    """Linear forms and quadrics that are zero at all poses that a limb allows; places are in lengths `size`.

    Errors:
        UncertainConditionsError: they cannot be told from rounding.
        NotSerialError: parts side by side leave the link where they meet nothing.

    >>> from assur.kinematics.limbs.networks import limbs_of
    >>> from assur.model.registry import load_record
    >>> limb = limbs_of(load_record("gough_stewart"))[0]
    >>> [len(limb_conditions(held_limb(limb, held), 1.0).quadrics) for held in ({}, {2: 1.0})]
    [0, 1]
    """
    if isinstance(limb, SerialLimb):
        return series_conditions(limb, size)
    if isinstance(limb, ParallelParts):
        kept = [] if limb.turned is None else [orientation_conditions(limb.turned)]
        return joined([*kept, *(limb_conditions(part, size) for part in limb.parts)])
    return conditions_of(_points(limb, size, np.random.default_rng(4)))


def closed_limb(limb: Limb, platform: Frame, size: float, driven: Collection[int] = ()) -> LimbSolutions:
    """All ways in which a limb closes at a frame of the platform.

    Errors:
        NotSerialError: it is not solved in this way.
        MovingLimbError: it closes in infinitely many ways.
        UncertainConditionsError: what a part of it allows cannot be told from rounding.
    """
    if isinstance(limb, SerialLimb):
        return closed_series(limb, platform, driven)
    if isinstance(limb, ParallelParts):
        return _product(limb, [[closed_limb(part, platform, size, driven) for part in limb.parts]])
    for place in range(1, len(limb.parts)):
        near, far = limb.halves(place)
        back = from_platform(far, platform)
        poses = poses_under(joined(limb_conditions(half, size) for half in (near, back)), size)
        if poses is not None:
            break
    else:
        raise MovingLimbError
    if not poses.sure:
        raise NotSerialError(f"{', '.join(limb.joints)}: roots are too near to tell them")
    sets = [[closed_limb(half, frame, size, driven) for half in (near, back)] for frame in poses.frames]
    return replace(_product(limb, sets), roots=poses.complex)


def _product(limb: ParallelParts | SeriesParts, sets: Sequence[Sequence[LimbSolutions]]) -> LimbSolutions:
    """All choices of one way a part, of each of several sets of ways."""
    indices = tuple(sorted(_indices(limb)))
    rows = [row for parts in sets for row in _choices(parts, indices)]
    values = np.array([values for values, _ in rows]).reshape(len(rows), len(indices))
    roots = sum(prod(own.roots for own in parts) for parts in sets)
    return LimbSolutions(limb, indices, values, np.array([bent for _, bent in rows]), roots)


def _indices(limb: Limb) -> Iterator[int]:
    if isinstance(limb, SerialLimb):
        yield from (index for motion in limb.motions for index in motion.indices)
    else:
        for part in limb.parts:
            yield from _indices(part)


def _choices(parts: Sequence[LimbSolutions], indices: tuple[int, ...]) -> Iterator[tuple[FloatArray, float]]:
    """Values of all series, one way each, and by how much their roots were made real."""
    for chosen in product(*(range(len(own.values)) for own in parts)):
        row, bent = np.empty(len(indices)), 0.0
        for own, k in zip(parts, chosen, strict=True):
            row[[indices.index(index) for index in own.indices]] = own.values[k]
            bent = max(bent, float(own.bent[k]))
        yield row, bent


def _points(limb: Limb, size: float, rng: np.random.Generator) -> ComplexArray:
    """Soma (SAMPLES, 8), complex ones too, of poses by chance that a limb allows."""
    if isinstance(limb, SerialLimb):
        return series_points(limb, size, SAMPLES, rng).astype(complex)
    if isinstance(limb, SeriesParts):
        return reduce(composed_soma, (_points(part, size, rng) for part in limb.parts))
    conditions = limb_conditions(limb, size)
    for freedoms in range(SIZE - 2, -1, -1):
        points = _section(conditions, freedoms, rng)
        if len(points):
            break
    else:
        raise NotSerialError("parts side by side leave the link where they meet nothing")
    if not freedoms:
        return points[np.arange(SAMPLES) % len(points)]
    for _ in range(MOST_SECTIONS):
        if len(points) >= SAMPLES:
            return points[:SAMPLES]
        points = np.concatenate([points, _section(conditions, freedoms, rng)])
    raise NotSerialError("parts side by side leave the link where they meet too little")


def _section(conditions: Conditions, freedoms: int, rng: np.random.Generator) -> ComplexArray:
    """Poses (K, 8) on as many planes by chance."""
    planes = np.linalg.qr(rng.normal(size=(SIZE, freedoms)))[0].T
    linear = np.linalg.qr(np.concatenate([conditions.linear, planes]).T)[0].T
    if len(linear) >= SIZE:
        return np.zeros((0, SIZE), dtype=complex)
    poses = poses_under(Conditions(linear, conditions.quadrics), 1.0)
    return np.zeros((0, SIZE), dtype=complex) if poses is None else poses.soma
