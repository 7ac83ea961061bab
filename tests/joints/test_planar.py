"""The planar joint: its directions by the rule, and its motion against a slide, a slide and a turn of their own."""

import numpy as np
import pytest

from assur.joints.planar import PLANAR, plane
from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.numerics import rotations

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


@pytest.mark.parametrize(("normal", "first", "second"), [(Z, X, Y), (X, Y, Z), (Y, Z, X), ((0, 0, -1), X, (0, -1, 0))])
def test_the_directions_of_the_axes_are_exact(normal, first, second):
    assert plane([tuple(map(float, normal))]) == (normal, first, second)


@pytest.mark.parametrize("seed", range(20))
def test_any_normal_has_a_right_handed_frame_by_the_rule(seed):
    normal = np.random.default_rng(seed).normal(size=3)
    normal /= np.linalg.norm(normal)
    made = np.array(plane([tuple(normal.tolist())]))
    assert made @ made.T == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.det(made) == pytest.approx(1.0, abs=1e-15)
    following = np.eye(3)[(np.argmax(np.abs(normal)) + 1) % 3]
    assert made[1] @ following > 0
    assert made[2] @ following == pytest.approx(0.0, abs=1e-15)  # what is left of it is all along the first


def test_it_moves_as_two_slides_and_a_turn():
    normal = np.array([2.0, -1.0, 2.0]) / 3
    axes = plane([tuple(normal.tolist())])
    values = np.array([3.0, -7.0, 0.6])
    turned, shift = PLANAR.motion(axes, 0, [3.0, -7.0, np.cos(0.6), np.sin(0.6)])
    parts = [PRISMATIC.motion([axis], 0, [value]) for axis, value in zip(axes[1:], values, strict=False)]
    single, _ = REVOLUTE.motion([axes[0]], 0, [np.cos(0.6), np.sin(0.6)])
    assert np.array(shift, dtype=float) == pytest.approx(
        np.sum([np.array(way, dtype=float) for _, way in parts], axis=0)
    )
    assert np.array(turned, dtype=float) == pytest.approx(np.array(single, dtype=float))
    assert np.array(turned, dtype=float) == pytest.approx(rotations.about_axis(normal, np.array(0.6)))


def test_what_it_can_do():
    assert (PLANAR.slides, PLANAR.turns, PLANAR.kinds) == (2, 1, ("length", "length", "angle"))
    assert not any((PLANAR.ball, PLANAR.screw, PLANAR.axial))
