"""Reactions: how many are open, which are unique, and that what is open can be added."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.machine.forces.actuator_forces import forces
from assur.machine.forces.reactions import reactions
from assur.model.machine_data import LinkData, MachineData
from weighed import weighed

POSE = [-15.4714, 9.6849, 456.3315]


@pytest.fixture(scope="module")
def passed():
    return reactions(forces(weighed(assur.load("zeng2019")), POSE))


def test_of_88_unknowns_of_the_papers_mechanism_78_are_determined(passed):
    assert (passed.unknowns, passed.equations, passed.rank, passed.redundancy) == (88, 78, 78, 10)


def test_open_directions_are_orthonormal_and_leave_unique_numbers_alone(passed):
    for item in passed.joints:
        rows = item.indeterminate
        np.testing.assert_allclose(rows @ rows.T, np.eye(len(rows)), atol=1e-9)
        if len(rows):
            np.testing.assert_allclose(rows[:, item.unique], 0.0, atol=1e-6)
        assert item.unique.all() == (len(rows) == 0)


def test_a_drive_passes_its_force_and_a_hinge_no_moment(passed):
    by_name = {item.joint: item for item in passed.joints}
    assert by_name["P1"].force[1] == pytest.approx(passed.actuators[0])
    assert by_name["P1"].unique[1]
    for name in ("B1", "C1", "B3a", "C3b"):
        assert by_name[name].moment[0] == pytest.approx(0.0, abs=1e-9)


def test_a_planar_five_bar_by_hand():
    """Weights of the rods alone, symmetric about y: each joint on the base bears half of them."""
    bare = assur.load("fivebar")
    links = {name: LinkData(mass=0.0) for name in ("crank1", "crank2")}
    links |= {name: LinkData(mass=2.0, centre=np.array([97.0, 0, 0])) for name in ("rod1", "rod2")}
    record = replace(
        bare,
        machine=MachineData(links=links, gravity=replace(bare.machine.gravity, direction=np.array([0.0, -1.0, 0.0]))),
    )
    answer = forces(record, [0.0, 224.0])
    by_name = {item.joint: item for item in reactions(answer).joints}
    assert by_name["A1"].force[1] == pytest.approx(2 * 9.81)
    assert by_name["A2"].force[1] == pytest.approx(2 * 9.81)
    assert by_name["P"].force[1] == pytest.approx(0.0, abs=1e-9)
    assert answer.forces[0, 0] == pytest.approx(-answer.forces[0, 1])
    rod = answer.motion.inertia.centres[0][2]
    push = by_name["P"].force[0]  # of rod 1 on rod 2, so the other way on rod 1
    weight = (rod[0] + 0.07) * -2 * 9.81
    assert answer.forces[0, 0] == pytest.approx(-(weight + 0.224 * push), abs=1e-9)
