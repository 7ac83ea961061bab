"""Numbers modulo a polynomial, with roots of such numbers: what vanishes at every root, whatever the signs."""

import pytest
from flint import fmpz_mod_ctx, fmpz_mod_poly_ctx

from assur.verifier.derivations.roots import RootNumber, circle_at_roots, interpolated
from assur.verifier.field import Element, NoRootError
from assur.verifier.reading import RefusedError

P = 10007


def polynomial(*coefficients):
    return fmpz_mod_poly_ctx(fmpz_mod_ctx(P))([*coefficients])


def number(modulus, *coefficients):
    return RootNumber(polynomial(*coefficients) % modulus, modulus)


def test_what_vanishes_at_every_root_is_zero_and_nothing_else():
    modulus = polynomial(-2, 0, 1) * polynomial(3, 1)  # t^2 = 2, or t = -3
    t = number(modulus, 0, 1)
    assert ((t * t - 2) * (t + 3)).zero
    assert not (t * t - 2).zero
    assert not (t + 3).zero


def test_what_vanishes_at_one_root_has_no_inverse():
    modulus = polynomial(-2, 0, 1) * polynomial(3, 1)
    t = number(modulus, 0, 1)
    assert (t / t - 1).zero
    with pytest.raises(RefusedError, match="vanishes at a root"):
        1 / (t + 3)


def test_roots_of_numbers_have_signs_of_their_own():
    modulus = polynomial(5, 1, 0, 1)
    t = number(modulus, 0, 1)
    first = (t + 1).root()
    second = (t + 2).root(first)
    assert (first * first - t - 1).zero
    assert (second * second - t - 2).zero
    assert not (first - second).zero
    assert not (first + second).zero
    both = first + second * 3 + t
    assert (both / both - 1).zero
    assert (Element(P, 7) * both - both * 7).zero
    assert (both - Element(P, 7) - (both - 7)).zero


def test_a_root_of_a_root_is_one():
    t = number(polynomial(5, 1, 0, 1), 0, 1)
    first = (t + 1).root()
    inner = (first + 2).root(first)
    assert (inner * inner - first - 2).zero


def test_cosine_and_sine_at_roots_are_those_of_the_polynomial():
    own = interpolated(lambda cosine, sine: 3 * cosine * cosine + sine - 2, 4, P)
    cosine, sine = circle_at_roots(own)
    assert (cosine * cosine + sine * sine - 1).zero
    assert (3 * cosine * cosine + sine - 2).zero


@pytest.mark.parametrize("degree", [2, 6])
def test_another_degree_is_refused(degree):
    with pytest.raises(RefusedError):
        interpolated(lambda cosine, sine: 3 * cosine * cosine + sine - 2, degree, P)


def test_multiple_roots_are_refused():
    with pytest.raises(RefusedError, match="multiple"):
        interpolated(lambda cosine, sine: (cosine + 2 * sine - 3) * (cosine + 2 * sine - 3), 4, P)


def test_what_is_no_residue_has_no_polynomial():
    with pytest.raises(NoRootError):
        interpolated(lambda cosine, sine: cosine * Element(P, 0, 1) + sine, 2, P)
