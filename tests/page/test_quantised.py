from __future__ import annotations

import numpy as np
import pytest

from assur.page.quantised import STEPS, quantised, thinned


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


def test_vertices_come_back_within_half_a_step_and_faces_exactly(rng, restored):
    vertices = rng.uniform([-300, 0, 1e-3], [200, 0, 2e-3], size=(500, 3))
    faces = rng.integers(0, 500, size=(900, 3))
    back, same = restored(quantised(vertices, faces))
    half = np.ptp(vertices, axis=0) / STEPS / 2
    assert np.all(np.abs(back - vertices) <= half * (1 + 1e-9) + 1e-12)
    assert np.array_equal(same, faces)


def test_the_ends_of_the_box_are_exact(rng, restored):
    vertices = rng.normal(size=(50, 3))
    back, _ = restored(quantised(vertices, np.zeros((1, 3), dtype=np.int64)))
    assert np.array_equal(back.min(axis=0), vertices.min(axis=0))
    assert np.allclose(back.max(axis=0), vertices.max(axis=0), rtol=1e-15)


def test_many_vertices_take_wide_faces(restored):
    vertices = np.column_stack([np.arange(70000.0)] * 3)
    faces = np.array([[0, 69999, 65536]])
    found = quantised(vertices, faces)
    assert found["wide"]
    assert np.array_equal(restored(found)[1], faces)


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
