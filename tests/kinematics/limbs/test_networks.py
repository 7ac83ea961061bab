"""Limbs as series, and as series that meet at one link; others are said to be none."""

from dataclasses import replace

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.frames import frames
from assur.kinematics.home import home_values
from assur.kinematics.limbs.networks import SeriesParts, from_platform, limbs_of, limbs_of_middle
from assur.kinematics.limbs.serial import NotSerialError, SerialLimb, composed, displacement, inverted
from assur.model.registry import load_record


@pytest.fixture(scope="module")
def hybrid(tmp_path_factory):
    path = tmp_path_factory.mktemp("networks") / "mine.toml"
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
    assert isinstance(branched, SeriesParts)
    assert isinstance(other, SerialLimb)
    near, far = branched.parts
    assert len(near.parts) == 2
    middle = moved(near.parts[0], values)
    for series in near.parts:
        for part, same in zip(moved(series, values), middle, strict=True):
            assert np.allclose(part, same, rtol=0, atol=1e-9)
    whole = composed(middle, moved(far, values))
    back = moved(from_platform(far, whole), values)
    for frame, expected in ((whole, placed[hybrid.platform.link]), (back, middle)):
        assert np.allclose(frame[0], expected[0], rtol=0, atol=1e-9)
        assert np.allclose(frame[1], expected[1], rtol=0, atol=1e-7)


def test_the_link_where_series_meet_may_be_the_platform(hybrid):
    limbs = limbs_of(hybrid)
    first, second, third = limbs_of_middle(limbs)
    assert (first, second) == limbs[0].parts[0].parts
    assert third.parts[0] == limbs[1]
    values = home_values(hybrid)
    way = composed(*(moved(part, values) for part in third.parts))
    expected = moved(first, values)
    assert np.allclose(way[0], expected[0], rtol=0, atol=1e-9)
    assert np.allclose(composed(inverted(way), expected)[1], 0.0, rtol=0, atol=1e-7)
    assert limbs_of_middle(limbs_of(load_record("planar_3rrr"))) is None


def shape(limb):
    """Names of joints, in lists where they are in series and in sets where parts lie side by side."""
    if isinstance(limb, SerialLimb):
        return limb.joints
    parts = tuple(map(shape, limb.parts))
    return parts if isinstance(limb, SeriesParts) else frozenset(parts)


def test_parts_lie_one_after_another_and_side_by_side():
    first, second = limbs_of(load_record("zeng2019"))
    assert shape(first) == (frozenset({("P1", "B1", "C1"), ("P2", "B2", "C2")}), ("D1", "D2"))
    pairs = [frozenset({(f"{name}3a", f"{end}3a"), (f"{name}3b", f"{end}3b")}) for name, end in ("BC", "DE")]
    assert shape(second) == (("P3",), *pairs)
    legs = [
        (("A1",), frozenset({("B1a", "C1a"), ("B1b", "C1b")})),
        (("A2",), frozenset({("B2a", "C2a"), ("B2b", "C2b")})),
    ]
    assert shape(limbs_of(load_record("h4_robot"))[0]) == (frozenset(legs), ("D1",))


def test_links_that_join_two_limbs_are_no_network():
    record = load_record("planar_3rrr")
    bridge = replace(record.joints["leg1.B"], name="bridge", parent="leg1.crank", child="leg2.crank")
    with pytest.raises(NotSerialError, match="no limb in series from base to platform"):
        limbs_of(replace(record, joints={**record.joints, "bridge": bridge}))
