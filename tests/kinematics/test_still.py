"""What stands still about home."""

import numpy as np

from assur.joint_graph.frames import frames
from assur.kinematics.home import home_values
from assur.kinematics.position import direct
from assur.kinematics.still import otherwise
from assur.model.registry import load_record


def test_a_platform_that_home_never_turns_is_otherwise_where_it_is_turned():
    """A search of the Delta robot's assemblies meets some whose platform is turned; none of its formulas knows them."""
    record = load_record("delta_4s")
    found = direct(record, np.radians([10.0, 20.0, 30.0]), method="search")
    joints = found.joints[found.exists]
    turned = ~np.all(np.isclose(frames(record, joints)[record.platform.link][0], np.eye(3), atol=1e-6), axis=(1, 2))
    assert [bool(text) for text in otherwise(record, joints)] == turned.tolist()
    assert otherwise(record, home_values(record)[None]) == [""]
