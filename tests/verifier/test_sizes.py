"""Degrees and heights of the verifier beside those of the other program, on the same formulas."""

import itertools
from fractions import Fraction

import pytest

from assur.numerics.degrees import Degrees
from assur.verifier.sizes import Size


def bump(x, y, z, _root):
    return 5 / (1 + (x - 10) * (x - 10) * 10**20) + y * z


def elbow(x, y, z, root):
    square = x * x + y * y
    along = (square + z * z - 4) / 2
    return (along * x + root(square * z * z - along * along) * y) / square - Fraction(1, 3) * x


def roots_of_roots(x, y, z, root):
    inner = root(x * x + y)
    return (root(3 * inner + z) - inner) / (2 * z) + 1


@pytest.mark.parametrize("formula", [bump, elbow, roots_of_roots])
def test_both_programs_say_the_same(formula):
    other = Degrees([(object(), Fraction(1)) for _ in range(4)])
    theirs = formula(*(other.uniform() for _ in range(3)), other.sqrt)
    names = itertools.count()
    own = formula(Size(1), Size(1), Size(1), lambda radicand: radicand.root(next(names), 0))
    assert own.whole == pytest.approx((theirs.bound, theirs.bits))


def test_a_root_of_a_square_has_a_larger_height():
    square = Size(2, 3)
    assert square.root(None, 5).height == square.root(0, 5).height + 5
    assert not square.root(None, 5).roots
