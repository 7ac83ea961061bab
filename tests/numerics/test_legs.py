"""Legs round Z, pointed rods and pairs of bars: against rotation matrices, and what defines them."""

import numpy as np
import pytest
import sympy

from assur.numerics import legs, vectors
from assur.numerics.number_types import Floats, Symbols

RNG = np.random.default_rng(5)


def turn_of(angle):
    return (np.cos(angle), np.sin(angle))


def test_three_legs_are_a_third_of_a_turn_apart():
    expected = [turn_of(np.radians(angle)) for angle in (0, 120, 240)]
    np.testing.assert_allclose(legs.thirds(Floats()), expected, rtol=0, atol=1e-15)


def test_thirds_are_exact_over_symbols():
    total = [sympy.Add(*parts) for parts in zip(*legs.thirds(Symbols()), strict=True)]
    assert total == [0, 0]
    assert all(sympy.simplify(c * c + s * s) == 1 for c, s in legs.thirds(Symbols()))


def test_frames_of_legs_are_rotations_about_z():
    turn, vector = turn_of(0.7), tuple(RNG.normal(size=3))
    np.testing.assert_allclose(legs.from_leg(turn, vector), np.array(vectors.about_z(turn)) @ vector, atol=1e-15)
    np.testing.assert_allclose(legs.in_leg(turn, legs.from_leg(turn, vector)), vector, atol=1e-15)


def test_the_two_angles_point_the_rod():
    """First about Y, then about the turned X: that takes Z onto the rod."""
    rods = RNG.normal(size=(3, 200))
    x, y, z = rods / np.linalg.norm(rods, axis=0)
    first, second, square = legs.pointing(Floats(), z, x, -y)
    turned = vectors.apply(vectors.product(vectors.about_y(first), vectors.about_x(second)), (0, 0, 1))
    np.testing.assert_allclose(turned, (x, y, z), rtol=0, atol=1e-14)
    np.testing.assert_allclose(square, 1 - y * y, rtol=0, atol=1e-14)
    assert np.all(second[0] >= 0)


def test_a_rod_along_the_first_axis_is_not_turned_about_it():
    first, second, square = legs.pointing(Floats(), 0.0, 0.0, 1.0, 1e-30)
    assert (*first, *second, square) == (1.0, 0.0, 0.0, 1.0, 0.0)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_two_bars_reach_their_end_with_the_elbow_on_the_side_of_the_sign(sign):
    end = tuple(RNG.normal(size=(2, 300)))
    found = legs.two_bars(Floats(), end, 1.2, 0.9, sign)
    real = found.radicand > 0
    assert 50 < np.sum(real) < 300
    np.testing.assert_array_equal(real, (np.hypot(*end) < 2.1) & (np.hypot(*end) > 0.3))
    reached = 1.2 * np.array(found.crank) + 0.9 * np.array(found.rod)
    np.testing.assert_allclose(reached[:, real], np.array(end)[:, real], rtol=0, atol=1e-13)
    crank, rod, elbow = (np.arctan2(sine, cosine) for cosine, sine in (found.crank, found.rod, found.elbow))
    np.testing.assert_allclose(np.sin(crank + elbow - rod)[real], 0, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(np.sign(elbow[real]), sign)
    np.testing.assert_allclose(np.hypot(*np.array(found.rod)[:, real]), 1, rtol=0, atol=1e-12)
    # a second route: the law of cosines
    law = (np.square(end).sum(axis=0) - 1.2**2 - 0.9**2) / (2 * 1.2 * 0.9)
    np.testing.assert_allclose(found.elbow[0][real], law[real], rtol=0, atol=1e-12)


def test_couples_are_across_the_tangents_and_the_rods():
    turns = [turn_of(angle) for angle in RNG.uniform(-3, 3, size=3)]
    rods = [tuple(rod) for rod in RNG.normal(size=(3, 3))]
    expected = np.linalg.det([np.cross((-s, c, 0), rod) for (c, s), rod in zip(turns, rods, strict=True)])
    assert legs.couples(tuple(turns), tuple(rods)) == pytest.approx(expected, rel=1e-12)
