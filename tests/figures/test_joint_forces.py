"""Forces drawn on the mechanism are those of the reactions, in the joints where they act."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.figures import catalogue as figures
from assur.kinematics.pose import pose_of
from assur.machine.forces.reactions import reactions
from assur.model.machine_data import MachineData


@pytest.fixture(scope="module")
def drawn():
    return figures.Context(assur.load("zeng2019"))


def test_each_joint_has_its_force_where_it_acts(drawn):
    data = figures.drawing(drawn.record, "reactions", drawn).data
    answer = drawn.record.forces(pose_of(drawn.record, drawn.drawn_joints))
    for item, own in zip(data["joints"], reactions(answer).joints, strict=True):
        assert item["joint"] == own.joint
        np.testing.assert_allclose(item["force"][own.unique[:3]], own.force[own.unique[:3]], atol=1e-6)
    slider = next(item for item in data["joints"] if item["joint"] == "P1")
    np.testing.assert_allclose(slider["at"], drawn.record.point("A1", drawn.drawn_joints))


def test_joints_are_hatched_where_rigid_links_leave_forces_open(drawn):
    figure = figures.draw(drawn.record, "reactions", drawn)
    hatched = sum(bool(patch.get_hatch()) for patch in figure.axes[0].patches)
    assert hatched == 14  # all but P3, D1, D2
    caption = figures.spec(drawn.record, "reactions", drawn).caption
    assert "10 stresses balance themselves" in caption
    solid = figures.Context(assur.load("delta_4s"))
    assert "All of it is determined" in figures.spec(solid.record, "reactions", solid).caption


def test_a_file_without_masses_has_no_figures_of_forces(drawn):
    bare = figures.Context(replace(drawn.record, machine=MachineData()))
    why = figures.left_out(bare.record, bare)
    assert all("no mass of slider1" in why[name] for name in ("reactions", "polytope", "forces"))
