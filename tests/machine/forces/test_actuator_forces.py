"""Forces of the actuators: by hand, at singularities, and what is said where there are none."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

import assur
from assur.errors import UsageError
from assur.kinematics.status import Status
from assur.machine.forces.actuator_forces import forces
from assur.machine.forces.loads import load_of
from assur.model.machine_data import Actuator, Gravity, LinkData, MachineData
from weighed import weighed

POSE = [-15.4714, 9.6849, 456.3315]


@pytest.fixture(scope="module")
def zeng():
    return assur.load("zeng2019")


@pytest.fixture(scope="module")
def fivebar():
    return assur.load("fivebar", l2=150)


def test_a_load_at_the_pose_of_table_1(zeng):
    """By the inverse velocity relation of the paper, Eq. (25), at pose 3*."""
    answer = replace(zeng, machine=MachineData()).forces(POSE, load=[0, 0, -100], gravity=False)
    np.testing.assert_allclose(answer.forces, [[-11.7115, 4.4868, 7.2248]], atol=2e-4)
    assert np.isnan(answer.mass_matrix).all()  # the file says no masses, and none are needed
    assert np.isnan(answer.kinetic_energy).all()


@pytest.mark.parametrize("share", [1e-3, 1e-4, 2e-5])
def test_nearly_at_a_singularity_forces_are_those_of_the_relation_of_velocities(zeng, share):
    """Where links 9 and 10 nearly lie along Y: what they nearly let go is no motion that nothing drives."""
    w = share * 280.0
    pose = [-39.03225806451612, 0.0, 199.3603687 - w]
    jp, jq = zeng.velocity_map(pose).jp, zeng.velocity_map(pose).jq
    answer = zeng.forces(pose, load=[0, 0, -100], gravity=False)
    assert answer.growth[0] > 0.1 / share
    np.testing.assert_allclose(answer.forces[0], np.linalg.solve(np.linalg.solve(jq, jp).T, [0, 0, 100]), rtol=1e-9)


def test_what_moves_along_y_moves_as_one_body(zeng):
    record = weighed(zeng)
    answer = forces(record, POSE, acceleration=[0, 1000, 0], gravity=False)
    total = sum(link.mass for name, link in record.machine.links.items() if name != "base")
    rotors = [record.machine.actuators[name].rotor for name in ("P1", "P2", "P3")]
    assert answer.mass_matrix[0, 1, 1] == pytest.approx(total + sum(rotors))
    assert answer.forces.sum() == pytest.approx(total + sum(rotors))  # 1 m/s2


def test_gravity_across_the_rails_asks_for_forces_that_balance(zeng):
    turned = weighed(zeng)
    data = turned.machine.gravity.direction
    assert data[1] == 0.0
    assert forces(turned, POSE).forces.sum() == pytest.approx(0.0, abs=1e-9)


def test_a_load_along_a_rod_at_right_angles_to_its_crank(fivebar):
    """Its motor bears the force times the crank, the other one nothing."""
    crank = np.deg2rad(120.0)
    elbow = np.array([-70 + 100 * np.cos(crank), 100 * np.sin(crank)])
    along = np.array([np.cos(crank - np.pi / 2), np.sin(crank - np.pi / 2)])
    answer = fivebar.forces(elbow + 150 * along, load=[*(-10 * along), 0], gravity=False)
    assert answer.forces[0] == pytest.approx([-1.0, 0.0], abs=1e-9)


def test_a_singularity_is_a_status_and_no_large_number(fivebar):
    singular = fivebar.forces([0.0, 60.0], load=[0, -10, 0], gravity=False, mode="-+")  # both rods in one line
    assert Status(int(singular.status[0])) == Status.parallel
    assert np.isnan(singular.forces).all()
    near = fivebar.forces([[0.0, 60.01], [0.0, 120.0]], load=[0, -10, 0], gravity=False, mode="-+")
    assert [Status(int(code)).name for code in near.status] == ["near_singular", "regular"]
    assert np.isfinite(near.forces).all()
    assert near.growth[0] > 100 * near.growth[1]


def test_where_the_pose_is_not_free_a_load_is_held_and_a_motion_undecided(fivebar):
    angle = np.arctan2(200.0, 150.0)
    pose = [-70 + 250 * np.cos(angle), 250 * np.sin(angle)]  # crank 1 and its rod in one line
    still = fivebar.forces(pose, load=[0, -10, 0], gravity=False, mode="++")
    assert Status(int(still.status[0])) == Status.serial
    assert np.isfinite(still.forces).all()
    record = weighed(fivebar)
    assert np.isnan(forces(record, pose).mass_matrix).all()
    moving = forces(record, pose, velocity=[1, 0], mode="++")
    assert (Status(int(moving.status[0])), np.isnan(moving.forces).all()) == (Status.undecided, True)


def test_a_pose_out_of_reach_has_no_numbers(zeng):
    answer = zeng.forces([POSE, [0, 0, 5000]], load=[0, 0, -100], gravity=False)
    assert [Status(int(code)).name for code in answer.status] == ["regular", "unreachable"]
    assert (np.isfinite(answer.forces[0]).all(), np.isnan(answer.forces[1]).all()) == (True, True)


def test_rods_along_the_rails_pass_forces_on_as_they_are():
    """The Orthoglide's isotropic pose: no motor bears more than the load, in newtons, not over a length."""
    orthoglide = assur.load("orthoglide")
    answer = orthoglide.forces([0.0, 0.0, 0.0], load=[1, 2, 3], gravity=False)
    assert answer.growth[0] == pytest.approx(1.0)
    np.testing.assert_allclose(np.abs(answer.forces), [[1, 2, 3]])


def test_friction_stands_apart(zeng):
    record = weighed(zeng)
    machine = replace(record.machine, actuators={"P1": Actuator(coulomb=5.0, viscous=20.0)})
    record = replace(record, machine=machine)
    still, moving = (forces(record, POSE, velocity=v) for v in (None, [0, 100, 0]))
    assert (still.friction.tolist(), still.friction_band.tolist()) == ([[0.0] * 3], [5.0, 0.0, 0.0])
    np.testing.assert_allclose(moving.input_rates, [[0.1] * 3])
    np.testing.assert_allclose(moving.friction, [[7.0, 0.0, 0.0]])


def test_an_input_that_rests_while_others_move_has_no_friction_but_its_band():
    delta = assur.load("delta_4s")
    answer = delta.forces([0.0, 0.0, -0.9], [1.0, 0.0, 0.0])  # across the plane of leg 1
    assert answer.input_rates[0, 0] == 0.0
    assert answer.friction[0, 0] == 0.0
    assert not answer.unbalanced[0]


def test_wrong_use_is_told(zeng):
    with pytest.raises(UsageError, match=r"zeng2019: no mass of slider1, .*platform") as caught:
        replace(zeng, machine=MachineData()).forces(POSE)
    assert caught.value.exit_code == 2
    with pytest.raises(UsageError, match="not three or six finite numbers"):
        load_of([1, 2])
    with pytest.raises(UsageError, match="velocity of zeng2019"):
        zeng.forces(POSE, velocity=[1, 2], gravity=False)


def test_it_prints_what_it_says(zeng):
    text = str(zeng.forces(POSE, load=[0, 0, -100], gravity=False))
    assert text.splitlines()[:2] == ["forces of the actuators of zeng2019 (regular)", "yA1: -11.7116 N"]


@pytest.mark.deep
def test_a_five_bar_of_uniform_bars_by_lagrange():
    """The equation of motion by SymPy from the elbows' places as functions of P: no joint graph, no screws."""
    bare = assur.load("fivebar")
    links = {name: LinkData(kg_per_m=weight) for name, weight in zip(("crank1", "crank2"), (1.0, 1.5), strict=True)}
    links |= {name: LinkData(kg_per_m=weight) for name, weight in zip(("rod1", "rod2"), (0.5, 0.8), strict=True)}
    down = Gravity(np.array([0.0, -1.0, 0.0]), 9.81)
    record = replace(bare, machine=MachineData(links=links, gravity=down))
    pose, velocity, acceleration = np.array([[30.0, 200.0], [300.0, -400.0], [2000.0, 1000.0]])
    answer = forces(record, pose, velocity, acceleration)

    x, y = place = sp.symbols("x y")
    point, mass, height, angles = sp.Matrix(place), sp.zeros(2, 2), 0, []
    for base, side, (crank, rod) in ((-0.07, 1, (1.0, 0.5)), (0.07, -1, (1.5, 0.8))):
        reach = sp.sqrt((x - base) ** 2 + y**2)
        angle = sp.atan2(y, x - base) + side * sp.acos((0.1**2 + reach**2 - 0.194**2) / (0.2 * reach))
        elbow = sp.Matrix([base + 0.1 * sp.cos(angle), 0.1 * sp.sin(angle)])
        moving = elbow.jacobian(place)
        mass += crank * 0.1 / 3 * moving.T * moving
        mass += rod * 0.194 / 3 * (moving.T * moving + (moving + moving.T) / 2 + sp.eye(2))
        height += crank * 0.1 * elbow[1] / 2 + rod * 0.194 * (elbow[1] + point[1]) / 2
        angles.append(angle)
    v, a = sp.Matrix(velocity / 1e3), sp.Matrix(acceleration / 1e3)
    changing = mass.diff(x) * v[0] + mass.diff(y) * v[1]
    pull = sp.Matrix([(v.T * mass.diff(name) * v)[0] / 2 for name in place])
    needed = mass * a + changing * v - pull + 9.81 * sp.Matrix([sp.diff(height, name) for name in place])
    at = dict(zip(place, (pose / 1e3).tolist(), strict=True))
    driven = np.array(sp.Matrix(angles).jacobian(place).evalf(30, subs=at), dtype=float)
    expected = np.linalg.solve(driven.T, np.array(needed.evalf(30, subs=at), dtype=float)[:, 0])
    np.testing.assert_allclose(answer.mass_matrix[0], np.array(mass.evalf(30, subs=at), dtype=float), rtol=1e-9)
    np.testing.assert_allclose(answer.forces[0], expected, rtol=1e-9)
