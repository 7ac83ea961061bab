"""Stiffness: known numbers, limits by hand, legs one by one, and what is said where there is none."""

import re
from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.status import Status
from assur.machine.elasticity.springs import Springs
from assur.machine.elasticity.stiffness import stiffness_at
from assur.machine.elasticity.strains import strains
from assur.machine.elasticity.structure import structure
from assur.model.machine_data import Actuator

POSE = [-15.4714, 9.6849, 456.3315]
PORTAL = """
format = 1
name = "portal"
title = "Two columns and a beam"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "beam", pose = ["x"] }
[parameters]
h = { value = 300, meaning = "columns" }
w = { value = 400, meaning = "beam" }
[links]
base = { meaning = "base" }
left = { profile = "bar", material = "steel", meaning = "left column" }
right = { profile = "bar", material = "steel", meaning = "right column" }
beam = { profile = "bar", material = "steel", meaning = "beam" }
[joints]
A = { type = "revolute", parent = "base", child = "left", axis = "z" }
B = { type = "revolute", parent = "left", child = "beam", at = [0, "h", 0], axis = "z" }
D = { type = "revolute", parent = "base", child = "right", at = ["w", 0, 0], axis = "z" }
C = { type = "revolute", parent = "right", child = "beam", at = [0, "h", 0], child_at = ["w", 0, 0], axis = "z" }
[inputs]
order = ["A"]
A = { name = "q" }
[profiles]
bar = { round = 0.02 }
[materials]
steel = { density = 7850, E = 210e9, nu = 0.3 }
[actuators]
A = { stiffness = 1e5 }
[home]
A = 0
B = 0
C = 0
D = 0
"""


@pytest.fixture(scope="module")
def zeng():
    return assur.load("zeng2019").stiffness(POSE)


def test_actuators_alone_mislead_about_the_papers_mechanism(zeng):
    """With 10 N/um each they are 19.5 N/um in the weakest direction; rods of 20 mm make it 87 times less."""
    weakest = zeng.translational[0][0, 0]
    motors = zeng.actuator_only
    assert motors.translational[0][0, 0] == pytest.approx(19.5e6, rel=1e-3)
    assert motors.translational[0][0, 0] / weakest == pytest.approx(86.7, rel=1e-3)
    assert (zeng.rank[0], motors.rank[0]) == (6, 3)
    np.testing.assert_allclose(zeng.stiffness[0] @ zeng.compliance[0], np.eye(6), atol=1e-9)
    assert np.isnan(motors.stiffness).all()
    shares = zeng.shares()
    links = 1.0 - shares.links["actuators"]
    assert shares.kinds["bending"] / links == pytest.approx(0.88, abs=1e-3)
    assert shares.links["link12"] > 0.5
    assert str(zeng).splitlines()[1].startswith("regular: 224917 along (0.193, 0.978, -0.082)")


def test_without_shear_beams_are_stiffer(zeng):
    slender = assur.load("zeng2019").stiffness(POSE, shear=False)
    ratio = slender.actuator_only.translational[0][0, 0] / slender.translational[0][0, 0]
    assert ratio == pytest.approx(86.14, rel=1e-3)
    assert slender.shares().kinds["shear"] == 0.0


def test_the_orthoglide_is_isotropic_and_its_rods_act_in_series_with_the_drives():
    record = assur.load("orthoglide")
    motors = record.stiffness([0, 0, 0]).actuator_only
    np.testing.assert_allclose(motors.translational[0], 1e7)
    rigid = {
        name: replace(data, rigid=True) for name, data in record.machine.links.items() if name.endswith(("near", "far"))
    }
    links = {**record.machine.links, **rigid}
    own = replace(record, machine=replace(record.machine, links=links)).stiffness([0, 0, 0])
    length = record.parameters["L"].value / 1e3
    area = np.pi * 0.02**2 / 4
    expected = 1.0 / (1e-7 + length / (2.0 * 210e9 * area))
    np.testing.assert_allclose(own.translational[0], expected, rtol=1e-9)


def test_a_portal_with_clamped_corners_sways_as_frames_do(tmp_path):
    """Slope and deflection: F h^3 (3 g + 2) / (12 E I (6 g + 1)), g = h / w, without axial strain and shear."""
    path = tmp_path / "portal.toml"
    path.write_text(PORTAL, encoding="utf-8")
    record = assur.load(path)
    profile = replace(record.machine.profiles["bar"], area=10.0)
    record = replace(record, machine=replace(record.machine, profiles={"bar": profile}))
    clamped = replace(
        structure(record, shear=False), springs=Springs(np.eye(4), np.full(4, 1e11), (), (), np.zeros(4), ())
    )
    state = strains(clamped, record.home_values[None])
    sway = (state.platform @ state.displaced(np.swapaxes(state.platform, -1, -2)))[0, 0, 0]
    ratio, bend = 0.3 / 0.4, 210e9 * profile.iz
    assert sway == pytest.approx(0.3**3 * (3 * ratio + 2) / (12 * bend * (6 * ratio + 1)), rel=1e-6)


def test_singular_and_unreachable_poses_have_no_numbers():
    """Where the rods of a five-bar are in line nothing holds their common end across them."""
    fivebar = assur.load("fivebar", l2=150)
    flat = fivebar.stiffness([0, 60])  # cranks at cos = 0.8, elbows 300 apart
    assert (flat.status[0], np.isnan(flat.compliance).all()) == (Status.parallel, True)
    assert flat.actuator_only.status[0] == Status.parallel
    near = fivebar.stiffness([0, 61])
    assert (near.status[0], near.translational[0][0, 0] > 0) == (Status.regular, True)
    far = fivebar.stiffness([0, 900])
    assert (far.status[0], np.isnan(far.compliance).all()) == (Status.unreachable, True)
    assert np.isnan(far.translational[0]).all()
    open_loop = stiffness_at(fivebar, np.zeros((1, 5)))
    assert open_loop.status[0] == Status.not_closed


def test_a_batch_shares_what_does_not_change_with_the_pose(zeng):
    poses = np.array(POSE) + np.array([[0, 0, 0], [5, 0, -9], [0, -5, -20]])
    batch = zeng.record.stiffness(poses)
    for place_, pose in enumerate(poses):
        np.testing.assert_allclose(batch.compliance[place_], zeng.record.stiffness(pose).compliance[0], rtol=1e-9)


def test_an_actuator_without_stiffness_is_named():
    record = assur.load("delta_4s")
    data = {**record.machine.actuators, "leg2.A": Actuator(force=1.0)}
    with pytest.raises(UsageError, match=r"no stiffness of leg2\.A") as error:
        replace(record, machine=replace(record.machine, actuators=data)).stiffness([0, 0, -0.9])
    said = r"say it in mechanism\.toml, line \d+, \[actuators\]: A = \{ \.\.\., stiffness = 1e5 \}, in N m/rad"
    assert re.fullmatch(said, error.value.hint)
