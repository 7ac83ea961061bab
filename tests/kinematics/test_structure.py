"""A mechanism with dimensions as topology sees it: screws of the closed home."""

from pathlib import Path

import numpy as np
import pytest

from assur.joint_graph.frames import screws
from assur.joint_graph.tree import joint_graph
from assur.joints.helical import HELICAL
from assur.kinematics.home import home_values
from assur.kinematics.structure import linkage
from assur.model.registry import load_record, names

FILES = Path(__file__).parents[1] / "model"


def records():
    return [load_record(name) for name in names()] + [load_record(FILES / "file" / "delta.toml")]


@pytest.mark.parametrize("record", records(), ids=lambda record: record.name)
def test_the_screws_span_what_the_loop_closure_has_at_home(record):
    # of an S joint only the span is the same: the rates of its rotation vector are no unit screws
    built = linkage(record)
    twists = screws(record, home_values(record))
    for joint, (name, place) in zip(built.joints.values(), joint_graph(record).slices.items(), strict=True):
        assert joint.name in (name, record.joints[name].alias)
        both = np.hstack([twists[:, place], joint.screws.T]) / np.repeat([1.0, built.length], 3)[:, None]
        assert np.linalg.matrix_rank(both, tol=1e-9) == len(joint.screws)


@pytest.mark.parametrize("record", records(), ids=lambda record: record.name)
def test_every_screw_is_a_unit_screw_through_its_joints_point(record):
    for joint in linkage(record).joints.values():
        for row in joint.screws:
            turning = np.linalg.norm(row[:3]) > 0.5
            assert np.isclose(np.linalg.norm(row[:3] if turning else row[3:]), 1)
            if turning and joint.type is not HELICAL:
                assert np.allclose(row[3:], np.cross(joint.point, row[:3]), atol=1e-9 * np.abs(joint.point).max())
