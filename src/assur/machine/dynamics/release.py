"""A start from which a mechanism is left to the forces of its actuators, and these forces in time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Forces = Callable[[float], FloatArray]
"""Forces (d,) of the actuators, in N or N m, at a time in s."""
SMOOTH = 5
MOMENTS = 101


@dataclass(frozen=True, eq=False)
class Release:
    """A start and what acts from then on.

    Attributes:
        pose: (m,) in the mechanism's unit and rad.
        velocity: (k,) of the pose, in these per s.
        t_end: in s.
        forces: of the actuators.
        t_start: in s.
        count: of moments at which the motion is told, evenly spaced.
    """

    pose: FloatArray
    velocity: FloatArray
    t_end: float
    forces: Forces
    t_start: float = 0.0
    count: int = MOMENTS


def constant_forces(values: FloatArray) -> Forces:
    """The same forces (d,) at all times.

    >>> constant_forces(np.array([1.0, 2.0]))(0.5).tolist()
    [1.0, 2.0]
    """
    return lambda _: values.copy()


def forces_in_time(times: FloatArray, values: FloatArray, *, smooth: bool = False) -> Forces:
    """Forces (N, d) at times (N,) in s: straight between them, or smooth; before the first and after the last as there.

    >>> forces_in_time(np.array([0.0, 2.0]), np.array([[1.0], [3.0]]))(0.5).tolist()
    [1.5]
    """
    from scipy.interpolate import make_interp_spline  # which takes half a second to load

    curve = make_interp_spline(times, values, k=min(SMOOTH, len(times) - 1) if smooth else 1)
    return lambda time: np.asarray(curve(np.clip(time, times[0], times[-1])))
