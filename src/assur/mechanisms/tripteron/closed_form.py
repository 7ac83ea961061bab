"""Closed form of the tripteron: every input is a coordinate of the platform; the knees follow from two circles each."""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, Quantity, Sign
from assur.numerics.legs import two_bars
from assur.numerics.vectors import opposite

LIMBS = (1, 2, 3)


def inverse(ns, p, pose, sign):
    """Slider positions at a pose. Signs: k1, k2, k3, those of sin(B) of each limb."""
    return _branch(ns, p, pose, tuple(part - p.e for part in pose), (sign.k1, sign.k2, sign.k3))


def direct(ns, p, inputs, sign):
    """The pose at given slider positions: one, whatever the knees do. Signs: e1, e2, e3, those of sin(B)."""
    return _branch(ns, p, tuple(part + p.e for part in inputs), inputs, (sign.e1, sign.e2, sign.e3))


def _branch(ns, p, pose, inputs, knees):
    """Limb i works in the plane across its rail, in which C has the two other coordinates of the platform."""
    x, y, z = pose
    legs = [two_bars(ns, end, p.l1, p.l2, knee) for end, knee in zip(((y, z), (z, x), (x, y)), knees, strict=True)]
    margins = {f"distance{n}": leg.square for n, leg in zip(LIMBS, legs, strict=True)}
    margins |= {f"reach{n}": leg.radicand for n, leg in zip(LIMBS, legs, strict=True)}
    core = SimpleNamespace(inputs=inputs, legs=legs, **{f"knee{n}": legs[n - 1].elbow[1] for n in LIMBS})
    return Branch(pose, inputs, margins, core)


def joints(ns, p, core):
    """Every joint's value; a revolute as (cosine, sine)."""
    values = {}
    for n, slider, leg in zip(LIMBS, core.inputs, core.legs, strict=True):
        values |= {f"leg{n}.P": slider, f"leg{n}.A": leg.crank, f"leg{n}.B": leg.elbow, f"leg{n}.C": opposite(leg.rod)}
    return values


def factors(ns, p, core):
    """The sine of each knee divides both determinants, because both problems branch there."""
    knees = {n: leg.elbow[1] for n, leg in zip(LIMBS, core.legs, strict=True)}
    return {**{f"knee{n}": knees[n] for n in LIMBS}, **{f"border{n}": knees[n] for n in LIMBS}}


def jacobians(ns, p, core):
    """dx/dt = dq/dt for each rail, times the sine of the limb's knee: a straight limb says nothing of the rates."""
    rows = ((core.knee1, 0, 0), (0, core.knee2, 0), (0, 0, core.knee3))
    return rows, rows


def quantities(ns, p, core):
    """Directions of the rods in the planes of their limbs."""
    return {f"rod{n}": leg.rod for n, leg in zip(LIMBS, core.legs, strict=True)}


def constraints(ns, p, core, inputs):
    """The distance e from C to the platform's centre along each rail, that a pose and inputs would need."""
    return {f"C{n}O": (own - given + p.e, p.e) for n, own, given in zip(LIMBS, core.inputs, inputs, strict=True)}


def _margins(signs, scale):
    """Where a limb's circles meet. The direct problem is more lenient: it finds again what is given back."""
    pairs = [
        (
            Margin(f"distance{n}", scale, f"C of limb {n} lies on the hinge A", unit=2, zero="degenerate"),
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
