"""Arrows of forces: where they are, where they point, and which are dashed; against reactions and weights."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics.home import home_values
from assur.machine.forces.forces_at_rest import forces_at_rest
from assur.machine.masses.link_masses import masses
from assur.model.machine_data import MachineData
from assur.page.force_layers import DASHES, SMALLEST, force_layers
from assur.page.turned_meshes import SIDES

PLAIN, DASHED = 7, 4 * DASHES + 3
"""Rings of an arrow whose shaft is whole, and of one with dashes."""


def arrows(layer, rings):
    """Starts and ways (k, 3) of the arrows of a layer."""
    middles = layer.vertices.reshape(-1, rings, SIDES, 3).mean(axis=2)
    return middles[:, 0], middles[:, -1] - middles[:, 0]


@pytest.mark.parametrize("name", ["zeng2019", "orthoglide"])
def test_arrows_are_the_reactions_on_one_scale_those_that_are_open_dashed(name):
    mechanism = assur.load(name)
    values = home_values(mechanism)
    held = forces_at_rest(mechanism, values)
    sure, left_open, driven, weight = force_layers(mechanism, values)
    scales = []
    for layer, rings, unique in ((sure, PLAIN, True), (left_open, DASHED, False)):
        own = [item for item in held.joints if bool(item.unique[:3].all()) is unique]
        shown = [item for item in own if np.linalg.norm(item.force) > SMALLEST * held.largest]
        starts, ways = arrows(layer, rings)
        for item, start in zip(shown, starts, strict=True):
            if mechanism.joints[item.joint].type.turning:  # a slider's force is at its own point, not at the rail's
                np.testing.assert_allclose(start, mechanism.point(item.joint, values), atol=1e-9)
        scales += [way @ item.force / (item.force @ item.force) for way, item in zip(ways, shown, strict=True)]
        np.testing.assert_allclose(np.cross(ways, [item.force for item in shown]), 0.0, atol=1e-6)
    np.testing.assert_allclose(scales, scales[0])
    assert (
        f"up to {max(np.linalg.norm(item.force) for item in held.joints if item.unique[:3].all()):.3g} N" in sure.label
    )
    assert (
        f"{mechanism.drives[0].name} {held.actuators[0] if abs(held.actuators[0]) > 1e-9 else 0:.3g} N" in driven.label
    )
    known = masses(mechanism)
    np.testing.assert_allclose(
        arrows(weight, PLAIN)[1][0], scales[0] * known.bodies[mechanism.platform.link].mass * known.gravity, atol=1e-9
    )


def test_an_actuator_that_turns_points_along_its_axis():
    delta = assur.load("delta_4s")
    (driven,) = (layer for layer in force_layers(delta, home_values(delta)) if "actuators" in layer.label)
    _, ways = arrows(driven, PLAIN)
    assert len(ways) == 3
    np.testing.assert_allclose(ways[:, 2], 0.0, atol=1e-9)  # axes of the motors are level
    np.testing.assert_allclose(np.linalg.norm(ways, axis=1), np.linalg.norm(ways[0]))


def test_without_masses_there_are_no_arrows():
    bare = replace(assur.load("fivebar"), machine=MachineData())
    assert force_layers(bare, home_values(bare)) == ()
