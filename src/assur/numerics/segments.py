"""Distances of straight segments in space, many at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def segment_distances(p: FloatArray, q: FloatArray, r: FloatArray, s: FloatArray) -> FloatArray:
    """Distances (...) of segments pq and rs, (..., 3) each: inside both, or from an end of one to the other.

    >>> ends = np.array([[0.0, 0, 0], [2, 0, 0], [1, -1, 3], [1, 1, 3]])
    >>> float(segment_distances(*ends))
    3.0
    """
    u, v, w = q - p, s - r, p - r
    uu, vv, uv = (np.sum(a * b, axis=-1) for a, b in ((u, u), (v, v), (u, v)))
    uw, vw = np.sum(u * w, axis=-1), np.sum(v * w, axis=-1)
    skew = uu * vv - uv**2 > 1e-12 * uu * vv
    apart = np.where(skew, uu * vv - uv**2, 1.0)
    t, k = (uv * vw - vv * uw) / apart, (uu * vw - uv * uw) / apart
    inside = (t >= 0) & (t <= 1) & (k >= 0) & (k <= 1) & skew
    t, k = np.where(inside, t, 0.0), np.where(inside, k, 0.0)
    between = np.linalg.norm(w + t[..., None] * u - k[..., None] * v, axis=-1)
    ends = [_from_point(p, r, v), _from_point(q, r, v), _from_point(r, p, u), _from_point(s, p, u)]
    least = np.minimum.reduce(ends)
    return np.asarray(np.where(inside, np.minimum(between, least), least))


def _from_point(point: FloatArray, start: FloatArray, way: FloatArray) -> FloatArray:
    """Distances (...) of points from segments that begin at `start` and run along `way`."""
    length = np.maximum(np.sum(way * way, axis=-1), 1e-300)
    share = np.clip(np.sum((point - start) * way, axis=-1) / length, 0.0, 1.0)
    return np.asarray(np.linalg.norm(point - start - share[..., None] * way, axis=-1))
