"""Zeng et al. (2019), inverse problem: Eqs. (18)-(21) from the closure, the 32 branches, E6, E11, E15."""

from itertools import product
from types import SimpleNamespace

import pytest
import sympy as sp

from assur.numerics.number_types import Symbols

NAMES = ("s_alpha", "s_beta", "u1", "u2", "u3")
MODE = sp.symbols("s_alpha s_beta s1 s2 s3")
ANY_MODE = SimpleNamespace(**dict(zip(NAMES, MODE, strict=True)))
ROW_3 = tuple(sp.Rational(text) for text in ("-15.4714", "9.6849", "456.3315"))  # Table 1
TABLE_2 = [
    ("162.6909", "22.6909", "44.0476"),
    ("162.6909", "22.6909", "-24.6778"),
    ("162.6909", "-143.3211", "44.0476"),
    ("162.6909", "-143.3211", "-24.6778"),
    ("-3.3211", "22.6909", "44.0476"),
    ("-3.3211", "22.6909", "-24.6778"),
    ("-3.3211", "-143.3211", "44.0476"),
    ("-3.3211", "-143.3211", "-24.6778"),
]
HALF_UNIT = sp.Rational(1, 20000)


def rational(row):
    return tuple(sp.Rational(text) for text in row)


@pytest.fixture(scope="module")
def any_branch(model):
    roots = model.Roots()
    return model.kernels.inverse(roots, model.p, model.pose, ANY_MODE), roots


def test_eqs_18_19_are_the_x_rows_of_the_closure(model):
    p, x = model.p, model.pose[0]
    gaps = model.closure(p, model.inputs, model.pose, model.joints)
    cos_alpha, cos_beta = model.joints["alpha"][0], model.joints["beta"][0]
    assert sp.expand(gaps["via_B1_x"] - p.l4 * (cos_alpha - (x + p.b - p.d) / p.l4)) == 0
    assert sp.expand(gaps["via_B3_x"] - p.l6 * (cos_beta - (x + p.d - p.b) / p.l6)) == 0


def test_eqs_20_21_margins_are_M1_and_M3(model, any_branch):
    """zC1 = z - l4 sin a, zC3 of Eq. (11); M1 = M2 because C1 and C2 are level."""
    branch, roots = any_branch
    p, z, core = model.p, model.pose[2], branch.core
    m1 = p.l2**2 - (z - p.l4 * core.sin_alpha - p.l1) ** 2
    m3 = p.l6**2 - (z - p.l8 - p.l6 * core.sin_beta - p.l7 - p.l1) ** 2
    assert roots.vanishes(branch.margins["M12"] - m1, MODE)
    assert roots.vanishes(branch.margins["M3"] - m3, MODE)


def test_each_sign_is_that_of_its_quantity(any_branch):
    branch, roots = any_branch
    alpha, beta, m12, m3 = (root for root, _ in roots.radicands)
    core = branch.core
    found = (core.sin_alpha, core.sin_beta, core.u1, core.u2, core.u3)
    assert found == tuple(sign * root for sign, root in zip(MODE, (alpha, beta, m12, m12, m3), strict=True))


def test_all_32_branches_of_the_kernel_close_the_mechanism(model, any_branch):
    branch, roots = any_branch
    joints = model.kernel_joints(model.p, branch.core)
    for name, gap in model.closure(model.p, branch.inputs, model.pose, joints).items():
        assert roots.vanishes(gap, MODE), name


def test_the_32_branches_are_all_there_are(model, any_branch):
    """The closure fixes both cosines, all heights and inputs, once a sign is chosen on each of five circles."""
    branch, _ = any_branch
    p, core = model.p, branch.core
    cosines = dict(zip(model.joints, sp.symbols("cB1 cB2 cB3 ca cb"), strict=True))
    sines = dict(zip(model.joints, sp.symbols("sB1 sB2 sB3 sa sb"), strict=True))
    pairs = {name: (cosines[name], sines[name]) for name in model.joints}
    gaps = [gap for name, gap in model.closure(p, model.inputs, model.pose, pairs).items() if name.startswith("via")]
    fixed = [cosines["alpha"], cosines["beta"], *(sines[name] for name in ("B1", "B2", "B3")), *model.inputs]
    (solution,) = sp.solve(gaps, fixed, dict=True)
    assert set(solution) == set(fixed)
    # The circles then give sin a, sin b from their cosines and u1, u2, u3 from their heights: 2^5 choices.
    chosen = {
        sines["alpha"]: core.sin_alpha,
        sines["beta"]: core.sin_beta,
        **{
            cosines[name]: u / length
            for name, u, length in zip(("B1", "B2", "B3"), (core.u1, core.u2, core.u3), (p.l2, p.l2, p.l6), strict=True)
        },
    }
    wanted = [core.cos_alpha, core.cos_beta, core.w / p.l2, core.w / p.l2, core.v / p.l6, *branch.inputs]
    for letter, value in zip(fixed, wanted, strict=True):
        assert sp.simplify(solution[letter].subs(chosen) - value) == 0, letter


def test_joint_values_and_quantities_of_the_kernel_mean_what_their_letters_say(model, any_branch):
    branch, roots = any_branch
    p, core = model.p, branch.core
    _, y, z = model.pose
    joints = model.kernels.joints(roots, p, core)
    for name, value in zip(("P1", "P2", "P3"), branch.inputs, strict=True):
        assert sp.expand(joints[name] - value) == 0
    angles = model.kernel_joints(p, core)
    forth = {"B1": "B1", "B2": "B2", "B3a": "B3", "B3b": "B3", "D1": "alpha", "D3a": "beta", "D3b": "beta"}
    back = {"C1": "B1", "C2": "B2", "C3a": "B3", "C3b": "B3", "D2": "alpha", "E3a": "beta", "E3b": "beta"}
    assert set(joints) == {"P1", "P2", "P3", *forth, *back}
    assert all(joints[name] == angles[angle] for name, angle in forth.items())
    assert all(joints[name] == (angles[angle][0], -angles[angle][1]) for name, angle in back.items())
    t = p.l4 * core.sin_alpha - p.l6 * core.sin_beta  # Eq. (13)
    wanted = {
        "gamma": angles["B1"],
        "alpha": angles["alpha"],
        "beta": angles["beta"],
        "A": 2 * p.l2,
        "B": branch.inputs[0] - p.l3 - branch.inputs[1],
        "H1": core.w - p.l8 - p.l7,
        "H2": p.l6**2 - (y - branch.inputs[2]) ** 2,
        "t": t,
        "J1": 2 * p.l4 * t,
        "J2": 4 * p.l4 * (p.b - p.d),
        "J3": p.l6**2 - p.l4**2 - t**2 - 4 * (p.b - p.d) ** 2,
        "M1": branch.margins["M12"],
        "M2": branch.margins["M12"],
        "M3": branch.margins["M3"],
        "yC1": y + p.l3 / 2,
        "yC2": y - p.l3 / 2,
        "yC3": y,
        "zC1": z - p.l4 * core.sin_alpha,
        "zC2": z - p.l4 * core.sin_alpha,
        "zC3": z - p.l8 - p.l6 * core.sin_beta - p.l7,
    }
    named = model.kernels.quantities(roots, p, core)
    assert set(named) == set(wanted) == {item.name for item in model.kernels.CLOSED_FORM.quantity_list}
    for name, value in wanted.items():
        if isinstance(value, tuple):
            assert named[name] == value, name
        else:
            assert roots.vanishes(named[name] - value, MODE), name


def test_constraints_are_the_lengths_of_eq_20(model, any_branch):
    """At the branch's own inputs they are l2, l2, l6; at any other inputs they are the distances B_iC_i."""
    branch, roots = any_branch
    p, core, y = model.p, branch.core, model.pose[1]
    found = model.kernels.constraints(Symbols(), p, core, model.inputs)
    gaps = {
        "B1C1": (y + p.l3 / 2 - model.inputs[0], core.w),
        "B2C2": (y - p.l3 / 2 - model.inputs[1], core.w),
        "B3C3": (y - model.inputs[2], core.v),
    }
    own = dict(zip(model.inputs, branch.inputs, strict=True))
    for (name, (length, wanted)), size in zip(found.items(), (p.l2, p.l2, p.l6), strict=True):
        assert wanted == size
        assert sp.expand(length**2 - sum(part**2 for part in gaps[name])) == 0
        assert roots.vanishes((length**2).subs(own) - wanted**2, MODE)


def test_direct_returns_the_pose_from_every_mode_with_u1_opposite_to_u2(model, any_branch):
    """The direct problem's radicands are the squares of w, v and 2 l4 l6 sin(b - a) of the inverse branch."""
    p = model.p
    opposite = {MODE[3]: -MODE[2]}
    branch, roots = any_branch
    inputs = [q.subs(opposite) for q in branch.inputs]
    core = branch.core
    back = model.kernels.direct(model.Roots(), p, inputs, SimpleNamespace(e1=1, e2=1, e3=1))
    assert roots.vanishes(back.pose[1] - model.pose[1], MODE)
    assert roots.vanishes(back.margins["w2"] - core.w**2, MODE)
    assert roots.vanishes(back.margins["v2"] - core.v**2, MODE)
    width, t = 2 * (p.b - p.d), core.v + p.l7 + p.l8 - core.w
    centres = width**2 + t**2
    meeting = 4 * p.l4**2 * centres - (p.l6**2 - p.l4**2 - centres) ** 2
    assert roots.vanishes(meeting - (2 * p.l4 * p.l6 * core.sin_beta_minus_alpha) ** 2, MODE)


def test_kernel_over_symbols_gives_back_rational_inputs(model):
    """The pose (4, 0, 398) built by hand: cos a = 3/5, cos b = -5/13, w = 224, v = 100."""
    sizes = {"b": 154, "d": 50, "l1": 30, "l2": 280, "l3": 140, "l4": 180, "l6": 260, "l7": 20, "l8": 8}
    p = SimpleNamespace(**{k: sp.Integer(v) for k, v in sizes.items()})
    mode = SimpleNamespace(s_alpha=1, s_beta=1, u1=-1, u2=1, u3=1)
    branch = model.kernels.inverse(Symbols(), p, [sp.Integer(value) for value in (4, 0, 398)], mode)
    assert branch.inputs == (238, -238, -240)


def test_e11_x_runs_from_minus_130_to_80(model):
    s = model.sizes
    d = s.b - s.d
    reach = sp.Interval(-d - s.l4, -d + s.l4).intersect(sp.Interval(d - s.l6, d + s.l6))
    assert reach == sp.Interval(-130, 80)
    box = sp.Interval(-110, 90)
    assert reach - box == sp.Interval.Ropen(-130, -110)
    assert box - reach == sp.Interval.Lopen(80, 90)
    # Both ends are assembled: there sin b = 0 or sin a = 0, and C1, C3 are within reach.
    for end in (-130, 80):
        branch = model.kernels.inverse(
            Symbols(), s, (sp.Integer(end), 0, 200), SimpleNamespace(**dict.fromkeys(NAMES, 1))
        )
        assert all(margin >= 0 for margin in branch.margins.values())


def test_e11_y_is_bounded_by_the_sliders_only(model, any_branch):
    branch, _ = any_branch
    shift, y = sp.Symbol("shift"), model.pose[1]
    assert y not in set().union(*(margin.free_symbols for margin in branch.margins.values()))
    for q in branch.inputs:
        assert sp.expand(q.subs(y, y + shift) - q - shift) == 0


def real_modes(model, pose):
    modes = [SimpleNamespace(**dict(zip(NAMES, signs, strict=True))) for signs in product((1, -1), repeat=5)]
    branches = [(mode, model.kernels.inverse(Symbols(), model.sizes, pose, mode)) for mode in modes]
    return [(mode, b) for mode, b in branches if all(margin >= 0 for margin in b.margins.values())]


def test_e15_24_of_the_32_inverse_solutions_are_imaginary_at_row_3(model):
    real = real_modes(model, ROW_3)
    assert len(real) == 8
    assert {(mode.s_alpha, mode.s_beta) for mode, _ in real} == {(1, 1)}


def printed_tolerance(model, branch):
    """Half a unit in the last printed place, of each pose coordinate times its effect on each input, and its own."""
    jp, jq = model.kernels.as_printed(Symbols(), model.sizes, branch.core)
    return [HALF_UNIT * (1 + sum(abs(entry) for entry in row) / abs(jq[i][i])) for i, row in enumerate(jp)]


def test_e6_table_2_has_all_real_solutions_of_row_3_and_no_other(model):
    real = real_modes(model, ROW_3)
    found = []
    for _, branch in real:
        tolerance = printed_tolerance(model, branch)
        near = [
            number
            for number, row in enumerate(TABLE_2, start=1)
            if all(abs(p - q) <= t for p, q, t in zip(rational(row), branch.inputs, tolerance, strict=True))
        ]
        found += near
    assert sorted(found) == list(range(1, 9))


def test_e6_only_rows_3_and_4_can_be_built(model):
    self_motion, passed, built = set(), set(), set()
    for number, row in enumerate(TABLE_2, start=1):
        y_a1, y_a2, _ = rational(row)
        kind = self_motion if y_a1 - y_a2 == model.sizes.l3 else passed if y_a1 < y_a2 else built
        kind.add(number)
    assert (self_motion, passed, built) == ({1, 2, 7, 8}, {5, 6}, {3, 4})


def test_e6_every_mode_with_u1_equal_to_u2_has_B_zero_and_det_jp_zero(model, any_branch):
    branch, roots = any_branch
    same = {MODE[3]: MODE[2]}
    b = (branch.inputs[0] - model.p.l3 - branch.inputs[1]).subs(same)
    assert sp.expand(b) == 0
    jp, _ = model.kernels.jacobians(roots, model.p, branch.core)
    assert sp.Matrix(jp).subs(same).row(0).is_zero_matrix
    assert not sp.Matrix(jp).subs(MODE[3], -MODE[2]).row(0).is_zero_matrix


def test_row_4_of_table_2_is_the_default_mode(model):
    modes = {
        tuple(vars(mode).values())
        for mode, branch in real_modes(model, ROW_3)
        if all(abs(p - q) < sp.Rational(1, 1000) for p, q in zip(rational(TABLE_2[3]), branch.inputs, strict=True))
    }
    assert modes == {(1, 1, -1, 1, 1)}
