"""Laws of stiffness, for every mechanism with beams of random profiles; none knows a printed number."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigvalsh

from assur.kinematics.pose import platform_frame
from assur.kinematics.status import Status
from assur.kinematics.validation.check import METRES
from assur.machine.elasticity.elastic_reactions import elastic_reactions
from assur.machine.elasticity.stiffness import stiffness_at
from assur.machine.forces.actuator_forces import forces_at
from assur.machine.forces.loads import load_of
from assur.machine.forces.reactions import child_points, reactions
from assur.machine.masses.link_masses import masses
from assur.machine.motion.inertia import link_inertia
from assur.model.machine_data import LinkData
from bending import bending, by_limbs, by_multipliers, given, serial_limbs, yielding
from own_machines import every_mechanism
from weighed import motion_of, place

mechanism = every_mechanism()
LOOPED = ("delta_4s", "h4_robot", "linear_delta_4r", "linear_delta_4s", "orthoglide", "three_p2us", "three_rrrp4r",
          "tsai_platform", "zeng2019", "parallelograms")  # fmt: skip
"""Links of these limbs are held in loops of their own."""
SHORT = ("gough_stewart", "planar_3rpr", "three_rps", "three_upu")
"""Parts of their legs have no length where strokes are zero: the platform alone bends, by several bars."""


@pytest.fixture
def bent(mechanism):
    return stiffness_at(bending(mechanism), place(mechanism))


def test_a_bars_compliance_given_by_hand_is_that_of_its_profile(bent):
    record = given(bent.record)
    by_hand = [data.compliance is not None for data in record.machine.links.values()]
    assert any(by_hand) != (bent.record.name in SHORT)
    _assert_alike(bent, stiffness_at(record, bent.values).compliance[0], 1e-9)


def test_joints_that_yield_and_gears_are_those_of_the_other_routes(mechanism):
    """Multipliers with a compliance of their own, gears in series; virtual joints where limbs are serial."""
    record, values = yielding(bending(mechanism)), place(mechanism)
    own = stiffness_at(record, values)
    _assert_alike(own, by_multipliers(record, values[0])[0], 1e-8)
    if serial_limbs(mechanism):
        rigid = {**record.machine.links, record.platform.link: LinkData(mass=1.0)}
        record = replace(record, machine=replace(record.machine, links=rigid))
        _assert_alike(stiffness_at(record, values), by_limbs(record, values, serial_limbs(mechanism)), 1e-9)


def _assert_alike(answer, other, share):
    """A compliance within a share of its largest number, turns by the characteristic length; of three RRRP 50 times.

    These are a billion times as stiff across their plane as in it.
    """
    share *= 50.0 if answer.record.name == "three_rrrp" else 1.0
    units = np.repeat([answer.length, 1.0], 3)
    plain = other / units / units[:, None]
    np.testing.assert_allclose(
        answer.compliance[0] / units / units[:, None], plain, atol=share * np.abs(plain).max(), rtol=0.0
    )


def test_compliance_is_symmetric_positive_and_that_of_the_other_route(bent):
    """Bars by the matrix of the textbook, joints by multipliers: rigid links and joints that hold twice among them."""
    (compliance,) = bent.compliance
    assert bent.status[0] == Status.regular
    other, _ = by_multipliers(bent.record, bent.values[0])
    units = np.repeat([bent.length, 1.0], 3)
    size = np.abs(other / units / units[:, None]).max()
    np.testing.assert_allclose(compliance / units / units[:, None], other / units / units[:, None], atol=1e-8 * size)
    assert np.linalg.eigvalsh(compliance / units / units[:, None])[0] >= -1e-12 * size


def test_limbs_one_by_one_add_to_the_whole(mechanism):
    """Virtual joints: the compliance of each serial limb at the platform, on forces that its passive joints pass on."""
    record = bending(mechanism)
    rigid = replace(record.machine, links={**record.machine.links, record.platform.link: LinkData(mass=1.0)})
    record = replace(record, machine=rigid)
    values, limbs = place(mechanism), serial_limbs(mechanism)
    assert bool(limbs) != (mechanism.name in LOOPED)
    if limbs:
        own = stiffness_at(record, values)
        units = np.repeat([own.length, 1.0], 3)
        other = by_limbs(record, values, limbs) / units / units[:, None]
        compliance = own.compliance[0] / units / units[:, None]
        np.testing.assert_allclose(compliance, other, atol=1e-9 * np.abs(other).max())


def test_work_of_loads_is_energy_of_strains_and_shares_are_whole(bent):
    shares = bent.shares()
    assert shares.energy == pytest.approx(0.5 * np.trace(bent.compliance[0, :3, :3]), rel=1e-9)
    for split in (shares.links, shares.kinds, shares.actuators):
        assert sum(split.values()) == pytest.approx(1.0)


def test_what_a_stiffer_link_gains_lies_between_bounds_by_its_share(bent):
    """By the least complementary energy, from the softer one to the stiffer one and back."""
    shares = bent.shares()
    link = max(bent.record.machine.materials, key=shares.links.get)
    machine, times = bent.record.machine, 3.0
    material = machine.materials[link]
    stiffer = {**machine.materials, link: replace(material, elasticity=times * material.elasticity)}
    after = stiffness_at(replace(bent.record, machine=replace(machine, materials=stiffer)), bent.values).shares()
    most, least = 1.0 - shares.links[link] * (1.0 - 1.0 / times), 1.0 / (1.0 + (times - 1.0) * after.links[link])
    assert least - 1e-9 <= after.energy / shares.energy <= most + 1e-9
    assert after.energy < shares.energy


def test_rigid_links_vibrate_on_their_actuators_and_those_that_bend_more_slowly(mechanism):
    """By the mass matrix of the pose's rates and the inputs' springs; a constraint raises each frequency (Rayleigh)."""
    bent, values = bending(mechanism), place(mechanism)
    links = {name: replace(data, rigid=True) for name, data in bent.machine.links.items()}
    record = replace(bent, machine=replace(bent.machine, links=links))
    moving = forces_at(record, values, load_of(None))
    rates = moving.motion.drives @ moving.motion.of_pose[0]
    springs = [record.machine.actuators[record.coordinate_label(item.coordinate)].stiffness for item in record.drives]
    squares = eigvalsh(rates.T @ np.diag(springs) @ rates, moving.mass_matrix[0])
    own = stiffness_at(record, values).vibrations().frequencies
    np.testing.assert_allclose(own, np.sqrt(squares) / (2.0 * np.pi), rtol=1e-8)
    assert np.all(stiffness_at(bent, values).vibrations().frequencies[: len(own)] <= own * (1.0 + 1e-9))


def test_as_links_stiffen_only_the_actuators_are_left(mechanism):
    values = place(mechanism)
    motors = stiffness_at(bending(mechanism), values).actuator_only
    units = np.repeat([motors.length, 1.0], 3)
    left, less = (
        np.abs((stiffness_at(bending(mechanism, factor), values).compliance - motors.compliance)[0] / units).max()
        for factor in (10.0, 1e3)
    )
    assert motors.rank[0] == len(mechanism.inputs)
    assert less <= 0.012 * left + 1e-9 * np.abs(motors.compliance[0] / units).max()


def test_reactions_are_unique_where_no_profile_changes_them_and_open_where_one_does(mechanism):
    """Under a load in two structures of other profiles, at rest without weight."""
    values, load = place(mechanism), load_of([3.0, -4.0, 5.0, 0.6, 0.7, -0.8], gravity=False)
    passed = reactions(forces_at(bending(mechanism), values, load))
    bent, other = (elastic_reactions(forces_at(bending(mechanism, seed=seed), values, load)) for seed in (0, 1))
    size = max(np.abs([*item.force, *item.moment]).max() for item in passed.joints)
    for item in passed.joints:
        assert bent[item.joint] is not None
        np.testing.assert_allclose(bent[item.joint][item.unique], other[item.joint][item.unique], atol=1e-8 * size)
        apart = np.abs(bent[item.joint] - other[item.joint])[~item.unique]
        assert np.all(apart > 1e-7 * size)


def test_the_base_bears_weight_and_load_however_often_the_platform_is_held(mechanism):
    """Force, and moment about the base's origin, of all that the base passes: joints that yield, gears, beams."""
    record, values, load = yielding(bending(mechanism)), place(mechanism), load_of([3.0, -4.0, 5.0, 0.6, 0.7, -0.8])
    passed, points = elastic_reactions(forces_at(record, values, load)), child_points(record, values)
    borne = sum(
        (1.0 if joint.parent == record.base else -1.0) * _about_origin(passed[name], points[name])
        for name, joint in record.joints.items()
        if record.base in (joint.parent, joint.child)
    )
    inertia = link_inertia(record, values, masses(record))
    weights = inertia.masses[:, None] * inertia.gravity
    carried = np.concatenate([weights.sum(axis=0), np.cross(inertia.centres[0], weights).sum(axis=0)])
    point = METRES[record.unit] * platform_frame(record, values)[1][0]
    carried += _about_origin(np.concatenate([load.force, load.moment]), point)
    np.testing.assert_allclose(borne, -carried, atol=1e-8 * np.abs(carried).max())


def _about_origin(wrench, point):
    """A wrench (6,) at a point (3,), its moment about the base's origin."""
    return np.concatenate([wrench[:3], wrench[3:] + np.cross(point, wrench[:3])])


def test_in_motion_bars_that_bend_pass_what_newton_and_euler_say(mechanism):
    record = bending(mechanism)
    answer = forces_at(record, place(mechanism), load_of([3.0, -4.0, 5.0, 0.6, 0.7, -0.8]), *motion_of(mechanism))
    bent = elastic_reactions(answer)
    passed = reactions(answer)
    size = max(np.abs([*item.force, *item.moment]).max() for item in passed.joints)
    for item in passed.joints:
        rigid = np.concatenate([item.force, item.moment])
        np.testing.assert_allclose(bent[item.joint][item.unique], rigid[item.unique], atol=1e-8 * size)
