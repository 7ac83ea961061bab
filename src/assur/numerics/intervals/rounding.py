"""Rounding outwards: a float that is certainly below, or above, the exact result of one rounded operation.

An operation that IEEE 754 rounds to nearest errs by at most half the distance to the next float, so one step of
`nextafter` outwards encloses it. Products of the size with 2^-53 give that step many times faster than
`numpy.nextafter` (S. M. Rump, P. Zimmermann, S. Boldo, G. Melquiond, Computing predecessor and successor in rounding
to nearest, BIT 49, 2009, algorithm 1: one step exactly, of every float but those next to underflow).

Products and quotients may underflow, and a result of 0 need not be exact: their step has a part that does not depend
on the size. A sum, a difference or a root is 0 only where it is exact, and below 2^-1021 sums are exact: their step
needs no such part, so that bounds of 0 stay 0, and what is a sum of squares does not become negative.

All of it holds where the processor rounds to nearest and keeps subnormal numbers: where it takes them for zero, a sum
of 0 may be any of them. Other libraries may leave a thread otherwise, without a word (importing some interval
libraries, or one linked with -ffast-math, does): every interval that is made asks, in the thread that makes it, and
raises.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError

SHARE = 2.0**-53 * (1 + 2.0**-52)
"""A little more than half the distance between 1 and the next float."""

SHARE_OF_SUM = 2.0**-52
"""The distance between 1 and the next float: times a normal float it is at least one step, rounded or not."""

LEAST = 2.0**-960
"""Added to the step of a product: covers underflow, and keeps bounds about zero out of the slow subnormal numbers."""

GREATEST = float(np.finfo(float).max)

TINY = 2.0**-60
"""Added to 1, or taken from it, this is rounded away; upwards, downwards or to zero one of the two is not."""


SUBNORMAL = float(np.int64(1).view(np.float64))
"""The least float above 0, from its bits: read from decimals it is 0 where subnormal numbers are taken for zero."""


def check_nearest() -> None:
    """See that this thread rounds to nearest, to subnormal numbers too.

    Errors:
        UsageError: it does not, so that no bound could be trusted.
    """
    if not 1.0 + TINY == 1.0 == 1.0 - TINY:
        raise UsageError(
            "this thread of the processor does not round to nearest, so no bound of an interval would be proved",
            hint="another library changed the mode of rounding: import it in another process, or set the mode back"
            " (fesetround(FE_TONEAREST))",
        )
    if SUBNORMAL + 0.0 == 0.0:
        raise UsageError(
            "this thread of the processor takes subnormal numbers for zero, so no bound of an interval would be proved",
            hint="another library has turned that on (one linked with -ffast-math does): import it in another process,"
            " or turn it off (fesetenv(FE_DFL_ENV))",
        )


def down(result: Any) -> NDArray[np.float64]:
    """A float (...) at or below the predecessor of a rounded result; an overflow upwards gives almost the greatest.

    At most one float below the predecessor and 2^-960. NaN stays NaN.

    >>> bool(down(0.1 * 0.2) <= np.nextafter(0.1 * 0.2, -np.inf))
    True
    """
    finite = np.minimum(result, GREATEST)
    step = np.abs(finite)
    step *= SHARE
    step += LEAST
    with np.errstate(over="ignore"):
        finite -= step
    return np.asarray(finite)


def up(result: Any) -> NDArray[np.float64]:
    """A float (...) at or above the successor of a rounded result: the mirror image of `down`.

    >>> bool(up(0.1 * 0.2) >= np.nextafter(0.1 * 0.2, np.inf))
    True
    """
    finite = np.maximum(result, -GREATEST)
    step = np.abs(finite)
    step *= SHARE
    step += LEAST
    with np.errstate(over="ignore"):
        finite += step
    return np.asarray(finite)


def down_sum(result: Any) -> NDArray[np.float64]:
    """A float (...) at or below the exact value of a rounded sum, difference or square root: one float less, or two.

    >>> bool(down_sum(0.1 + 0.2) < 0.1 + 0.2), float(down_sum(0.25 - 0.25))
    (True, 0.0)
    """
    finite = np.minimum(result, GREATEST)
    step = np.abs(finite)
    step *= SHARE_OF_SUM
    with np.errstate(over="ignore"):
        finite -= step
    return np.asarray(finite)


def up_sum(result: Any) -> NDArray[np.float64]:
    """A float (...) at or above the exact value of a rounded sum, difference or square root: `down_sum`, mirrored.

    >>> bool(up_sum(0.1 + 0.2) > 0.1 + 0.2), float(up_sum(0.25 - 0.25))
    (True, 0.0)
    """
    finite = np.maximum(result, -GREATEST)
    step = np.abs(finite)
    step *= SHARE_OF_SUM
    with np.errstate(over="ignore"):
        finite += step
    return np.asarray(finite)
