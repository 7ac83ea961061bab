"""Reactions where links bend: by multipliers, in balance, and open where rigid links leave them so."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.pose import platform_frame
from assur.kinematics.validation.check import METRES
from assur.machine.elasticity.elastic_reactions import elastic_reactions
from assur.machine.forces.actuator_forces import forces, forces_at
from assur.machine.forces.loads import load_of
from assur.machine.forces.reactions import child_points
from bending import bending, by_multipliers
from weighed import place

POSE = [-15.4714, 9.6849, 456.3315]
WRENCH = np.array([3.0, -4.0, 5.0, 0.6, 0.7, -0.8])


@pytest.mark.parametrize("name", ["zeng2019", "orthoglide", "planar_3rrr"])
def test_what_passive_joints_pass_is_what_multipliers_say(name):
    bare = assur.load(name)
    record, values = bending(bare), place(bare)
    bent = elastic_reactions(forces_at(record, values, load_of(WRENCH, gravity=False)))
    _, passed = by_multipliers(record, values[0])
    point = METRES[record.unit] * platform_frame(record, values)[1][0]
    driven = {item.coordinate.joint for item in record.drives}
    for joint, at in child_points(record, values).items():
        if joint not in driven:
            wrench = passed[joint] @ WRENCH
            wrench[3:] += np.cross(point - at, wrench[:3])
            np.testing.assert_allclose(bent[joint], wrench, atol=1e-6)


def test_a_parallelogram_of_rigid_links_stays_open_and_the_rest_does_not():
    zeng = assur.load("zeng2019")
    rigid = {name: replace(zeng.machine.links[name], rigid=True) for name in ("link7a", "link7b")}
    record = replace(zeng, machine=replace(zeng.machine, links={**zeng.machine.links, **rigid}))
    bent = elastic_reactions(forces(record, POSE))
    assert [joint for joint, wrench in bent.items() if wrench is None] == ["D3a", "D3b", "E3a", "E3b"]


def test_where_the_actuators_do_not_hold_the_platform_nothing_is_known():
    fivebar = assur.load("fivebar", l2=150)
    flat = forces(fivebar, [0, 60])
    assert set(elastic_reactions(flat).values()) == {None}
    bare = replace(fivebar, machine=replace(fivebar.machine, actuators={}))
    with pytest.raises(UsageError, match="no stiffness of A1, A2"):
        elastic_reactions(forces(bare, [0, 224]))
