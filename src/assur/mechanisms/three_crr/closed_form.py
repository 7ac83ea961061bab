"""Closed form of the 3-CRR: u . (p - c) = q for each rod, linear in the pose; each knee is where two circles meet."""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, Quantity, Sign
from assur.numerics.legs import from_leg, in_leg, thirds, two_bars
from assur.numerics.vectors import dot, opposite, scaled, triple

LIMBS = (1, 2, 3)


def inverse(ns, p, pose, sign):
    """Translations on the rods at a pose. Signs: k1, k2, k3, those of sin(B) of each limb."""
    axis = _axis(ns, p)
    back = (p.R - p.r) * axis[0]  # what the feet and the platform's hinges are apart, along each rod
    inputs = tuple(dot(axis, in_leg(turn, pose)) - back for turn in thirds(ns))
    return _branch(ns, p, pose, inputs, (sign.k1, sign.k2, sign.k3))


def direct(ns, p, inputs, sign):
    """The pose at given translations: one, whatever the knees do. Signs: e1, e2, e3, those of sin(B).

    With a_i = q_i sqrt(1 + rise^2) + R - r the three equations are (radial direction i) . (x, y) + rise z = a_i.
    """
    stretch = ns.sqrt(1 + p.rise * p.rise)
    a1, a2, a3 = (part * stretch + p.R - p.r for part in inputs)
    pose = ((2 * a1 - a2 - a3) / 3, (a2 - a3) / ns.sqrt(3), (a1 + a2 + a3) / (3 * p.rise))
    return _branch(ns, p, pose, inputs, (sign.e1, sign.e2, sign.e3))


def _axis(ns, p):
    """Unit direction of a rod, in its limb's frame: outwards, tangential, up."""
    long = ns.sqrt(1 + p.rise * p.rise)
    return (1 / long, 0, p.rise / long)


def _branch(ns, p, pose, inputs, signs):
    """Limb i works in the plane across its rod: C's tangential and its upward coordinate from the rod."""
    out, _, rise = _axis(ns, p)
    margins, legs = {}, []
    for n, turn, knee in zip(LIMBS, thirds(ns), signs, strict=True):
        x, y, z = in_leg(turn, pose)
        leg = two_bars(ns, (y, out * z - rise * (x - p.R + p.r)), p.l1, p.l2, knee)
        legs.append(leg)
        margins |= {f"distance{n}": leg.square, f"reach{n}": leg.radicand}
    core = SimpleNamespace(inputs=inputs, legs=legs, **{f"knee{n}": legs[n - 1].elbow[1] for n in LIMBS})
    return Branch(pose, inputs, margins, core)


def joints(ns, p, core):
    """Every joint's value; a rotation as (cosine, sine)."""
    values = {}
    for n, slide, leg in zip(LIMBS, core.inputs, core.legs, strict=True):
        values |= {f"leg{n}.A.translation": slide, f"leg{n}.A.rotation": leg.crank}
        values |= {f"leg{n}.B": leg.elbow, f"leg{n}.C": opposite(leg.rod)}
    return values


def _axes(ns, p):
    """Unit directions of the rods."""
    return tuple(from_leg(turn, _axis(ns, p)) for turn in thirds(ns))


def factors(ns, p, core):
    """The sine of each knee divides both determinants, because both problems branch there."""
    knees = {n: leg.elbow[1] for n, leg in zip(LIMBS, core.legs, strict=True)}
    return {
        "axes": triple(*_axes(ns, p)),
        **{f"knee{n}": knees[n] for n in LIMBS},
        **{f"border{n}": knees[n] for n in LIMBS},
    }


def jacobians(ns, p, core):
    """U . v = dq/dt for each rod, times the sine of the limb's knee: a straight limb says nothing of the rates."""
    knees = (core.knee1, core.knee2, core.knee3)
    jp = tuple(scaled(axis, knee) for axis, knee in zip(_axes(ns, p), knees, strict=True))
    return jp, ((core.knee1, 0, 0), (0, core.knee2, 0), (0, 0, core.knee3))


def quantities(ns, p, core):
    """Directions of the rods in the planes of their limbs."""
    return {f"rod{n}": leg.rod for n, leg in zip(LIMBS, core.legs, strict=True)}


def constraints(ns, p, core, inputs):
    """The distance from C to the platform's centre, less that along the rod which a pose and inputs leave over."""
    return {f"C{n}O": (p.r + own - given, p.r) for n, own, given in zip(LIMBS, core.inputs, inputs, strict=True)}


def _margins(signs, scale):
    """Where a limb's circles meet. The direct problem is more lenient: it finds again what is given back."""
    pairs = [
        (
            Margin(f"distance{n}", scale, f"C of limb {n} lies on its rod", unit=2, zero="degenerate"),
            Margin(f"reach{n}", scale, f"the platform is out of reach of limb {n}", unit=2, signs=(name,)),
        )
        for n, name in zip(LIMBS, signs, strict=True)
    ]
    return tuple(margin for pair in pairs for margin in pair)


CLOSED_FORM = ClosedForm(
    complete_for="joint_graph",
    direct=direct,
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    quantities=quantities,
    constraints=constraints,
    signs={f"{letter}{n}": Sign(f"knee{n}", "1") for letter in "ke" for n in LIMBS},
    direct_margins=_margins(("e1", "e2", "e3"), "l2*l2"),
    inverse_margins=_margins(("k1", "k2", "k3"), "l2*l2/2"),
    factor_list=(
        Factor("axes", "parallel", "1", "the three rods are parallel to one plane", r"u_1\cdot(u_2\times u_3)", unit=0),
        *(
            Factor(
                f"knee{n}",
                "parallel",
                "1",
                f"A, B, C of limb {n} are in one line: its knee moves while every input stands still",
                rf"\sin B_{n}",
                unit=0,
            )
            for n in LIMBS
        ),
        *(
            Factor(
                f"border{n}",
                "serial",
                "1",
                f"A, B, C of limb {n} are in one line: the platform cannot go on along it",
                rf"\sin B_{n}",
                unit=0,
            )
            for n in LIMBS
        ),
    ),
    quantity_list=tuple(
        Quantity(f"rod{n}", "angle", "", meaning=f"angle of BC of limb {n} in its plane") for n in LIMBS
    ),
)
