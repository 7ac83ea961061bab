"""MuJoCo itself reads the file as our joint graph is, for every type of joint, in the tree and cut."""

import numpy as np
import pytest

from assur.crosscheck import engine as engines
from assur.export.bodies import MASS
from assur.export.names import link_name
from assur.joint_graph.frames import frames
from assur.kinematics.closure import mobility
from assur.machine.masses.link_masses import masses

pytestmark = pytest.mark.sim


def test_links_loops_and_freedoms_are_ours(record, elsewhere, anywhere, metre):
    engine = engines.engine(record)
    for values in (elsewhere, anywhere):
        engines.put(engine, values)
        found = engines.link_frames(engine)
        for link, (rotation, origin) in frames(record, values).items():
            np.testing.assert_allclose(found[link][0], rotation, atol=1e-9)
            np.testing.assert_allclose(found[link][1], metre * origin, atol=1e-9)
    assert np.max(np.abs(engines.constraints(engine)[0])) > 1e-4
    engines.put(engine, elsewhere)
    assert np.max(np.abs(engines.constraints(engine)[0])) < 1e-9
    assert engines.freedoms(engine) == mobility(record, elsewhere).freedoms


def test_masses_are_those_of_the_file(record):
    """Principal moments as MuJoCo finds them; a point has those of a carrier."""
    engine, known = engines.engine(record), masses(record)
    bodies = known.carried(record.platform.link)
    for link in record.links:
        body = engine.model.body(link_name(link))
        own = None if known.lacking else bodies.get(link)
        assert body.mass[0] == pytest.approx(MASS if own is None else own.mass)
        if own is not None:
            np.testing.assert_allclose(body.ipos, own.centre, atol=1e-12)
            moments, nominal = np.linalg.eigvalsh(own.inertia), 4e-7 * engine.bodies.size**2
            np.testing.assert_allclose(np.sort(body.inertia), moments + nominal, rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(engine.model.opt.gravity, known.gravity)
