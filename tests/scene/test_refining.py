"""Refined meshes lie on the surface, keep their rims, and stay one surface."""

import numpy as np
import pytest

from assur.scene.refining import combed, refined

OCTAHEDRON = np.concatenate([np.eye(3), -np.eye(3)])
FACES = np.array(
    [
        [i % 3 + 3 * a, (i + 1) % 3 + 3 * b, (i + 2) % 3 + 3 * c]
        for i in (0,)
        for a in (0, 1)
        for b in (0, 1)
        for c in (0, 1)
    ]
)


def ball(points):
    return np.sum(points**2, axis=1) ** 1.5 - 1.0


def turned(vertices, faces):
    """The faces with their normals outwards."""
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    inwards = np.sum(np.cross(b - a, c - a) * a, axis=1) < 0
    return np.where(inwards[:, None], faces[:, ::-1], faces)


def test_an_octahedron_becomes_a_ball():
    vertices, faces = refined(OCTAHEDRON, turned(OCTAHEDRON, FACES), ball, 600)
    assert len(faces) == 8 * 4**3
    np.testing.assert_allclose(np.linalg.norm(vertices, axis=1), 1.0, atol=1e-4)
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    assert np.sum(a * np.cross(b, c)) / 6 == pytest.approx(4 * np.pi / 3, rel=0.03)
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    assert np.all(np.unique(edges, axis=0, return_counts=True)[1] == 2)


def test_where_the_field_is_not_known_a_vertex_stays_on_its_edge():
    vertices, _ = refined(OCTAHEDRON, turned(OCTAHEDRON, FACES), lambda points: np.full(len(points), np.nan), 40)
    assert np.max(np.abs(vertices).sum(axis=1)) == pytest.approx(1.0)
    assert np.min(np.abs(vertices).sum(axis=1)) == pytest.approx(1.0)


def test_no_more_faces_than_asked_for():
    assert len(refined(OCTAHEDRON, FACES, ball, 31)[1]) == 8
    assert len(refined(OCTAHEDRON, FACES, ball, 32)[1]) == 32
    nothing = refined(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64), ball, 100)
    assert len(nothing[1]) == 0


def zigzag(count=12, deep=0.4):
    """A strip whose upper rim has teeth."""
    x = np.arange(count + 1.0)
    low = np.column_stack([x, 0 * x, 0 * x])
    high = np.column_stack([x, 1 + deep * (-1.0) ** np.arange(count + 1), 0 * x])
    k = np.arange(count)
    faces = np.concatenate(
        [np.column_stack([k, k + 1, k + count + 1]), np.column_stack([k + 1, k + count + 2, k + count + 1])]
    )
    return np.concatenate([low, high]), faces


def test_a_rim_loses_its_teeth_and_moves_no_further_than_told():
    vertices, faces = zigzag()
    ends = np.isin(vertices[:, 0], [0.0, 12.0])
    found = combed(vertices, faces, 0.5, ends)
    assert np.ptp(found[15:24, 1]) < 0.15 < 0.8 == pytest.approx(np.ptp(vertices[15:24, 1]))
    np.testing.assert_array_equal(found[ends], vertices[ends])
    little = combed(vertices, faces, 0.1, ends)
    assert np.max(np.linalg.norm(little - vertices, axis=1)) <= 0.1 + 1e-12


def test_what_has_no_rim_stays():
    assert np.array_equal(combed(OCTAHEDRON, turned(OCTAHEDRON, FACES), 1.0, np.zeros(6, dtype=bool)), OCTAHEDRON)
