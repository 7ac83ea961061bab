"""Closed form of the 3-RRC: two circles in each limb; and three cylinders, one polynomial of degree eight.

In limb i, with radial direction e_i, the rod runs from the end of the crank at (rho_i, zeta_i), outward and upward and
less the platform's radius, to (e_i . p, z): (e_i . p - rho_i)^2 + (z - zeta_i)^2 = l2^2. Three such cylinders meet in
eight points at most, and never in a curve: z alone satisfies a polynomial with the leading coefficient 9.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Eliminant, Factor, Margin, Quantity, Sign
from assur.numerics.meetings import angle_with
from assur.numerics.resultants import ASKEW, eliminant, nearer, other_two, sum_of_squares
from assur.numerics.vectors import add, apply, difference_of_angles, dot, scaled, transposed, triple

LIMBS = (1, 2, 3)


def inverse(ns, p, pose, sign):
    """Crank angles at a pose. Signs: s1, s2, s3, those of sin(B) of each limb."""
    margins, cranks = {}, []
    for n, radial, elbow in zip(LIMBS, _radial(ns), (sign.s1, sign.s2, sign.s3), strict=True):
        outward, up = dot(radial, pose) - (p.R - p.r), pose[2]
        square = outward * outward + up * up
        along = (square + p.l1 * p.l1 - p.l2 * p.l2) / (2 * p.l1)
        crank, reach = angle_with(ns, outward, up, along, -elbow)
        margins |= {f"distance{n}": square, f"reach{n}": reach}
        cranks.append(crank)
    return Branch(pose, tuple(cranks), margins, _core(ns, p, pose, tuple(cranks)))


def coefficients(ns, p, inputs):
    """The nine coefficients of the polynomial in t, the pose's coordinate along ASKEW[0] in units of l2."""
    return eliminant(tuple(sum_of_squares(own) for own in _cylinders(ns, _ends(p, inputs))))


def back(ns, p, inputs, t):
    """The pose at a root: the other two coordinates, then two steps of least squares for what rounding left."""
    cylinders = _cylinders(ns, _ends(p, inputs))
    x, y, apart = other_two(tuple(sum_of_squares(own) for own in cylinders), t)
    pose = scaled(nearer(cylinders, apply(transposed(ASKEW), (t, x, y))), p.l2)
    return Branch(pose, tuple(inputs), {"apart": apart}, _core(ns, p, pose, tuple(inputs)))


def _radial(ns):
    """Radial directions of the limbs."""
    half = ns.sqrt(3) / 2
    return ((1, 0, 0), (-1 / 2, half, 0), (-1 / 2, -half, 0))


def _ends(p, cranks):
    """Ends of the cranks (rho_i, zeta_i) in units of l2."""
    return tuple(((p.R - p.r + p.l1 * cosine) / p.l2, p.l1 * sine / p.l2) for cosine, sine in cranks)


def _cylinders(ns, ends):
    """Forms e_i . p - rho_i and z - zeta_i, whose squares add up to 1 on a cylinder."""
    return tuple(((-rho, e), (-zeta, (0, 0, 1))) for e, (rho, zeta) in zip(_radial(ns), ends, strict=True))


def _rods(ns, ends, point):
    """Vectors of the rods, across their axes, in units of l2."""
    return tuple(
        add(scaled(e, dot(e, point) - rho), (0, 0, point[2] - zeta))
        for e, (rho, zeta) in zip(_radial(ns), ends, strict=True)
    )


def _core(ns, p, pose, cranks):
    ends = _ends(p, cranks)
    rods = _rods(ns, ends, scaled(pose, 1 / p.l2))
    planar = tuple((dot(e, rod), rod[2]) for e, rod in zip(_radial(ns), rods, strict=True))
    elbows = tuple(difference_of_angles(rod, crank) for rod, crank in zip(planar, cranks, strict=True))
    return SimpleNamespace(
        pose=pose, cranks=cranks, rods=rods, planar=planar, elbows=elbows, normals=triple(*rods),
        **{f"sin{n}": elbow[1] for n, elbow in zip(LIMBS, elbows, strict=True)},
    )  # fmt: skip


def joints(ns, p, core):
    """Every joint's value; a rotation as (cosine, sine). The tangential axes point to the right of outward."""
    values = {}
    for n, (c, s, _), crank, rod, elbow in zip(LIMBS, _radial(ns), core.cranks, core.planar, core.elbows, strict=True):
        values |= {
            f"leg{n}.A": crank,
            f"leg{n}.B": elbow,
            f"leg{n}.C.translation": s * core.pose[0] - c * core.pose[1],
            f"leg{n}.C.rotation": (rod[0], -rod[1]),
        }
    return values


def factors(ns, p, core):
    """Det Jp is the triple product of the rods, det Jq the product of the arms."""
    return {
        "normals": core.normals,
        **{f"arm{n}": p.l1 * elbow[1] for n, elbow in zip(LIMBS, core.elbows, strict=True)},
        **{f"out{n}": rod[0] for n, rod in zip(LIMBS, core.planar, strict=True)},
    }


def jacobians(ns, p, core):
    """The rods are rigid across their axes: rod_i . v = l1 sin(B_i) dtheta_i."""
    arm1, arm2, arm3 = (p.l1 * elbow[1] for elbow in core.elbows)
    return core.rods, ((arm1, 0, 0), (0, arm2, 0), (0, 0, arm3))


def quantities(ns, p, core):
    """The unknown of the direct problem, and the directions of the rods."""
    directions = {f"phi{n}": rod for n, rod in zip(LIMBS, core.planar, strict=True)}
    return {"t": dot(ASKEW[0], core.pose) / p.l2, **directions}


def constraints(ns, p, core, inputs):
    """The lengths |BC| across the axes that given inputs and a given pose would need."""
    rods = _rods(ns, _ends(p, inputs), scaled(core.pose, 1 / p.l2))
    return {f"B{n}C{n}": (p.l2 * ns.sqrt(dot(rod, rod)), p.l2) for n, rod in zip(LIMBS, rods, strict=True)}


CLOSED_FORM = ClosedForm(
    complete_for="joint_graph",
    direct=Eliminant("t", "plain", 8, coefficients, back),
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    quantities=quantities,
    constraints=constraints,
    signs={**{f"s{n}": Sign(f"sin{n}", "1") for n in LIMBS}, "e": Sign("normals", "1")},
    direct_margins=(Margin("apart", "1", "two poses share the unknown t", unit=2, zero="degenerate"),),
    inverse_margins=tuple(
        margin
        for n in LIMBS
        for margin in (
            Margin(f"distance{n}", "l2*l2", f"C of limb {n} lies on the axis of its motor", unit=2, zero="degenerate"),
            Margin(f"reach{n}", "l2*l2", f"the platform is out of reach of limb {n}", unit=2, signs=(f"s{n}",)),
        )
    ),
    factor_list=(
        Factor(
            "normals",
            "parallel",
            "1",
            "the three rods are parallel to one plane",
            r"\mathbf{d}_1\cdot(\mathbf{d}_2\times\mathbf{d}_3)",
            unit=0,
        ),
        *(Factor(f"arm{n}", "serial", "l1", f"A, B, C of limb {n} are in line", rf"l_1\sin B_{n}") for n in LIMBS),
        *(Factor(f"out{n}", "other", "1", f"rod {n} stands upright", rf"\cos\varphi_{n}", unit=0) for n in LIMBS),
    ),
    constraint_singular=(
        ("normals", "arm1", "arm2", "arm3"),
        ("out1", "out2", "arm1", "arm2"),
        ("out2", "out3", "arm2", "arm3"),
        ("out3", "out1", "arm3", "arm1"),
    ),
    quantity_list=(
        Quantity("t", "number", "", meaning="(6 x + 2 y + 3 z)/(7 l2), the unknown of the direct problem"),
        *(Quantity(f"phi{n}", "angle", "", latex=rf"\varphi_{n}", meaning=f"rise of rod {n}") for n in LIMBS),
    ),
)
