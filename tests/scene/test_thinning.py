"""A thinned surface is still the same one, closed as before."""

import numpy as np
import pytest

from assur.scene.thinning import thinned


def sphere(count):
    """A closed triangle mesh of a unit sphere, by the hull of points spread on it."""
    from scipy.spatial import ConvexHull

    k = np.arange(count) + 0.5
    z, turn = 1 - 2 * k / count, np.pi * (1 + 5**0.5) * k
    points = np.stack([np.cos(turn) * np.sqrt(1 - z * z), np.sin(turn) * np.sqrt(1 - z * z), z], axis=1)
    return points, ConvexHull(points).simplices.astype(np.int64)


def area(vertices, faces):
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    return 0.5 * float(np.sum(np.linalg.norm(np.cross(b - a, c - a), axis=1)))


def test_what_is_small_enough_stays_as_it_is():
    vertices, faces = sphere(200)
    same, kept = thinned(vertices, faces, len(faces))
    assert same is vertices
    assert kept is faces


@pytest.mark.parametrize("most", [300, 1000, 3000])
def test_a_thinned_sphere_is_still_one(most):
    vertices, faces = sphere(4000)
    fewer, kept = thinned(vertices, faces, most)
    assert most / 2 < len(kept) <= most
    assert kept.max() == len(fewer) - 1
    assert len(np.unique(kept)) == len(fewer)
    assert abs(area(fewer, kept) / area(vertices, faces) - 1) < 12 / most**0.5 / 3
    edges = np.sort(kept[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    assert np.linalg.norm(fewer, axis=1).min() > 0.8
    assert len(np.unique(edges, axis=0)) - len(fewer) - len(kept) == -2  # Euler: still closed, without a handle
