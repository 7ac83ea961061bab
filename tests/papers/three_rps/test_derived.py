"""The 3-RPS near equal lengths, where poses were lost once: against a search, mpmath and an older elimination."""

import mpmath
import numpy as np
import pytest

import assur
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.configurations import distinct
from assur.kinematics.status import Status

KNOWN = {(380, 380, 400): 16, (263, 263, 263): 8, (380, 395, 395): 16, (380, 380.02, 400): 16, (263, 263.1, 263.3): 8}
RANDOM = np.random.default_rng(6)


@pytest.fixture(scope="module")
def mechanism():
    return assur.load("three_rps")


def count(lengths, base=200, platform=120):
    """How many poses there are: the angle of leg 1 by two resultants of |S_i S_j|^2 = 3 r^2, with 60 digits.

    Not the way of the closed form: one polynomial of degree sixteen for both modes, in the tangent of half of A1.
    """
    with mpmath.workdps(60):
        first, second, third = (mpmath.mpf(float(length)) / base for length in lengths)
        values = [mpmath.expjpi(mpmath.mpf(2 * k) / 32) for k in range(32)]
        side = 3 * mpmath.mpf(platform) ** 2 / base**2
        sampled = [_resultant(first, second, third, side, t) for t in values]
        # the degree is at most 16: the coefficients are those of a discrete Fourier transform
        waves = [[mpmath.expjpi(-mpmath.mpf(2 * k * j) / 32) for k in range(32)] for j in range(32)]
        coefficients = [sum(f * part for f, part in zip(sampled, wave, strict=True)).real / 32 for wave in waves]
        assert max(map(abs, coefficients[17:])) < 1e-40 * max(map(abs, coefficients))
        roots = mpmath.polyroots(coefficients[16::-1], maxsteps=500, extraprec=500)
        return sum(abs(root.imag) < 1e-20 * (1 + abs(root)) for root in roots)


def _bilinear(one, other, side):
    """Entries (j, k) of the condition on two legs, times (1 + t^2) each: factors of t_one^j t_other^k."""
    ends = 3 + one**2 + other**2 - side
    both = -2 * one * other
    return [
        [ends + both, 6 * other, ends - both],
        [6 * one, 4 * one * other, 6 * one],
        [ends - both, 6 * other, ends + both],
    ]


def _resultant(first, second, third, side, t):
    """Resultant by legs 2 and 3 at one t of leg 1, as the determinant of the quadratic and the quartic in leg 3."""
    a, b = (
        [sum(row[k] * t**j for j, row in enumerate(_bilinear(first, item, side))) for k in range(3)]
        for item in (second, third)
    )
    cross = _bilinear(second, third, side)
    # resultant of a (in leg 2) and cross (in leg 2, coefficients in leg 3): a quartic in leg 3
    quartic = [mpmath.mpf(0)] * 5
    for j in range(3):
        for k in range(3):
            quartic[j + k] += (a[2] * cross[0][j] - a[0] * cross[2][j]) * (a[2] * cross[0][k] - a[0] * cross[2][k])
            quartic[j + k] -= (a[2] * cross[1][j] - a[1] * cross[2][j]) * (a[1] * cross[0][k] - a[0] * cross[1][k])
    rows = [[0] * k + quartic[::-1] + [0] * (1 - k) for k in range(2)]
    rows += [[0] * k + b[::-1] + [0] * (3 - k) for k in range(4)]
    return mpmath.det(mpmath.matrix(rows))


@pytest.mark.parametrize(("lengths", "number"), KNOWN.items(), ids=str)
def test_no_pose_is_lost_near_equal_lengths(mechanism, lengths, number):
    found = mechanism.direct(np.array(lengths))
    assert found.complete
    assert len(found) == number
    assert len(distinct(mechanism, found.joints[found.exists])) == number
    assert np.max(found.residuals[found.exists]) < 1e-11 * characteristic_length(mechanism)


@pytest.mark.parametrize("lengths", [(380, 380, 400), (263, 263, 263)], ids=str)
def test_a_search_finds_the_same(mechanism, lengths):
    found = mechanism.direct(np.array(lengths, dtype=float))
    searched = mechanism.direct(np.array(lengths, dtype=float), method="search")
    assert len(searched) == len(found)
    both = np.concatenate([found.joints[found.exists], searched.joints[searched.exists]])
    assert len(distinct(mechanism, both)) == len(found)


@pytest.mark.parametrize("away", [1e-6, 1e-2])
def test_near_the_known_cases_the_older_elimination_counts_as_many(mechanism, away):
    for lengths in [(380, 380, 380), (263, 263, 263), (380, 395, 395)]:
        near = np.array(lengths) + away * RANDOM.uniform(-1, 1, 3)
        found = mechanism.direct(near)
        assert found.complete
        assert len(found) == count(near)


def test_random_lengths(mechanism):
    lengths = RANDOM.uniform(80, 450, (4, 3))
    found = mechanism.direct(lengths)
    assert np.all(found.overall_status != Status.undecided)
    assert np.sum(found.exists, axis=-1).tolist() == [count(row) for row in lengths]


@pytest.mark.parametrize("length", [80.0, 320.0])
def test_a_flat_platform_in_the_plane_of_the_base_is_not_decided(mechanism, length):
    """Four poses and their mirror images meet there."""
    found = mechanism.direct(np.full(3, length))
    assert found.overall_status == Status.undecided
    assert not found.complete


def test_half_the_platform_is_not_decided_by_its_polynomials():
    """With R = r/2 the four points lie on a line in mode +; the loops in turn decide it all the same."""
    mechanism, legs = assur.load("three_rps", R=60.0, r=120.0), np.array([250.0, 260.0, 275.0])
    assert not mechanism.direct(legs, method="closed form").complete
    assert mechanism.direct(legs).complete


def test_everything_agrees(found):
    assert found.origin == "derived"
    assert found.claims_hold
