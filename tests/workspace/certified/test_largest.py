"""The largest shapes: against circles of the paper's mechanism, and against the inverse problem."""

import math

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.workspace.certified.largest import largest

RNG = np.random.default_rng(7)
ZENG, DELTA = assur.load("zeng2019"), assur.load("delta_4s")
P = ZENG.values


def circles():
    """In the plane of x and z: where w or v is zero or as long as its link, as (centre x, centre z, radius)."""
    d, low, high = P.b - P.d, P.l1, P.l1 + P.l7 + P.l8
    return [
        *((-d, low + shift, P.l4) for shift in (-P.l2, 0.0, P.l2)),
        *((d, high + shift, P.l6) for shift in (-P.l6, 0.0, P.l6)),
    ]


@pytest.mark.parametrize("centre", [(-40.0, 7.0, 400.0), (-60.0, 0.0, 330.0), (0.0, -20.0, 300.0)])
def test_a_ball_ends_at_the_nearest_circle(centre):
    x, _, z = centre
    nearest = min(abs(math.hypot(x - a, z - c) - r) for a, c, r in circles())
    found = largest(ZENG, "ball", centre, tolerance=1e-4)
    assert found.stopped == ""
    assert found.size <= 2 * nearest <= found.refuted
    assert found.refuted - found.size <= 1e-4 * found.refuted


@pytest.mark.parametrize("shape", ["cube", "cylinder", "ball"])
def test_every_pose_inside_is_reached_and_regular_and_the_witness_is_not(shape):
    centre = (0.0, 0.0, -1.0)
    found = largest(DELTA, shape, centre, ratio=0.7, tolerance=0.02)
    assert 0 < found.size <= found.refuted < 1.03 * found.size
    low, high = found.shape.around(found.size)
    poses = low + RNG.uniform(size=(4000, 3)) * (high - low)
    poses = poses[found.shape.size(poses.T) <= found.size]
    answer = DELTA.inverse(poses, found.mode)
    assert np.all(answer.exists[:, 0])
    for item in DELTA.closed_form.factor_list:
        if item.kind in ("parallel", "serial"):
            assert len(np.unique(np.sign(answer.factors[item.name][:, 0]))) == 1
    pose = np.array([found.witness.pose[name] for name in ("x", "y", "z")])
    np.testing.assert_allclose(found.shape.size(pose[:, None])[0], found.refuted, rtol=1e-9)
    if "not reached" in found.witness.why:
        assert not DELTA.inverse(pose, found.mode).exists[0]
    assert found.height == (found.size * 0.7 if shape == "cylinder" else None)


def test_about_a_pose_that_is_not_reached_there_is_none():
    found = largest(ZENG, "cube", (0.0, 0.0, 900.0))
    assert (found.size, found.refuted) == (0.0, 0.0)
    assert "not reached" in found.witness.why


def test_nothing_is_proved_where_no_sign_tells():
    found = largest(ZENG, "cube", (-40.0, 0.0, 400.0), mode="+++++", what=["parallel"])
    assert found.size < 1e-3
    assert found.stopped == "undecided"


def test_a_plane_has_squares_and_discs_and_ctrl_c_keeps_what_is_proved():
    square = largest(ZENG, "cube", {"x": -40.0, "z": 400.0}, held={"y": 0.0})
    cube = largest(ZENG, "cube", {"x": -40.0, "y": 0.0, "z": 400.0})
    np.testing.assert_allclose(square.size, cube.size, rtol=2e-3)
    steps = []

    def interrupt(done, total):
        steps.append(done)
        if len(steps) == 6:
            raise KeyboardInterrupt

    early = largest(ZENG, "cube", (-40.0, 0.0, 400.0), progress=interrupt)
    assert early.stopped == "interrupted"
    assert early.size <= cube.refuted
    assert early.refuted >= cube.size


def test_misuse():
    for tolerance in (0.0, 1.0, math.nan):
        with pytest.raises(UsageError, match="tolerance"):
            largest(ZENG, "cube", (0.0, 0.0, 400.0), tolerance=tolerance)
    with pytest.raises(UsageError, match="centre"):
        largest(ZENG, "cube", (0.0, 0.0))
