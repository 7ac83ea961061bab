"""Compliances and gears: in series by hand, in vibrations, in reactions, and what is said of them."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.pose import platform_frame
from assur.kinematics.validation.check import METRES
from assur.machine.elasticity.elastic_reactions import elastic_reactions
from assur.machine.elasticity.stiffness import stiffness_at
from assur.machine.forces.actuator_forces import forces_at
from assur.machine.forces.loads import load_of
from assur.machine.forces.reactions import child_points, reactions
from assur.machine.masses.bars import joint_points
from assur.machine.masses.link_masses import masses
from assur.model.machine_data import Actuator, Gear, LinkData
from bending import bending, by_multipliers, given, yielding
from weighed import motion_of, place, weighed

WRENCH = np.array([3.0, -4.0, 5.0, 0.6, 0.7, -0.8])


def machine_of(record, **changes):
    """The record with other data of its machine."""
    return replace(record, machine=replace(record.machine, **changes))


def geared(record, gear):
    return machine_of(
        record, actuators={label: replace(own, gear=gear) for label, own in record.machine.actuators.items()}
    )


def test_a_gear_is_in_series_and_its_energy_apart():
    record = assur.load("orthoglide")
    own = geared(record, Gear(100.0, 4e7)).stiffness([0, 0, 0])
    motors = own.actuator_only
    np.testing.assert_allclose(motors.translational[0], 1.0 / (1e-7 + 1.0 / 4e7))
    shares = motors.shares()
    assert (shares.kinds["gears"], shares.kinds["actuators"]) == (pytest.approx(0.2), pytest.approx(0.8))
    assert shares.links == {"actuators": pytest.approx(1.0)}
    np.testing.assert_allclose(
        geared(record, Gear(100.0)).stiffness([0, 0, 0]).compliance, record.stiffness([0, 0, 0]).compliance
    )


def test_rotors_behind_gears_vibrate_by_themselves():
    """By the mass matrix of the pose's rates and the rotors, rigid links, and rates of inputs over the pose's."""
    bare = assur.load("zeng2019")
    rigid = {name: replace(data, rigid=True) for name, data in bare.machine.links.items()}
    record = geared(machine_of(bare, links=rigid), Gear(300.0, 4e7, 2e-5))
    own = record.stiffness([-15.4714, 9.6849, 456.3315])
    moving = forces_at(geared(record, None), own.values, load_of(None))
    rates = moving.motion.drives @ moving.motion.of_pose[0]
    rotor = 300.0**2 * 2e-5 * np.eye(3)
    mass = np.block([[moving.mass_matrix[0], np.zeros((3, 3))], [np.zeros((3, 3)), rotor]])
    apart, held = np.hstack([rates, -np.eye(3)]), np.hstack([np.zeros((3, 3)), np.eye(3)])
    squares = np.linalg.eigvals(np.linalg.solve(mass, 4e7 * apart.T @ apart + 1e7 * held.T @ held)).real
    np.testing.assert_allclose(own.vibrations().frequencies, np.sqrt(np.sort(squares)) / (2 * np.pi), rtol=1e-9)
    whole = forces_at(record, own.values, load_of(None)).mass_matrix
    np.testing.assert_allclose(whole - moving.mass_matrix, [rates.T @ rotor @ rates], atol=1e-12)


def test_a_bars_compliance_given_by_hand_vibrates_as_the_bar():
    """The same consistent mass, as slender bars bend: of profiles that do not give way to shear."""
    bare = assur.load("zeng2019")
    values, record = place(bare), bending(bare)
    by_hand = given(record, shear=False)
    weighed = {
        name: replace(data, profile=record.machine.links[name].profile, kg_per_m=None)
        for name, data in by_hand.machine.links.items()
    }
    own = stiffness_at(record, values, shear=False).vibrations().frequencies
    other = stiffness_at(machine_of(by_hand, links=weighed), values, shear=False).vibrations().frequencies
    np.testing.assert_allclose(other, own, rtol=1e-9)


def test_a_compliance_seen_from_either_end_is_one():
    """At the second joint while the first is held, and the other way round; the file's order where no bars are said."""
    bare = assur.load("fivebar")
    points, (first, second) = joint_points(bare, "rod1"), joint_points(bare, "rod1")
    lever = METRES[bare.unit] * (points[first] - points[second])
    back = np.block([[np.eye(3), np.cross(np.eye(3), lever, axis=0)], [np.zeros((3, 3)), np.eye(3)]])
    roots = np.repeat([1e-4, 1e-3], 3)[:, None] * np.random.default_rng(0).normal(size=(6, 6))
    record, values = bending(bare), place(bare)
    answers = [
        stiffness_at(machine_of(record, links={**record.machine.links, "rod1": own}), values).compliance
        for own in (
            LinkData(compliance=roots @ roots.T),
            LinkData(compliance=roots @ roots.T, bars=((first, second),)),
            LinkData(compliance=back @ roots @ roots.T @ back.T, bars=((second, first),)),
        )
    ]
    for other in answers[1:]:
        np.testing.assert_allclose(other, answers[0], rtol=1e-9, atol=1e-12 * np.abs(answers[0]).max())


def test_a_link_without_length_gives_way_as_the_joint_before_it():
    bare = assur.load("three_rps")
    record, values = bending(bare), place(bare)
    roots = np.repeat([1e-4, 1e-3], 3)[:, None] * np.random.default_rng(0).normal(size=(6, 6))
    link = next(name for name, data in record.machine.links.items() if data.profile is None and name != bare.base)
    before, after = joint_points(bare, link)
    assert (bare.joints[before].child, bare.joints[after].parent) == (link, link)
    np.testing.assert_array_equal(*joint_points(bare, link).values())
    soft = machine_of(record, links={**record.machine.links, link: LinkData(compliance=roots @ roots.T)})
    other = machine_of(record, compliances={before: roots @ roots.T})
    own, same = (stiffness_at(each, values).compliance[0] for each in (soft, other))
    np.testing.assert_allclose(own, same, rtol=1e-8, atol=1e-11 * np.abs(own).max())
    assert not np.allclose(own, stiffness_at(record, values).compliance[0], rtol=1e-3)


@pytest.mark.parametrize("rigid", [False, True])
@pytest.mark.parametrize("name", ["zeng2019", "orthoglide", "tsai_platform"])
def test_joints_that_yield_pass_what_multipliers_say(name, rigid):
    """Where no link bends too: compliances alone tell what an overconstrained mechanism of rigid links leaves open."""
    bare = assur.load(name)
    record, values = yielding(bending(bare), ways=6), place(bare)
    if rigid:
        record = machine_of(record, links={link: LinkData(mass=1.0) for link in record.links})
    solved = forces_at(record, values, load_of(WRENCH, gravity=False))
    assert any(not joint.unique.all() for joint in reactions(solved).joints)
    bent = elastic_reactions(solved)
    _, passed = by_multipliers(record, values[0])
    point = METRES[record.unit] * platform_frame(record, values)[1][0]
    for joint, at in child_points(record, values).items():
        wrench = passed[joint] @ WRENCH
        wrench[3:] += np.cross(point - at, wrench[:3])
        np.testing.assert_allclose(bent[joint], wrench, atol=1e-6)


def test_in_motion_gears_and_joints_that_yield_pass_what_newton_and_euler_say():
    bare = assur.load("zeng2019")
    record, values = yielding(bending(bare)), place(bare)
    answer = forces_at(record, values, load_of(WRENCH), *motion_of(bare))
    bent, passed = elastic_reactions(answer), reactions(answer)
    size = max(np.abs([*joint.force, *joint.moment]).max() for joint in passed.joints)
    for joint in passed.joints:
        rigid = np.concatenate([joint.force, joint.moment])
        np.testing.assert_allclose(bent[joint.joint][joint.unique], rigid[joint.unique], atol=1e-8 * size)


@pytest.mark.parametrize("name", ["zeng2019", "fivebar", "delta_4s"])
def test_bodies_beside_bars_that_bend_pass_what_newton_and_euler_say(name):
    """Centres anywhere, also beyond the ends of bars, in motion."""
    bare = assur.load(name)
    values, bodies = place(bare), weighed(bare).machine.links
    record = yielding(bending(bare))
    links = {
        link: replace(data, mass=bodies[link].mass, centre=bodies[link].centre, inertia=bodies[link].inertia)
        for link, data in record.machine.links.items()
    }
    answer = forces_at(machine_of(record, links=links), values, load_of(WRENCH), *motion_of(bare))
    bent, passed = elastic_reactions(answer), reactions(answer)
    size = max(np.abs([*joint.force, *joint.moment]).max() for joint in passed.joints)
    for joint in passed.joints:
        rigid = np.concatenate([joint.force, joint.moment])
        np.testing.assert_allclose(bent[joint.joint][joint.unique], rigid[joint.unique], atol=1e-8 * size)


def test_a_slender_body_on_a_bar_that_bends_vibrates_much_as_the_bar_that_weighs_so():
    """One body for what is spread: the slowest, which swings the bars and bends them little, within 2 %."""
    bare = assur.load("fivebar")
    record, values = bending(bare), place(bare)
    links = {
        link: replace(data, mass=body.mass, centre=1e3 * body.centre, inertia=body.inertia)
        for link, data in record.machine.links.items()
        if (body := masses(record).bodies.get(link)) is not None
    }
    stated = machine_of(record, links=record.machine.links | links)
    own, other = (stiffness_at(each, values).vibrations().frequencies[:2] for each in (record, stated))
    np.testing.assert_allclose(other, own, rtol=0.02)
    assert not np.allclose(other, own, rtol=1e-9)


def test_shares_of_joints_are_by_joint_and_whole():
    shares = stiffness_at(yielding(bending(assur.load("delta_4s"))), place(assur.load("delta_4s"))).shares()
    for split in (shares.links, shares.kinds, shares.actuators, shares.joints):
        assert sum(split.values()) == pytest.approx(1.0)
    assert shares.links["joints"] == pytest.approx(shares.kinds["joints"])
    assert shares.links["joints"] > 0.0
    assert list(shares.joints) == list(assur.load("delta_4s").joints)
    assert set(shares.bent) == set(shares.links) - {"actuators", "joints"}


def test_a_compliance_between_joints_that_are_not_known_is_refused():
    record = assur.load("zeng2019")
    links = {**record.machine.links, "link11": LinkData(mass=1.0, compliance=np.eye(6))}
    with pytest.raises(UsageError, match="it has 3 joints that are not prismatic"):
        machine_of(record, links=links).stiffness([-15.4714, 9.6849, 456.3315])
    with pytest.raises(UsageError, match="no stiffness of P1, P2, P3"):
        machine_of(record, actuators={"P1": Actuator(gear=Gear(2.0, 1e5))}).stiffness([-15.4714, 9.6849, 456.3315])
