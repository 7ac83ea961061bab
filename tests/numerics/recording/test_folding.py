"""Folded numbers: what is known leaves no operation, and the rest means what it says."""

from __future__ import annotations

import itertools
import operator

import numpy as np
import pytest

from assur.numerics.recording.folding import Folded, Folding

PLAIN = (0.0, 1.0, -1.0, 2.5)
OPERATORS = (operator.add, operator.sub, operator.mul, operator.truediv)


@pytest.mark.parametrize("work", OPERATORS)
@pytest.mark.parametrize(("plain", "first"), list(itertools.product(PLAIN, (True, False))))
def test_a_number_and_a_plain_one_on_either_side(work, plain, first):
    plain = plain or (3.0 if work is operator.truediv and first else 0.0)  # x / 0 has no meaning
    folding = Folding()
    x = folding.varying("x")
    value = work(x, plain) if first else work(plain, x)
    found = folding.tape({"y": value}).evaluate([np.array([0.3, -7.0])], list(folding.numbers))["y"]
    given = np.array([0.3, -7.0])
    np.testing.assert_array_equal(found, work(given, plain) if first else work(plain, given))


def test_zeros_and_ones_leave_no_operation():
    folding = Folding()
    x, y = folding.varying("x"), folding.varying("y")
    for nothing in (x * 0.0, 0.0 * x, x - x, 0.0 / x):
        assert isinstance(nothing, float)
        assert nothing == 0.0
    for same in (x * 1.0, 1.0 * x, x + 0.0, 0.0 + x, x - 0.0, x / 1.0):
        assert same.value.index == x.value.index
    assert [item.name for item in folding.tape({"y": x * y}).operations] == ["varying", "varying", "*"]
    assert not len(folding.numbers)


def test_plain_numbers_are_uniform_so_that_others_share_the_program():
    tapes, numbers = [], []
    for size in (2.5, 7.25):
        folding = Folding()
        x = folding.varying("x")
        tapes.append(folding.tape({"y": size * x + size}))
        numbers.append(folding.numbers)
    assert tapes[0].operations == tapes[1].operations
    assert [list(found) for found in numbers] == [[2.5], [7.25]]


def test_arrays_of_numbers_multiply_as_matrices():
    folding = Folding()
    c, s = folding.varying("c"), folding.varying("s")
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]], dtype=object)
    square = turn @ turn
    assert [[isinstance(entry, Folded) for entry in row] for row in square] == [[True] * 2 + [False]] * 2 + [
        [False] * 3
    ]
    angle = np.array([0.4])
    tape = folding.tape({"sine": square[1, 0]})
    found = tape.evaluate([np.cos(angle), np.sin(angle)], list(folding.numbers))
    assert found["sine"] == pytest.approx(np.sin(0.8))


def test_roots_of_plain_numbers_are_plain():
    folding = Folding()
    assert folding.sqrt(2.25) == 1.5
    assert folding.sqrt(-1.0) == 0.0
    assert isinstance(folding.sqrt(folding.varying("x")), Folded)
