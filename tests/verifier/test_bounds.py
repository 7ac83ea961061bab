import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from flint import arb, ctx

from assur.verifier import bounds

FLOATS = (-3.0, -1.5, -1e-9, -5e-324, 0.0, 5e-324, 0.1, 1 / 3, 1.0, 7.25, 1e15)
PAIRS = [(a, b) for a in FLOATS for b in FLOATS if a <= b]
EXACT = {
    "add": lambda x, y: x + y,
    "subtract": lambda x, y: x - y,
    "multiply": lambda x, y: x * y,
    "divide": lambda x, y: x / y,
}


@pytest.fixture(autouse=True)
def few_bits():
    """Few bits, so that rounding is large and a wrong direction shows."""
    before, ctx.prec = ctx.prec, 20
    yield
    ctx.prec = before


def balls(pair):
    return arb(pair[0]), arb(pair[1])


def exact(ball):
    mantissa, exponent = ball.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


@pytest.mark.parametrize("name", EXACT)
def test_exact_results_lie_inside_and_close(name):
    checked = 0
    for one in PAIRS:
        for two in PAIRS[::3]:
            if name == "divide" and two[0] <= 0 <= two[1]:
                with pytest.raises(ZeroDivisionError):
                    bounds.divide(balls(one), balls(two))
                continue
            low, high = map(exact, getattr(bounds, name)(balls(one), balls(two)))
            corners = [EXACT[name](Fraction(x), Fraction(y)) for x in one for y in two]
            assert low <= min(corners)
            assert high >= max(corners)
            size = max(map(abs, corners))
            assert high - max(corners) <= size / 2**18
            assert min(corners) - low <= size / 2**18
            checked += 1
    assert checked > 500


@pytest.mark.parametrize("pair", PAIRS)
def test_functions_of_one_number(pair):
    low, high = pair
    points = [Fraction(low) + (Fraction(high) - Fraction(low)) * k / 7 for k in range(8)]
    x = balls(pair)
    square, size, opposite, root = (
        tuple(map(exact, found))
        for found in (bounds.multiply(x, x), bounds.magnitude(x), bounds.negative(x), bounds.root(x))
    )
    assert all(square[0] <= p * p <= square[1] for p in points)
    assert square[0] >= 0
    least = Fraction(0) if low < 0 < high else min(abs(Fraction(low)), abs(Fraction(high)))
    most = max(abs(Fraction(low)), abs(Fraction(high)))
    room = most / 2**18
    assert least - room <= size[0] <= least <= most <= size[1] <= most + room
    assert -high - room <= opposite[0] <= -Fraction(high) <= -Fraction(low) <= opposite[1] <= -low + room
    assert all(root[0] ** 2 <= max(p, 0) <= root[1] ** 2 for p in points)
    assert root[0] >= 0


@pytest.mark.parametrize("name", ["cosine", "sine"])
def test_cosine_and_sine_against_multiple_precision(name):
    rng = np.random.default_rng(8)
    function = {"cosine": mpmath.cos, "sine": mpmath.sin}[name]
    with mpmath.workprec(120):
        for scale in (0.01, 1.0, 5.0, 100.0, 1e6):
            for middle, half in rng.normal(size=(40, 2)) * [scale, 1.5]:
                low, high = float(middle - abs(half)), float(middle + abs(half))
                least, most = (
                    mpmath.mpf(int(b.man_exp()[0])) * mpmath.mpf(2) ** int(b.man_exp()[1])
                    for b in getattr(bounds, name)(balls((low, high)))
                )
                values = [function(mpmath.mpf(low) + (mpmath.mpf(high) - low) * k / 50) for k in range(51)]
                assert least <= min(values)
                assert most >= max(values)
                # 51 points miss a peak by at most half a step squared over two
                room = (2 * abs(half) / 50) ** 2 / 2 + 1e-4 + scale * 2.0**-17
                assert least >= min(values) - room or least == -1
                assert most <= max(values) + room or most == 1
                assert -1 <= least <= most <= 1


def test_peaks_and_huge_angles():
    assert tuple(map(float, bounds.cosine((arb(-0.1), arb(0.1))))) == (pytest.approx(math.cos(0.1), abs=1e-4), 1.0)
    assert tuple(map(float, bounds.cosine((arb(0), arb(7))))) == (-1.0, 1.0)
    assert tuple(map(float, bounds.cosine((arb(2) ** 10**6, arb(2) ** 10**6)))) == (-1.0, 1.0)
    assert float(bounds.cosine((arb(3), arb(3.5)))[0]) == -1.0


def test_zero_inside():
    assert not bounds.nonzero((arb(-1), arb(0)))
    assert not bounds.nonzero((arb(0), arb(1)))
    assert bounds.nonzero((arb(5e-324), arb(1)))
    assert bounds.nonzero((arb(-1), arb(-5e-324)))
