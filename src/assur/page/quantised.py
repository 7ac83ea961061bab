"""Meshes in few bytes: vertices as 16-bit shares of their box, faces as short integers, both in base64."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Faces = NDArray[np.int64]
STEPS = 65535
"""Steps into which the box of a mesh is cut along each axis."""


def quantised(vertices: FloatArray, faces: Faces) -> dict[str, Any]:
    """Vertices (n, 3) and faces (k, 3), or segments (k, 2), as JSON: a vertex is low + q / 65535 (high - low).

    The error is at most half a step along each axis. Numbers are little-endian; faces take 32 bits each where "wide".

    >>> found = quantised(np.array([[0.0, 0, 0], [1, 0, 2]]), np.array([[0, 1]]))
    >>> found["low"], found["high"], found["primitive"]
    ([0.0, 0.0, 0.0], [1.0, 0.0, 2.0], 'segments')
    """
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    span = np.where(high > low, high - low, 1.0)
    steps = np.rint((vertices - low) / span * STEPS).astype("<u2")
    wide = len(vertices) > STEPS
    return {
        "primitive": "segments" if faces.shape[1] == 2 else "triangles",
        "vertices": _text(steps),
        "faces": _text(faces.astype("<u4" if wide else "<u2")),
        "wide": wide,
        "low": low.tolist(),
        "high": high.tolist(),
    }


def _text(array: NDArray[Any]) -> str:
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode("ascii")
