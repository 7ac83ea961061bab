"""Closed form of the biglide: each rod reaches for its rail, and the rods meet over the middle of their feet."""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, Sign


def inverse(ns, p, pose, sign):
    """Sliders at a position of P. Signs: s1, s2, those of the cosines of the rods."""
    x, y = pose
    height1 = p.r1 * p.r1 - y * y
    height2 = p.r2 * p.r2 - y * y
    arm1 = sign.s1 * ns.sqrt(height1)
    arm2 = sign.s2 * ns.sqrt(height2)
    core = _core(p, x, y, arm1, arm2)
    return Branch(pose, (core.q1, core.q2), {"height1": height1, "height2": height2}, core)


def direct(ns, p, inputs, sign):
    """Position of P. Sign: e, that of sin(P)."""
    q1, q2 = inputs
    gap = q2 - q1
    along = (gap * gap + p.r1 * p.r1 - p.r2 * p.r2) / (2 * gap)
    square = p.r1 * p.r1 - along * along
    y = sign.e * ns.sqrt(square) * (gap / ns.sqrt(gap * gap))
    core = _core(p, q1 + along, y, along, along - gap)
    return Branch((core.x, core.y), (q1, q2), {"gap": gap, "square": square}, core)


def _core(p, x, y, arm1, arm2):
    rod1 = (arm1 / p.r1, y / p.r1)
    rod2 = (arm2 / p.r2, y / p.r2)
    return SimpleNamespace(
        x=x, y=y, q1=x - arm1, q2=x - arm2, arm1=arm1, arm2=arm2, rod1=rod1, rod2=rod2,
        turn=rod1[0] * rod2[1] - rod1[1] * rod2[0],
    )  # fmt: skip


def joints(ns, p, core):
    """Every joint's value; a revolute as (cosine, sine)."""
    return {
        "S1": core.q1,
        "S2": core.q2,
        "B1": core.rod1,
        "B2": core.rod2,
        "P": (core.rod1[0] * core.rod2[0] + core.rod1[1] * core.rod2[1], core.turn),
    }


def factors(ns, p, core):
    """The rods in line, or flat on the rail; each rod upright."""
    return {"gap": core.arm1 - core.arm2, "y": core.y, "arm1": core.arm1, "arm2": core.arm2}


def jacobians(ns, p, core):
    """The rods are rigid: arm_i (x' - q_i') + y y' = 0."""
    jp = ((core.arm1, core.y), (core.arm2, core.y))
    jq = ((core.arm1, 0), (0, core.arm2))
    return jp, jq


CLOSED_FORM = ClosedForm(
    complete_for="joint_graph",
    direct=direct,
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    signs={"s1": Sign("arm1", "r1"), "s2": Sign("arm2", "r2"), "e": Sign("turn", "1")},
    direct_margins=(
        Margin("gap", "r1", "both sliders are in one place", unit=1, zero="degenerate"),
        Margin("square", "r1*r1", "the sliders are too far apart for the rods to meet", unit=2, signs=("e",)),
    ),
    inverse_margins=(
        Margin("height1", "r1*r1", "P is too high for rod 1", unit=2, signs=("s1",)),
        Margin("height2", "r2*r2", "P is too high for rod 2", unit=2, signs=("s2",)),
    ),
    factor_list=(
        Factor("gap", "parallel", "r1", "both sliders are in one place"),
        Factor("y", "parallel", "r1", "the rods lie along the rail"),
        Factor("arm1", "serial", "r1", "rod 1 is upright"),
        Factor("arm2", "serial", "r2", "rod 2 is upright"),
    ),
)
