"""Zeng et al. (2019), Eqs. (22)-(26): rows by differentiation, determinants, complete list, cases (i) and (ii)."""

from types import SimpleNamespace

import pytest
import sympy as sp

from assur.numerics.number_types import Symbols

CORE = ("x", "y", "z", "u1", "u2", "u3", "w", "v")


@pytest.fixture(scope="module")
def any_core(model):
    """A configuration with every quantity free: the kernels of the Jacobians know no more."""
    alpha, beta = model.angles["alpha"], model.angles["beta"]
    return SimpleNamespace(
        **{name: sp.Symbol(name, real=True) for name in CORE},
        cos_alpha=sp.cos(alpha),
        sin_alpha=sp.sin(alpha),
        cos_beta=sp.cos(beta),
        sin_beta=sp.sin(beta),
        sin_beta_minus_alpha=sp.sin(beta - alpha),
    )


@pytest.fixture(scope="module")
def printed(model, any_core):
    return tuple(map(sp.Matrix, model.kernels.as_printed(Symbols(), model.p, any_core)))


@pytest.fixture(scope="module")
def regular(model, any_core):
    return tuple(map(sp.Matrix, model.kernels.jacobians(Symbols(), model.p, any_core)))


def is_zero(expression):
    return sp.simplify(sp.expand_trig(sp.expand(expression))) == 0


def cot_difference(core):
    return core.cos_alpha / core.sin_alpha - core.cos_beta / core.sin_beta


def test_eqs_22_to_25_are_eq20_differentiated(model, any_core, printed):
    """Eq. (20) with alpha(x) and beta(x) given implicitly by Eqs. (18) and (19); half the derivative is Eq. (24)."""
    p, (x, y, z) = model.p, model.pose
    q1, q2, q3 = model.inputs
    alpha, beta = (sp.Function(name)(x) for name in ("alpha", "beta"))
    rows = [
        (y + p.l3 / 2 - q1) ** 2 + (z - p.l4 * sp.sin(alpha) - p.l1) ** 2,
        (y - p.l3 / 2 - q2) ** 2 + (z - p.l4 * sp.sin(alpha) - p.l1) ** 2,
        (y - q3) ** 2 + (z - p.l8 - p.l6 * sp.sin(beta) - p.l7 - p.l1) ** 2,
    ]
    rates = {}
    for angle, equation in ((alpha, x + p.b - p.d - p.l4 * sp.cos(alpha)), (beta, x + p.d - p.b - p.l6 * sp.cos(beta))):
        rate = sp.Symbol("rate")
        rates[angle.diff(x)] = sp.solve(equation.diff(x).subs(angle.diff(x), rate), rate)[0]
    assert rates[alpha.diff(x)] == -1 / (p.l4 * sp.sin(alpha))  # Eq. (22)
    assert rates[beta.diff(x)] == -1 / (p.l6 * sp.sin(beta))  # Eq. (23)
    named = {
        any_core.u1: y + p.l3 / 2 - q1,
        any_core.u2: y - p.l3 / 2 - q2,
        any_core.u3: y - q3,
        any_core.w: z - p.l4 * sp.sin(alpha) - p.l1,
        any_core.v: z - p.l8 - p.l6 * sp.sin(beta) - p.l7 - p.l1,
        model.angles["alpha"]: alpha,
        model.angles["beta"]: beta,
    }
    jp, jq = printed
    for i, row in enumerate(rows):
        for k, coordinate in enumerate((x, y, z)):
            assert is_zero(row.diff(coordinate).subs(rates) / 2 - jp[i, k].subs(named)), (i, k)
        for k, q in enumerate((q1, q2, q3)):
            assert is_zero(row.diff(q) / 2 + jq[i, k].subs(named)), (i, k)  # Jq stands on the other side


def test_e9_regular_rows_are_combinations_of_the_printed_rows(any_core, printed, regular):
    combine = sp.Matrix([[1, -1, 0], [any_core.sin_alpha, 0, 0], [0, 0, any_core.sin_beta]])
    for rows, combined in zip(printed, regular, strict=True):
        assert (combine * rows - combined).applyfunc(sp.simplify).is_zero_matrix
    assert sp.expand(combine.det() - any_core.sin_alpha * any_core.sin_beta) == 0  # sign +


def test_e7_determinant_of_the_printed_form(any_core, printed):
    c = any_core
    assert is_zero(printed[0].det() + (c.u1 - c.u2) * c.w * c.v * cot_difference(c))
    assert printed[1].det() == c.u1 * c.u2 * c.u3


def test_e9_determinants_of_the_regular_form(model, any_core, regular):
    c = any_core
    sine = sp.sin(model.angles["alpha"] - model.angles["beta"])
    assert is_zero(regular[0].det() - (c.u1 - c.u2) * c.w * c.v * sine)
    assert is_zero(regular[1].det() - c.u1 * c.u2 * c.u3 * c.sin_alpha * c.sin_beta)


def test_e9_multiplying_every_row_out_brings_a_false_sin_alpha(model, any_core, printed):
    c = any_core
    cleared = sp.diag(c.sin_alpha, c.sin_alpha, c.sin_beta) * printed[0]
    sine = sp.sin(model.angles["alpha"] - model.angles["beta"])
    assert is_zero(cleared.det() - (c.u1 - c.u2) * c.w * c.v * sine * c.sin_alpha)


def test_factors_of_the_kernel_multiply_to_the_determinants(model, any_core, regular):
    values = model.kernels.factors(Symbols(), model.p, any_core)
    for kind, matrix in zip(("parallel", "serial"), regular, strict=True):
        names = [factor.name for factor in model.kernels.CLOSED_FORM.factor_list if factor.kind == kind]
        assert is_zero(matrix.det() - sp.prod([values[name] for name in names])), kind


@pytest.fixture(scope="module")
def closure_rows(model):
    """The eight independent walks (the x rows via B1 and B2 are one) with all joint angles kept."""
    gaps = model.closure(model.p, model.inputs, model.pose, model.joints)
    assert gaps["via_B1_x"] == gaps["via_B2_x"]
    return sp.Matrix([gaps[name] for name in gaps if name.startswith("via") and name != "via_B2_x"])


def test_e9_list_is_complete_without_eliminating_anything(model, closure_rows):
    """Derivatives of the closure by all joint angles and by the pose (or the inputs): no factor more, none less.

    No row was divided or multiplied by a sine here, so no singularity of the reduced model is hidden or made up.
    """
    p, angles = model.p, model.angles
    u1, u2 = (p.l2 * sp.cos(angles[name]) for name in ("B1", "B2"))
    w1, w2 = (p.l2 * sp.sin(angles[name]) for name in ("B1", "B2"))
    u3, v = p.l6 * sp.cos(angles["B3"]), p.l6 * sp.sin(angles["B3"])
    alpha, beta = angles["alpha"], angles["beta"]
    passive = list(angles.values())
    forward = closure_rows.jacobian([*model.pose, *passive]).det()
    backward = closure_rows.jacobian([*model.inputs, *passive]).det()
    parallel = (w1 * u2 - w2 * u1) * v * p.l4 * p.l6 * sp.sin(alpha - beta)  # w1 = w2 = w: -(u1 - u2) w
    serial = u1 * u2 * u3 * p.l4 * p.l6 * sp.sin(alpha) * sp.sin(beta)
    assert any(is_zero(forward - sign * parallel) for sign in (1, -1))
    assert any(is_zero(backward - sign * serial) for sign in (1, -1))


def test_case_i_a_is_u1_equal_u2_or_w_zero_and_nothing_else(any_core, printed):
    """e1 = k e2: B1C1 and B2C2 parallel. With u1^2 = u2^2 either k = 1 (self-motion) or k = -1 and w = 0 (E7)."""
    c = any_core
    pair = printed[0][:2, :]
    minors = [pair[:, columns].det() for columns in ([0, 1], [0, 2], [1, 2])]
    common = c.w * (c.u1 - c.u2)
    cot_alpha = c.cos_alpha / c.sin_alpha
    for minor, wanted in zip(minors, (-cot_alpha * common, 0, common), strict=True):
        assert is_zero(minor - wanted)


def test_e15_chain_2_alone_gives_three_translations(model):
    """O' by P3 and the two parallelograms: its three rates are independent unless u3 or sin b vanishes."""
    gaps = model.closure(model.p, model.inputs, model.pose, model.joints)
    walk = sp.Matrix([gaps[f"via_B3_{axis}"] for axis in "xyz"])
    rates = walk.jacobian([model.inputs[2], model.angles["B3"], model.angles["beta"]])
    u3 = model.p.l6 * sp.cos(model.angles["B3"])
    assert is_zero(rates.det() + u3 * model.p.l6 * sp.sin(model.angles["beta"]))


def test_e7_case_ii_exists_where_parallelogram_1_is_flat(any_core, printed):
    """e3 = k (e1 - e2) at v = 0, that is e2 = k1 e1 + k2 e3 with k1 = 1, k2 = -(u1 - u2)/u3, both not zero."""
    c = any_core
    e1, e2, e3 = (printed[0].row(i).subs(c.v, 0) for i in range(3))
    k = c.u3 / (c.u1 - c.u2)
    assert (e3 - k * (e1 - e2)).applyfunc(sp.simplify).is_zero_matrix
    assert (e2 - (e1 - (c.u1 - c.u2) / c.u3 * e3)).applyfunc(sp.simplify).is_zero_matrix


def test_e8_makes_three_vectors_dependent_too(any_core, printed):
    """cot a = cot b makes the x and z columns proportional: again case (ii), and case (i) b only if u1 v = u3 w."""
    c = any_core
    rows = printed[0].subs({c.cos_beta: -c.cos_alpha, c.sin_beta: -c.sin_alpha})
    e1, e2, e3 = (rows.row(i) for i in range(3))
    k1, k2 = (c.u3 * c.w - c.u2 * c.v) / (c.u3 * c.w - c.u1 * c.v), c.w * (c.u2 - c.u1) / (c.u3 * c.w - c.u1 * c.v)
    assert (e2 - k1 * e1 - k2 * e3).applyfunc(sp.simplify).is_zero_matrix
    assert sp.simplify((e1 * c.v - e3 * c.w)[1] - (c.u1 * c.v - c.u3 * c.w)) == 0
    assert (e1 * c.v - e3 * c.w)[0] == 0


def test_e7_both_loci_cross_the_search_box_in_the_built_mode(model):
    """Exact witnesses with every margin positive: w = 0 at x = -100, v = 0 at x = -38."""
    mode = SimpleNamespace(s_alpha=1, s_beta=1, u1=-1, u2=1, u3=1)
    for pose, vanishing in (((-100, 0, 210), "w"), ((-38, 0, 214), "v")):
        pose = tuple(map(sp.Integer, pose))
        assert all(low <= q <= high for q, (low, high) in zip(pose, ((-110, 90), (-250, 250), (180, 480)), strict=True))
        branch = model.kernels.inverse(Symbols(), model.sizes, pose, mode)
        assert all(margin > 0 for margin in branch.margins.values())
        values = model.kernels.factors(Symbols(), model.sizes, branch.core)
        assert [name for name, value in values.items() if sp.simplify(value) == 0] == [vanishing]


def test_e8_opposite_sines_are_singular_on_a_plane_only(model):
    p, x = model.p, model.pose[0]
    d = sp.Symbol("D", positive=True)
    cos_alpha, cos_beta = (x + d) / p.l4, (x - d) / p.l6
    # beta = alpha - pi or alpha + pi: cosines opposite, and with opposite sines that is all.
    (plane,) = sp.solve(cos_alpha + cos_beta, x)
    assert sp.simplify(plane + d * (p.l6 - p.l4) / (p.l6 + p.l4)) == 0
    sines = (1 - cos_alpha**2) - (1 - cos_beta**2)
    assert sp.simplify(sines.subs(x, plane)) == 0
    at_sizes = plane.subs({d: 100, p.l4: 180, p.l6: 230})
    assert at_sizes == sp.Rational(-500, 41)  # -12.1951 mm
    assert -130 < at_sizes < 80


def test_e8_same_sines_are_never_singular_with_these_lengths(model):
    """alpha = beta asks for cos a = 2 D / (l4 - l6), here -4."""
    s, cosine = model.sizes, sp.Symbol("cosine")
    d = s.b - s.d
    (found,) = sp.solve(s.l4 * cosine - d - (s.l6 * cosine + d), cosine)
    assert found == sp.Rational(2 * d, s.l4 - s.l6) == -4
    # Both sines zero is the other way to sin(alpha - beta) = 0: it would ask for l4 +- l6 = +-2 D.
    assert all(first * s.l4 - d != second * s.l6 + d for first in (1, -1) for second in (1, -1))


def test_e8_kernel_is_singular_on_the_plane_in_all_modes_with_opposite_sines_and_in_no_other(model):
    for s_alpha in (1, -1):
        for s_beta in (1, -1):
            mode = SimpleNamespace(s_alpha=s_alpha, s_beta=s_beta, u1=-1, u2=1, u3=1)
            pose = (sp.Rational(-500, 41), sp.Integer(0), sp.Integer(250))
            core = model.kernels.inverse(Symbols(), model.sizes, pose, mode).core
            assert (sp.simplify(core.sin_beta_minus_alpha) == 0) == (s_alpha != s_beta)
