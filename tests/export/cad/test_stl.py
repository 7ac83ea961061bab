"""STL files read back by hand: watertight, in mm, as large as the link that they are of."""

import numpy as np
import pytest
from manifold3d import Manifold

import assur
from assur.export.cad.stl import RECORD, stl, stl_files
from assur.scene.bodies import bodies, fused
from catalogue import each

METRE = {"mm": 1.0, "cm": 10.0, "m": 1000.0}


def read(data):
    count = int(np.frombuffer(data, "<u4", 1, 80)[0])
    assert len(data) == 84 + 50 * count
    return np.frombuffer(data, RECORD, count, 84)


def open_edges(rows):
    """Edges that are not run as often one way as the other: none where the triangles close."""
    _, index = np.unique(rows["corners"].reshape(-1, 3), axis=0, return_inverse=True)
    faces = index.reshape(-1, 3)
    ways = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    ways = ways[ways[:, 0] != ways[:, 1]]
    edges, which = np.unique(np.sort(ways, axis=1), axis=0, return_inverse=True)
    balance = np.bincount(which.ravel(), np.where(ways[:, 0] < ways[:, 1], 1, -1), len(edges))
    return int(np.count_nonzero(balance))


def volume(rows):
    return float(np.linalg.det(rows["corners"].astype(float)).sum() / 6)


@pytest.mark.parametrize("name", each())
def test_every_file_is_watertight_and_has_the_volume_of_its_link(name):
    record = assur.load(name)
    files, made = stl_files(record), {body.link: body for body in bodies(record)}
    assert set(files) == {f"{link}.stl" for link, body in made.items() if body.fused} | {
        f"{link}.pins.stl" for link, body in made.items() if body.pins
    }
    for file, data in files.items():
        rows = read(data)
        assert open_edges(rows) == 0, file
        assert volume(rows) > 0
        if not file.endswith(".pins.stl"):
            wanted = fused(made[file.removesuffix(".stl")]).volume() * METRE[record.unit] ** 3
            assert volume(rows) == pytest.approx(wanted, rel=1e-4)


def test_normals_are_unit_and_point_outwards():
    rows = read(stl(Manifold.cube((2.0, 3.0, 4.0), True), "a cube"))
    np.testing.assert_allclose(np.linalg.norm(rows["normal"], axis=1), 1.0, atol=1e-6)
    assert np.all(np.sum(rows["normal"] * rows["corners"].mean(axis=1), axis=1) > 0)


def test_a_missing_triangle_is_an_open_edge():
    rows = read(stl(Manifold.sphere(3.0, 12), "a ball"))
    assert open_edges(rows) == 0
    assert open_edges(rows[1:]) == 3
