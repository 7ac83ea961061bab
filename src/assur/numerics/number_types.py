"""The functions that a kernel needs beside + - * /, one class per number type it is read over.

A kernel is written once (`assur.model.closed_form`) and takes one of these as its first argument.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.numerics.intervals.interval import Interval, as_interval


class Floats:
    """Float arrays. Below zero the root is 0: whether a branch exists is read off its margins.

    >>> Floats().sqrt([4.0, -4.0])
    array([2., 0.])
    """

    def sqrt(self, radicand: ArrayLike, /) -> NDArray[np.float64]:
        """Root of max(radicand, 0)."""
        root: NDArray[np.float64] = np.sqrt(np.maximum(radicand, 0.0))
        return root


class Extended:
    """Float arrays whose root goes on below zero as an odd function.

    The surface of a margin that holds an inner radicand then runs smoothly past the place where that
    radicand changes sign, so that the surfaces of a workspace can be intersected as solids.

    >>> Extended().sqrt([4.0, -4.0])
    array([ 2., -2.])
    """

    def sqrt(self, radicand: ArrayLike, /) -> NDArray[np.float64]:
        """Sign of the radicand times the root of its magnitude."""
        root: NDArray[np.float64] = np.copysign(np.sqrt(np.abs(radicand)), radicand)
        return root


class Intervals:
    """Intervals over arrays; a plain number is exact. The root is that of `Floats`, so that it encloses it.

    >>> root = Intervals().sqrt(3)
    >>> bool(root.contains(3**0.5)), float(root.width) < 1e-15
    (True, True)
    """

    def sqrt(self, radicand: Interval | ArrayLike, /) -> Interval:
        """Root of max(radicand, 0), not defined where part of it is negative."""
        return as_interval(radicand).sqrt()


class Symbols:
    """SymPy expressions. SymPy is imported where it is asked for: it is slow to start.

    >>> Symbols().sqrt(9)
    3
    """

    def sqrt(self, radicand: Any, /) -> Any:
        """SymPy's root."""
        import sympy

        return sympy.sqrt(radicand)
