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


def thinned(vertices: FloatArray, faces: Faces, most: int) -> tuple[FloatArray, Faces]:
    """A mesh of at most `most` faces: vertices that share a cube of a grid become their mean.

    The grid is the finest of a row, each a tenth coarser than the one before, that is coarse enough.

    >>> line = np.column_stack([np.linspace(0.0, 1.0, 101), np.zeros(101), np.zeros(101)])
    >>> segments = np.column_stack([np.arange(100), np.arange(1, 101)])
    >>> vertices, faces = thinned(line, segments, 30)
    >>> 20 < len(faces) <= 30, round(float(np.ptp(vertices[:, 0])), 1)
    (True, 1.0)
    """
    extent = float(np.max(np.ptp(vertices, axis=0), initial=0.0)) if len(vertices) else 0.0
    cells = 400.0
    found = vertices, faces
    while len(found[1]) > most and cells > 2:
        found = _clustered(vertices, faces, extent / cells)
        cells /= 1.1
    return found


def _clustered(vertices: FloatArray, faces: Faces, size: float) -> tuple[FloatArray, Faces]:
    cubes = np.floor((vertices - vertices.min(axis=0)) / size).astype(np.int64)
    _, where = np.unique(cubes, axis=0, return_inverse=True)
    where = where.ravel()
    counts = np.bincount(where)
    means = np.stack([np.bincount(where, vertices[:, k]) / counts for k in range(3)], axis=1)
    moved = where[faces]
    ordered = np.sort(moved, axis=1)
    moved = moved[np.all(ordered[:, 1:] > ordered[:, :-1], axis=1)]  # what has fallen together is no face
    _, first = np.unique(np.sort(moved, axis=1), axis=0, return_index=True)
    moved = moved[np.sort(first)]
    used, places = np.unique(moved, return_inverse=True)
    return means[used], places.reshape(moved.shape)


def _text(array: NDArray[Any]) -> str:
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode("ascii")
