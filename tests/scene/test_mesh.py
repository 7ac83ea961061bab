"""Every solid is closed with its faces outwards: the divergence theorem must give its volume."""

import numpy as np
import pytest

from assur.scene import mesh

SKEW = np.array([0.3, -0.5, 0.8]) / np.linalg.norm([0.3, -0.5, 0.8])
ACROSS = np.cross(SKEW, [1.0, 0, 0]) / np.linalg.norm(np.cross(SKEW, [1.0, 0, 0]))
START = np.array([1.0, 2.0, 3.0])
ROUND = mesh.ROUND / (2 * np.pi) * np.sin(2 * np.pi / mesh.ROUND)
"""Area of the polygon that stands for a circle, as a share of the circle's."""

SOLIDS = {
    "box": (mesh.box(START, np.diag([1.0, 2.0, 3.0]), "#808080"), 48.0),
    "cylinder": (mesh.cylinder(START, START + 5 * SKEW, 2.0, "#808080"), 5 * np.pi * 4 * ROUND),
    "bar": (
        mesh.bar(START, START + 6 * ACROSS, SKEW, 1.5, 0.8, "#808080"),
        0.8 * (6 * 3 + np.pi * 2.25 * ROUND),
    ),
    "ball": (mesh.ball(START, 2.0, "#808080"), 4 / 3 * np.pi * 8),
}


def volume(corners):
    return float(np.sum(np.linalg.det(corners))) / 6


@pytest.mark.parametrize("name", SOLIDS)
def test_volume(name):
    solid, wanted = SOLIDS[name]
    assert volume(solid.corners) == pytest.approx(wanted, rel=0.02 if name == "ball" else 1e-9)


@pytest.mark.parametrize("name", SOLIDS)
def test_normals_are_unit_and_point_outwards(name):
    solid, _ = SOLIDS[name]
    face = np.cross(solid.corners[:, 1] - solid.corners[:, 0], solid.corners[:, 2] - solid.corners[:, 0])
    size = np.linalg.norm(face, axis=1)
    whole = size > 1e-9
    np.testing.assert_allclose(np.linalg.norm(solid.normals, axis=2), 1.0)
    cosine = np.einsum("fkx,fx->fk", solid.normals[whole], face[whole] / size[whole, None])
    assert cosine.min() > 0.9


def test_joined_keeps_patches_apart():
    parts = [solid for solid, _ in SOLIDS.values()]
    whole = mesh.joined(parts)
    assert len(np.unique(whole.patch)) == sum(len(np.unique(part.patch)) for part in parts)
    assert volume(whole.corners) == pytest.approx(sum(volume(part.corners) for part in parts))


def test_a_surface_is_smooth_but_for_its_creases():
    angles = np.linspace(0, np.pi, 40)
    arch = np.array([[np.cos(a), y, np.sin(a)] for a in angles for y in (0.0, 1.0)])
    strip = np.array([f for k in range(39) for f in ([2 * k, 2 * k + 2, 2 * k + 1], [2 * k + 1, 2 * k + 2, 2 * k + 3])])
    found = mesh.surface(arch, strip, "#123456")
    assert len(np.unique(found.patch)) == 1
    radial = found.corners * [1.0, 0.0, 1.0]
    cosine = np.abs(np.einsum("fkx,fkx->fk", found.normals, radial))
    assert cosine.min() > 0.999
    cube = mesh.box(np.zeros(3), np.eye(3), "#000000").corners
    vertices, index = np.unique(cube.reshape(-1, 3), axis=0, return_inverse=True)
    assert len(mesh.creases(vertices, index.reshape(-1, 3))) == 12


@pytest.mark.parametrize("gap", [0.0, 1e-12])
def test_between_two_points_that_are_one_there_is_a_ball(gap):
    """A leg that has no length in one configuration is still drawn."""
    end = START + gap * SKEW
    ball = mesh.ball(START, 0.5, "#808080")
    for found in (mesh.cylinder(START, end, 0.5, "#808080"), mesh.bar(START, end, ACROSS, 0.5, 0.2, "#808080")):
        np.testing.assert_allclose(found.corners, ball.corners)
        assert np.all(np.isfinite(found.normals))
