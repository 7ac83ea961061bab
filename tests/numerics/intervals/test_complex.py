import operator

import numpy as np
import pytest

from assur.numerics.dual import Dual
from assur.numerics.intervals.complex import Complex
from assur.numerics.intervals.interval import Interval


def number(value):
    return Complex(Interval.of(value.real), Interval.of(value.imag))


@pytest.mark.parametrize("operation", [operator.add, operator.sub, operator.mul])
def test_operations_hold_those_of_complex_numbers(operation):
    rng = np.random.default_rng(1)
    a, b = rng.normal(size=(2, 500)) + 1j * rng.normal(size=(2, 500))
    for left, right, exact in (
        (number(a), number(b), operation(a, b)),
        (number(a), 2.5, operation(a, 2.5)),
        (2.5, number(b), operation(2.5, b)),
        (Interval.of(a.real), number(b), operation(a.real, b)),
        (a.real, number(b), operation(a.real, b)),
    ):
        found = operation(left, right)
        assert found.real.contains(exact.real).all()
        assert found.imaginary.contains(exact.imag).all()


def test_derivatives_are_carried_through():
    """d(z^2) = 2 z dz."""
    one, zero = Interval.of(1.0), Interval.of(0.0)
    z = Complex(Dual(Interval.of(2.0), one), Dual(Interval.of(3.0), zero))
    found = z * z - 1 + -z
    assert found.real.derivative.contains(3.0)
    assert found.imaginary.derivative.contains(6.0)
    assert (+found) is found
