"""Meetings of circles, spheres and lines: what defines them, what the sign means, exact cases, and no answer."""

from fractions import Fraction

import numpy as np
import pytest
import sympy

from assur.numerics import vectors
from assur.numerics.dual import Dual, Duals
from assur.numerics.meetings import angle_with, coincident_spheres, linear_in_three, three_spheres
from assur.numerics.number_types import Floats, Symbols

RNG = np.random.default_rng(11)
SIGNS = pytest.mark.parametrize("sign", [1.0, -1.0])


def square_to(point, centre):
    step = vectors.subtract(point, centre)
    return vectors.dot(step, step)


# ---- a cos + b sin = c -----------------------------------------------------------------------------------------


@SIGNS
def test_angle_solves_its_equation_on_the_side_of_the_sign(sign):
    a, b = RNG.normal(size=(2, 200))
    c = RNG.uniform(-1, 1, 200) * np.hypot(a, b)
    (cosine, sine), radicand = angle_with(Floats(), a, b, c, sign)
    np.testing.assert_allclose(a * cosine + b * sine, c, rtol=0, atol=1e-13)
    np.testing.assert_allclose(cosine**2 + sine**2, 1.0, rtol=0, atol=1e-13)
    np.testing.assert_allclose(a * sine - b * cosine, sign * np.sqrt(radicand), rtol=0, atol=1e-13)
    np.testing.assert_allclose(radicand, a * a + b * b - c * c, rtol=1e-12, atol=1e-15)


@SIGNS
def test_angle_is_the_direction_turned_by_an_arc_cosine(sign):
    """A second route: atan2(b, a) + sign arccos(c / hypot(a, b))."""
    a, b = RNG.normal(size=(2, 200))
    c = RNG.uniform(-0.99, 0.99, 200) * np.hypot(a, b)
    expected = np.arctan2(b, a) + sign * np.arccos(c / np.hypot(a, b))
    (cosine, sine), _ = angle_with(Floats(), a, b, c, sign)
    np.testing.assert_allclose((cosine, sine), (np.cos(expected), np.sin(expected)), rtol=0, atol=1e-12)


def test_angle_is_exact_over_symbols():
    three, four, root = sympy.Integer(3), sympy.Integer(4), sympy.Rational(7, 2)
    (cosine, sine), radicand = angle_with(Symbols(), three, four, root, 1)
    assert radicand == sympy.Rational(51, 4)
    assert sympy.simplify(3 * cosine + 4 * sine - root) == 0
    assert sympy.simplify(cosine**2 + sine**2 - 1) == 0


def test_angle_out_of_reach_has_a_negative_radicand():
    assert angle_with(Floats(), 1.0, 1.0, 2.0, 1.0)[1] == -2.0


# ---- three spheres ---------------------------------------------------------------------------------------------


@SIGNS
def test_spheres_meet_at_their_radii_on_the_side_of_the_sign(sign):
    centres = RNG.normal(size=(3, 3, 100))
    point = RNG.normal(size=(3, 100))
    squares = tuple(square_to(point, centre) for centre in centres)
    normal = vectors.cross(centres[1] - centres[0], centres[2] - centres[0])
    found, radicand, square = three_spheres(Floats(), tuple(centres), squares, sign)
    sound = square > 1e-3
    height = vectors.dot(vectors.subtract(found, centres[0]), normal)
    for centre, wanted in zip(centres, squares, strict=True):
        np.testing.assert_allclose(square_to(found, centre)[sound], wanted[sound], rtol=0, atol=1e-10)
    np.testing.assert_allclose(height[sound], sign * np.sqrt(np.maximum(radicand, 0.0))[sound], rtol=0, atol=1e-10)
    assert np.count_nonzero(sound) > 80


def test_one_of_the_two_meetings_is_the_point_that_gave_the_radii():
    centres = RNG.normal(size=(3, 3))
    point = RNG.normal(size=3)
    squares = tuple(square_to(point, centre) for centre in centres)
    both = [np.array(three_spheres(Floats(), tuple(centres), squares, sign)[0]) for sign in (1, -1)]
    assert min(np.linalg.norm(found - point) for found in both) < 1e-12
    assert np.linalg.norm(both[0] - both[1]) > 1e-3


def test_spheres_meet_exactly_over_symbols():
    """Centres of a linear Delta at sliders 15, -135, -135; its table says (120, 0, -300) and (-100, 0, 140)."""
    root = sympy.sqrt(3)
    centres = ((200, 0, 15), (-100, 100 * root, -135), (-100, -100 * root, -135))
    for sign, expected in ((-1, (120, 0, -300)), (1, (-100, 0, 140))):
        point, _, _ = three_spheres(Symbols(), centres, (325**2,) * 3, sympy.Integer(sign))
        assert tuple(sympy.nsimplify(sympy.simplify(part)) for part in point) == expected


def test_spheres_that_touch_meet_once_and_those_apart_do_not():
    centres = ((0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (0.0, 2.0, 0.0))
    touching, radicand, _ = three_spheres(Floats(), centres, (2.0, 2.0, 2.0), 1.0)
    assert radicand == 0.0
    np.testing.assert_array_equal(touching, [1.0, 1.0, 0.0])
    assert three_spheres(Floats(), centres, (1.0, 1.0, 1.0), 1.0)[1] < 0.0


def test_centres_in_one_line_have_no_normal():
    with np.errstate(divide="ignore", invalid="ignore"):
        _, _, square = three_spheres(Floats(), tuple(np.outer([0.0, 1.0, 2.0], [1.0, 0.0, 0.0])), (5.0, 5.0, 5.0), 1.0)
    assert square == 0.0


def test_dual_numbers_give_the_speed_of_the_meeting():
    centres = ((0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (0.0, 2.0, 0.0))

    def height(radius):
        return three_spheres(Floats(), centres, (radius * radius,) * 3, 1.0)[0][2]

    moving = Dual(np.float64(1.8), np.float64(1.0))
    found = three_spheres(Duals(), centres, (moving * moving,) * 3, 1.0)[0][2]
    assert float(found.derivative) == pytest.approx((height(1.8 + 1e-6) - height(1.8 - 1e-6)) / 2e-6, rel=1e-8)


# ---- two of three spheres the same -----------------------------------------------------------------------------


@pytest.mark.parametrize("pair", [(0, 1), (1, 2), (0, 2)], ids=str)
def test_point_of_the_circle_has_its_distance_from_both_centres(pair):
    same, other = RNG.normal(size=(2, 3))
    centres = tuple(tuple(same) if k in pair else tuple(other) for k in range(3))
    angle = np.linspace(-np.pi, np.pi, 13)
    point, radicand = coincident_spheres(Floats(), centres, 9.0, (1.0, 2.0, 3.0), (np.cos(angle), np.sin(angle)))
    for centre in (same, other):
        np.testing.assert_allclose(square_to(point, centre), 9.0, rtol=0, atol=1e-13)
    assert float(radicand) == pytest.approx(9.0 - np.sum((same - other) ** 2) / 4, abs=1e-13)
    middle = (same + other)[:, None] / 2
    turned = np.einsum("ik,ik->k", (np.array(point) - middle)[:, 1:], (np.array(point) - middle)[:, :-1])
    np.testing.assert_allclose(turned, radicand * np.cos(angle[1] - angle[0]), rtol=0, atol=1e-13)


def test_spheres_too_far_apart_have_no_circle():
    centres = ((0.0, 0.0, 0.0), (0.0, 0.0, 4.0), (0.0, 0.0, 0.0))
    assert coincident_spheres(Floats(), centres, 3.0, (1.0, 0.0, 0.0), (1.0, 0.0))[1] == -1.0


def test_equal_spheres_about_three_points_of_a_line_have_no_circle():
    """One in the middle of the others, and one beyond them: no point has the same distance from all three."""
    for place in (-1.0, 0.5, 3.0):
        centres = ((0.0, 0.0, 0.0), (0.1, 0.0, 0.2), (0.1 * place, 0.0, 0.2 * place))
        with np.errstate(invalid="ignore"):
            assert coincident_spheres(Floats(), centres, 9.0, (0.0, 1.0, 0.0), (1.0, 0.0))[1] < 0.0


def test_spheres_that_all_coincide_give_the_circle_about_z():
    angle = np.linspace(-np.pi, np.pi, 13)
    point, radicand = coincident_spheres(
        Floats(), ((1.0, 2.0, 3.0),) * 3, 9.0, (1.0, 1.0, 0.0), (np.cos(angle), np.sin(angle))
    )
    assert radicand == 9.0
    np.testing.assert_allclose(np.hypot(point[0] - 1, point[1] - 2), 3.0, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(point[2], 3.0)


# ---- three linear equations ------------------------------------------------------------------------------------


def test_linear_equations_agree_with_numpy():
    rows, right = RNG.normal(size=(20, 3, 3)), RNG.normal(size=(20, 3))
    found, determinant = linear_in_three(tuple(tuple(np.moveaxis(rows[:, k], -1, 0)) for k in range(3)), tuple(right.T))
    np.testing.assert_allclose(np.stack(found, -1), np.linalg.solve(rows, right[..., None])[..., 0], rtol=1e-9)
    np.testing.assert_allclose(determinant, np.linalg.det(rows), rtol=1e-10, atol=1e-14)


def test_linear_equations_are_exact_over_fractions():
    rows = ((2, 1, 0), (0, 3, 1), (1, 0, 5))
    found, determinant = linear_in_three(rows, (Fraction(1), Fraction(2), Fraction(3)))
    assert determinant == 31
    assert vectors.apply(rows, found) == (1, 2, 3)
