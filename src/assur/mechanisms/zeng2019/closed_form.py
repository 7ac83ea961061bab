"""Closed form of the mechanism of Zeng, Yang, Shen and Chablat (2019), arXiv:1907.08432.

Letters as in the paper, and four more: w = zC1 - l1 and v = zC3 - l1 are the heights of C1 and C3 over
the B's, u_i = yCi - yBi (the paper's u_ii), and D = b - d. Chain I is the plane linkage A1 B1 C1 C2 B2 A2
followed by link 12 at the angle alpha; chain II is parallelogram 1 in YZ followed by parallelogram 2 at the
angle beta. Where this file and the paper differ, `reference/errata.toml` says why.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, Quantity, SelfMotion, Sign


def inverse(ns, p, pose, sign):
    """Inputs at a pose, Eqs. (18)-(21). Signs: s_alpha, s_beta, u1, u2, u3."""
    x, y, z = pose
    cos_alpha = (x + p.b - p.d) / p.l4  # Eq. (18)
    cos_beta = (x + p.d - p.b) / p.l6  # Eq. (19)
    n_alpha = 1 - cos_alpha * cos_alpha
    n_beta = 1 - cos_beta * cos_beta
    sin_alpha = sign.s_alpha * ns.sqrt(n_alpha)
    sin_beta = sign.s_beta * ns.sqrt(n_beta)
    w = z - p.l4 * sin_alpha - p.l1
    v = z - p.l8 - p.l6 * sin_beta - p.l7 - p.l1  # Eq. (11)
    m12 = p.l2 * p.l2 - w * w  # M1 = M2 of Eq. (21), because zC1 = zC2
    m3 = p.l6 * p.l6 - v * v
    root12 = ns.sqrt(m12)
    u1 = sign.u1 * root12
    u2 = sign.u2 * root12
    u3 = sign.u3 * ns.sqrt(m3)
    inputs = (y + p.l3 / 2 - u1, y - p.l3 / 2 - u2, y - u3)  # Eq. (21)
    core = _core(p, pose, cos_alpha, sin_alpha, cos_beta, sin_beta, u1, u2, u3, w, v)
    return Branch(pose, inputs, {"n_alpha": n_alpha, "n_beta": n_beta, "M12": m12, "M3": m3}, core)


def direct(ns, p, inputs, sign):
    """Pose at given inputs, Eqs. (7)-(17) with Eq. (9) put right. Signs: e1, e2, e3."""
    y_a1, y_a2, y_a3 = inputs
    big_b = y_a1 - p.l3 - y_a2
    y = (y_a1 + y_a2) / 2  # Eq. (10): linear and exact
    u3 = y - y_a3
    w_squared = p.l2 * p.l2 - big_b * big_b / 4  # Eq. (8)
    v_squared = p.l6 * p.l6 - u3 * u3  # H2 of Eq. (14)
    w = sign.e1 * ns.sqrt(w_squared)
    v = sign.e2 * ns.sqrt(v_squared)
    meeting, centres, core = _second_loop(ns, p, y, -big_b / 2, big_b / 2, u3, w, v, sign.e3)
    margins = {"B": big_b, "w2": w_squared, "v2": v_squared, "centres": centres, "meeting": meeting}
    return Branch((core.x, y, core.z), tuple(inputs), margins, core)


def self_motion(ns, p, inputs, gamma, sign):
    """The curve of poses at B = 0, run along by the angle gamma of B1C1. Signs: e2, e3."""
    y_a1, _, y_a3 = inputs
    cos_gamma, sin_gamma = gamma
    u1 = p.l2 * cos_gamma
    y = y_a1 + u1 - p.l3 / 2
    u3 = y - y_a3
    v_squared = p.l6 * p.l6 - u3 * u3
    v = sign.e2 * ns.sqrt(v_squared)
    meeting, centres, core = _second_loop(ns, p, y, u1, u1, u3, p.l2 * sin_gamma, v, sign.e3)
    margins = {"v2": v_squared, "centres": centres, "meeting": meeting}
    return Branch((core.x, y, core.z), tuple(inputs), margins, core)


def _second_loop(ns, p, y, u1, u2, u3, w, v, e3):
    """Meet the circle of D2 about D1 (radius l4) and that of E3 about D3 (radius l6), Eqs. (13)-(17)."""
    width = 2 * (p.b - p.d)
    t = v + p.l7 + p.l8 - w  # Eq. (14)
    centres = width * width + t * t
    j3 = p.l6 * p.l6 - p.l4 * p.l4 - centres
    meeting = 4 * p.l4 * p.l4 * centres - j3 * j3  # J1^2 + J2^2 - J3^2 of Eq. (17)
    half = e3 * ns.sqrt(meeting)
    denominator = 2 * centres * p.l4
    cos_alpha = (-j3 * width - half * t) / denominator
    sin_alpha = (-j3 * t + half * width) / denominator
    cos_beta = (p.l4 * cos_alpha - width) / p.l6  # Eq. (16)
    sin_beta = (p.l4 * sin_alpha - t) / p.l6  # Eq. (13)
    pose = (p.l4 * cos_alpha - width / 2, y, p.l1 + w + p.l4 * sin_alpha)  # Eq. (10)
    core = _core(p, pose, cos_alpha, sin_alpha, cos_beta, sin_beta, u1, u2, u3, w, v)
    return meeting, centres, core


def _core(p, pose, cos_alpha, sin_alpha, cos_beta, sin_beta, u1, u2, u3, w, v):
    x, y, z = pose
    return SimpleNamespace(
        x=x, y=y, z=z,
        cos_alpha=cos_alpha, sin_alpha=sin_alpha, cos_beta=cos_beta, sin_beta=sin_beta,
        u1=u1, u2=u2, u3=u3, w=w, v=v,
        sin_beta_minus_alpha=sin_beta * cos_alpha - cos_beta * sin_alpha,
    )  # fmt: skip


def joints(ns, p, core):
    """Every joint's value; a revolute as (cosine, sine)."""
    b1 = (core.u1 / p.l2, core.w / p.l2)
    b2 = (core.u2 / p.l2, core.w / p.l2)
    b3 = (core.u3 / p.l6, core.v / p.l6)
    alpha = (core.cos_alpha, core.sin_alpha)
    beta = (core.cos_beta, core.sin_beta)
    return {
        "P1": core.y + p.l3 / 2 - core.u1, "P2": core.y - p.l3 / 2 - core.u2, "P3": core.y - core.u3,
        "B1": b1, "C1": _back(b1), "B2": b2, "C2": _back(b2),
        "D1": alpha, "D2": _back(alpha),
        "B3a": b3, "B3b": b3, "C3a": _back(b3), "C3b": _back(b3),
        "D3a": beta, "D3b": beta, "E3a": _back(beta), "E3b": _back(beta),
    }  # fmt: skip


def _back(angle):
    cosine, sine = angle
    return (cosine, -sine)


def factors(ns, p, core):
    """Factors of det Jp and det Jq of the regular form below."""
    return {
        "u1_minus_u2": core.u1 - core.u2,
        "w": core.w,
        "v": core.v,
        "sin_alpha_minus_beta": -core.sin_beta_minus_alpha,
        "u1": core.u1,
        "u2": core.u2,
        "u3": core.u3,
        "sin_alpha": core.sin_alpha,
        "sin_beta": core.sin_beta,
    }


def jacobians(ns, p, core):
    """Regular form of Eq. (25): row 1 - row 2, row 1 times sin(alpha), row 3 times sin(beta)."""
    u1, u2, u3, w, v = core.u1, core.u2, core.u3, core.w, core.v
    ca, sa, cb, sb = core.cos_alpha, core.sin_alpha, core.cos_beta, core.sin_beta
    jp = ((0, u1 - u2, 0), (ca * w, sa * u1, sa * w), (cb * v, sb * u3, sb * v))
    jq = ((u1, -u2, 0), (sa * u1, 0, 0), (0, 0, sb * u3))
    return jp, jq


def as_printed(ns, p, core):
    """Jp and Jq as Eqs. (24) and (25) print them; they divide by sin(alpha) and sin(beta)."""
    u1, u2, u3, w, v = core.u1, core.u2, core.u3, core.w, core.v
    cot_alpha = core.cos_alpha / core.sin_alpha
    cot_beta = core.cos_beta / core.sin_beta
    jp = ((cot_alpha * w, u1, w), (cot_alpha * w, u2, w), (cot_beta * v, u3, v))
    jq = ((u1, 0, 0), (0, u2, 0), (0, 0, u3))
    return jp, jq


def quantities(ns, p, core):
    """What the paper names on its way, at any solution."""
    t = p.l4 * core.sin_alpha - p.l6 * core.sin_beta
    width = 2 * (p.b - p.d)
    return {
        "gamma": (core.u1 / p.l2, core.w / p.l2),
        "alpha": (core.cos_alpha, core.sin_alpha),
        "beta": (core.cos_beta, core.sin_beta),
        "A": 2 * p.l2,
        "B": core.u2 - core.u1,
        "H1": core.w - p.l8 - p.l7,
        "H2": core.v * core.v,
        "t": t,
        "J1": 2 * p.l4 * t,
        "J2": 2 * p.l4 * width,
        "J3": p.l6 * p.l6 - p.l4 * p.l4 - t * t - width * width,
        "M1": p.l2 * p.l2 - core.w * core.w,
        "M2": p.l2 * p.l2 - core.w * core.w,
        "M3": p.l6 * p.l6 - core.v * core.v,
        "yC1": core.y + p.l3 / 2,
        "yC2": core.y - p.l3 / 2,
        "yC3": core.y,
        "zC1": p.l1 + core.w,
        "zC2": p.l1 + core.w,
        "zC3": p.l1 + core.v,
    }


def constraints(ns, p, core, inputs):
    """Eq. (20): the lengths |BiCi| that a pose and inputs would need, beside l2, l2 and l6."""
    y_a1, y_a2, y_a3 = inputs
    gaps = (core.y + p.l3 / 2 - y_a1, core.y - p.l3 / 2 - y_a2, core.y - y_a3)
    heights = (core.w, core.w, core.v)
    lengths = [ns.sqrt(gap * gap + height * height) for gap, height in zip(gaps, heights, strict=True)]
    return {"B1C1": (lengths[0], p.l2), "B2C2": (lengths[1], p.l2), "B3C3": (lengths[2], p.l6)}


SOURCES = {
    "x": "(10)", "y": "(10)", "z": "(10)", "yA1": "(21)", "yA2": "(21)", "yA3": "(21)",
    "u1": "(24)", "u2": "(24)", "u3": "(24)",
}  # fmt: skip
DIRECT_MARGINS = (
    Margin("B", "l2", "B1B2 less C1C2: zero where B1C1 and B2C2 stay parallel", unit=1, zero="degenerate", latex="B"),
    Margin("w2", "l2*l2", "B1 and B2 are too far apart for links 9, 10 and 11 to meet",
           unit=2, signs=("e1",), latex=r"l_2^2-B^2/4"),
    Margin("v2", "l6*l6", "D1 and slider 3 are too far apart along Y for parallelogram 1",
           unit=2, signs=("e2",), latex="H_2"),
    Margin("centres", "4*(b-d)*(b-d)+l6*l6", "squared distance of D1 and D3 in the XZ plane",
           unit=2, zero="degenerate", latex=r"4(b-d)^2+t^2"),
    Margin("meeting", "4*l4*l4*(l6*l6 + 4*(b-d)*(b-d))",
           "the circles of link 12 about D1 and of parallelogram 2 about D3 do not meet",
           unit=4, signs=("e3",), latex=r"J_1^2+J_2^2-J_3^2"),
)  # fmt: skip
INVERSE_MARGINS = (
    Margin("n_alpha", "1", "x is out of reach of link 12", unit=0, signs=("s_alpha",), latex=r"1-\cos^2\alpha"),
    Margin("n_beta", "1", "x is out of reach of parallelogram 2", unit=0, signs=("s_beta",), latex=r"1-\cos^2\beta"),
    Margin("M12", "l2*l2", "C1 and C2 are too high or too low for links 9 and 10",
           unit=2, signs=("u1", "u2"), latex="M_1"),
    Margin("M3", "l6*l6", "C3 is too high or too low for parallelogram 1", unit=2, signs=("u3",), latex="M_3"),
)  # fmt: skip
CLOSED_FORM = ClosedForm(
    complete_for="reduced",
    reduced_because="a parallelogram that has crossed over to an antiparallelogram is left out, as in the paper",
    direct=direct,
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    as_printed=as_printed,
    quantities=quantities,
    constraints=constraints,
    sources=SOURCES,
    signs={
        "s_alpha": Sign("sin_alpha", "1"),
        "s_beta": Sign("sin_beta", "1"),
        "u1": Sign("u1", "l2"),
        "u2": Sign("u2", "l2"),
        "u3": Sign("u3", "l6"),
        "e1": Sign("w", "l2"),
        "e2": Sign("v", "l6"),
        "e3": Sign("sin_beta_minus_alpha", "1"),
    },
    direct_margins=DIRECT_MARGINS,
    inverse_margins=INVERSE_MARGINS,
    factor_list=(
        Factor(
            "u1_minus_u2",
            "parallel",
            "l2",
            "B1C1 and B2C2 are parallel: the platform moves with every input locked",
            latex="u_1-u_2",
            equation="(25), E6",
        ),
        Factor(
            "w", "parallel", "l2", "B1, C1, C2, B2 are collinear: links 9 and 10 lie along Y", latex="w", equation="E7"
        ),
        Factor("v", "parallel", "l6", "parallelogram 1 is flat: B3C3 lies along Y", latex="v", equation="E7"),
        Factor(
            "sin_alpha_minus_beta",
            "parallel",
            "1",
            "D1D2 and D3E3 are parallel",
            latex=r"\sin(\alpha-\beta)",
            equation="E8",
            unit=0,
        ),
        Factor("u1", "serial", "l2", "A1, B1, C1 are collinear", latex="u_1", equation="(26) W1"),
        Factor("u2", "serial", "l2", "A2, B2, C2 are collinear", latex="u_2", equation="(26) W2"),
        Factor("u3", "serial", "l6", "A3, B3, C3 are collinear", latex="u_3", equation="(26) W3"),
        Factor("sin_alpha", "serial", "1", "link 12 lies along X", latex=r"\sin\alpha", equation="E9", unit=0),
        Factor(
            "sin_beta",
            "serial",
            "1",
            "parallelogram 2 is flat: D3E3 lies along X",
            latex=r"\sin\beta",
            equation="E9",
            unit=0,
        ),
    ),
    self_motion_singular=(("u1_minus_u2",),),
    constraint_singular=(("v",), ("sin_beta",), ("u1", "u2")),
    quantity_list=(
        Quantity("A", "length", "(9)", ()),
        Quantity("B", "length", "(9)", ("yA1", "yA2")),
        Quantity("gamma", "angle", "(9)", ("A", "B"), r"\gamma", meaning="angle of B1C1 from the Y axis"),
        Quantity("H1", "length", "(14)", ("gamma",), "H_1"),
        Quantity("H2", "area", "(14)", ("gamma", "yA1", "yA3"), "H_2"),
        Quantity("t", "length", "(14)", ("H1", "H2"), "t"),
        Quantity("J1", "area", "(17)", ("t",), "J_1"),
        Quantity("J2", "area", "(17)", (), "J_2"),
        Quantity("J3", "area", "(17)", ("t",), "J_3"),
        Quantity(
            "alpha", "angle", "(17), (18)", ("J1", "J2", "J3"), r"\alpha", meaning="angle of D1D2 from the X axis"
        ),
        Quantity("beta", "angle", "(16), (19)", ("alpha",), r"\beta", meaning="angle of D3E3 from the X axis"),
        Quantity("yC1", "length", "(20)", (), "y_{C_1}"),
        Quantity("yC2", "length", "(20)", (), "y_{C_2}"),
        Quantity("yC3", "length", "(20)", (), "y_{C_3}"),
        Quantity("zC1", "length", "(20)", ("alpha",), "z_{C_1}"),
        Quantity("zC2", "length", "(20)", ("alpha",), "z_{C_2}"),
        Quantity("zC3", "length", "(11)", ("beta",), "z_{C_3}"),
        Quantity("M1", "area", "(21)", ("zC1",), "M_1"),
        Quantity("M2", "area", "(21)", ("zC2",), "M_2"),
        Quantity("M3", "area", "(21)", ("zC3",), "M_3"),
    ),
    self_motion=SelfMotion("B", "gamma", ("e2", "e3"), self_motion, r"\gamma"),
)
