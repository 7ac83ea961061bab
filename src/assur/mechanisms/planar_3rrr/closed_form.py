"""Closed form of the planar 3-RRR mechanism: a meeting of two circles in each leg, and one polynomial of degree six.

Leg i lies at the angle of u_i, one every third of a turn. At given cranks the corners C_i of the platform lie on
three circles about the elbows B_i (see `assur.numerics.triangles`).
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Eliminant, Factor, Margin, Quantity, Sign
from assur.numerics import triangles
from assur.numerics.meetings import angle_with
from assur.numerics.vectors import difference_of_angles, sum_of_angles


def inverse(ns, p, pose, sign):
    """Crank angles at a pose. Signs: s1, s2, s3, those of sin(B)."""
    margins, cranks = {}, []
    signs = (sign.s1, sign.s2, sign.s3)
    for k, (leg, (x, y), s) in enumerate(zip(_legs(ns), _reaches(ns, p, pose), signs, strict=True), 1):
        square = x * x + y * y
        crank, reach = angle_with(ns, 2 * p.l * x, 2 * p.l * y, square + p.l * p.l - p.m * p.m, -s)
        margins |= {f"distance{k}": square, f"reach{k}": reach}
        cranks.append(difference_of_angles(crank, leg))
    return Branch(pose, tuple(cranks), margins, _core(ns, p, pose, cranks))


def _reaches(ns, p, pose):
    """Vectors from A_i to C_i."""
    x, y, phi = pose
    return tuple(
        (x + corner[0] - p.R * leg[0], y + corner[1] - p.R * leg[1])
        for leg, corner in zip(_legs(ns), _turned(ns, p, phi), strict=True)
    )


def coefficients(ns, p, inputs):
    """The seven coefficients of the polynomial in t = tan(phi/2)."""
    return triangles.polynomial(_elbows(ns, p, inputs), _corners(ns, p), _squares(p))


def back(ns, p, inputs, phi):
    """Position at given cranks and platform angle: two linear equations."""
    (x, y), area = triangles.position(_elbows(ns, p, inputs), _corners(ns, p), _squares(p), phi)
    pose = (x, y, phi)
    return Branch(pose, tuple(inputs), {"area": area}, _core(ns, p, pose, inputs))


def _legs(ns):
    """Directions u_i of the legs as (cosine, sine)."""
    sine = ns.sqrt(3) / 2
    return (1, 0), (-0.5, sine), (-0.5, -sine)


def _corners(ns, p):
    return tuple((p.r * leg[0], p.r * leg[1]) for leg in _legs(ns))


def _squares(p):
    return (p.m * p.m,) * 3


def _elbows(ns, p, inputs):
    """B_i, in the base's frame."""
    cranks = _cranks(ns, inputs)
    return tuple(
        (p.R * leg[0] + p.l * crank[0], p.R * leg[1] + p.l * crank[1])
        for leg, crank in zip(_legs(ns), cranks, strict=True)
    )


def _cranks(ns, inputs):
    """Directions of the cranks in the base's frame."""
    return tuple(sum_of_angles(turn, leg) for turn, leg in zip(inputs, _legs(ns), strict=True))


def _turned(ns, p, phi):
    return tuple(triangles.rotated(corner, phi) for corner in _corners(ns, p))


def _core(ns, p, pose, inputs):
    x, y, phi = pose
    corners, cranks = _turned(ns, p, phi), _cranks(ns, inputs)
    rods = tuple(
        ((x + corner[0] - elbow[0]) / p.m, (y + corner[1] - elbow[1]) / p.m)
        for corner, elbow in zip(corners, _elbows(ns, p, inputs), strict=True)
    )
    sines = tuple(triangles.cross(crank, rod) for crank, rod in zip(cranks, rods, strict=True))
    return SimpleNamespace(
        x=x, y=y, phi=phi, inputs=tuple(inputs), rods=rods, sin_b1=sines[0], sin_b2=sines[1], sin_b3=sines[2],
        rows=tuple((*rod, triangles.cross(corner, rod)) for corner, rod in zip(corners, rods, strict=True)),
        lines=triangles.lines(rods, corners),
    )  # fmt: skip


def joints(ns, p, core):
    """Every joint's value: the crank against the base, the rod against the crank, the platform against the rod."""
    values = {}
    turns = zip(core.inputs, _legs(ns), core.rods, strict=True)
    for k, (turn, leg, rod) in enumerate(turns, 1):
        along = difference_of_angles(rod, leg)
        values |= {
            f"leg{k}.A": turn,
            f"leg{k}.B": difference_of_angles(along, turn),
            f"leg{k}.C": difference_of_angles(core.phi, along),
        }
    return values


def factors(ns, p, core):
    """Det Jp is the determinant of the lines of the rods; det Jq is the product of the arms."""
    return {"lines": core.lines, "arm1": p.l * core.sin_b1, "arm2": p.l * core.sin_b2, "arm3": p.l * core.sin_b3}


def jacobians(ns, p, core):
    """The rods are rigid: rod_i . v + (R c_i x rod_i) omega = l sin(B_i) dq_i."""
    return core.rows, ((p.l * core.sin_b1, 0, 0), (0, p.l * core.sin_b2, 0), (0, 0, p.l * core.sin_b3))


def quantities(ns, p, core):
    """Directions of the rods."""
    return {f"rod{k}": rod for k, rod in enumerate(core.rods, 1)}


LEGS = (1, 2, 3)
CLOSED_FORM = ClosedForm(
    complete_for="joint_graph",
    direct=Eliminant("phi", "angle", 6, coefficients, back),
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    quantities=quantities,
    signs={**{f"s{k}": Sign(f"sin_b{k}", "1") for k in LEGS}, "e": Sign("lines", "r")},
    direct_margins=(
        Margin("area", "R*R", "the two linear equations are one: they leave a line", unit=2, zero="degenerate"),
    ),
    inverse_margins=(
        *(Margin(f"distance{k}", "l*l", f"C of leg {k} lies on its motor", unit=2, zero="degenerate") for k in LEGS),
        *(
            Margin(f"reach{k}", "4*l*l*m*m", f"C of leg {k} is out of its reach", unit=4, signs=(f"s{k}",))
            for k in LEGS
        ),
    ),
    factor_list=(
        Factor(
            "lines",
            "parallel",
            "r",
            "the lines of the three rods meet in a point or are parallel",
            r"\det(e_i,\ Rc_i\times e_i)",
        ),
        *(Factor(f"arm{k}", "serial", "l", f"A, B, C of leg {k} are collinear", rf"l\sin B_{k}") for k in LEGS),
    ),
    constraint_singular=(("lines", "arm1", "arm2", "arm3"),),
    quantity_list=tuple(
        Quantity(f"rod{k}", "angle", "", meaning=f"angle of BC of leg {k} from the X axis") for k in LEGS
    ),
)
