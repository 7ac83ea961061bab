"""Thinning: a mesh with fewer faces, for the eye."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Faces = NDArray[np.int64]


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
    thin = vertices, faces
    while len(thin[1]) > most and cells > 2:
        thin = _clustered(vertices, faces, extent / cells)
        cells /= 1.1
    return thin


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
