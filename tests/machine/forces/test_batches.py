"""Many configurations at once: recorded programs against singular values, the other way to the same forces."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics import border
from assur.kinematics.home import home_values
from assur.kinematics.rates.acceleration import joints_in_mode
from assur.kinematics.rates.motions import around_home
from assur.kinematics.status import Status
from assur.machine.forces.actuator_forces import MANY, forces
from assur.machine.forces.balance import Asked, balanced
from assur.machine.forces.batches import BLOCK, balanced_in_batches, batch_of
from assur.machine.forces.loads import Load, load_of
from assur.machine.masses.link_masses import masses
from assur.model.machine_data import LinkData
from catalogue import each
from weighed import motion_of, weighed

WRENCH = [3.0, -4.0, 5.0, 0.6, 0.7, -0.8]


def asked(name, still=False, load=WRENCH, record=None):
    """Configurations around home, all alike in how they move."""
    record = weighed(assur.load(name)) if record is None else record
    values = around_home(record)
    motion = [None if still else np.repeat(part, len(values), axis=0) for part in motion_of(record)]
    return Asked(record, values, masses(record), load_of(load), *motion)


def agree(question, share=1e-10):
    answer, clear = batch_of(question).balanced(question)
    expected = balanced(question)
    assert clear.all()
    for name in ("forces", "joint_rates", "joint_accelerations", "kinetic_energy", "potential_energy"):
        own, other = getattr(answer, name), getattr(expected, name)
        np.testing.assert_allclose(own, other, atol=share * np.abs(other).max(), err_msg=name)
    np.testing.assert_array_equal(answer.status, expected.status)
    np.testing.assert_array_equal(answer.rated, expected.rated)


@pytest.mark.parametrize(
    ("name", "still"), [("fivebar", False), ("three_rps", False), ("zeng2019", True), ("linear_delta_4s", False)]
)
def test_both_ways_agree(name, still):
    """A plane, two angles of three, parallelograms that hold the same twice, rods that spin."""
    agree(asked(name, still))


@pytest.mark.parametrize("name", each(quick=()))
def test_both_ways_agree_on_every_mechanism(name):
    agree(asked(name))


@pytest.mark.deep
def test_spins_of_slender_rods_are_the_shortest():
    """Bars without inertia about their axes: nothing but the least motion says how they spin."""
    record = assur.load("linear_delta_4s")
    links = {name: LinkData(kg_per_m=1.0) if "rod" in name else own for name, own in record.machine.links.items()}
    question = asked("linear_delta_4s", record=replace(record, machine=replace(record.machine, links=links)))
    assert not batch_of(question).question.heavy
    agree(question)


def test_forces_at_many_poses_are_those_at_each():
    """Across a singularity of the five-bar, near it, and out of reach; loads that differ from pose to pose."""
    record = weighed(assur.load("fivebar", l2=150))
    x, y = np.meshgrid(np.linspace(-60, 60, 21), np.concatenate([np.linspace(30, 400, 20), [60.0, 60.001]]))
    poses = np.stack([x.ravel(), y.ravel()], axis=-1)
    loads = np.random.default_rng(0).normal(size=(len(poses), 6))
    assert len(poses) > MANY
    together = forces(record, poses, [100.0, -50.0], [1000.0, 0.0], loads, mode="-+")
    apart = [
        forces(record, part, [100.0, -50.0], [1000.0, 0.0], load, mode="-+")
        for part, load in ((poses[:200], loads[:200]), (poses[200:], loads[200:]))
    ]
    np.testing.assert_array_equal(together.status, np.concatenate([part.status for part in apart]))
    kinds = {Status(int(code)).name for code in together.status}
    assert kinds >= {"regular", "near_singular", "parallel", "unreachable"}
    for name in ("forces", "power", "kinetic_energy", "mass_matrix", "bias", "gravity", "input_rates"):
        expected = np.concatenate([getattr(part, name) for part in apart])
        np.testing.assert_allclose(getattr(together, name), expected, rtol=1e-7, atol=1e-9, err_msg=name)


def test_a_configuration_that_is_open_is_left_to_singular_values():
    question = asked("fivebar")
    open_loops = Asked(**{**vars(question), "values": question.values + 1e-5 * np.arange(5)})
    assert not batch_of(open_loops).balanced(open_loops)[1].any()
    assert (balanced_in_batches(open_loops).status == Status.not_closed).all()


def test_pivots_that_are_not_good_are_noticed():
    """The first joint of a four-bar's crank as the pivot, at a place where the crank does not follow from it."""
    question = asked("fivebar")
    batch = batch_of(question)
    wrong = replace(batch.question, loops=((*batch.question.loops[:-1],)))
    bad = replace(batch, question=wrong)
    assert not bad.balanced(question)[1].any()


def test_blocks_are_joined_in_order():
    record = weighed(assur.load("fivebar"))
    values = np.tile(home_values(record), (BLOCK + 3, 1))
    loads = Load(np.random.default_rng(0).normal(size=(len(values), 3)), np.zeros(3))
    answer = balanced_in_batches(Asked(record, values, masses(record), loads))
    ends = np.array([0, BLOCK - 1, BLOCK, BLOCK + 2])
    few = balanced(Asked(record, values[ends], masses(record), loads.part(ends, len(values))))
    np.testing.assert_allclose(answer.forces[ends], few.forces, rtol=1e-9)


@pytest.mark.parametrize("name", each(quick=()))
def test_both_ways_agree_in_the_whole_workspace(name):
    record = weighed(assur.load(name))
    low, high = np.array([record.box[coordinate] for coordinate in record.platform.pose]).T
    poses = border.checked_poses(record, np.random.default_rng(1).uniform(low, high, size=(300, len(low))))
    joints = joints_in_mode(record, poses)
    values = joints[np.isfinite(joints).all(axis=1)]
    motion = [np.repeat(part, len(values), axis=0) for part in motion_of(record)]
    question = Asked(record, values, masses(record), load_of(None), *motion)
    answer, clear = batch_of(question).balanced(question)
    expected = balanced(question)
    regular = clear & (expected.status == Status.regular)
    assert np.mean(clear) > 0.95
    np.testing.assert_array_equal(answer.status[clear], expected.status[clear])
    size = np.abs(expected.forces[regular]).max(axis=1, keepdims=True)
    np.testing.assert_allclose(answer.forces[regular] / size, expected.forces[regular] / size, atol=1e-8)
