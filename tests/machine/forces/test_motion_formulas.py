"""Formulas of motion: against numbers that know no closed form, at other poses than those that simplified them."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.status import Status
from assur.kinematics.validation.check import METRES
from assur.machine.forces.motion_formulas import difference, motion_formulas
from assur.machine.masses.link_masses import all_masses
from assur.model.machine_data import LinkData
from assur.model.registry import load_record
from weighed import weighed

WRITTEN = ["orthoglide", "linear_delta_4r", "three_crr", "three_rrc", "three_rrrp4r", "tsai_platform", "three_upu"]
WRITTEN += ["planar_3rrr", "three_rps"]
DEEP = [pytest.param(name, marks=pytest.mark.deep) for name in WRITTEN]
WITH_RODS = ["delta_4s", "three_p2us", "h4_robot"]


@pytest.mark.parametrize(
    "name",
    [
        "fivebar",
        "zeng2019",
        "tripteron",
        "planar_3rpr",
        *(pytest.param(name, marks=pytest.mark.deep) for name in WRITTEN),
    ],
)
def test_they_are_the_numbers_of_the_joint_graph(name):
    """In motion and under a load, with bodies whose centres and inertias lie anywhere, and rotors."""
    assert difference(motion_formulas(weighed(load_record(name)))) < 1e-10


@pytest.mark.parametrize(
    "name", ["linear_delta_4s", *(pytest.param(name, marks=pytest.mark.deep) for name in WITH_RODS)]
)
def test_rods_between_balls_turn_across_their_axes_alone(name):
    """As in the numbers, whatever the closed form says of their spins; thick ones, so that turning them weighs."""
    record = load_record(name)
    metre = METRES[record.unit]
    thick = {
        link: LinkData(mass=body.mass, centre=body.centre / metre, inertia=body.inertia + 0.01 * body.mass * np.eye(3))
        for link, body in all_masses(record).bodies.items()
    }
    assert difference(motion_formulas(replace(record, machine=replace(record.machine, links=thick)))) < 1e-10


def test_they_hold_up_to_the_border_where_the_numbers_have_a_status():
    """Where the third limb is nearly stretched: a rate of the pose asks for any number of its actuator's."""
    record = assur.load("zeng2019")
    own = motion_formulas(record)
    border = 458.9129351803  # of z at this x and y: M3 = 0
    poses = np.array([[-15.4714, 9.6849, border - away] for away in (1.0, 1e-2, 1e-4, 1e-6, 1e-7)])
    told = own(poses)
    answer = record.forces(poses)
    assert [Status(int(code)).name for code in answer.status] == ["regular"] * 2 + ["near_singular"] * 3
    np.testing.assert_allclose(answer.mass_matrix, told.mass, rtol=1e-7)
    np.testing.assert_allclose(answer.gravity, told.gravity, rtol=1e-7, atol=1e-9)


@pytest.mark.parametrize(
    ("record", "said"),
    [(load_record("gough_stewart"), "not by a quaternion"), (weighed(load_record("linear_delta_4s")), "swings")],
)
def test_what_has_no_formulas_is_told(record, said):
    with pytest.raises(UsageError, match=said):
        motion_formulas(record)


def test_without_a_closed_form_it_is_told_what_would_derive_one():
    with pytest.raises(UsageError, match="no formulas of motion without a closed form") as refused:
        motion_formulas(replace(load_record("fivebar"), closed_form=None))
    assert "assur derive" in refused.value.hint


def test_a_file_without_a_box_is_told_to_have_one():
    record = replace(load_record("fivebar"), box={})
    with pytest.raises(UsageError, match="no box of x, y"):
        motion_formulas(record)
