"""Curves of self-motion: they close the loops, and centres in one line give none unless two of them coincide."""

import numpy as np
import pytest
from scipy.optimize import least_squares

import assur
from assur.kinematics.status import Status


def _knees(name, values, arms):
    """About what the platform's centre turns (3, 3), written down from the dimensions."""
    p, cosines, sines = values, np.cos(arms), np.sin(arms)
    if name == "delta_4s":
        legs, out, up = np.radians([-90, 30, 150]), p.wB - p.uP + p.L * cosines, -p.L * sines
    else:
        legs, out, up = np.radians([0, 120, 240]), p.r - p.c + p.a * cosines, p.a * sines
    return np.stack([out * np.cos(legs), out * np.sin(legs), up], axis=-1)


@pytest.mark.parametrize("name", ["delta_4s", "tsai_platform"])
def test_knees_in_one_line_but_all_apart_let_no_rods_meet(name):
    """No point has the same distance from three points of a line: there is no circle to run on."""
    mechanism, rng, seen = assur.load(name), np.random.default_rng(0), 0

    def normal(arms):
        first, second, third = _knees(name, mechanism.values, arms)
        return np.cross(second - first, third - first)

    while seen < 3:
        found = least_squares(normal, rng.uniform(-np.pi, np.pi, 3), xtol=1e-15, ftol=1e-15, gtol=1e-15)
        knees = _knees(name, mechanism.values, found.x)
        gaps = np.linalg.norm(knees - np.roll(knees, 1, axis=0), axis=-1)
        size = np.ptp(knees)
        if np.linalg.norm(found.fun) > 1e-14 * size**2 or np.min(gaps) < 0.05 * size:
            continue
        seen += 1
        answer = mechanism.direct(found.x)
        assert (answer.overall_status, len(answer), answer.curves) == (Status.unreachable, 0, ())


@pytest.mark.parametrize("inputs", [[0.0, 0.0, 50.0], [0.0, 50.0, 0.0], [50.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
def test_the_orthoglide_runs_round_the_rail_of_the_slider_that_is_apart(inputs):
    """At the distance L from both places where sliders stand; where all stand in the origin, on a circle of it."""
    mechanism = assur.load("orthoglide")
    (curve,) = mechanism.direct(inputs).curves
    assert curve.interval == (-np.pi, np.pi)
    poses, joints = curve.poses(17), curve.joints(17)
    for centre in np.diag(inputs):
        np.testing.assert_allclose(np.linalg.norm(poses - centre, axis=-1), mechanism.values.L, rtol=1e-12)
    assert np.ptp(poses, axis=0).max() > mechanism.values.L
    assert np.max(mechanism.closure_error(joints)) < 1e-9 * mechanism.values.L
