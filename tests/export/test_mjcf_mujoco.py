"""MuJoCo itself reads the file as our joint graph is, for every type of joint, in the tree and cut."""

import numpy as np
import pytest

from assur.crosscheck import engine as engines
from assur.joint_graph.frames import frames
from assur.kinematics.closure import mobility

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
