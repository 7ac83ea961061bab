"""Zeng et al. (2019), direct problem: Eqs. (7)-(17) from the closure, E1, E5, and the kernel in every mode."""

from types import SimpleNamespace

import pytest
import sympy as sp

from assur.numerics.number_types import Symbols

E1, E2, E3 = MODE = sp.symbols("e1 e2 e3")
ANY_MODE = SimpleNamespace(e1=E1, e2=E2, e3=E3)


@pytest.fixture(scope="module")
def gaps(model):
    return model.closure(model.p, model.inputs, model.pose, model.joints)


@pytest.fixture(scope="module")
def any_branch(model):
    """The direct kernel with every letter and every sign symbolic, and the roots it took."""
    roots = model.Roots()
    return model.kernels.direct(roots, model.p, model.inputs, ANY_MODE), roots


def letters(model):
    """A, B, t and the J's of Eqs. (9), (13), (17), from the joint angles."""
    p, (y_a1, y_a2, _) = model.p, model.inputs
    t = p.l4 * sp.sin(model.angles["alpha"]) - p.l6 * sp.sin(model.angles["beta"])
    return SimpleNamespace(
        A=2 * p.l2,
        B=y_a1 - p.l3 - y_a2,
        t=t,
        J1=2 * p.l4 * t,
        J2=4 * p.l4 * (p.b - p.d),
        J3=p.l6**2 - p.l4**2 - t**2 - 4 * (p.b - p.d) ** 2,
    )


def is_zero(expression):
    return sp.simplify(sp.expand(expression)) == 0


def test_eq7_link_11_stays_level(model, gaps):
    heights = [model.p.l2 * model.joints[name][1] for name in ("B1", "B2")]
    assert is_zero(gaps["via_B1_z"] - gaps["via_B2_z"] - (heights[0] - heights[1]))


def test_eq8_reads_A_B_cos_gamma_plus_B_squared(model):
    named, p = letters(model), model.p
    cosine, sine = model.joints["B1"]
    reach = (model.inputs[0] + p.l2 * cosine - p.l3 - model.inputs[1], p.l2 * sine)  # B2C2
    length_condition = reach[0] ** 2 + reach[1] ** 2 - p.l2**2
    assert is_zero(length_condition - (named.A * named.B * cosine + named.B**2))


def test_e1_only_minus_B_over_A_closes_loop_1(model):
    named = letters(model)

    def left(cosine):
        return sp.expand(named.A * named.B * cosine + named.B**2)

    assert left(-named.B / named.A) == 0
    assert sp.expand(left(named.B / named.A) - 2 * named.B**2) == 0  # zero at B = 0 only


def test_e1_u1_and_u2_are_opposite_or_B_vanishes(model, gaps):
    """Completeness of loop 1: closure and the two circles leave B = 0 or u1 = -u2 = -B/2, with w either way."""
    named, p = letters(model), model.p
    u1, u2 = (p.l2 * model.joints[name][0] for name in ("B1", "B2"))
    assert is_zero(gaps["via_B1_y"] - gaps["via_B2_y"] - (named.B + u1 - u2))
    # Eq. (7) and the circles give u1^2 = u2^2; with u2 = B + u1 this is -B (2 u1 + B) = 0.
    assert is_zero(u1**2 - (named.B + u1) ** 2 + named.B * (2 * u1 + named.B))


def test_e2_the_false_root_stretches_B2C2_to_365_mm(model):
    """At Table 1's inputs; |B2C2|^2 exceeds l2^2 by 2 B^2."""
    b = sp.Rational("162.6907") - 140 - sp.Rational("-143.3209")
    false_length = sp.sqrt((b + b / 2) ** 2 + model.sizes.l2**2 - (b / 2) ** 2)
    assert false_length == sp.sqrt(model.sizes.l2**2 + 2 * b**2)
    assert abs(false_length - sp.Rational("365.40")) < sp.Rational("0.005")


def test_eq14_t_plus_H1_is_the_height_v(model, gaps):
    named, p = letters(model), model.p
    w, v = p.l2 * model.joints["B1"][1], p.l6 * model.joints["B3"][1]
    assert is_zero(gaps["via_B1_z"] - gaps["via_B3_z"] - (named.t + (w - p.l8 - p.l7) - v))


def test_eq15_D1_and_D3_have_one_y(model, gaps):
    y_d1 = model.inputs[0] + model.p.l2 * model.joints["B1"][0] - model.p.l3 / 2
    y_d3 = model.inputs[2] + model.p.l6 * model.joints["B3"][0]
    assert is_zero(gaps["via_B1_y"] - gaps["via_B3_y"] - (y_d1 - y_d3))


def test_eq16_width(model, gaps):
    p = model.p
    eq16 = p.l4 * model.joints["alpha"][0] + 2 * p.d - p.l6 * model.joints["beta"][0] - 2 * p.b
    assert is_zero(gaps["via_B1_x"] - gaps["via_B3_x"] - eq16)


def test_eq17_is_what_is_left_when_beta_is_eliminated(model):
    """J1 sin a + J2 cos a + J3 = l6^2 - |l6 (cos b, sin b)|^2 with Eqs. (13) and (16) put in."""
    p, (cosine, sine) = model.p, model.joints["alpha"]
    t = sp.Symbol("t")
    j1, j2 = 2 * p.l4 * t, 4 * p.l4 * (p.b - p.d)
    j3 = p.l6**2 - p.l4**2 - t**2 - 4 * (p.b - p.d) ** 2
    l6_cos_beta, l6_sin_beta = p.l4 * cosine - 2 * (p.b - p.d), p.l4 * sine - t
    assert is_zero(j1 * sine + j2 * cosine + j3 - (p.l6**2 - l6_cos_beta**2 - l6_sin_beta**2))


def test_eq17_half_tangent_and_the_angle_that_it_loses():
    j1, j2, j3, k = sp.symbols("J1 J2 J3 k")
    form = sp.numer(sp.together(j1 * 2 * k / (1 + k**2) + j2 * (1 - k**2) / (1 + k**2) + j3))
    root = sp.Symbol("root")
    for sign in (1, -1):
        left = sp.expand(sp.numer(sp.together(form.subs(k, (j1 + sign * root) / (j2 - j3)))))
        assert sp.rem(left, root**2 - (j1**2 + j2**2 - j3**2), root) == 0
    # E15: alpha = pi (k infinite) is a solution exactly when J2 = J3, where one root of the quadratic is lost.
    assert (j1 * sp.sin(sp.pi) + j2 * sp.cos(sp.pi) + j3).subs(j3, j2) == 0
    assert sp.degree(form.subs(j3, j2), k) == 1


def test_e15_the_lost_angle_is_out_of_reach_with_the_lengths_of_the_paper(model):
    """J2 = J3 asks for l6^2 = (l4 + 2 (b - d))^2 + t^2."""
    s, t = model.sizes, sp.Symbol("t")
    j2, j3 = 4 * s.l4 * (s.b - s.d), s.l6**2 - s.l4**2 - t**2 - 4 * (s.b - s.d) ** 2
    assert sp.expand(j3 - j2 - (s.l6**2 - (s.l4 + 2 * (s.b - s.d)) ** 2 - t**2)) == 0
    assert s.l6 < s.l4 + 2 * (s.b - s.d)


def test_meeting_margin_is_J1_J2_J3_and_vanishes_where_D1D2_and_D3E3_are_parallel(model, any_branch):
    branch, roots = any_branch
    p = model.p
    named = model.kernels.quantities(roots, p, branch.core)
    assert roots.vanishes(branch.margins["meeting"] - (named["J1"] ** 2 + named["J2"] ** 2 - named["J3"] ** 2), MODE)
    on_closure = {p.b: p.d + (p.l4 * model.joints["alpha"][0] - p.l6 * model.joints["beta"][0]) / 2}
    by_angles = letters(model)
    radicand = (by_angles.J1**2 + by_angles.J2**2 - by_angles.J3**2).subs(on_closure)
    sine = sp.sin(model.angles["beta"] - model.angles["alpha"])
    assert is_zero(sp.expand_trig(radicand - (2 * p.l4 * p.l6 * sine) ** 2))


def test_two_circles_meet_in_no_other_point_than_the_two_of_e3(any_branch, model):
    """Completeness of loop 2: W cos a + t sin a is given by Eq. (17), and the cross product only up to e3."""
    branch, roots = any_branch
    p, core = model.p, branch.core
    width, t, cosine, sine = sp.symbols("W t c s")
    lagrange = (width * cosine + t * sine) ** 2 + (width * sine - t * cosine) ** 2
    assert sp.expand(lagrange - (width**2 + t**2) * (cosine**2 + sine**2)) == 0
    w_kernel, t_kernel = 2 * (p.b - p.d), core.v + p.l7 + p.l8 - core.w
    j3 = p.l6**2 - p.l4**2 - w_kernel**2 - t_kernel**2
    along = w_kernel * core.cos_alpha + t_kernel * core.sin_alpha
    across = w_kernel * core.sin_alpha - t_kernel * core.cos_alpha
    root = roots.radicands[-1][0]
    assert roots.vanishes(2 * p.l4 * along + j3, MODE)
    assert roots.vanishes(2 * p.l4 * across - E3 * root, MODE)


def test_e3_is_the_sign_of_the_cross_product_and_of_sin_beta_minus_alpha(any_branch, model):
    """(c2 - c1) x (p - c1) in (x, z): c1, c2 the centres, p the point they share."""
    branch, roots = any_branch
    p, core = model.p, branch.core
    x, _, z = branch.pose
    d = p.b - p.d
    c1, c2 = (-d, p.l1 + core.w), (d, p.l1 + core.v + p.l7 + p.l8)
    cross = (c2[0] - c1[0]) * (z - c1[1]) - (c2[1] - c1[1]) * (x - c1[0])
    root = roots.radicands[-1][0]
    assert roots.vanishes(2 * cross - E3 * root, MODE)
    assert roots.vanishes(cross - p.l4 * p.l6 * core.sin_beta_minus_alpha, MODE)


def test_eq17_with_plus_is_e3_positive(any_branch, model):
    branch, roots = any_branch
    named = model.kernels.quantities(roots, model.p, branch.core)
    root, core = roots.radicands[-1][0], branch.core
    half_tangent = core.sin_alpha * (named["J2"] - named["J3"]) - (1 + core.cos_alpha) * (named["J1"] + E3 * root)
    assert roots.vanishes(half_tangent, MODE)


def test_e1_and_e2_are_the_signs_of_w_and_v(any_branch):
    branch, roots = any_branch
    (w_root, _), (v_root, _), _ = roots.radicands
    assert (branch.core.w, branch.core.v) == (E1 * w_root, E2 * v_root)


def test_every_branch_of_the_kernel_closes_the_mechanism(any_branch, model):
    """All lengths, all inputs, all eight modes at once: an identity of polynomials."""
    branch, roots = any_branch
    joints = model.kernel_joints(model.p, branch.core)
    for name, gap in model.closure(model.p, model.inputs, branch.pose, joints).items():
        assert roots.vanishes(gap, MODE), name


def test_a_kernel_with_the_printed_root_would_not_close(any_branch, model):
    """The test above can fail: turn u1 and u2 to the other sign of Eq. (9)."""
    branch, roots = any_branch
    core = SimpleNamespace(**{**vars(branch.core), "u1": -branch.core.u1, "u2": -branch.core.u2})
    gaps = model.closure(model.p, model.inputs, branch.pose, model.kernel_joints(model.p, core))
    assert [name for name, gap in gaps.items() if not roots.vanishes(gap, MODE)] == ["via_B1_y", "via_B2_y"]


def test_e5_y_is_linear_wherever_B_does_not_vanish(model):
    """Row 1 - row 2 of Eq. (20) is B (yA1 + yA2 - 2 y), whatever x and z."""
    p, (y_a1, y_a2, _), y, w = model.p, model.inputs, model.pose[1], sp.Symbol("w")
    rows = [(y + p.l3 / 2 - y_a1) ** 2 + w**2, (y - p.l3 / 2 - y_a2) ** 2 + w**2]
    assert sp.expand(rows[0] - rows[1] - letters(model).B * (y_a1 + y_a2 - 2 * y)) == 0


def test_e5_x_and_z_depend_on_two_differences_only(model):
    middle, apart, ahead = sp.symbols("middle apart ahead", real=True)
    inputs = (middle + apart / 2, middle - apart / 2, middle - ahead)
    x, y, z = model.kernels.direct(Symbols(), model.p, inputs, ANY_MODE).pose
    assert y == middle
    assert {apart, ahead} <= x.free_symbols
    assert {apart, ahead} <= z.free_symbols
    assert middle not in x.free_symbols | z.free_symbols


def rational_example():
    """Lengths and inputs made from Pythagorean triples, so that one pair of branches has no root left."""
    sizes = {"b": 154, "d": 50, "l1": 30, "l2": 280, "l3": 140, "l4": 180, "l6": 260, "l7": 20, "l8": 8}
    return SimpleNamespace(**{k: sp.Integer(v) for k, v in sizes.items()}), (238, -238, -240), (4, 0, 398)


def test_kernel_over_symbols_hits_a_pose_built_by_hand(model):
    """cos a = 3/5, cos b = -5/13, u1 = -168, w = 224, u3 = 240, v = 100: the walk ends at (4, 0, 398)."""
    p, inputs, pose = rational_example()
    mode = SimpleNamespace(e1=1, e2=1, e3=1)
    branch = model.kernels.direct(Symbols(), p, [sp.Integer(q) for q in inputs], mode)
    assert tuple(branch.pose) == pose
    assert (branch.core.cos_alpha, branch.core.sin_alpha) == (sp.Rational(3, 5), sp.Rational(4, 5))
    assert (branch.core.cos_beta, branch.core.sin_beta) == (sp.Rational(-5, 13), sp.Rational(12, 13))
    gaps = model.closure(p, inputs, branch.pose, model.kernel_joints(p, branch.core))
    assert set(gaps.values()) == {sp.Integer(0)}
