"""Interval operations as machine code: one interpreter for every tape, whose operations are loops over a few elements.

The formulas are those of `assur.numerics.intervals`, in the same order and with the same roundings: bounds agree to the
last bit (but for the sign of a zero). No flag lets the compiler change floats. Imported where it is used only: it needs
numba. Its machine code is kept on disk where that can be written.

Numba takes what it kept for the same as long as this file is: so every number that the code depends on is written here,
and importing it fails where another file has come to say something else.
"""

from __future__ import annotations

from math import inf, isnan, sqrt
from typing import Any

from numba import njit

from assur.numerics.intervals import rounding
from assur.numerics.recording import interval_plan

SHARE = 2.0**-53 * (1 + 2.0**-52)
SHARE_OF_SUM = 2.0**-52
LEAST = 2.0**-960
GREATEST = (2 - 2.0**-52) * 2.0**1023
STEPS = ("varying", "store", "+", "-", "*", "/", "negative", "magnitude", "root", "sign rate", "root rate")
_VARYING, _STORE, _PLUS, _MINUS, _TIMES, _OVER, _NEGATIVE, _MAGNITUDE, _ROOT, _SIGN_RATE, _ROOT_RATE = range(len(STEPS))

_SAME = {rounding: ("SHARE", "SHARE_OF_SUM", "LEAST", "GREATEST"), interval_plan: ("STEPS",)}
for _place, _name in ((place, name) for place, names in _SAME.items() for name in names):
    if globals()[_name] != getattr(_place, _name):
        raise ImportError(f"{__name__}: {_name} is not that of {_place.__name__}; write the same in both")


def _compiled(function: Any) -> Any:
    """Machine code of a function, kept on disk where a folder for it can be written."""
    try:
        return njit(cache=True, nogil=True, error_model="numpy")(function)
    except RuntimeError:  # no folder can be written
        return njit(nogil=True, error_model="numpy")(function)


@_compiled
def _down(result: float) -> float:
    finite = min(result, GREATEST)
    return finite - (abs(finite) * SHARE + LEAST)


@_compiled
def _up(result: float) -> float:
    finite = max(result, -GREATEST)
    return finite + (abs(finite) * SHARE + LEAST)


@_compiled
def _down_sum(result: float) -> float:
    finite = min(result, GREATEST)
    return finite - abs(finite) * SHARE_OF_SUM


@_compiled
def _up_sum(result: float) -> float:
    finite = max(result, -GREATEST)
    return finite + abs(finite) * SHARE_OF_SUM


@_compiled
def _known(number: float) -> float:
    """0 inf, 0/0 and inf/inf have the limit 0."""
    return 0.0 if isnan(number) else number


@_compiled
def _product(a: float, b: float, c: float, d: float) -> tuple[float, float]:
    one, two, three, four = _known(a * c), _known(a * d), _known(b * c), _known(b * d)
    return _down(min(min(one, two), min(three, four))), _up(max(max(one, two), max(three, four)))


@_compiled
def _square(a: float, b: float) -> tuple[float, float]:
    least, most = max(max(a, -b), 0.0), max(-a, b)
    return max(_down(least * least), 0.0), _up(most * most)


@_compiled
def _quotient(a: float, b: float, c: float, d: float) -> tuple[float, float, bool]:
    """Bounds, and whether the divisor has zero inside or for a bound."""
    around = c <= 0.0 <= d
    inside = around and ((c < 0.0 and d > 0.0) or (c == 0.0 and d == 0.0)) and (a != 0.0 or b != 0.0)
    if inside:
        return -inf, inf, around
    if around:  # numbers on one side of zero only: 1/0 is the infinity of that side
        c, d = (0.0 if c == 0.0 else c), (-0.0 if d == 0.0 else d)
    one, two, three, four = _known(a / c), _known(a / d), _known(b / c), _known(b / d)
    return _down(min(min(one, two), min(three, four))), _up(max(max(one, two), max(three, four))), around


@_compiled
def _root(a: float, b: float) -> tuple[float, float]:
    return _down_sum(sqrt(max(a, 0.0))), _up_sum(sqrt(max(b, 0.0)))


@_compiled
def _root_rate(a: float, b: float, c: float, d: float) -> tuple[float, float]:
    """`assur.numerics.intervals.rates.root_rate` of [a, b], the whole, and [c, d], in the middle."""
    one, two = _root(a, b), _root(c, d)
    low, high, _ = _quotient(1.0, 1.0, _down_sum(one[0] + two[0]), _up_sum(one[1] + two[1]))
    least, most = max(low, 0.0), high
    finite = abs(a) < inf and abs(d) < inf
    start, end = (a, d) if finite else (0.0, 1.0)
    far = max(end, start)
    slanted = _quotient(two[0], two[0], _down_sum(far - start), _up_sum(far - start))[0] if finite else 0.0
    if min(a, c) < 0.0:
        least = min(least, slanted if slanted > 0.0 else 0.0)
    if d < 0.0:
        depth = _root(-d, -c)
        most = _quotient(0.5, 0.5, depth[0], depth[1])[1]
    if c < 0.0:
        least = 0.0
    return least, max(least, most)


@_compiled
def run(steps: Any, given: Any, answer: Any, work: Any, clamped: bool) -> None:
    """Go through a program for every element, some at a time.

    Args:
        steps: (S, 5) as `interval_plan` plans them.
        given: low, high, defined (V, N) and exact (V,), whether both bounds are one object: an exact zero among the
            factors makes an exact zero of the product.
        answer: low, high, defined (R, N).
        work: low, high, defined (P, B). The first rows come filled with what is the same for every element, are read
            again for each B of them, and so must be no step's place; the others are room for intermediate results.
        clamped: whether the root of a negative number counts as defined.
    """
    low, high, defined = work
    size, count = low.shape[1], answer[0].shape[1]
    for begin in range(0, count, size):
        length = min(size, count - begin)
        for k in range(len(steps)):
            code, at, a, b, number = steps[k, 0], steps[k, 1], steps[k, 2], steps[k, 3], steps[k, 4]
            if code == _VARYING:
                for i in range(length):
                    low[at, i], high[at, i] = given[0][a, begin + i], given[1][a, begin + i]
                    defined[at, i] = given[2][a, begin + i]
            elif code == _STORE:
                for i in range(length):
                    answer[0][at, begin + i], answer[1][at, begin + i] = low[a, i], high[a, i]
                    answer[2][at, begin + i] = defined[a, i]
            elif code == _PLUS:
                for i in range(length):
                    low[at, i] = _down_sum(low[a, i] + low[b, i])
                    high[at, i] = _up_sum(high[a, i] + high[b, i])
                    defined[at, i] = defined[a, i] & defined[b, i]
            elif code == _MINUS:
                for i in range(length):
                    least, most = low[a, i] - high[b, i], high[a, i] - low[b, i]
                    low[at, i], high[at, i] = _down_sum(least), _up_sum(most)
                    defined[at, i] = defined[a, i] & defined[b, i]
            elif code == _TIMES and a == b:
                for i in range(length):
                    low[at, i], high[at, i] = _square(low[a, i], high[a, i])
                    defined[at, i] = defined[a, i]
            elif code == _TIMES:
                exact = number >= 0 and given[3][number]
                for i in range(length):
                    least, most = _product(low[a, i], high[a, i], low[b, i], high[b, i])
                    nothing = exact and low[b, i] == 0.0
                    low[at, i], high[at, i] = (0.0 if nothing else least), (0.0 if nothing else most)
                    defined[at, i] = defined[a, i] & defined[b, i]
            elif code == _OVER:
                for i in range(length):
                    low[at, i], high[at, i], around = _quotient(low[a, i], high[a, i], low[b, i], high[b, i])
                    defined[at, i] = defined[a, i] & defined[b, i] & (not around)
            elif code == _NEGATIVE:
                for i in range(length):
                    low[at, i], high[at, i] = -high[a, i], -low[a, i]
                    defined[at, i] = defined[a, i]
            elif code == _MAGNITUDE:
                for i in range(length):
                    low[at, i], high[at, i] = max(max(low[a, i], -high[a, i]), 0.0), max(-low[a, i], high[a, i])
                    defined[at, i] = defined[a, i]
            elif code == _ROOT:
                for i in range(length):
                    known = defined[a, i] & (clamped or low[a, i] >= 0.0)
                    low[at, i], high[at, i] = _root(low[a, i], high[a, i])
                    defined[at, i] = known
            elif code == _SIGN_RATE:
                for i in range(length):
                    sure = 1.0 if low[a, i] >= 0.0 else -1.0, -1.0 if high[a, i] <= 0.0 else 1.0
                    low[at, i], high[at, i] = min(sure[0], sure[1]), max(sure[0], sure[1])
                    defined[at, i] = defined[a, i]
            elif code == _ROOT_RATE:
                for i in range(length):
                    least, most = _root_rate(low[a, i], high[a, i], low[b, i], high[b, i])
                    low[at, i], high[at, i] = least, most
                    defined[at, i] = defined[a, i] & defined[b, i]
