"""The cross-check holds for every mechanism, and fails for each thing that could be wrong."""

import dataclasses
import re
import sys

import numpy as np
import pytest

import assur
from assur.crosscheck.crosscheck import MEANINGS, TOLERANCES, crosscheck
from assur.crosscheck.samples import configurations
from assur.export.mjcf import mjcf
from assur.kinematics.status import Status
from assur.model.machine_data import LinkData
from own_machines import own_machine
from weighed import weighed

CLOSED_FORM = "Jacobian, closed form"
ALWAYS = set(TOLERANCES) - {"self-motions", CLOSED_FORM}


def failing(found):
    return {item.kind for item in found.differences if not item.holds}


@pytest.mark.sim
@pytest.mark.parametrize("name", assur.names())
def test_assur_and_mujoco_agree(name):
    record = assur.load(name)
    found = crosscheck(record, samples=3, seed=1)
    assert found.holds, [(item.kind, item.largest, item.mode) for item in found.differences if not item.holds]
    kinds = {item.kind for item in found.differences}
    assert kinds - {"self-motions"} == ALWAYS | ({CLOSED_FORM} if record.closed_form else set())
    assert sum(found.modes["inverse"].values()) >= 1
    assert sum(found.modes["direct"].values()) >= 1


@pytest.mark.sim
def test_they_agree_without_a_closed_form_and_without_a_box():
    record = dataclasses.replace(assur.load("fivebar"), closed_form=None, box={})
    found = crosscheck(record, samples=3)
    assert found.holds
    assert {item.kind for item in found.differences} == ALWAYS


@pytest.mark.sim
def test_every_one_of_too_many_drives_has_its_force_and_its_rotor():
    found = crosscheck(weighed(own_machine("two_upr_two_rpu")), samples=1)
    assert "forces of actuators" in {item.kind for item in found.differences}
    assert failing(found) == set()


@pytest.mark.sim
def test_a_file_with_another_dimension_differs_in_all_that_depends_on_it():
    record = assur.load("fivebar")
    other = mjcf(assur.load("fivebar", l2=195))
    found = failing(crosscheck(record, samples=3, text=other))
    assert {"loops", "Jacobian, joint graph", "assembly by the engine"} <= found


@pytest.mark.sim
def test_a_link_in_another_place_differs():
    text = mjcf(assur.load("fivebar"))
    moved = text.replace('name="crank1" pos="-0.07 ', 'name="crank1" pos="-0.0700001 ')
    assert moved != text
    assert {"frames of links", "loops"} <= failing(crosscheck(assur.load("fivebar"), samples=3, text=moved))


@pytest.mark.sim
def test_a_motor_of_the_other_sense_differs_in_the_inputs_alone():
    text = mjcf(assur.load("fivebar"))
    turned = text.replace('gear="1"', 'gear="-1"')
    assert turned != text
    assert failing(crosscheck(assur.load("fivebar"), samples=3, text=turned)) == {"inputs"}


@pytest.mark.sim
def test_a_missing_constraint_differs_in_the_freedoms_and_in_what_they_leave_open():
    text = mjcf(assur.load("fivebar"))
    loose = re.sub(r"<connect [^>]*>", "", text)
    found = failing(crosscheck(assur.load("fivebar"), samples=3, text=loose))
    assert found == {"freedoms", "Jacobian, joint graph", CLOSED_FORM, "assembly by the engine", "forces of actuators"}


@pytest.mark.sim
def test_a_link_of_another_mass_differs_in_the_forces_alone():
    """Along the plane of the links, so that gravity does not tell it, but a motion does."""
    record = assur.load("fivebar")
    links = {**record.machine.links, "rod1": LinkData(mass=0.7)}
    other = dataclasses.replace(record, machine=dataclasses.replace(record.machine, links=links))
    assert failing(crosscheck(record, samples=2, text=mjcf(other))) == {"forces of actuators"}


@pytest.mark.sim
def test_a_wrong_jacobian_of_a_closed_form_differs():
    record = assur.load("fivebar")
    form = record.closed_form

    def jacobians(ns, p, core):
        jp, jq = form.jacobians(ns, p, core)
        return jp, [[1.001 * entry for entry in row] for row in jq]

    wrong = dataclasses.replace(record, closed_form=dataclasses.replace(form, jacobians=jacobians))
    assert failing(crosscheck(wrong, samples=3)) == {CLOSED_FORM}


@pytest.mark.sim
def test_self_motions_are_the_engines_too():
    record = assur.load("zeng2019")
    (found,) = [item for item in crosscheck(record, samples=2).differences if item.kind == "self-motions"]
    assert found.holds
    assert found.count >= 8


@pytest.mark.sim
def test_a_self_motion_that_the_engine_does_not_have_differs(monkeypatch):
    def all_of_them(*arguments):
        return [dataclasses.replace(item, status=Status.self_motion) for item in configurations(*arguments)]

    monkeypatch.setattr("assur.crosscheck.crosscheck.configurations", all_of_them)
    assert failing(crosscheck(assur.load("fivebar"), samples=2)) == {"self-motions"}


@pytest.mark.sim
def test_where_no_pose_is_reached_nothing_is_said_to_hold():
    far = dataclasses.replace(assur.load("fivebar"), box={"x": (1000.0, 1001.0), "y": (0.0, 1.0)})
    found = crosscheck(far, samples=3)
    assert found.differences == ()
    assert not found.holds


@pytest.mark.sim
def test_the_same_seed_gives_the_same_numbers():
    record = assur.load("fivebar")
    first, again, other = (crosscheck(record, samples=3, seed=seed) for seed in (1, 1, 2))
    assert first == again
    assert first.differences != other.differences


def test_without_mujoco_the_message_says_how_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(assur.UsageError, match=re.escape("pip install '.[sim]'")):
        crosscheck(assur.load("fivebar"))


def test_every_kind_has_a_meaning():
    assert set(MEANINGS) == set(TOLERANCES)


@pytest.mark.sim
def test_a_number_that_is_none_is_the_largest_difference(monkeypatch):
    def sizes(engine, item, rng):
        return {"loops": np.nan if item.problem == "inverse" else 0.0}

    monkeypatch.setattr("assur.crosscheck.crosscheck._compared", sizes)
    found = crosscheck(assur.load("fivebar"), samples=2)
    assert found.differences[0].largest == np.inf
    assert not found.holds
