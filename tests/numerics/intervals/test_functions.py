"""Cosine and sine of intervals against multiple precision, the standard's vectors, and with faults put in."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.numerics.intervals import functions
from assur.numerics.intervals.functions import ERROR, TURN, cosine_sine, from_degrees
from assur.numerics.intervals.interval import Interval

FLOATS_WIDER = 18
"""By how many floats a bound may lie outside the tightest one: `ERROR` is 8 to 16, beside 2^-959."""


def exact(function, number):
    """The value at a float with 60 digits beyond those that a reduction by multiples of pi takes away."""
    with mpmath.workprec(1400):
        return function(mpmath.mpf(float(number)))


@pytest.fixture(scope="module")
def angles():
    """Angles of all sizes, among them those beside multiples of a quarter of pi."""
    rng = np.random.default_rng(0)
    quarters = np.arange(-200, 201) * (np.pi / 4)
    sizes = 10.0 ** rng.uniform(-320, 300, size=600) * rng.choice([-1.0, 1.0], size=600)
    beside = [np.nextafter(quarters, -np.inf), np.nextafter(quarters, np.inf)]
    return np.concatenate([quarters, *beside, rng.uniform(-7, 7, size=1500), sizes])


def test_the_library_s_error_is_within_the_stated_bound(angles):
    for ours, theirs in ((np.cos, mpmath.cos), (np.sin, mpmath.sin)):
        for angle, value in zip(angles, ours(angles), strict=True):
            true = exact(theirs, angle)
            assert abs(mpmath.mpf(float(value)) - true) <= ERROR * abs(true) + mpmath.mpf(2) ** -1074


def test_a_turn_lies_between_its_bounds():
    with mpmath.workprec(200):
        assert mpmath.mpf(float(TURN.low)) < 2 * mpmath.pi < mpmath.mpf(float(TURN.high))
    assert np.nextafter(TURN.low, 7) == TURN.high


def escapes(angles):
    """How many exact values of numbers inside lie outside: ends, random numbers and the peaks between."""
    rng = np.random.default_rng(1)
    low = rng.choice(angles[np.abs(angles) < 1e6], size=400)
    width = 10.0 ** rng.uniform(-18, 1.2, size=400) * (rng.random(400) < 0.9)
    high = low + width
    cosine, sine = cosine_sine(Interval.of(low, high))
    count = 0
    for k in range(400):
        inside = [low[k], high[k], *np.clip(rng.uniform(low[k], high[k], size=4), low[k], high[k])]
        quarters = np.arange(np.ceil(low[k] / (np.pi / 2)), np.floor(high[k] / (np.pi / 2)) + 1)
        inside += [number for number in quarters * (np.pi / 2) if low[k] <= number <= high[k]]
        for number in inside:
            for found, function in ((cosine, mpmath.cos), (sine, mpmath.sin)):
                value = exact(function, number)
                count += not mpmath.mpf(float(found.low[k])) <= value <= mpmath.mpf(float(found.high[k]))
    return count


def test_exact_values_lie_inside(angles):
    assert escapes(angles) == 0


def test_exact_values_of_angles_of_any_size_lie_inside(angles):
    cosine, sine = cosine_sine(Interval.of(angles))
    for found, function in ((cosine, mpmath.cos), (sine, mpmath.sin)):
        for low, angle, high in zip(found.low, angles, found.high, strict=True):
            assert mpmath.mpf(float(low)) <= exact(function, angle) <= mpmath.mpf(float(high))


def test_peaks_between_the_ends_are_reached():
    cosine, sine = cosine_sine(Interval.of([-0.1, 3.0, 1.0, 4.0, 0.0, 7.0], [0.1, 3.2, 2.0, 5.0, 7.0, 7.5]))
    assert cosine.high.tolist()[0] == 1
    assert cosine.low.tolist()[1] == -1
    assert sine.high.tolist()[2] == 1
    assert sine.low.tolist()[3] == -1
    assert (cosine.low[4], cosine.high[4], sine.low[4], sine.high[4]) == (-1, 1, -1, 1)
    assert -1 < cosine.low[5] < cosine.high[5] < 1
    assert -1 < sine.low[5] < sine.high[5] < 1


@pytest.mark.parametrize("bounds", [(-np.inf, np.inf), (0.0, np.inf), (-np.inf, 0.0), (0.0, 1e300), (1e300, 1.01e300)])
def test_an_angle_without_a_bound_or_of_many_turns_has_all_values(bounds):
    for found in cosine_sine(Interval.of(*bounds)):
        assert (found.low, found.high, found.defined) == (-1, 1, True)


def test_defined_and_the_shape_are_kept():
    angle = 1 / Interval.of([[1.0, -1.0, 2.0]], [[2.0, 1.0, 3.0]])
    for found in cosine_sine(angle):
        assert found.defined.tolist() == [[True, False, True]]
        assert found.shape == (1, 3)
        assert (found.low[0, 1], found.high[0, 1]) == (-1, 1)


@given(st.floats(-20, 20), st.floats(0, 10), st.floats(0, 1), st.floats(0, 1))
def test_inclusion_is_monotone_and_the_pair_lies_about_the_circle(start, width, s, t):
    large = Interval.of(start, start + width)
    small = Interval.of(
        min(start + 0.5 * s * width, start + width), max(start + 0.5 * s * width, start + width * (1 - 0.5 * t))
    )
    for inner, outer in zip(cosine_sine(small), cosine_sine(large), strict=True):
        assert outer.low - 4e-15 <= inner.low <= inner.high <= outer.high + 4e-15
    cosine, sine = cosine_sine(large)
    assert (cosine * cosine + sine * sine).contains(1.0)


@pytest.mark.parametrize("name", ["cos", "sin"])
def test_the_standard_s_vectors(name, vectors):
    cases = [(arguments[0], result) for operation, arguments, result in vectors if operation == name]
    assert len(cases) == 52
    for bounds, result in cases:
        if bounds is None:
            continue
        ours = cosine_sine(Interval.of(*bounds))[name == "sin"]
        assert ours.low <= result[0], bounds
        assert ours.high >= result[1], bounds
        for mine, theirs in ((ours.low, result[0]), (ours.high, result[1])):
            assert abs(mine - theirs) <= FLOATS_WIDER * np.spacing(abs(theirs)) + 2.0**-959, bounds


@pytest.mark.parametrize(
    ("name", "broken"),
    [
        ("TURN", Interval.of(7.0)),
        ("_whole", lambda number: np.zeros(number.shape, dtype=bool)),
        ("ERROR", -(2.0**-50)),
        ("_between", lambda one, two, *_: (np.minimum(one, two), np.maximum(one, two))),
    ],
)
def test_a_mutation_is_noticed(name, broken, monkeypatch, angles):
    monkeypatch.setattr(functions, name, broken)
    assert escapes(angles) > 0


@pytest.mark.parametrize("angle", [141994952969023.25, -141994952969023.25, 1.6e74, 2.0**20 + 1])
def test_far_angles_where_the_library_errs_more_have_no_bounds_but_one(angle):
    """At the first the library's cosine is wrong by 248 times the stated error."""
    for function, bounds in zip((mpmath.cos, mpmath.sin), cosine_sine(Interval.of(angle)), strict=True):
        assert bounds.low <= exact(function, angle) <= bounds.high
        assert (bounds.low, bounds.high) == (-1.0, 1.0)


def test_bounds_hold_the_degrees_that_a_float_was_converted_from():
    """Decimals of degrees times pi / 180 with 60 digits, against the ways in which floats are converted."""
    rng = np.random.default_rng(7)
    texts = [
        f"{value:.{digits}f}"
        for value, digits in zip(rng.uniform(-720, 720, 2000), rng.integers(0, 17, 2000), strict=True)
    ]
    with mpmath.workdps(60):
        for text in texts:
            angle = mpmath.mpf(text) * mpmath.pi / 180
            for rad in (np.radians(float(text)), math.radians(float(text)), float(text) * (np.pi / 180)):
                found = from_degrees(rad)
                assert mpmath.mpf(float(found.low)) <= angle <= mpmath.mpf(float(found.high))
                assert found.width <= 2.0**-49 * abs(rad)
    assert (from_degrees(0.0).low, from_degrees(0.0).high) == (0.0, 0.0)
