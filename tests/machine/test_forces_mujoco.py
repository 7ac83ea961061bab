"""Forces against MuJoCo's own mass matrix, bias and constraint Jacobian of the exported file, projected on the motions
that keep the loops closed: masses assigned at random, in motion, under gravity and a load."""

import numpy as np
import pytest

import assur
from assur.crosscheck import engine as engines
from assur.export.bodies import CARRIER_INERTIA
from assur.export.names import link_name
from assur.machine.balance import Asked
from assur.machine.batches import batch_of
from assur.machine.forces import forces_at
from assur.machine.loads import load_of
from assur.machine.masses import masses
from assur.machine.reactions import reactions
from catalogue import each
from own_machines import OWN, own_machine
from weighed import motion_of, place, weighed

pytestmark = pytest.mark.sim
WRENCH = [3.0, -4.0, 5.0, 0.6, 0.7, -0.8]
STEP = 1e-5
"""Seconds on either side of which Jacobians are compared: half of the change of their change is some 1e-10."""


def bare(engine):
    """The engine without what the export adds: what carriers weigh, and some inertia of each body."""
    model, links = engine.model, {link_name(link) for link in engine.record.links}
    added = CARRIER_INERTIA * engine.bodies.size**2
    for number in range(1, model.nbody):
        if model.body(number).name in links:
            model.body_inertia[number] -= added
        else:
            model.body_mass[number], model.body_inertia[number] = 1e-8, 1e-8 * added
    return engine


def rows(engine):
    """Rates (r + k, nv) of the loops and of the pose per velocity, in SI units."""
    size, record = engine.bodies.size, engine.record
    loops = engines.constraints(engine)[1] / engine.units
    lengths = np.array([size if name in "xyz" else 1.0 for name in engines.rate_names(record.platform.pose)])
    return np.concatenate([loops, engines._pose_rates(engine) * lengths[:, None]]), len(loops)


def rows_after(engine, velocity, seconds):
    start = engine.data.qpos.copy()
    engine.mujoco.mj_integratePos(engine.model, engine.data.qpos, velocity, seconds)
    engines._positions(engine)
    moved = rows(engine)[0]
    engine.data.qpos[:] = start
    engines._positions(engine)
    return moved


def mass_matrix(engine):
    columns = np.zeros((engine.model.nv, engine.model.nv))
    for column, unit in zip(columns, np.eye(engine.model.nv), strict=True):
        engine.mujoco.mj_mulM(engine.model, engine.data, column, unit)
    return columns


def bias(engine, velocity):
    """Centrifugal forces, and gravity (nv,)."""
    engine.data.qvel[:] = velocity
    engine.mujoco.mj_fwdVelocity(engine.model, engine.data)
    return engine.data.qfrc_bias.copy()


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
    engine = bare(engines.engine(record))
    model, data = engine.model, engine.data
    engines.put(engine, values[0])
    matrix = mass_matrix(engine)
    closed, count = rows(engine)
    scaled = closed * engine.units
    idle = engine.units[:, None] * null_space(scaled)
    held = np.concatenate([scaled, idle.T @ matrix * engine.units])  # what nothing drives moves with the least energy

    def moves(of_rows, of_idle):
        goal = np.concatenate([of_rows, of_idle])
        return engine.units * np.linalg.lstsq(held, goal, rcond=1e-10)[0]

    velocity = moves(np.concatenate([np.zeros(count), speed[0]]), np.zeros(idle.shape[1]))
    turning = (rows_after(engine, velocity, STEP) - rows_after(engine, velocity, -STEP)) @ velocity / (2 * STEP)
    goal = np.concatenate([np.zeros(count), change[0]]) - turning
    platform = np.zeros((2, 3, model.nv))
    body = data.body(link_name(record.platform.link))
    point = body.xpos + body.xmat.reshape(3, 3) @ (engine.bodies.metre * record.platform.point)
    engine.mujoco.mj_jac(model, data, *platform, point, body.id)
    pushed = np.einsum("akv,ak->v", platform, np.reshape(WRENCH, (2, 3)))
    passive = bias(engine, velocity) - pushed
    acceleration = moves(goal, -idle.T @ passive)
    needed = matrix @ acceleration + passive
    free = engine.units[:, None] * null_space(scaled[:count])
    dofs = [model.joint(record.coordinate_label(item.coordinate)).dofadr[0] for item in record.drives]
    signs = np.array([item.sign for item in record.drives])
    tau = np.linalg.lstsq(free[dofs].T * signs, free.T @ needed, rcond=1e-10)[0]
    np.testing.assert_allclose(answer.forces[0], tau, atol=1e-6 * np.abs(tau).max())
    question = Asked(record, values, masses(record), load_of(WRENCH), speed, change)
    many, clear = batch_of(question).balanced(question)
    assert clear.all()
    np.testing.assert_allclose(many.forces[0], tau, atol=1e-6 * np.abs(tau).max())
    np.testing.assert_allclose(reactions(answer).actuators, tau, atol=1e-6 * np.abs(tau).max())


def null_space(matrix):
    _, sizes, right = np.linalg.svd(matrix)
    rank = int(np.sum(sizes > 1e-8 * sizes[0]))
    return right[rank:].T
