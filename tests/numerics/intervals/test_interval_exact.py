"""Containment against exact arithmetic: millions of cases without rounding, rationals for the nasty ones, mutations.

Two routes that share no code: the rounding error of an operation, itself a float that two sums or Dekker's product
give without error (T. J. Dekker, A floating-point technique for extending the available precision, 1971), and
Python's rationals. The last tests break the arithmetic on purpose and see that these checks notice.
"""

from fractions import Fraction
from itertools import product

import numpy as np
import pytest

from assur.numerics.intervals import interval, rounding
from assur.numerics.intervals.interval import Interval, common

OPERATIONS = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
}


def two_sum(a, b):
    """The rounded sum and its error: a + b = sum + error exactly (D. E. Knuth)."""
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


def two_product(a, b):
    """The rounded product and its error, exactly, where nothing under- or overflows (Dekker, Veltkamp)."""
    whole = a * b
    (a1, a2), (b1, b2) = (_halves(number) for number in (a, b))
    return whole, ((a1 * b1 - whole) + a1 * b2 + a2 * b1) + a2 * b2


def _halves(number):
    large = number * 134217729.0
    high = large - (large - number)
    return high, number - high


def points(seed, count=1_000_000):
    """Floats of both signs and of sizes from 1e-60 to 1e60, half of them near each other so that sums cancel."""
    rng = np.random.default_rng(seed)
    first, second = rng.choice([-1.0, 1.0], size=(2, count)) * 10.0 ** rng.uniform(-60, 60, size=(2, count))
    near = rng.random(count) < 0.5
    return first, np.where(near, first * rng.uniform(-1.5, 1.5, size=count), second)


def escaped_points(name, a, b):
    """How many exact results of a (n,) and b (n,) lie outside the interval answer; no rounding on the way."""
    answer = OPERATIONS[name](Interval.of(a), Interval.of(b))
    low, high = answer.low, answer.high
    if name in "+-":
        rounded, error = two_sum(a, b if name == "+" else -b)
        return int(np.sum((low - rounded > error) | (high - rounded < error)))
    if name == "*":
        rounded, error = two_product(a, b)
        return int(np.sum((low - rounded > error) | (high - rounded < error)))
    turned = np.sign(b)  # low <= a/b as low |b| <= a sign(b)
    outside = np.zeros(len(a), dtype=bool)
    for bound, side in ((low, 1.0), (high, -1.0)):
        rounded, error = two_product(bound, np.abs(b))
        outside |= side * (turned * a - rounded) < side * error
    return int(np.sum(outside))


def escaped_roots(a):
    """How many exact roots of a (n,), none negative, lie outside."""
    answer = Interval.of(a).sqrt()
    outside = np.zeros(len(a), dtype=bool)
    for bound, side in ((answer.low, 1.0), (answer.high, -1.0)):
        rounded, error = two_product(bound, bound)
        outside |= side * (a - rounded) < side * error
    return int(np.sum(outside))


def corners(x, y):
    """Pairs of numbers of two scalar intervals: their finite ends, zero and a number between."""
    return product(_some(x), _some(y))


def _some(x):
    ends = [float(end) for end in (x.low, x.high, x.middle) if np.isfinite(end)]
    return {Fraction(end) for end in ends} | ({Fraction(0)} if x.low <= 0 <= x.high else set())


def escaped_rationals(name, x, y, bounded_by):
    """How many exact results of numbers inside x (n,) and y (n,) lie outside, or have no value and are defined."""
    answer, count = OPERATIONS[name](x, y), 0
    for k in range(len(x.low)):
        low, high, defined = float(answer.low[k]), float(answer.high[k]), bool(answer.defined[k])
        for a, b in corners(x[k], y[k]):
            if name == "/" and b == 0:
                count += defined
                continue
            count += not bounded_by(low, OPERATIONS[name](a, b), high)
    return count


def escaped_ends(x, bounded_by):
    """The same for the operations on one interval: minus, size, square, root."""
    count = 0
    answers = {"-": -x, "abs": abs(x), "square": x * x}
    exact = {"-": lambda a: -a, "abs": abs, "square": lambda a: a * a}
    root = x.sqrt()
    for k in range(len(x.low)):
        for a in _some(x[k]):
            for name, answer in answers.items():
                count += not bounded_by(float(answer.low[k]), exact[name](a), float(answer.high[k]))
            if a < 0:
                count += bool(root.defined[k])
            else:
                high = float(root.high[k])
                count += not (Fraction(float(root.low[k])) ** 2 <= a and (high == np.inf or a <= Fraction(high) ** 2))
    return count


def sample(intervals, seed, count):
    """Some of them, drawn with repetition."""
    return intervals[np.random.default_rng(seed).integers(len(intervals.low), size=count)]


def escaped_pairs(x, y, bounded_by):
    """The same for what two have in common."""
    count = 0
    both, nothing = common(x, y)
    for k in range(len(x.low)):
        for a in _some(x[k]) | _some(y[k]):
            inside = all(bounded_by(float(part.low[k]), a, float(part.high[k])) for part in (x, y))
            found = bounded_by(float(both.low[k]), a, float(both.high[k])) and not nothing[k]
            count += inside != found if not nothing[k] or inside else 0
    empty = (x.high < y.low) | (y.high < x.low)
    return count + int(np.sum(nothing != empty))


# ---- the arithmetic holds -----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", OPERATIONS)
def test_a_million_exact_results_lie_inside(name):
    assert escaped_points(name, *points(1)) == 0


def test_a_million_exact_roots_lie_inside():
    assert escaped_roots(np.abs(points(2)[0])) == 0


def test_the_two_exact_routes_agree():
    a, b = points(3, 2000)
    for errorless, operation in ((two_sum, "+"), (two_product, "*")):
        rounded, error = errorless(a, b)
        for x, y, r, e in zip(a.tolist(), b.tolist(), rounded.tolist(), error.tolist(), strict=True):
            assert Fraction(r) + Fraction(e) == OPERATIONS[operation](Fraction(x), Fraction(y))


@pytest.mark.parametrize("name", OPERATIONS)
def test_rationals_of_nasty_intervals_lie_inside(name, nasty_intervals, bounded_by):
    x, y = (sample(nasty_intervals, seed, 1500) for seed in (4, 5))
    assert escaped_rationals(name, x, y, bounded_by) == 0


@pytest.mark.parametrize("name", OPERATIONS)
def test_every_pair_of_nasty_floats_lies_inside(name, nasty, bounded_by):
    a, b = (part.ravel() for part in np.meshgrid(nasty, nasty))
    assert escaped_rationals(name, Interval.of(a), Interval.of(b), bounded_by) == 0


@pytest.mark.parametrize("name", OPERATIONS)
def test_exact_numbers_on_either_side_give_the_same_bounds_or_tighter(name, nasty, nasty_intervals):
    x = sample(nasty_intervals, 6, 4000)
    number = np.random.default_rng(7).choice(nasty, size=4000)
    operation = OPERATIONS[name]
    pairs = [
        (operation(x, number), operation(x, Interval(number, number.copy(), np.ones(4000, dtype=bool)))),
        (operation(number, x), operation(Interval(number, number.copy(), np.ones(4000, dtype=bool)), x)),
    ]
    for short, full in pairs:
        assert np.all((short.low >= full.low) & (short.high <= full.high))
        np.testing.assert_array_equal(short.defined, full.defined)


def test_rationals_of_numbers_beside_intervals_lie_inside(nasty, nasty_intervals, bounded_by):
    x = sample(nasty_intervals, 8, 800)
    number = np.random.default_rng(9).choice(nasty, size=800)
    for operation in OPERATIONS.values():
        answer = operation(x, number)
        for k in range(800):
            for a in _some(x[k]):
                b = Fraction(float(number[k]))
                if b != 0 or operation is not OPERATIONS["/"]:
                    assert bounded_by(float(answer.low[k]), operation(a, b), float(answer.high[k]))


def test_rationals_of_one_and_of_two_lie_inside(nasty_intervals, bounded_by):
    assert escaped_ends(nasty_intervals, bounded_by) == 0
    assert escaped_pairs(sample(nasty_intervals, 10, 1000), sample(nasty_intervals, 11, 1000), bounded_by) == 0


# ---- and a fault in it is noticed ---------------------------------------------------------------------------


def escapes(nasty_intervals, bounded_by):
    """Whether anything escapes, of a smaller number of cases."""
    a, b = points(12, 20_000)
    tiny = np.array([5e-324, 1e-200, -1e-200, 2.0**-1022, -3e-310])
    one, two = (part.ravel() for part in np.meshgrid(tiny, tiny))
    x, y = (sample(nasty_intervals, seed, 150) for seed in (13, 14))
    return (
        any(escaped_points(name, a, b) for name in OPERATIONS)
        or escaped_roots(np.abs(a)) > 0
        or escaped_rationals("*", Interval.of(one), Interval.of(two), bounded_by) > 0
        or escaped_ends(x, bounded_by) > 0
        or escaped_pairs(x, y, bounded_by) > 0
        or any(escaped_rationals(name, x, y, bounded_by) for name in OPERATIONS)
    )


def nearest(result):
    return np.asarray(result, dtype=float)


def without_zero_inside(self, other):
    low, high, defined = interval._parts(other)
    least, most = interval._corners(np.divide, (self.low, self.high), (low, high))
    return Interval(least, most, self.defined & defined)


def always_defined(self, other):
    found = TRUE_DIVISION(self, other)
    return Interval(found.low, found.high, np.ones_like(found.defined))


def one_corner(operation, ends, others):
    return CORNERS(operation, (ends[0], ends[-1]), (others[0],))


def never_empty(a, b):
    found, nothing = COMMON(a, b)
    return found, np.zeros_like(nothing)


TRUE_DIVISION, CORNERS, COMMON = Interval.__truediv__, interval._corners, common
MUTATIONS = {
    "no rounding down": (rounding, "down", nearest),
    "no rounding up": (rounding, "up", nearest),
    "no rounding down of sums": (rounding, "down_sum", nearest),
    "no rounding up of sums": (rounding, "up_sum", nearest),
    "rounding inwards from below": (rounding, "down", rounding.up),
    "rounding inwards from above": (rounding, "up", rounding.down),
    "sums rounded inwards": (rounding, "up_sum", rounding.down_sum),
    "half a step": (rounding, "SHARE", 2.0**-54),
    "a quarter of a step of sums": (rounding, "SHARE_OF_SUM", 2.0**-55),
    "underflow forgotten": (rounding, "LEAST", 0.0),
    "sign of minus": (Interval, "__neg__", lambda self: Interval(-self.low, -self.high, self.defined)),
    "difference as a sum": (Interval, "__sub__", lambda self, other: Interval.__add__(self, other)),
    "difference of like ends": (
        Interval, "__sub__", lambda self, other: Interval(self.low - other.low, self.high - other.high, self.defined)
    ),
    "two corners of four": (interval, "_corners", one_corner),
    "zero in a divisor": (Interval, "__truediv__", without_zero_inside),
    "division always defined": (Interval, "__truediv__", always_defined),
    "size of the ends": (
        Interval, "__abs__",
        lambda self: Interval(np.minimum(abs(self.low), abs(self.high)), self.magnitude, self.defined),
    ),
    "empty taken for inside": ("here", "common", never_empty),
}  # fmt: skip


def test_nothing_escapes_without_a_mutation(nasty_intervals, bounded_by):
    assert not escapes(nasty_intervals, bounded_by)


@pytest.mark.parametrize("name", MUTATIONS)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_mutation_is_noticed(name, monkeypatch, nasty_intervals, bounded_by):
    place, attribute, broken = MUTATIONS[name]
    if place == "here":
        monkeypatch.setitem(globals(), attribute, broken)
    else:
        monkeypatch.setattr(place, attribute, broken)
    assert escapes(nasty_intervals, bounded_by)
