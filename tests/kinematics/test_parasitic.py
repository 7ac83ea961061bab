"""Parasitic motion against formulas of the 3-RPS, and where there is none."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics import parasitic as parasitic_motion
from assur.kinematics.parasitic import all_coordinates, left_out, moving, parasitic, parasitic_at
from assur.kinematics.pose import pose_of
from assur.kinematics.position import inverse

RECORD = assur.load("three_rps")

OVER_A_BOX = [name for name in assur.names() if set(assur.load(name).platform.pose) <= set(assur.load(name).box)]
"""Mechanisms with an interval for every coordinate of the pose."""


def test_the_platform_of_a_3rps_shifts_sideways_as_known():
    """With joints in three planes at 120 degrees x = r (R22 - R11) / 2 or its negative, y = -r R12 (Carretero 2000)."""
    rng = np.random.default_rng(3)
    poses = np.stack([rng.uniform(200, 300, 20), *rng.uniform(-0.5, 0.5, (2, 20))], axis=1)
    found = parasitic(RECORD, poses)
    theta, psi = poses[:, 1], poses[:, 2]
    phi = np.arctan2(np.sin(theta) * np.sin(psi), np.cos(theta) + np.cos(psi))
    np.testing.assert_allclose(found["phi"], phi, atol=1e-12)
    c, s = np.cos, np.sin
    r11, r22 = c(phi) * c(theta), s(phi) * s(theta) * s(psi) + c(phi) * c(psi)
    r12 = c(phi) * s(theta) * s(psi) - s(phi) * c(psi)
    ratio_x, ratio_y = found["x"] / (r11 - r22), found["y"] / r12
    np.testing.assert_allclose(np.abs(ratio_x), np.abs(ratio_y[0]) / 2, rtol=1e-9)
    np.testing.assert_allclose(ratio_y, ratio_y[0], rtol=1e-9)
    assert np.max(np.abs(found["x"])) > 1e-3 * RECORD.values.R


def test_poses_that_are_not_reached_have_none():
    found = parasitic(assur.load("planar_3rrr"), [[0.0, 0.0, 0.0], [1e4, 0.0, 0.0]])
    assert list(found) == ["z", "theta", "psi"]
    np.testing.assert_allclose([values[0] for values in found.values()], 0.0, atol=1e-12)
    assert all(np.isnan(values[1]) for values in found.values())


def test_nothing_is_left_out_of_a_whole_pose():
    whole = replace(RECORD, platform=replace(RECORD.platform, pose=("x", "y", "z", "qw", "qx", "qy", "qz")))
    assert left_out(whole) == ()
    assert parasitic_at(whole, whole.home) == {}


@pytest.fixture
def assembled(monkeypatch):
    """What `moving` closed: assemblies beside home."""
    calls = []
    kept = parasitic_motion.assemble

    def noted(*given, **named):
        calls.append(kept(*given, **named))
        return calls[-1]

    monkeypatch.setattr(parasitic_motion, "assemble", noted)
    return calls


@pytest.mark.parametrize("name", assur.names())
def test_what_moves_is_seen_in_few_steps_and_along_every_way(assembled, monkeypatch, name):
    """As with so many steps, and ones so short, that every way that can be gone is gone."""
    record = assur.load(name)
    seen = moving.__wrapped__(record)
    assert sum(found.steps for found in assembled) <= 12
    assert not assembled or np.all(assembled[-1].closed)
    monkeypatch.setattr(parasitic_motion, "CLOSING", 200)
    monkeypatch.setattr(parasitic_motion, "STEPS", (0.1, 0.05, 0.02, 0.01, 0.005))
    assert moving.__wrapped__(record) == seen


@pytest.mark.parametrize("name", ["three_rps", "planar_3rrr", "zeng2019"])
def test_the_coordinates_of_the_pose_are_among_all(name):
    record = assur.load(name)
    found = all_coordinates(record, record.home_values)
    own = [found[key] for key in record.platform.pose]
    np.testing.assert_allclose(own, pose_of(record, record.home_values), atol=1e-12)


@pytest.mark.parametrize("name", OVER_A_BOX)
def test_what_stands_still_near_home_stands_still_in_the_box(name):
    """A route of its own: poses spread over the box, the inverse problem solved at each."""
    record = assur.load(name)
    quiet = [key for key in left_out(record) if key not in moving(record)]
    low, high = np.array([record.box[key] for key in record.platform.pose]).T
    poses = np.random.default_rng(5).uniform(low, high, (12, len(low)))
    found = parasitic(record, poses)
    for key in quiet:
        reached = found[key][np.isfinite(found[key])]
        if key in ("x", "y", "z") or record.platform.orientation == "constant":
            assert np.all(np.abs(reached - reached[:1]) < 1e-6), key


def test_what_grows_with_a_product_is_seen_from_a_level_home():
    level = replace(RECORD, home=inverse(RECORD, [250.0, 0.0, 0.0]).joints[0])
    assert moving(level) == ("x", "y", "phi")
