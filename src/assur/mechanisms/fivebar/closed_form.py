"""Closed form of the planar five-bar: a meeting of two circles in each leg, and one in the direct problem."""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, Quantity, SelfMotion, Sign


def inverse(ns, p, pose, sign):
    """Crank angles at a position of P. Signs: s1, s2, those of sin(B1) and sin(B2)."""
    x, y = pose
    crank1, square1, reach1 = _leg(ns, p, x + p.g, y, sign.s1)
    crank2, square2, reach2 = _leg(ns, p, x - p.g, y, sign.s2)
    margins = {"distance1": square1, "distance2": square2, "reach1": reach1, "reach2": reach2}
    return Branch(pose, (crank1, crank2), margins, _core(p, pose, crank1, crank2))


def _leg(ns, p, dx, dy, sign):
    """Crank direction (cosine, sine) that lets a rod reach the point (dx, dy) from the motor."""
    square = dx * dx + dy * dy
    along = square + p.l1 * p.l1 - p.l2 * p.l2
    reach = 4 * p.l1 * p.l1 * square - along * along
    across = sign * ns.sqrt(reach)
    denominator = 2 * p.l1 * square
    return ((along * dx + across * dy) / denominator, (along * dy - across * dx) / denominator), square, reach


def direct(ns, p, inputs, sign):
    """Position of P at given crank angles. Sign: e, that of sin(P)."""
    crank1, crank2 = inputs
    (x1, y1), (gap_x, gap_y) = _ends(p, crank1, crank2)
    square = gap_x * gap_x + gap_y * gap_y
    meeting = 4 * p.l2 * p.l2 - square
    height = sign.e * ns.sqrt(meeting / square) / 2
    pose = (x1 + gap_x / 2 - height * gap_y, y1 + gap_y / 2 + height * gap_x)
    return Branch(pose, (crank1, crank2), {"gap": square, "meeting": meeting}, _core(p, pose, crank1, crank2))


def self_motion(ns, p, inputs, rod, sign):
    """Where B1 and B2 coincide, P runs round them at the angle of rod 1."""
    crank1, crank2 = inputs
    (x1, y1), _ = _ends(p, crank1, crank2)
    pose = (x1 + p.l2 * rod[0], y1 + p.l2 * rod[1])
    return Branch(pose, (crank1, crank2), {"meeting": 4 * p.l2 * p.l2 + 0 * pose[0]}, _core(p, pose, crank1, crank2))


def _ends(p, crank1, crank2):
    """B1, and the vector from B1 to B2."""
    x1, y1 = p.l1 * crank1[0] - p.g, p.l1 * crank1[1]
    return (x1, y1), (p.l1 * crank2[0] + p.g - x1, p.l1 * crank2[1] - y1)


def _core(p, pose, crank1, crank2):
    x, y = pose
    (x1, y1), (gap_x, gap_y) = _ends(p, crank1, crank2)
    rod1 = ((x - x1) / p.l2, (y - y1) / p.l2)
    rod2 = ((x - x1 - gap_x) / p.l2, (y - y1 - gap_y) / p.l2)
    return SimpleNamespace(
        x=x, y=y, crank1=crank1, crank2=crank2, rod1=rod1, rod2=rod2, gap_x=gap_x, gap_y=gap_y,
        sin_b1=_cross(crank1, rod1), sin_b2=_cross(crank2, rod2), sin_rods=_cross(rod1, rod2),
    )  # fmt: skip


def _cross(first, second):
    return first[0] * second[1] - first[1] * second[0]


def _dot(first, second):
    return first[0] * second[0] + first[1] * second[1]


def joints(ns, p, core):
    """Every joint's value as (cosine, sine)."""
    return {
        "A1": core.crank1,
        "A2": core.crank2,
        "B1": (_dot(core.crank1, core.rod1), core.sin_b1),
        "B2": (_dot(core.crank2, core.rod2), core.sin_b2),
        "P": (_dot(core.rod1, core.rod2), core.sin_rods),
    }


def factors(ns, p, core):
    """Det Jp = sin of the angle between the rods, det Jq = arm1 arm2; the gap B1B2 vanishes in self-motion."""
    return {
        "sin_rods": core.sin_rods,
        "arm1": p.l1 * core.sin_b1,
        "arm2": p.l1 * core.sin_b2,
        "gap_x": core.gap_x,
        "gap_y": core.gap_y,
    }


def jacobians(ns, p, core):
    """The rods are rigid: rod_i . v = l1 sin(B_i) dtheta_i."""
    return (core.rod1, core.rod2), ((p.l1 * core.sin_b1, 0), (0, p.l1 * core.sin_b2))


def quantities(ns, p, core):
    """Angles of the rods from the X axis."""
    return {"rod1": core.rod1, "rod2": core.rod2}


CLOSED_FORM = ClosedForm(
    complete_for="joint_graph",
    direct=direct,
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    quantities=quantities,
    signs={"s1": Sign("sin_b1", "1"), "s2": Sign("sin_b2", "1"), "e": Sign("sin_rods", "1")},
    direct_margins=(
        Margin("gap", "l2*l2", "B1 and B2 coincide: P is free to run round them", unit=2, zero="degenerate"),
        Margin("meeting", "4*l2*l2", "B1 and B2 are too far apart for the rods to meet", unit=2, signs=("e",)),
    ),
    inverse_margins=(
        Margin("distance1", "l2*l2", "P lies on motor A1", unit=2, zero="degenerate"),
        Margin("distance2", "l2*l2", "P lies on motor A2", unit=2, zero="degenerate"),
        Margin("reach1", "4*l1*l1*l2*l2", "P is out of reach of leg 1", unit=4, signs=("s1",)),
        Margin("reach2", "4*l1*l1*l2*l2", "P is out of reach of leg 2", unit=4, signs=("s2",)),
    ),
    factor_list=(
        Factor(
            "sin_rods",
            "parallel",
            "1",
            "B1, P, B2 are collinear: the two rods are in one line",
            r"\sin\angle(B_1P,B_2P)",
            unit=0,
        ),
        Factor("arm1", "serial", "l1", "A1, B1, P are collinear", r"l_1\sin B_1"),
        Factor("arm2", "serial", "l1", "A2, B2, P are collinear", r"l_1\sin B_2"),
        Factor("gap_x", "other", "l2", "B1 and B2 have the same x", r"x_{B_2}-x_{B_1}"),
        Factor("gap_y", "other", "l2", "B1 and B2 have the same y", r"y_{B_2}-y_{B_1}"),
    ),
    self_motion_singular=(("gap_x", "gap_y"),),
    constraint_singular=(("sin_rods", "arm1", "arm2"),),
    quantity_list=(
        Quantity("rod1", "angle", "", meaning="angle of B1P from the X axis"),
        Quantity("rod2", "angle", "", meaning="angle of B2P from the X axis"),
    ),
    self_motion=SelfMotion("gap", "rod1", (), self_motion),
)
