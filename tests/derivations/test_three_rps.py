"""docs/derivations/three_rps.md: the six quadrics follow from the closure, and their roots are poses, nothing else."""

import re
from pathlib import Path
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
import sympy as sp

import assur
from assur.model.kernels.reading import names_of

DOCUMENT = Path(__file__).parents[2] / "docs" / "derivations" / "three_rps.md"
ROOT3 = sp.sqrt(3)
OMEGA = (sp.Integer(1), -sp.Rational(1, 2) - sp.I * ROOT3 / 2, -sp.Rational(1, 2) + sp.I * ROOT3 / 2)
BACK = tuple(sp.conjugate(item) for item in OMEGA)
K, Z, S1, S2, S3 = sp.symbols("k z s1 s2 s3", real=True)
R = (K + 1) / 2
SQUARES = (S1, S2, S3)
MEAN = (S1 + S2 + S3) / 3
D, D_BAR = (
    sp.Rational(2, 3) * sum((s - MEAN) * o for s, o in zip(SQUARES, part, strict=True)) for part in (OMEGA, BACK)
)
OTHERS = ((0, 1, 2), (1, 2, 0), (2, 0, 1))


def zero(expression):
    return sp.expand(sp.expand_complex(sp.expand(expression))) == 0


def real(number, conjugate):
    """Real part of a number whose conjugate is given."""
    return (number + conjugate) / 2


def tilted(u, u_bar, v):
    """P_i."""
    return tuple(v / 2 + real(o * u, o_bar * u_bar) for o, o_bar in zip(OMEGA, BACK, strict=True))


def quadrics(u, u_bar, v, d, d_bar, k=K):
    """X1 of Eq. (1), X2 and X3 of Eq. (2): left sides less right sides."""
    square = d * d_bar
    a, b = 4 * MEAN - 3 + 12 * R - square / (2 * k**2), 8 * (MEAN - (1 - R) ** 2)
    e, e_bar = d - d_bar**2 / (4 * k**2), d_bar - d**2 / (4 * k**2)
    x1 = u**2 - v * u_bar - (d_bar * u - d * v) / k
    x2 = a * v**2 - e * u * v - e_bar * u_bar * v - k * (d * u + d_bar * u_bar) + square - b * v
    x3 = (
        a * u * v
        - e * u_bar * v
        - e_bar * v**2
        - e * (d_bar * u - d * v) / k
        - k * (d * u_bar + d_bar * v)
        + d**2
        - b * u
    )
    return x1, x2, x3


@pytest.fixture(scope="module")
def kernels():
    """The kernels and what they are made of, without the underscores."""
    path = assur.load("three_rps").folder / "closed_form.py"
    names = names_of(path.read_text(encoding="utf-8"), path)
    wanted = ("coefficients", "AWRY", "_times_t", "_less", "_products_of_heights")
    return SimpleNamespace(**{name.strip("_").lower(): names[name] for name in wanted})


def test_every_witness_of_the_derivation_is_a_test():
    groups = re.findall(r"\[((?:`\w+`,?\s*)+)\]", DOCUMENT.read_text(encoding="utf-8"))
    named = {name for group in groups for name in re.findall(r"`(\w+)`", group)}
    tests = {name.removeprefix("test_") for name in globals() if name.startswith("test_")}
    assert len(named) == 8
    assert sorted(named - tests) == []


def corners(side):
    """Corners (e_i, h_i) of mode +, sqrt(n) being a symbol, with w = alpha + i beta."""
    alpha, beta, root = sp.symbols("alpha beta root", real=True)
    w = alpha + sp.I * beta
    p = tilted(sp.expand(w**2), sp.expand(sp.conjugate(w) ** 2), alpha**2 + beta**2)
    out = tuple(sp.expand(sp.expand_complex(side * (1 - part))) for part in p)
    up = tuple(sp.expand(sp.re(sp.expand(Z - root * o_bar * w))) for o_bar in BACK)
    return SimpleNamespace(alpha=alpha, beta=beta, root=root, p=p, out=out, up=up, v=alpha**2 + beta**2)


def vanishes_on_circle(at, expression):
    """Whether it is zero where n = 2 - v is the square of its root."""
    return sp.rem(sp.expand(expression), at.root**2 - 2 + at.v, at.root) == 0


@pytest.mark.parametrize("side", [1, -1])
def test_the_tilt_is_one_complex_number(side):
    at = corners(side)
    wanted = (
        (3 * at.alpha**2 - at.beta**2) / 2,
        at.beta**2 + ROOT3 * at.alpha * at.beta,
        at.beta**2 - ROOT3 * at.alpha * at.beta,
    )
    assert all(zero(found - part) for found, part in zip(at.p, wanted, strict=True))
    assert zero(wanted[0] * wanted[1] + wanted[1] * wanted[2] + wanted[2] * wanted[0])
    limbs = [(1, 0), (-sp.Rational(1, 2), ROOT3 / 2), (-sp.Rational(1, 2), -ROOT3 / 2)]
    points = [sp.Matrix([e * x, e * y, h]) for e, h, (x, y) in zip(at.out, at.up, limbs, strict=True)]
    for i, j, _ in OTHERS:
        gap = points[i] - points[j]
        assert vanishes_on_circle(at, gap.dot(gap) - 3)
    normal = (points[1] - points[0]).cross(points[2] - points[0]) * 2 / (3 * ROOT3)
    assert vanishes_on_circle(at, normal[2] - (at.root**2 - 1))  # R33 = n - 1


@pytest.mark.parametrize("side", [1, -1])
def test_the_three_legs_are_one_real_and_one_complex_equation(side):
    at = corners(side)
    w = at.alpha + sp.I * at.beta
    u, u_bar = sp.expand(w**2), sp.expand(sp.conjugate(w) ** 2)
    level = Z**2 - (MEAN - (1 - R) ** 2 - R * at.v - at.v**2 / 4)
    turning = K * u_bar + at.v * u_bar / 2 + u**2 / 2 - D - 2 * Z * at.root * w
    for out, up, square, o_bar in zip(at.out, at.up, SQUARES, BACK, strict=True):
        leg = (out - side * R) ** 2 + up**2 - square
        assert vanishes_on_circle(at, sp.expand_complex(leg - level - sp.re(sp.expand(o_bar * turning))))


def complex_symbols():
    """The tilt w and D with their conjugates as four free symbols, and R and m."""
    return sp.symbols("w W d d_bar")


def curve(w, w_bar, d, d_bar):
    return K * w_bar**3 - d * w_bar - K * w**3 + d_bar * w


def test_the_first_quadric_follows():
    w, w_bar, d, d_bar = complex_symbols()
    u, u_bar, v, s = w**2, w_bar**2, w * w_bar, sp.Symbol("S")
    turning = K * u_bar + v * u_bar / 2 + u**2 / 2 - d - 2 * s * w
    conjugate = K * u + v * u / 2 + u_bar**2 / 2 - d_bar - 2 * s * w_bar
    assert sp.expand(w_bar * turning - w * conjugate - curve(w, w_bar, d, d_bar)) == 0
    x1, x2, _ = quadrics(u, u_bar, v, d, d_bar)
    assert sp.expand(w * curve(w, w_bar, d, d_bar) + K * x1) == 0
    along = (K + v) * (w**3 + w_bar**3) / 2 - (d * w_bar + d_bar * w) / 2
    assert sp.expand(w_bar * turning + 2 * s * v - along - curve(w, w_bar, d, d_bar) / 2) == 0
    left = along**2 - 4 * v**2 * (2 - v) * (MEAN - (1 - R) ** 2 - R * v - v**2 / 4)
    assert sp.simplify(sp.rem(sp.expand(left - v * x2), curve(w, w_bar, d, d_bar), w)) == 0


def test_the_second_is_the_first_times_u_over_v():
    w, w_bar, d, d_bar = complex_symbols()
    _, x2, x3 = quadrics(w**2, w_bar**2, w * w_bar, d, d_bar)
    assert sp.simplify(sp.rem(sp.expand(w * x2 - w_bar * x3), curve(w, w_bar, d, d_bar), w)) == 0


def test_the_six_quadrics_in_real_unknowns():
    p = sp.symbols("P1 P2 P3", real=True)
    third = sp.Rational(2, 3)
    u, u_bar = (third * sum(part * o for part, o in zip(p, turn, strict=True)) for turn in (BACK, OMEGA))
    v = third * sum(p)
    x1, x2, x3 = quadrics(u, u_bar, v, D, D_BAR)
    x1_bar, _, x3_bar = quadrics(u_bar, u, v, D_BAR, D)
    cone = sp.expand(u * u_bar - v**2)
    e, e_bar = D - D_BAR**2 / (4 * K**2), D_BAR - D**2 / (4 * K**2)
    even = [real(o_bar * e, o * e_bar) for o, o_bar in zip(OMEGA, BACK, strict=True)]
    a, b = 4 * MEAN - 3 + 12 * R - D * D_BAR / (2 * K**2), 8 * (MEAN - (1 - R) ** 2)
    others = [((SQUARES[m] - SQUARES[i]) * p[j] + (SQUARES[j] - SQUARES[i]) * p[m]) / (3 * K) for i, j, m in OTHERS]
    for i, j, m in OTHERS:
        split = real(BACK[i] * x1, OMEGA[i] * x1_bar)
        assert zero(p[j] * p[m] - others[i] - split / 2 + cone / 4)
        f = a - 2 * even[i]
        rest = sp.Rational(3, 2) * (b + 2 * K * (SQUARES[i] - MEAN)) * p[i] + a * others[i]
        rest += 2 * (even[j] * others[m] + even[m] * others[j])
        rest -= (SQUARES[j] - SQUARES[i]) * (SQUARES[m] - SQUARES[i])
        whole = f * (split + cone) / 2 + sp.Rational(3, 4) * (x2 + 2 * real(OMEGA[i] * x3, BACK[i] * x3_bar))
        assert zero(f * p[i] ** 2 - rest - whole)


def test_the_products_of_the_heights():
    ei, ej, hi, hj, ratio = sp.symbols("e_i e_j h_i h_j R")
    si, sj = ((e - ratio) ** 2 + h**2 for e, h in ((ei, hi), (ej, hj)))
    side = ei**2 + ej**2 + ei * ej + (hi - hj) ** 2  # |S_i S_j|^2, which is 3
    assert sp.expand((si + sj + ei * ej - side) / 2 + ratio * (ei + ej) - ratio**2 - hi * hj) == 0


class Digits:
    """Numbers of mpmath, real or complex."""

    def sqrt(self, radicand):
        return mpmath.sqrt(radicand)


def polynomial(kernels, base, platform, lengths, side):
    sizes = SimpleNamespace(R=mpmath.mpf(base), r=mpmath.mpf(platform))
    return kernels.coefficients(Digits(), sizes, lengths, SimpleNamespace(o=side))


@pytest.mark.parametrize("side", [1, -1])
def test_the_quartic_vanishes_at_a_pose_and_has_no_other_factor(kernels, side):
    """All four roots are triples P whose heights have products of rank one: poses, real or complex."""
    with mpmath.workdps(50):
        alpha, beta, z, base, platform = mpmath.mpf("0.31"), mpmath.mpf("-0.42"), mpmath.mpf("2.3"), 200, 120
        at = corners(side)
        put = {at.alpha: alpha, at.beta: beta, at.root: mpmath.sqrt(2 - alpha**2 - beta**2), Z: z}
        numbers = [sp.lambdify(list(put), part, "mpmath")(*put.values()) for part in (*at.out, *at.up, *at.p)]
        out, up, p = (numbers[first : first + 3] for first in (0, 3, 6))
        ratio = mpmath.mpf(base) / platform
        lengths = [platform * mpmath.sqrt((e - ratio) ** 2 + h**2) for e, h in zip(out, up, strict=True)]
        quartic = polynomial(kernels, base, platform, lengths, side)
        t = sum(share * mpmath.re(part) for share, part in zip(kernels.awry, p, strict=True))
        size = sum(abs(part * t**power) for power, part in enumerate(quartic))
        assert len(quartic) == 5
        assert abs(mpmath.polyval(quartic[::-1], t)) < 1e-40 * size
        roots = mpmath.polyroots(quartic[::-1], maxsteps=200, extraprec=200)
        assert min(abs(a - b) for k, a in enumerate(roots) for b in roots[:k]) > 1e-3
        sizes = SimpleNamespace(R=mpmath.mpf(base), r=mpmath.mpf(platform))
        constant, linear, factors = kernels.times_t(sizes, lengths, SimpleNamespace(o=side))
        for root in roots:
            rows = mpmath.matrix([list(kernels.awry), *(list(row) for row in kernels.less(linear, factors, root))])
            right = mpmath.matrix([root, *(-part for part in constant)])
            values = mpmath.lu_solve(rows[1:4, :], right[1:4])
            assert abs((rows * values - right)[0]) < 1e-30
            assert abs(values[0] * values[1] + values[1] * values[2] + values[2] * values[0]) < 1e-30
            out = [side * platform * (1 - values[k]) for k in range(3)]
            heights = mpmath.matrix(kernels.products_of_heights(sizes, lengths, out))
            for i, j, m in OTHERS:
                assert abs(heights[i, i] * heights[j, j] - heights[i, j] ** 2) < 1e-22
                assert abs(heights[i, j] * heights[i, m] - heights[i, i] * heights[j, m]) < 1e-22


@pytest.mark.parametrize("length", [263, 300, 380])
def test_equal_legs_have_four_simple_roots(kernels, length):
    with mpmath.workdps(40):
        for side in (1, -1):
            quartic = polynomial(kernels, 200, 120, [mpmath.mpf(length)] * 3, side)
            ratio, mean = side * mpmath.mpf(200) / 120, (mpmath.mpf(length) / 120) ** 2
            far = 3 * 8 * (mean - (1 - ratio) ** 2) / (2 * (4 * mean - 3 + 12 * ratio))
            wanted = [mpmath.mpf(0), *(share * far for share in kernels.awry)]
            scale = max(abs(part) for part in quartic)
            assert max(abs(mpmath.polyval(quartic[::-1], root)) for root in wanted) < 1e-30 * scale
            assert np.min(np.diff(np.sort(np.array(wanted, dtype=float)))) > 0.05
