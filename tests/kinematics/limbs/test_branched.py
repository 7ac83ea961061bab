"""Limbs as series, and as series that meet at one link; others are said to be none."""

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.frames import frames
from assur.kinematics.home import home_values
from assur.kinematics.limbs.branched import BranchedLimb, from_platform, limbs_of, limbs_of_middle
from assur.kinematics.limbs.serial import NotSerialError, SerialLimb, composed, displacement, inverted
from assur.model.registry import load_record


@pytest.fixture(scope="module")
def hybrid(tmp_path_factory):
    path = tmp_path_factory.mktemp("branched") / "mine.toml"
    chains = ["--chain", "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "--chain", "P[y] R[y] R[y] R[y]"]
    assert main(["new", str(path), *chains]) == 0
    return load_record(path)


def moved(series, values):
    frame = series.zero
    for motion in reversed(series.motions):
        frame = composed(displacement(motion, values[motion.index]), frame)
    return frame


def test_series_that_meet_lead_where_the_spanning_tree_does(hybrid):
    """Frames of links by the joint graph, which knows no limbs."""
    values = home_values(hybrid)
    placed = frames(hybrid, values)
    branched, other = limbs_of(hybrid)
    assert isinstance(branched, BranchedLimb)
    assert isinstance(other, SerialLimb)
    assert (len(branched.near), len(branched.far)) == (2, 1)
    middle = moved(branched.near[0], values)
    for series in branched.near:
        for part, same in zip(moved(series, values), middle, strict=True):
            assert np.allclose(part, same, rtol=0, atol=1e-9)
    whole = composed(middle, moved(branched.far[0], values))
    back = moved(from_platform(branched.far[0], whole), values)
    for frame, expected in ((whole, placed[hybrid.platform.link]), (back, middle)):
        assert np.allclose(frame[0], expected[0], rtol=0, atol=1e-9)
        assert np.allclose(frame[1], expected[1], rtol=0, atol=1e-7)


def test_the_link_where_series_meet_may_be_the_platform(hybrid):
    limbs = limbs_of(hybrid)
    first, second, third = limbs_of_middle(limbs)
    assert (first, second) == limbs[0].near
    assert third.near == (limbs[1],)
    values = home_values(hybrid)
    way = composed(moved(third.near[0], values), moved(third.far[0], values))
    expected = moved(first, values)
    assert np.allclose(way[0], expected[0], rtol=0, atol=1e-9)
    assert np.allclose(composed(inverted(way), expected)[1], 0.0, rtol=0, atol=1e-7)
    assert limbs_of_middle(limbs_of(load_record("planar_3rrr"))) is None


def test_series_that_meet_at_several_links_are_none_of_these():
    with pytest.raises(NotSerialError, match="form no series of joints"):
        limbs_of(load_record("zeng2019"))
