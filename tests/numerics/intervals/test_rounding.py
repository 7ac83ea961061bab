"""Steps outwards against nextafter for floats of every size, and against exact rationals."""

import ctypes
import ctypes.util
import platform
import struct
import sys
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.errors import UsageError
from assur.numerics.intervals.interval import Interval
from assur.numerics.intervals.rounding import GREATEST, LEAST, down, down_sum, up, up_sum

FLOATS = st.floats(allow_nan=False, allow_infinity=False)
TINIEST = 5e-324

X86 = {"downwards": 0x400, "upwards": 0x800, "to zero": 0xC00}
ARM = {"upwards": 0x400000, "downwards": 0x800000, "to zero": 0xC00000}
MODES = {"x86_64": X86, "AMD64": X86, "aarch64": ARM, "arm64": ARM}
"""Of rounding, as <fenv.h> numbers them."""

X86_ZEROS = {"results": 0x8000, "operands": 0x40, "both": 0x8040}
ZEROS = {("linux", "x86_64"): (28, X86_ZEROS), ("linux", "aarch64"): (0, {"both": 0x1000000})}
"""Where the register of the modes lies in an fenv_t, and the bits that make zeros of subnormal numbers."""

PLACE, BITS = ZEROS.get((sys.platform, platform.machine()), (0, {}))
"""Those of this machine."""


@pytest.fixture(scope="module")
def every(nasty):
    """A million floats of random bits, floats beside powers of two and underflow: all finite, both signs."""
    bits = np.random.default_rng(0).integers(-(2**63), 2**63 - 1, size=1_000_000, dtype=np.int64).view(np.float64)
    powers = np.exp2(np.arange(-1074.0, 1024.0))
    beside = np.concatenate([powers, np.nextafter(powers, 0), np.nextafter(powers, np.inf)])
    subnormal = np.arange(4096) * TINIEST
    found = np.concatenate([bits, beside, -beside, subnormal, -subnormal, nasty, [GREATEST, -GREATEST]])
    return found[np.isfinite(found)]


def _next(number, towards):
    with np.errstate(over="ignore"):  # beside the greatest float
        return np.nextafter(number, towards)


def test_a_step_is_at_least_that_of_nextafter(every):
    assert np.all(down(every) <= _next(every, -np.inf))
    assert np.all(up(every) >= _next(every, np.inf))


def test_a_step_is_at_most_one_more_and_what_covers_underflow(every):
    two = _next(_next(every, -np.inf), -np.inf)
    assert np.all((down(every) >= two - 2 * LEAST) | (every < -0.999 * GREATEST))
    large = every[np.abs(every) > 1e-250]
    np.testing.assert_array_equal(down(large), _next(large, -np.inf))


def test_a_step_of_a_sum_is_at_least_that_of_nextafter_where_sums_are_rounded(every):
    """Below 2^-1021 a sum of floats is exact: it is a multiple of the smallest float and has room in 53 bits."""
    rounded = every[np.abs(every) >= 2.0**-1021]
    assert np.all(down_sum(rounded) <= _next(rounded, -np.inf))
    assert np.all(up_sum(rounded) >= _next(rounded, np.inf))
    exact = every[np.abs(every) < 2.0**-1021]
    assert len(exact) > 8000
    assert np.all(down_sum(exact) <= exact)
    assert np.all(up_sum(exact) >= exact)


def test_a_step_of_a_sum_is_at_most_two(every):
    two = _next(_next(every, -np.inf), -np.inf)
    assert np.all(down_sum(every) >= two)


def test_up_mirrors_down(every):
    np.testing.assert_array_equal(up(every), -down(-every))
    np.testing.assert_array_equal(up_sum(every), -down_sum(-every))


def test_a_sum_of_zero_stays_zero_and_a_product_of_zero_does_not():
    assert down_sum(0.0) == up_sum(0.0) == down_sum(-0.0) == 0
    assert down(0.0) == -LEAST
    assert up(-0.0) == LEAST


@pytest.mark.parametrize(("below", "above"), [(down, up), (down_sum, up_sum)])
def test_overflow_leaves_a_finite_bound_on_the_near_side(below, above):
    assert GREATEST * (1 - 4e-16) < below(np.inf) < GREATEST
    assert above(np.inf) == np.inf
    assert -GREATEST < above(-np.inf) < -GREATEST * (1 - 4e-16)
    assert below(-np.inf) == -np.inf
    assert above(GREATEST) == np.inf  # the next float; no warning
    assert np.isnan(below(np.nan))
    assert np.isnan(above(np.nan))


@pytest.mark.parametrize("step", [down, up, down_sum, up_sum])
def test_the_argument_is_not_changed_and_the_shape_kept(step):
    given_array = np.ones((2, 3))
    assert step(given_array).shape == (2, 3)
    assert np.all(given_array == 1)
    assert step(1.0).shape == ()


@given(FLOATS, FLOATS)
def test_steps_enclose_exact_rationals(a, b):
    with np.errstate(all="ignore"):
        total, product = np.float64(a) + b, np.float64(a) * b
        quotient = np.float64(a) / b if b else np.float64(0)
    cases = [(total, Fraction(a) + Fraction(b), down_sum, up_sum), (product, Fraction(a) * Fraction(b), down, up)]
    if b:
        cases.append((quotient, Fraction(a) / Fraction(b), down, up))
    for rounded, exact, below, above in cases:
        low, high = float(below(rounded)), float(above(rounded))
        assert low == -np.inf or Fraction(low) <= exact
        assert high == np.inf or Fraction(high) >= exact


@given(st.floats(min_value=0, allow_infinity=False))
def test_steps_enclose_exact_roots(radicand):
    root = np.sqrt(radicand)
    assert Fraction(float(down_sum(root))) ** 2 <= Fraction(radicand) <= Fraction(float(up_sum(root))) ** 2
    assert float(down_sum(root)) >= 0


@pytest.mark.parametrize("mode", ["upwards", "downwards", "to zero"])
def test_an_interval_is_refused_where_another_library_left_the_rounding_otherwise(mode):
    """Importing an interval library may do that to the whole thread."""
    library = ctypes.CDLL(ctypes.util.find_library("m"))
    nearest, other = library.fegetround(), MODES[platform.machine()][mode]
    x = Interval.of(0.1)
    assert library.fesetround(other) == 0
    try:
        with pytest.raises(UsageError, match="does not round to nearest"):
            x * x
    finally:
        library.fesetround(nearest)
    assert (x * x).contains(0.1 * 0.1)


@pytest.mark.parametrize("which", BITS)
def test_an_interval_is_refused_where_another_library_makes_zeros_of_subnormal_numbers(which):
    """2^-1022 - 1.5 2^-1022 would be [-0, 0] there. Importing a library linked with -ffast-math may do that."""
    library = ctypes.CDLL(ctypes.util.find_library("m"))
    before = ctypes.create_string_buffer(256)
    assert library.fegetenv(before) == 0
    changed = ctypes.create_string_buffer(before.raw, len(before.raw))
    struct.pack_into("<I", changed, PLACE, struct.unpack_from("<I", before, PLACE)[0] | BITS[which])
    x, y = Interval.of([2.0**-1022]), Interval.of([1.5 * 2.0**-1022])
    assert library.fesetenv(changed) == 0
    try:
        with pytest.raises(UsageError, match="takes subnormal numbers for zero"):
            x - y
    finally:
        library.fesetenv(before)
    assert (x - y).high < 0
