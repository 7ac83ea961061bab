"""Layers of stiffness: the ellipsoid is that of the compliance, tubes are where the vibration carries the links."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics.home import home_values
from assur.kinematics.pose import platform_frame
from assur.kinematics.validation.check import METRES
from assur.machine.elasticity.stiffness import stiffness_at
from assur.model.machine_data import MachineData
from assur.page.stiffness_layers import AWAY, FURTHEST, THICK, THIN, stiffness_layers
from assur.page.turned_meshes import AROUND
from assur.scene.companion import companion
from assur.scene.skeleton import skeleton


@pytest.mark.parametrize("name", ["zeng2019", "delta_4s"])
def test_layers_are_the_compliance_and_the_deflected_machine(name):
    mechanism = assur.load(name)
    values = home_values(mechanism)
    solved = stiffness_at(mechanism, values[None])
    ball, *vibrations = stiffness_layers(mechanism, values)
    middle = ball.vertices.mean(axis=0)
    np.testing.assert_allclose(middle, platform_frame(mechanism, values)[1], atol=1e-9 * np.ptp(ball.vertices))
    unit = (ball.vertices - middle) @ np.linalg.inv(solved.compliance[0, :3, :3])
    sizes = np.linalg.norm(unit, axis=1)  # of the forces that displace so far
    assert np.ptp(sizes) < 1e-6 * sizes.mean()
    size = skeleton(mechanism, companion(mechanism), values).size
    shapes = solved.mode_shapes()
    assert len(vibrations) == 3
    for layer, shape in zip(vibrations, shapes, strict=False):
        assert f"{shape.frequency:.3g} Hz" in layer.label
        curves = shape.deflected(FURTHEST * size * METRES[mechanism.unit])
        centres = layer.vertices.reshape(-1, AROUND, 3).mean(axis=1)
        for link, share in shape.shares.links.items():
            radius = size * (THIN + (THICK - THIN) * share)
            for curve in curves.get(link, np.empty((0, 9, 3))) / METRES[mechanism.unit]:
                for end in (curve[0], curve[-1]):
                    near = np.linalg.norm(layer.vertices - end, axis=1)
                    assert np.sum(np.abs(near - radius) < 1e-9 * size) >= AROUND
                    assert np.linalg.norm(centres - end, axis=1).min() < 1e-9 * size
                assert max(_apart(centres, point) for point in curve) < 1.001 * AWAY * radius


def _apart(centres, point):
    """How far a point is from the nearest chord between neighbours (n, 3)."""
    ways = np.diff(centres, axis=0)
    shares = np.einsum("ij,ij->i", point - centres[:-1], ways) / np.maximum(np.einsum("ij,ij->i", ways, ways), 1e-300)
    return np.linalg.norm(centres[:-1] + np.clip(shares, 0.0, 1.0)[:, None] * ways - point, axis=1).min()


def test_without_springs_there_are_none():
    bare = replace(assur.load("zeng2019"), machine=MachineData())
    assert stiffness_layers(bare, home_values(bare)) == ()
