"""Closed form of the H4 robot: four spheres, |p +- h u - m_j| = l, with u the direction from one bar to the other.

The bars do not turn. Limb j swings along d_j; about m_j = (its motor and knee, less its place on the bar) the middle of
its bar, p + h u or p - h u, runs on a sphere. In the direct problem the two spheres of a pair meet in a plane,

    a . (p + h u) = ..,  b . (p - h u) = ..,    a = m_2 - m_1 without y,  b = m_4 - m_3 without x.

The point (x of bar 1, y of bar 2, z) is in both, on a line along a x b; w is its place there. With u = (c, s), a sphere
of each bar and c^2 + s^2 = 1 are three quadrics in w, c and s. They meet in eight points, and where neither a nor b is
upright never in a curve: the leading coefficient is -16 (2 h/l)^8 n_z^4, with n the unit vector along a x b.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Eliminant, Factor, Margin, Quantity, Sign
from assur.numerics import resultants
from assur.numerics.meetings import angle_with
from assur.numerics.vectors import (
    about_x,
    about_y,
    add,
    apply,
    cross,
    dot,
    product,
    scaled,
    subtract,
    taking,
    transposed,
    triple,
)

LIMBS = (1, 2, 3, 4)
OUTWARDS = ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))
ALONG_MOTORS = ((0, 1, 0), (0, 1, 0), (1, 0, 0), (1, 0, 0))
DEGREE = 8
STEPS = 2
"""Of Newton's method after the root."""
SMALL = 1e-8
"""Where det Jp is about this part of its scale the steps fade out: there is a double root."""


def inverse(ns, p, pose, sign):
    """Angles of the arms at a pose. Signs: s1 to s4, + where a knee points outwards."""
    arms: list[object] = []
    margins: dict[str, object] = {}
    for k, knee in enumerate((sign.s1, sign.s2, sign.s3, sign.s4)):
        wrist = add(_bar(p, k, pose), scaled(OUTWARDS[k], p.r))
        wrist = subtract(wrist, add(_middle(p, k), scaled(OUTWARDS[k], p.R)))
        out, up = dot(wrist, OUTWARDS[k]), wrist[2]
        arm, reach = angle_with(ns, 2 * p.L * out, -2 * p.L * up, dot(wrist, wrist) + p.L * p.L - p.l * p.l, -knee)
        arms.append(arm)
        margins |= {f"distance{k + 1}": out * out + up * up, f"reach{k + 1}": reach}
    return _branch(ns, p, pose, tuple(arms), margins)


def coefficients(ns, p, inputs):
    """The nine coefficients of the polynomial in t."""
    m, foot, along, _ = _line(ns, p, inputs)
    return resultants.eliminant(_quadrics(p, m, foot, along))


def back(ns, p, inputs, t):
    """The pose of a root, then steps of Newton's method for what rounding left."""
    m, foot, along, crossed = _line(ns, p, inputs)
    u, v, apart = resultants.other_two(_quadrics(p, m, foot, along), t)
    w, cosine, sine = apply(transposed(resultants.ASKEW), (t, u, v))
    square = cosine * cosine + sine * sine
    size = ns.sqrt(square)
    middle = scaled(add(foot, scaled(along, w)), p.l)
    pose = (*add(middle, (-p.h * cosine, p.h * sine, 0)), (cosine / size, sine / size))
    for _ in range(STEPS):
        pose = _improved(ns, p, pose, inputs)
    away = t - resultants.ASKEW[0][0] * dot(along, subtract(m[0], foot))  # at a pose within (6 + sqrt(13))/7
    margins = {"near": 4 - away * away, "crossed": crossed, "apart": apart, "turn": square}
    return _branch(ns, p, pose, tuple(inputs), margins)


def _line(ns, p, inputs):
    """Lengths per l: the centres m_j; the line of (x of bar 1, y of bar 2, z), by its foot and direction; (a x b)^2."""
    m1, m2, m3, m4 = (scaled(_centre(p, k, inputs[k]), 1 / p.l) for k in range(4))
    a, b = subtract(m2, m1), subtract(m4, m3)
    n = cross(a, b)
    crossed = dot(n, n)
    across = add(scaled(cross(b, n), dot(a, add(m1, m2)) / 2), scaled(cross(n, a), dot(b, add(m3, m4)) / 2))
    foot = scaled(across, 1 / crossed)  # a . foot and b . foot are as said, n . foot is zero
    return (m1, m2, m3, m4), foot, scaled(n, 1 / ns.sqrt(crossed)), crossed


def _quadrics(p, m, foot, along):
    """A sphere of each bar, and c^2 + s^2 = 1."""
    side = 2 * p.h / p.l
    bar1 = tuple(zip(subtract(foot, m[0]), ((along[0], 0, 0), (along[1], 0, side), (along[2], 0, 0)), strict=True))
    bar2 = tuple(zip(subtract(foot, m[2]), ((along[0], -side, 0), (along[1], 0, 0), (along[2], 0, 0)), strict=True))
    turn = ((0, (0, 1, 0)), (0, (0, 0, 1)))
    return tuple(resultants.sum_of_squares(forms) for forms in (bar1, bar2, turn))


def _improved(ns, p, pose, arms):
    """The pose after one step of Newton's method on the lengths of the rods."""
    core = _branch(ns, p, pose, arms, {}).core
    n, m = core.rods, core.turning
    missing = tuple(p.l * (1 - dot(rod, rod)) / 2 for rod in n)
    determinant = _determinant(n, m)
    inverse_of = determinant / (determinant * determinant + SMALL * SMALL * p.h * p.h)
    x = _determinant([(turn, rod[1], rod[2]) for rod, turn in zip(n, m, strict=True)], missing)
    y = _determinant([(rod[0], turn, rod[2]) for rod, turn in zip(n, m, strict=True)], missing)
    z = _determinant([(rod[0], rod[1], turn) for rod, turn in zip(n, m, strict=True)], missing)
    moved = subtract(pose[:3], scaled((x, y, z), inverse_of))
    angle = _determinant(n, missing) * inverse_of
    (cosine, sine), size = pose[3], ns.sqrt(1 + angle * angle)
    return (*moved, ((cosine - angle * sine) / size, (sine + angle * cosine) / size))


def _determinant(rows, column):
    """Of four rows of three and a fourth column."""
    a, b, c, d = rows
    minors = (triple(b, c, d), triple(a, c, d), triple(a, b, d), triple(a, b, c))
    return column[1] * minors[1] - column[0] * minors[0] + column[3] * minors[3] - column[2] * minors[2]


def _middle(p, k):
    """The middle between the motors of a limb's pair."""
    return (p.h, -p.E, 0) if k < 2 else (-p.h, 0, 0)


def _bar(p, k, pose):
    """The middle of a limb's bar."""
    cosine, sine = pose[3]
    side = p.h if k < 2 else -p.h
    return (pose[0] + side * cosine, pose[1] + side * sine, pose[2])


def _centre(p, k, arm):
    """About what the middle of the bar runs on a sphere."""
    out = add(_middle(p, k), scaled(OUTWARDS[k], p.R - p.r + p.L * arm[0]))
    return (out[0], out[1], -p.L * arm[1])


def _branch(ns, p, pose, arms, margins):
    cosine, sine = pose[3]
    rods, levers, turning = [], [], []
    for k, (c, s) in enumerate(arms):
        rod = scaled(subtract(_bar(p, k, pose), _centre(p, k, (c, s))), 1 / p.l)
        rods.append(rod)
        levers.append(-p.L * (s * dot(rod, OUTWARDS[k]) + c * rod[2]))
        side = p.h if k < 2 else -p.h
        turning.append(side * (rod[1] * cosine - rod[0] * sine))
        margins[f"upright{k + 1}"] = 1 - rod[2]
    core = SimpleNamespace(
        arms=arms, pose=pose, phi=pose[3], rods=tuple(rods), levers=tuple(levers), turning=tuple(turning),
        lever1=levers[0], lever2=levers[1], lever3=levers[2], lever4=levers[3],
    )  # fmt: skip
    return Branch(pose, arms, margins, core)


def joints(ns, p, core):
    """Every joint's value; a rod is turned from hanging straight down by the smallest rotation: its spin is free."""
    found = {"D1": core.phi, "D2": core.phi}
    for k, ((cosine, sine), rod) in enumerate(zip(core.arms, core.rods, strict=True)):
        turn = (about_y, about_y, about_x, about_x)[k]
        lowering = (1, -1, -1, 1)[k]  # the sense about X or Y in which the arm goes down
        tilt = taking((0, 0, -1), rod)
        upper = product(turn((cosine, -lowering * sine)), tilt)
        lower = transposed(tilt)
        found[f"A{k + 1}"] = (cosine, sine)
        found |= {f"B{k + 1}{side}": upper for side in "ab"} | {f"C{k + 1}{side}": lower for side in "ab"}
    return found


def factors(ns, p, core):
    """Det Jp, the levers, and per pair what keeps its bar from turning: the couples across motors and rods."""
    n = core.rods
    return {
        "lines": _determinant(n, core.turning),
        **{f"lever{k}": lever for k, lever in zip(LIMBS, core.levers, strict=True)},
        "couples1": triple(ALONG_MOTORS[0], n[0], n[1]),
        "couples2": triple(ALONG_MOTORS[2], n[2], n[3]),
    }


def jacobians(ns, p, core):
    """The rods are rigid: n_k . v + m_k dphi/dt = lever_k dq_k/dt."""
    jp = tuple((*rod, moment) for rod, moment in zip(core.rods, core.turning, strict=True))
    jq = tuple(tuple(lever if i == k else 0 for i in range(4)) for k, lever in enumerate(core.levers))
    return jp, jq


def quantities(ns, p, core):
    """The unknown of the direct problem."""
    (x, y, z, (cosine, sine)), (_, _, along, _) = core.pose, _line(ns, p, core.arms)
    return {"t": dot(resultants.ASKEW[0], (dot(along, (x + p.h * cosine, y - p.h * sine, z)) / p.l, cosine, sine))}


_UPRIGHT = tuple(
    Margin(f"upright{k}", "1", f"the rods of limb {k} stand straight up: their joints have no single values", unit=0,
           zero="degenerate", latex=rf"1-n_{{{k}z}}")
    for k in LIMBS
)  # fmt: skip

CLOSED_FORM = ClosedForm(
    complete_for="reduced",
    reduced_because="assemblies in which a bar turns are left out; each rod spins freely",
    direct=Eliminant("t", "plain", DEGREE, coefficients, back),
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    quantities=quantities,
    quantity_list=(
        Quantity("t", "number", "", (), "", "direct", "(6 w/l + 2 cos(phi) + 3 sin(phi))/7, w a place on a line"),
    ),
    signs={f"s{k}": Sign(f"lever{k}", "L") for k in LIMBS},
    direct_margins=(
        Margin("near", "1", "the root is farther away than a sphere reaches", unit=0),
        Margin(
            "crossed",
            "1",
            "the planes in which pairs of spheres meet are parallel, or two spheres coincide",
            unit=4,
            zero="degenerate",
        ),
        Margin("apart", "1", "two poses share the unknown t", unit=2, zero="degenerate"),
        Margin("turn", "1", "the root is no direction from one bar to the other", unit=0, zero="degenerate"),
        *_UPRIGHT,
    ),
    inverse_margins=(
        *(
            Margin(f"distance{k}", "L*L", f"the rods of limb {k} end on the motor's axis", 2, zero="degenerate")
            for k in LIMBS
        ),
        *(Margin(f"reach{k}", "4*L*L*l*l", f"the pose is out of reach of limb {k}", 4, (f"s{k}",)) for k in LIMBS),
        *_UPRIGHT,
    ),
    factor_list=(
        Factor(
            "lines",
            "parallel",
            "h",
            "the rods leave the platform a motion: lines along them, moved to the middles of their bars, and a couple "
            "about X and one about Y are dependent",
            r"\det(n_k,\ \pm h\,n_k\cdot(\mathbf{z}\times u))",
        ),
        *(
            Factor(
                f"lever{k}",
                "serial",
                "L",
                f"the rods of limb {k} lie in the plane of the arm and the motor's axis",
                rf"L\,n_{k}\cdot t_{k}",
            )
            for k in LIMBS
        ),
        Factor(
            "couples1",
            "other",
            "1",
            "the rods of limbs 1 and 2 look parallel along Y: bar 1 can turn",
            r"\mathbf{y}\cdot(n_1\times n_2)",
            unit=0,
        ),
        Factor(
            "couples2",
            "other",
            "1",
            "the rods of limbs 3 and 4 look parallel along X: bar 2 can turn",
            r"\mathbf{x}\cdot(n_3\times n_4)",
            unit=0,
        ),
    ),
    constraint_singular=(("couples1",), ("couples2",), ("lines", "lever1", "lever2", "lever3", "lever4")),
)
