"""Float operations as machine code: one interpreter for every tape, whose operations are loops over a few elements.

The operations are those of NumPy, in the same order: the bits are the same but for the sign of a zero under a root. No
flag lets the compiler change floats. Imported where it is used only: it needs numba, whose code is kept on disk where
that can be written. What `assur.numerics.recording.interval_plan` numbers is written here too: numba does not see when
another file changes.
"""

from __future__ import annotations

from math import sqrt
from typing import Any

from numba import njit

from assur.numerics.recording import interval_plan

STEPS = ("varying", "store", "+", "-", "*", "/", "negative", "magnitude", "root", "sign rate", "root rate")
_VARYING, _STORE, _PLUS, _MINUS, _TIMES, _OVER, _NEGATIVE, _, _ROOT = range(9)

if interval_plan.STEPS != STEPS:
    raise ImportError(f"{__name__}: STEPS are not those of {interval_plan.__name__}; write the same in both")


def _compiled(function: Any) -> Any:
    """Machine code of a function, kept on disk where a folder for it can be written."""
    try:
        return njit(cache=True, nogil=True, error_model="numpy")(function)
    except RuntimeError:  # no folder can be written
        return njit(nogil=True, error_model="numpy")(function)


@_compiled
def run(steps: Any, given: Any, answer: Any, rows: Any, work: Any) -> None:
    """Go through a program for every element, some at a time.

    Args:
        steps: (S, 5) as `interval_plan` plans them, without magnitudes and rates.
        given: (V, N) what varies.
        answer: (R, N), and `rows` (outputs,) the row of each stored number.
        rows: as said.
        work: (P, B) whose first rows come filled with what is the same for every element.
    """
    size, count = work.shape[1], given.shape[1]
    for begin in range(0, count, size):
        length = min(size, count - begin)
        for k in range(len(steps)):
            code, at, a, b = steps[k, 0], steps[k, 1], steps[k, 2], steps[k, 3]
            if code == _VARYING:
                for i in range(length):
                    work[at, i] = given[a, begin + i]
                continue
            if code == _STORE:
                for i in range(length):
                    answer[rows[at], begin + i] = work[a, i]
                continue
            out, one, two = work[at], work[a], work[b]
            if code == _TIMES:
                for i in range(length):
                    out[i] = one[i] * two[i]
            elif code == _PLUS:
                for i in range(length):
                    out[i] = one[i] + two[i]
            elif code == _MINUS:
                for i in range(length):
                    out[i] = one[i] - two[i]
            elif code == _OVER:
                for i in range(length):
                    out[i] = one[i] / two[i]
            elif code == _NEGATIVE:
                for i in range(length):
                    out[i] = -one[i]
            elif code == _ROOT:
                for i in range(length):
                    out[i] = sqrt(0.0 if one[i] < 0.0 else one[i])
