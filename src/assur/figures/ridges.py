"""Ridges of maps: what grows without bound towards the zeros of a factor is followed there from node to node."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator
from scipy.ndimage import binary_dilation

from assur.figures.contours import continued

FloatArray = NDArray[np.float64]
GROWS = 1.2
"""So many times as large as a step away are values, at least, beside a zero towards which they grow: with one over the
root of the distance they are 1.7 times as large, with one over it 3 times."""


def followed(
    values: FloatArray,
    sides: Sequence[FloatArray],
    nodes: tuple[FloatArray, FloatArray],
    finer: tuple[FloatArray, FloatArray],
) -> FloatArray:
    """Values (b, a) over nodes (b,) and (a,), upwards and to the right, on finer ones; `sides` are signs of factors.

    Their reciprocals are followed, with the signs of the factors towards which they grow: these pass through zero
    between two nodes, where the values themselves would have a bead beside each node that is near. Small values go by
    decades.

    >>> x = np.array([-1.25, -0.25, 0.75])
    >>> values, side = np.tile(1.0 / np.abs(x), (3, 1)), np.tile(np.sign(x), (3, 1))
    >>> followed(values, [side], (x, x), (x, np.array([-1.25, -0.05, 0.05])))[0].round(9).tolist()
    [0.8, 20.0, 20.0]
    """
    known = np.isfinite(values) & (values > 0)
    if not np.any(known):
        return np.full((len(finer[0]), len(finer[1])), np.nan)
    middle = float(np.median(values[known]))
    shares = np.where(known, values, np.nan) / middle
    small = 1.0 - np.log(np.minimum(shares, 1.0))
    side = np.prod([sign for sign in sides if _grows(values, sign)], axis=0)  # 1 where there is none
    steps = RegularGridInterpolator(nodes, continued(side * np.where(shares > 1.0, 1.0 / shares, small)))
    way = np.abs(steps(np.stack(np.meshgrid(*finer, indexing="ij"), axis=-1)))
    return np.asarray(middle * np.where(way < 1.0, 1.0 / np.maximum(way, 1e-12), np.exp(1.0 - np.maximum(way, 1.0))))


def _grows(values: FloatArray, side: FloatArray) -> bool:
    """Whether values (b, a) are larger beside the zeros of a factor, of which these are the signs, than a step away."""
    changes = [np.diff(side, axis=axis, append=np.take(side, [-1], axis)) != 0 for axis in (0, 1)]
    beside = np.any([change | np.roll(change, 1, axis) for axis, change in enumerate(changes)], axis=0)
    away, known = binary_dilation(beside) & ~beside, np.isfinite(values)
    if not np.any(beside & known) or not np.any(away & known):
        return True
    return float(np.median(values[beside & known])) > GROWS * float(np.median(values[away & known]))
