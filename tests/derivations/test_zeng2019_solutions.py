"""Zeng et al. (2019), Table 1 and E2-E4: every real direct solution, by exact elimination without any kernel.

The five length conditions in x, y, z, w and v are brought to one polynomial in z with rational coefficients
(Groebner basis); its real roots are isolated exactly. Nothing is divided away, nothing can be missed.
"""

from dataclasses import dataclass
from itertools import product
from types import SimpleNamespace

import pytest
import sympy as sp

from assur.numerics.number_types import Symbols

X, Y, Z, W, V = sp.symbols("x y z w v")
TABLE_1_INPUTS = ("162.6907", "-143.3209", "-24.6776")
TABLE_1 = {
    1: ("64.6353", "175.6965", "370.1818"),
    2: ("-128.8290", "175.6965", "119.7372"),
    3: ("-15.4714", "9.6849", "456.3315"),
    4: ("-128.8290", "9.6849", "118.2099"),
}


@dataclass(frozen=True)
class Elimination:
    """Degree of the polynomial in z and the real solutions (x, y, z, w, v) in 30 digits."""

    degree: int
    real: list[dict]


def eliminate(inputs, offset=0, sizes=None):
    """All solutions at rational inputs; offset = l7 + l8."""
    s = sizes
    d = s.b - s.d
    y_a1, y_a2, y_a3 = (sp.Rational(q) for q in inputs)
    conditions = [
        (Y + s.l3 / 2 - y_a1) ** 2 + W**2 - s.l2**2,  # B1C1
        (Y - s.l3 / 2 - y_a2) ** 2 + W**2 - s.l2**2,  # B2C2
        (Y - y_a3) ** 2 + V**2 - s.l6**2,  # B3C3
        (X + d) ** 2 + (Z - s.l1 - W) ** 2 - s.l4**2,  # D1D2
        (X - d) ** 2 + (Z - s.l1 - V - offset) ** 2 - s.l6**2,  # D3E3
    ]
    basis = sp.groebner([sp.expand(c) for c in conditions], W, V, Y, X, Z, order="grevlex")
    if basis.exprs == [1]:
        return Elimination(0, [])
    *linear, last = basis.fglm("lex").exprs
    eliminant = sp.Poly(last, Z)
    assert eliminant.is_sqf  # no two solutions share z, so the others are polynomials of z
    rest = {letter: next(e for e in linear if sp.degree(e, letter) == 1) for letter in (X, Y, W, V)}
    real = []
    for root in eliminant.real_roots():
        z = root.evalf(30)
        solution = {Z: z}
        for letter, expression in rest.items():
            assert expression.free_symbols <= {letter, Z}
            one, zero = sp.Poly(expression, letter).all_coeffs()
            solution[letter] = -sp.sympify(zero).evalf(30, {Z: z}) / sp.sympify(one).evalf(30, {Z: z})
        real.append(solution)
    assert len(real) == eliminant.count_roots()  # Sturm
    return Elimination(eliminant.degree(), real)


@pytest.fixture(scope="module")
def at_table_1(model):
    return eliminate(TABLE_1_INPUTS, sizes=model.sizes)


def near(solution, row):
    return all(
        abs(solution[letter] - sp.Rational(text)) <= sp.Rational(2, 10000)
        for letter, text in zip((X, Y, Z), row, strict=True)
    )


def test_e4_table_1_inputs_have_four_real_solutions_of_eight(at_table_1):
    assert (at_table_1.degree, len(at_table_1.real)) == (8, 4)
    wanted = [
        ("-15.4714", "9.6849", "456.3315"),
        ("-83.0873", "9.6849", "118.2099"),
        ("-83.0873", "9.6849", "-58.2099"),
        ("-15.4714", "9.6849", "-396.3315"),
    ]
    for row in wanted:
        assert sum(near(solution, row) for solution in at_table_1.real) == 1


def test_e2_e3_only_row_3_of_table_1_is_a_solution(at_table_1):
    right = {number for number, row in TABLE_1.items() if any(near(s, row) for s in at_table_1.real)}
    assert right == {3}


def test_e3_row_4_has_y_and_z_of_a_solution_and_x_of_row_2(at_table_1):
    x, y, z = TABLE_1[4]
    (solution,) = [s for s in at_table_1.real if near(s | {X: sp.Rational(x)}, (x, y, z))]
    assert abs(solution[X] - sp.Rational("-83.0873")) < sp.Rational(1, 10000)
    assert x == TABLE_1[2][0]


def test_e2_rows_1_and_2_come_from_the_false_root(model):
    """With cos(gamma) = +B/A the same elimination gives them: y moves by B, C2 is put where u2 = 3 B/2."""
    y_a1, y_a2, _ = (sp.Rational(q) for q in TABLE_1_INPUTS)
    b = y_a1 - model.sizes.l3 - y_a2
    false_y = y_a1 + b / 2 - model.sizes.l3 / 2
    for number in (1, 2):
        x, y, z = (sp.Rational(text) for text in TABLE_1[number])
        assert abs(y - false_y) <= sp.Rational(1, 10000)
        # Height of C1 by link 12, both ways: |B1C1| holds to the printed digits, |B2C2| is 365.40.
        s = model.sizes
        heights = [z - s.l1 - sign * sp.sqrt(s.l4**2 - (x + s.b - s.d) ** 2) for sign in (1, -1)]
        lengths = [
            (sp.sqrt((y + s.l3 / 2 - y_a1) ** 2 + w**2), sp.sqrt((y - s.l3 / 2 - y_a2) ** 2 + w**2)) for w in heights
        ]
        (broken,) = [second for first, second in lengths if abs(first - s.l2) < sp.Rational(1, 1000)]
        assert abs(broken - sp.Rational("365.40")) < sp.Rational(1, 100)


# Inputs from Pythagorean triples with l2 = 280 and l6 = 230: (yA1, yA2, yA3), l7 + l8, number of real solutions.
COUNTS = [
    (("294", "-294", "-184"), 0, 8),  # w = 168, v = 138
    (("238", "-238", "-138"), 0, 4),  # w = 224, v = 184
    (("400", "-400", "0"), 0, 0),  # B > 2 l2
    (("238", "-238", "-400"), 0, 0),  # |u3| > l6
    (("294", "-294", "-184"), 40, 8),
    (("238", "-238", "-138"), 60, 6),
    (("238", "-238", "-138"), 30, 4),
    (("238", "-238", "-184"), 500, 2),
    (("238", "-238", "-184"), 900, 0),
]


def kernel_solutions(model, inputs, offset):
    """Real poses of the direct kernel over exact numbers."""
    p = SimpleNamespace(**{**vars(model.sizes), "l7": sp.Integer(offset), "l8": sp.Integer(0)})
    poses = []
    for signs in product((1, -1), repeat=3):
        mode = SimpleNamespace(**dict(zip(("e1", "e2", "e3"), signs, strict=True)))
        branch = model.kernels.direct(Symbols(), p, [sp.Rational(q) for q in inputs], mode)
        radicands = [branch.margins[name] for name in ("w2", "v2")]
        if all(r >= 0 for r in radicands) and branch.margins["meeting"] >= 0:
            poses.append([sp.sympify(value).evalf(20) for value in branch.pose])
    return poses


@pytest.mark.parametrize(("inputs", "offset", "count"), [*COUNTS, (TABLE_1_INPUTS, 0, 4)])
def test_e4_number_of_real_solutions_and_the_kernel_has_each_of_them_once(model, inputs, offset, count):
    exact = eliminate(inputs, offset, model.sizes)
    assert exact.degree == 8  # complex solutions: 8 is the most there can be
    assert len(exact.real) == count
    poses = kernel_solutions(model, inputs, offset)
    assert len(poses) == count
    for solution in exact.real:
        wanted = [solution[letter] for letter in (X, Y, Z)]
        assert sum(all(abs(a - b) < 1e-15 for a, b in zip(pose, wanted, strict=True)) for pose in poses) == 1


def test_e4_without_l7_and_l8_the_count_is_a_multiple_of_four(model):
    """The mirror image in the plane z = l1 turns (e1, e2) round and keeps the meeting margin."""
    roots = model.Roots()
    p = SimpleNamespace(**{**vars(model.p), "l7": 0, "l8": 0})
    e1, e2 = sp.symbols("e1 e2")
    one, other = (
        model.kernels.direct(roots, p, model.inputs, SimpleNamespace(e1=k * e1, e2=k * e2, e3=1)).margins["meeting"]
        for k in (1, -1)
    )
    # The two calls take the same roots under different names.
    renamed = dict(zip([r for r, _ in roots.radicands[3:]], [r for r, _ in roots.radicands[:3]], strict=True))
    assert sp.expand(one - other.subs(renamed)) == 0
    p = SimpleNamespace(**{**vars(model.p), "l8": 0})
    tilted = [
        model.kernels.direct(model.Roots(), p, model.inputs, SimpleNamespace(e1=k * e1, e2=k * e2, e3=1)).margins
        for k in (1, -1)
    ]
    assert sp.expand(tilted[0]["meeting"] - tilted[1]["meeting"]) != 0


def test_elimination_finds_the_printed_root_wrong_if_the_lengths_say_so(model, at_table_1):
    """The comparison can fail: another l2 gives other poses."""
    other = SimpleNamespace(**{**vars(model.sizes), "l2": sp.Integer(281)})
    moved = eliminate(TABLE_1_INPUTS, sizes=other)
    assert not any(near(solution, TABLE_1[3]) for solution in moved.real)
    assert any(near(solution, TABLE_1[3]) for solution in at_table_1.real)
