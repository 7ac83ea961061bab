"""The power coefficient of a wrench and a twist: their power over the most that the same wrench could have given.

At its characteristic point C a wrench of force f and pitch h meets a twist with angular velocity w, velocity v of C.
Its power f . v + h f . w is largest, over all directions of f, where f points along v + h w: the coefficient is the
|cosine| of the angle between the two. It lies between 0 and 1, and depends on neither the frame nor the unit.

This is |t o w| / |t o w|_max with |t o w|_max = |f| |w| sqrt((h_t + h_w)^2 + d_max^2), d_max being the distance of C
from the axis of the twist, of pitch h_t: the power coefficient of Wang, Wu and Liu (2010), after the generalised
transmission index of Chen and Angeles (2007). For a force it is the cosine of the pressure angle; a couple and a
rotation, and a force and a translation, have the cosine of the angle between their directions.

Sources: Wang J., Wu C., Liu X.-J., Performance evaluation of parallel manipulators: Motion/force transmissibility and
its index, Mechanism and Machine Theory 45(10), 2010. Chen C., Angeles J., Generalized transmission
index and transmission quality for spatial linkages, Mechanism and Machine Theory 42(9), 2007.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

COUPLE = 1e-9
"""A force below this share of the wrench, lengths in units of the characteristic length, counts as none."""


def power_coefficient(wrench: FloatArray, twist: FloatArray, point: FloatArray) -> FloatArray:
    """The power coefficient (...), between 0 and 1; 0 where wrench or twist vanish.

    Args:
        wrench: (..., 6), moment about the origin and force, in the order that pairs with a twist's.
        twist: (..., 6), angular velocity and velocity at the origin.
        point: (..., 3), a point near C: C is the foot of its perpendicular on the axis of the wrench.

    Lengths should be in units of the size of the mechanism: what is a couple is judged by them.

    Example: a force along X that acts at a height of 1 on a body that turns about X, about Y, and about a line between.

    >>> force = np.array([0.0, 1.0, 0.0, 1.0, 0.0, 0.0])
    >>> axes = np.array([[1.0, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0], [0.6, 0.8, 0, 0, 0, 0]])
    >>> power_coefficient(force, axes, np.array([0.0, 0.0, 1.0])).round(6)
    array([0. , 1. , 0.8])
    """
    moment, force = wrench[..., :3], wrench[..., 3:]
    angular, velocity = twist[..., :3], twist[..., 3:]
    size = np.linalg.norm(wrench, axis=-1)
    strength = np.linalg.norm(force, axis=-1)
    couple = strength <= COUPLE * size
    safe = np.where(couple, 1.0, strength)[..., None]
    direction = np.where(couple[..., None], moment, force / safe)
    about = moment - np.cross(point, force)
    foot = point + np.cross(force, about) / safe**2
    along = np.sum(direction * moment, axis=-1, keepdims=True)
    best = strength[..., None] * (velocity + np.cross(angular, foot)) + along * angular
    best = np.where(couple[..., None], angular * np.linalg.norm(moment, axis=-1, keepdims=True), best)
    power = np.abs(np.sum(moment * angular, axis=-1) + np.sum(force * velocity, axis=-1))
    most = np.linalg.norm(best, axis=-1)
    with np.errstate(invalid="ignore"):
        return np.asarray(np.where(most > 0.0, np.minimum(power / np.where(most > 0.0, most, 1.0), 1.0), 0.0))
