"""Polynomials in several unknowns, expanded: a number type that reads a kernel of + - * once and keeps it as arrays.

An `Expanded` maps exponents to coefficients, which may be arrays over a batch of problems. `expand` turns a system of
them into an `ExpandedSystem`: arrays that are evaluated fast at many points and at many values of its last unknown, the
path's parameter t.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.numerics.powers import whole_power

ComplexArray = NDArray[np.complex128]
Exponents = tuple[int, ...]

MOST_PRODUCTS = 100_000
"""Of terms with terms in one product; a power of a sum would grow without end."""


@dataclass(frozen=True, eq=False)
class Expanded:
    """A polynomial: exponents of the unknowns -> coefficient, a number or an array over a batch.

    >>> x, y = unknowns(2)
    >>> ((x + 2 * y) * (x - y)).terms
    {(2, 0): 1, (1, 1): 1, (0, 2): -2}
    """

    terms: Mapping[Exponents, Any]

    # an array on the left must leave the operator to the polynomial on the right
    __array_ufunc__ = None

    def __neg__(self) -> Expanded:
        return self * -1

    def __add__(self, other: Any) -> Expanded:
        total = dict(self.terms)
        for exponents, factor in self._like(other).terms.items():
            total[exponents] = total[exponents] + factor if exponents in total else factor
        return Expanded(total)

    def __sub__(self, other: Any) -> Expanded:
        return self + self._like(other) * -1

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)

    def __mul__(self, other: Any) -> Expanded:
        total: dict[Exponents, Any] = {}
        if not isinstance(other, Expanded):
            return Expanded({exponents: factor * other for exponents, factor in self.terms.items()})
        if len(self.terms) * len(other.terms) > MOST_PRODUCTS:
            raise OverflowError(f"a product of polynomials of {len(self.terms)} and {len(other.terms)} terms")
        for first, a in self.terms.items():
            for second, b in other.terms.items():
                exponents = tuple(i + j for i, j in zip(first, second, strict=True))
                total[exponents] = total[exponents] + a * b if exponents in total else a * b
        return Expanded(total)

    def __radd__(self, other: Any) -> Expanded:
        return self.__add__(other)

    def __rsub__(self, other: Any) -> Expanded:
        return (-self).__add__(other)

    def __rmul__(self, other: Any) -> Expanded:
        return self.__mul__(other)

    def _like(self, other: Any) -> Expanded:
        """A number as a constant polynomial of the same unknowns; a plain zero has no term."""
        if isinstance(other, Expanded):
            return other
        if type(other) is int and other == 0:
            return Expanded({})
        return Expanded({(0,) * len(next(iter(self.terms))): other} if self.terms else {})


def unknowns(count: int) -> tuple[Expanded, ...]:
    """The unknowns of a system, each as a polynomial."""
    return tuple(Expanded({tuple(int(k == j) for j in range(count)): 1}) for k in range(count))


def coefficients_of(polynomial: Expanded, count: int) -> tuple[Any, ...]:
    """The first coefficients of a polynomial in one unknown, the constant term first; a plain 0 where there is none.

    >>> (t,) = unknowns(1)
    >>> coefficients_of((t + 1) * (t - 2), 4)
    (-2, -1, 1, 0)
    """
    return tuple(polynomial.terms.get((power,), 0) for power in range(count))


@dataclass(frozen=True, eq=False)
class ExpandedSystem:
    """A family of homogeneous systems H(x, t) = 0 of E equations in n = E + 1 unknowns, for P problems.

    Attributes:
        coefficients: (P, T, E, M) by problem, power of t, equation and monomial.
        factors: (M, d) indices of the unknowns whose product is a monomial; n stands for the constant 1.
        size: n.
    """

    coefficients: ComplexArray
    factors: NDArray[np.intp]
    size: int

    def evaluate(
        self, x: ComplexArray, t: NDArray[np.inexact], problem: NDArray[np.intp]
    ) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
        """H (N, E), its derivatives by x (N, E, n) and by t (N, E), at points (N, n) of problems (N,)."""
        powers = self.coefficients.shape[1]
        parts = self._parts(x, problem)
        values, rate = parts[:, -1], np.zeros_like(parts[:, -1])
        for k in range(powers - 2, -1, -1):  # Horner's rule, and for the derivative
            rate = rate * t[:, None, None] + values
            values = values * t[:, None, None] + parts[:, k]
        return values[..., -1], values[..., :-1], rate[..., -1]

    def _parts(self, x: ComplexArray, problem: NDArray[np.intp]) -> ComplexArray:
        """Derivatives by the unknowns and, last, values (N, T, E, n + 1) of what each power of t is multiplied by."""
        problems, powers, equations, monomials = self.coefficients.shape
        if self._forms is not None:
            slopes = (x @ self._forms).reshape(len(x), powers, equations, self.size)
            values = 0.5 * (slopes @ x[:, None, :, None])  # Euler's theorem
            return np.concatenate([slopes, values], axis=-1)
        flat = self.coefficients.reshape(problems, powers * equations, monomials)
        coefficients = flat[0] if problems == 1 else flat[problem]
        return (coefficients @ self._monomials(x)).reshape(len(x), powers, equations, self.size + 1)

    @cached_property
    def _forms(self) -> ComplexArray | None:
        """Of one problem of quadrics, twice their matrices (n, T E n): a tenth of the arithmetic of monomials."""
        problems, powers, equations, monomials = self.coefficients.shape
        if problems != 1 or self.factors.shape[1] != 2 or np.any(self.factors == self.size):
            return None
        first, second = self.factors.T
        forms = np.zeros((self.size, powers * equations, self.size), dtype=complex)
        flat = self.coefficients[0].reshape(-1, monomials)
        forms[first, :, second] = flat.T
        return np.ascontiguousarray((forms + np.swapaxes(forms, 0, 2)).reshape(self.size, -1))

    def _monomials(self, x: ComplexArray) -> ComplexArray:
        """Derivatives of all monomials by the unknowns, and last the monomials (N, M, n + 1), at points (N, n)."""
        count, degree = self.factors.shape
        parts = np.concatenate([x, np.ones((len(x), 1))], axis=1)[:, self.factors]  # (N, M, d)
        answer = np.zeros((len(x), count, self.size + 1), dtype=complex)
        for k in range(degree):
            others = parts[:, :, [j for j in range(degree) if j != k]]
            answer[:, np.arange(count), self.factors[:, k]] += np.prod(others, axis=2)
        answer[:, :, -1] = np.prod(parts, axis=2)  # what was added for the constant 1 is not wanted
        return answer


def expand(equations: Sequence[Expanded]) -> ExpandedSystem:
    """The arrays of homogeneous equations in n unknowns and, last, the parameter t.

    Errors:
        UsageError: an equation is not homogeneous in the unknowns, or there are not n - 1 of them.

    Example: x^2 = (1 + t) y^2 at (1, 1) and t = 0.

    >>> x, y, t = unknowns(3)
    >>> system = expand([x * x - (1 + t) * y * y])
    >>> value, slope, rate = system.evaluate(np.array([[1.0 + 0j, 1.0]]), np.zeros(1), np.zeros(1, dtype=int))
    >>> value.real.tolist(), slope.real.tolist(), rate.real.tolist()
    ([[0.0]], [[[2.0, -2.0]]], [[-1.0]])
    """
    size = len(next(iter(equations[0].terms))) - 1
    kept = [{power: factor for power, factor in equation.terms.items() if np.any(factor)} for equation in equations]
    degrees = [{sum(exponents[:-1]) for exponents in terms} for terms in kept]
    if len(equations) != size - 1 or any(len(sums) != 1 for sums in degrees):
        raise UsageError(
            f"{len(equations)} equations of degrees {[sorted(sums) for sums in degrees]} in {size} unknowns",
            hint="homogeneous equations are wanted, one fewer than the unknowns",
        )
    powers = 1 + max(exponents[-1] for terms in kept for exponents in terms)
    monomials = sorted({exponents[:-1] for terms in kept for exponents in terms})
    problems = np.broadcast_shapes(*(np.shape(factor) for terms in kept for factor in terms.values()))
    coefficients = np.zeros((*(problems or (1,)), powers, len(equations), len(monomials)), dtype=complex)
    for row, terms in enumerate(kept):
        for exponents, factor in terms.items():
            coefficients[:, exponents[-1], row, monomials.index(exponents[:-1])] = factor
    degree = max(max(sums) for sums in degrees)
    factors = [[k for k in range(size) for _ in range(monomial[k])] for monomial in monomials]
    padded = [unknowns + [size] * (degree - len(unknowns)) for unknowns in factors]
    return ExpandedSystem(coefficients, np.array(padded, dtype=np.intp), size)
