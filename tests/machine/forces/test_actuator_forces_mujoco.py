"""Forces against MuJoCo's own mass matrix, bias and constraint Jacobian of the exported file, projected on the motions
that keep the loops closed: masses assigned at random, in motion, under gravity and a load."""

import numpy as np
import pytest

import assur
from assur.crosscheck import engine as engines
from assur.crosscheck.projected_dynamics import bare_bodies, projected_forces
from assur.machine.forces.actuator_forces import forces_at
from assur.machine.forces.balance import Asked
from assur.machine.forces.batches import batch_of
from assur.machine.forces.loads import load_of
from assur.machine.forces.reactions import reactions
from assur.machine.masses.link_masses import masses
from catalogue import each
from own_machines import OWN, own_machine
from weighed import motion_of, place, weighed

pytestmark = pytest.mark.sim
WRENCH = [3.0, -4.0, 5.0, 0.6, 0.7, -0.8]


@pytest.mark.parametrize("name", each())
def test_forces_are_those_of_mujoco(name):
    compared(assur.load(name))


@pytest.mark.parametrize(
    "name", [name if name == "screws" else pytest.param(name, marks=pytest.mark.deep) for name in OWN]
)
def test_forces_of_mechanisms_of_ones_own_are_those_of_mujoco(name):
    """Screws, a platform that folds, a loop in a limb, more drives than freedoms; none of them has a closed form."""
    compared(own_machine(name))


def compared(mechanism):
    """Ours, one pose and many, against MuJoCo's."""
    record = weighed(mechanism)
    values = place(mechanism)
    speed, change = motion_of(record)
    answer = forces_at(record, values, load_of(WRENCH), speed, change)
    engine = engines.engine(record)
    tau = projected_forces(record, engine, bare_bodies(engine), values[0], (speed[0], change[0]), np.array(WRENCH))
    np.testing.assert_allclose(answer.forces[0], tau, atol=1e-6 * np.abs(tau).max())
    question = Asked(record, values, masses(record), load_of(WRENCH), speed, change)
    many, clear = batch_of(question).balanced(question)
    assert clear.all()
    np.testing.assert_allclose(many.forces[0], tau, atol=1e-6 * np.abs(tau).max())
    np.testing.assert_allclose(reactions(answer).actuators, tau, atol=1e-6 * np.abs(tau).max())
