from fractions import Fraction

import numpy as np
import pytest

from assur.numerics import root_discs as module
from assur.numerics.intervals.interval import Interval
from assur.numerics.root_discs import root_discs


def with_roots(roots):
    """Coefficients, exact where roots are small integers."""
    return Interval.of(np.polynomial.polynomial.polyfromroots(roots).real)


@pytest.mark.parametrize(
    ("roots", "real"),
    [
        ([1, 2, 3, -4], [-4, 1, 2, 3]),
        ([1j, -1j, 2], [2]),
        ([1 + 1j, 1 - 1j, 3j, -3j], []),
        ([0, 5, 1000, -2000], [-2000, 0, 5, 1000]),
    ],
)
def test_simple_roots_are_counted_and_held(roots, real):
    found = root_discs(with_roots(roots))
    assert found.decided
    assert len(found.undecided.low) == 0
    assert len(found.real.low) == len(real)
    assert found.real.contains(np.array(real, dtype=float)).all()


def test_a_double_root_is_undecided_beside_a_simple_one():
    found = root_discs(with_roots([2, 2, -1]))
    assert found.real.contains(-1.0).tolist() == [True]
    assert found.undecided.contains(2.0).any()


def test_roots_that_bounds_of_coefficients_cannot_tell_apart_are_undecided():
    blurred = Interval.of([1 - 1e-6, -2.0, 1.0], [1 + 1e-6, -2.0, 1.0])
    found = root_discs(blurred)
    assert len(found.real.low) == 0
    for shift in (0.0, -1e-6):
        for root in np.roots([1.0, -2.0, 1 + shift]):
            assert found.undecided.contains(root.real).any()


def test_a_leading_coefficient_that_may_vanish_says_nothing():
    assert not root_discs(Interval.of([1.0, 2.0, -1e-9], [1.0, 2.0, 1e-9])).decided
    assert not root_discs(Interval.of([1.0, -np.inf, 1.0], [1.0, np.inf, 1.0])).decided
    assert not root_discs(Interval.of([0.0, 0.0, 0.0])).decided


def test_every_polynomial_within_the_bounds_has_its_roots_there():
    rng = np.random.default_rng(2)
    for _ in range(50):
        middle = with_roots(rng.uniform(-5, 5, 5)).middle
        spread = 1e-8 * np.abs(middle)
        found = root_discs(Interval.of(middle - spread, middle + spread))
        for _ in range(5):
            for root in np.roots(rng.uniform(middle - spread, middle + spread)[::-1]):
                inside = np.any(found.real.contains(root.real)) or np.any(found.undecided.contains(root.real))
                assert inside or abs(root.imag) > 1e-9


def held_exactly() -> bool:
    """Whether a sign change at the ends of each disc, in exact fractions, shows that it holds its root."""
    rng = np.random.default_rng(4)
    for _ in range(40):
        coefficients = rng.uniform(-1, 1, 6)
        found = root_discs(Interval.of(coefficients))
        for low, high in zip(found.real.low.tolist(), found.real.high.tolist(), strict=True):
            ends = [
                sum(Fraction(a) * Fraction(x) ** k for k, a in enumerate(coefficients.tolist())) for x in (low, high)
            ]
            if ends[0] * ends[1] > 0:
                return False
    return True


def test_discs_hold_their_roots_exactly():
    assert held_exactly()


def test_radii_that_are_too_small_are_noticed(monkeypatch):
    own = module._radii
    monkeypatch.setattr(module, "_radii", lambda coefficients, points: 1e-3 * own(coefficients, points))
    assert not held_exactly()


def test_radii_without_bound_leave_it_undecided():
    assert not root_discs(Interval.of([0.0] * 8 + [1e-300])).decided
