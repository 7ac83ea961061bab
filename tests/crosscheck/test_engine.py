"""MuJoCo reads the exported file, stands at home, and holds the loops together when it simulates."""

import numpy as np
import pytest

import assur
from assur.crosscheck import engine as engines
from assur.export.mjcf import mjcf

pytestmark = pytest.mark.sim


@pytest.fixture(params=assur.names())
def engine(request):
    return engines.engine(assur.load(request.param))


def at_home(engine):
    engine.mujoco.mj_resetDataKeyframe(engine.model, engine.data, engine.model.key("home").id)
    engine.mujoco.mj_fwdPosition(engine.model, engine.data)


def test_the_home_key_closes_the_loops_and_puts_our_joint_values(engine):
    at_home(engine)
    residual, _ = engines.constraints(engine)
    assert np.max(np.abs(residual)) < 1e-11
    key = engine.data.qpos.copy()
    engines.put(engine, engine.bodies.home)
    np.testing.assert_allclose(key, engine.data.qpos, atol=1e-12)


@pytest.mark.parametrize("name", assur.names())
def test_half_a_second_of_simulation_keeps_loops_closed_and_servos_near_home(name):
    record = assur.load(name)
    engine = engines.engine(record, mjcf(record, servos=True))
    at_home(engine)
    link = engine.record.platform.link
    before = engines.link_frames(engine)[link][1]
    steps = round(0.5 / engine.model.opt.timestep)
    engine.mujoco.mj_step(engine.model, engine.data, steps)
    engine.mujoco.mj_fwdPosition(engine.model, engine.data)
    residual, _ = engines.constraints(engine)
    assert np.max(np.abs(residual)) < 1e-4
    moved = np.linalg.norm(engines.link_frames(engine)[link][1] - before) / engine.bodies.size
    assert moved < 0.05
    assert not any(warning.number for warning in engine.data.warning)


def test_settling_finds_the_way_back_and_locked_inputs_stay(engine):
    engines.put(engine, engine.bodies.home)
    inputs = engines.printed_inputs(engine)
    residual_before = engines.link_frames(engine)[engine.record.platform.link]
    assert engines.settle(engine, 1e-5 * np.ones(engine.model.nv))
    np.testing.assert_allclose(engines.printed_inputs(engine), inputs, atol=1e-15)
    place = engines.link_frames(engine)[engine.record.platform.link]
    np.testing.assert_allclose(place[1], residual_before[1], atol=1e-7 * engine.bodies.size)
