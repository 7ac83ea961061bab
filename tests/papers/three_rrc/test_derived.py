"""The 3-RRC's tables by another route than its closed form: exact triangles, and a polynomial in z with mpmath."""

import itertools
from fractions import Fraction
from functools import lru_cache

import mpmath
import numpy as np
import pytest
import sympy

import assur

GAP, L1, L2 = 110, 100, 150  # R - r, crank, rod
SIGNS = list(itertools.product((1, -1), repeat=3))


@lru_cache
def norm():
    """Product of s +- w1 +- w2 +- w3 over all signs, with w_i^2 = l^2 - (z - h_i)^2: a polynomial in z."""
    s, z, length = sympy.symbols("s z l")
    w, heights = sympy.symbols("w1:4"), sympy.symbols("h1:4")
    product = sympy.Poly(sympy.prod([s + sum(a * b for a, b in zip(signs, w, strict=True)) for signs in SIGNS]), *w)
    squares = [length**2 - (z - height) ** 2 for height in heights]
    total = sum(
        factor * sympy.prod([square ** (power // 2) for square, power in zip(squares, powers, strict=True)])
        for powers, factor in product.terms()
    )
    return sympy.Poly(total, z), (s, length, *heights)


def poses(degrees):
    """Every pose at crank angles in degrees, with 40 digits."""
    with mpmath.workdps(40):
        angles = [mpmath.radians(mpmath.mpf(angle)) for angle in degrees]
        rho, zeta = [GAP + L1 * mpmath.cos(a) for a in angles], [L1 * mpmath.sin(a) for a in angles]
        polynomial, names = norm()
        coefficients = sympy.lambdify(names, polynomial.all_coeffs(), "mpmath")(sum(rho), L2, *zeta)
        roots = mpmath.polyroots([mpmath.mpf(part) for part in coefficients], maxsteps=500, extraprec=400)
        assert len(roots) == 8
        heights = [root.real for root in roots if abs(root.imag) < 1e-15]
        return np.array([_pose(rho, zeta, z) for z in heights if min(_squares(zeta, z)) >= 0], dtype=float)


def _squares(zeta, z):
    return [L2**2 - (z - height) ** 2 for height in zeta]


def _pose(rho, zeta, z):
    size = [mpmath.sqrt(square) for square in _squares(zeta, z)]
    choices = [[sign * part for sign, part in zip(signs, size, strict=True)] for signs in SIGNS]
    outward = min(choices, key=lambda w: abs(sum(rho) + sum(w)))
    assert abs(sum(rho) + sum(outward)) < 1e-12
    a, b, c = (start + part for start, part in zip(rho, outward, strict=True))
    return (2 * a - b - c) / 3, (b - c) / mpmath.sqrt(3), z


def test_there_are_eight_complex_heights_and_never_infinitely_many():
    polynomial, _ = norm()
    assert polynomial.degree() == 8
    assert polynomial.LC() == 9


def test_table_a_is_exact():
    rho, zeta = GAP + L1 * Fraction(-4, 5), L1 * Fraction(3, 5)
    for outward, height in itertools.product(((120, -60, -60), (-60, 120, -60), (-60, -60, 120)), (180, -60)):
        assert sum(outward) == 0
        assert all((part - rho) ** 2 + (height - zeta) ** 2 == L2**2 for part in outward)
    assert rho**2 + 21600 == L2**2


@pytest.mark.parametrize("degrees", [(135, 140, 146), (138, 142, 150), (100, 110, 130), (95, 140, 128)])
def test_all_poses_agree_with_the_other_route(degrees):
    found = assur.load("three_rrc").direct(np.radians(degrees))
    ours, theirs = found.poses[found.exists], poses(degrees)
    assert found.complete
    assert len(ours) == len(theirs)
    for pose in theirs:
        assert np.min(np.linalg.norm(ours - pose, axis=-1)) < 1e-8


@pytest.mark.parametrize(("table", "rows"), [("Table A", 8), ("Table B", 8), ("Table C", 8)])
def test_rows(at, table, rows):
    for number in range(1, rows + 1):
        assert {row.verdict for row in at(f"{table} row {number}").values()} == {"ok"}


def test_table_c_is_two_circles():
    for outward, height in ((10, 180), (-170, 180)):
        square = outward**2 + height**2
        one = (Fraction(-4, 5), Fraction(3, 5))
        share = 2 * (one[0] * outward + one[1] * height) / square
        for cosine, sine in (one, (share * outward - one[0], share * height - one[1])):
            assert cosine**2 + sine**2 == 1
            assert (outward - L1 * cosine) ** 2 + (height - L1 * sine) ** 2 == L2**2


def test_nothing_else_is_claimed(found):
    assert found.origin == "derived"
    assert found.claims_hold
