"""All postures of the Gough-Stewart platform: Dietmaier's forty, and platforms with fewer."""

import numpy as np
import pytest

import assur
from assur.kinematics.status import Status
from assur.numerics.homotopy import PathEnd

DIETMAIER = [1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071]
POSE = [0.1, 0.05, 0.9, 0.97, 0.1, 0.15, 0.1]


def ring(*degrees, radius=1.0):
    angles = np.radians(degrees)
    return np.stack([radius * np.cos(angles), radius * np.sin(angles), 0 * angles], axis=-1)


def platform(base, top):
    points = {"a": base, "b": top}
    values = {
        f"{letter}{n}{axis}": float(value)
        for letter, rows in points.items()
        for n, row in enumerate(rows, 1)
        for axis, value in zip("xyz", row, strict=True)
    }
    return assur.load("gough_stewart").with_parameters(**values)


def test_dietmaiers_platform_has_forty_real_postures():
    found = assur.load("gough_stewart").direct(DIETMAIER)
    assert found.complete
    assert found.exists.sum() == 40
    assert np.max(found.residuals) < 1e-11
    turns = np.abs(found.poses[:, 3:] @ found.poses[:, 3:].T)
    places = np.linalg.norm(found.poses[:, None, :3] - found.poses[:, :3], axis=-1)
    same = (turns > 1 - 1e-6) & (places < 1e-3)
    assert np.array_equal(same, np.eye(40, dtype=bool))


def test_every_posture_needs_the_lengths_that_were_given():
    """Along the way of the inverse problem, which knows nothing of the system."""
    mechanism = assur.load("gough_stewart")
    poses = mechanism.direct(DIETMAIER).poses
    lengths = mechanism.inverse(poses).inputs[:, 0]
    np.testing.assert_allclose(lengths, np.broadcast_to(DIETMAIER, lengths.shape), rtol=0, atol=1e-12)


def test_real_solutions_of_a_generic_platform_come_in_pairs():
    rng = np.random.default_rng(0)
    mechanism = platform(rng.normal(size=(6, 3)), rng.normal(size=(6, 3)))
    found = mechanism.direct(mechanism.inverse(POSE).inputs[0])
    assert found.complete
    assert found.exists.sum() % 2 == 0
    assert found.exists.sum() > 0


@pytest.mark.parametrize(
    ("base", "top", "degree"),
    [
        (ring(0, 0, 120, 120, 240, 240), ring(60, -60, 60, 180, 180, 300, radius=0.6), 16),
        (ring(0, 10, 120, 130, 240, 250), ring(60, -60, 60, 180, 180, 300, radius=0.6), 16),
    ],
    ids=["octahedral", "six points on three"],
)
def test_legs_that_share_joints_have_sixteen_postures_and_the_answer_does_not_claim_to_be_proved(base, top, degree):
    mechanism = platform(base, top)
    given = mechanism.inverse(POSE)
    found = mechanism.direct(given.inputs[0])
    assert np.sum((found.end == PathEnd.regular) & ~found.infinite) == degree
    assert not found.complete
    assert found.right.startswith("not proved: of 40 paths")
    pose = given.poses[0]
    assert np.min(np.max(np.abs(found.poses[found.exists] - pose), axis=-1)) < 1e-9
    mirrored = pose * [1, 1, -1, 1, -1, -1, 1]  # in the plane of the base
    assert np.min(np.max(np.abs(found.poses[found.exists] - mirrored), axis=-1)) < 1e-9


def test_legs_that_are_too_short_reach_nothing_and_all_forty_solutions_are_known():
    found = assur.load("gough_stewart").direct([1, 0.01, 0.01, 0.01, 0.01, 0.01])
    assert found.complete
    assert not found.exists.any()
    assert found.overall_status == Status.unreachable
    assert found.failures[0].quantity == "root"
