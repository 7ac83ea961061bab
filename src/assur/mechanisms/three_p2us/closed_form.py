"""Closed form of the 3-[P2(US)]: a vertical rail meets a sphere in each leg, three spheres meet in the direct problem.

A leg is computed in its own frame, which is the base's turned about Z: outwards, around, up.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, Sign
from assur.numerics.meetings import three_spheres
from assur.numerics.vectors import about_x, about_y, about_z, apply, cross, product, transposed, triple

LEGS = (0, 1, 2)


def inverse(ns, p, pose, sign):
    """Heights of the sliders at a position of the platform. Signs: s1, s2, s3, + where a slider is above it."""
    sliders, margins = [], {}
    for k, above in enumerate((sign.s1, sign.s2, sign.s3)):
        x, y, z = _wrist(ns, p, k, pose)
        reach = p.l * p.l - x * x - y * y
        sliders.append(z + above * ns.sqrt(reach))
        margins[f"reach{k + 1}"] = reach
    return _branch(ns, p, pose, tuple(sliders), margins)


def direct(ns, p, inputs, sign):
    """Position of the platform at given heights of the sliders. Sign: e, + where it hangs below them."""
    turns = _turns(ns)
    first, second, third = (apply(about_z(turns[k]), (p.R - p.r, 0, inputs[k])) for k in LEGS)
    pose, meeting, normal = three_spheres(ns, (first, second, third), (p.l * p.l,) * 3, -sign.e)
    return _branch(ns, p, pose, tuple(inputs), {"normal": normal, "meeting": meeting})


def _turns(ns):
    """Where the legs are, as (cosine, sine): 0, 120 and 240 deg."""
    one, root = ns.sqrt(1), ns.sqrt(3)
    return ((one, 0), (-one / 2, root / 2), (-one / 2, -root / 2))


def _wrist(ns, p, k, pose):
    """From the rail's zero to the middle of the rods' lower ends, in the leg's frame."""
    x, y, z = apply(transposed(about_z(_turns(ns)[k])), pose)
    return (x + p.r - p.R, y, z)


def _branch(ns, p, pose, sliders, margins):
    legs = [_leg(ns, p, k, pose, sliders[k]) for k in LEGS]
    rods = tuple(leg.rod for leg in legs)
    core = SimpleNamespace(
        legs=legs, sliders=sliders, rods=rods, volume=triple(*rods), couples=triple(*(leg.couple for leg in legs)),
        below=-triple(*rods), above1=-legs[0].up, above2=-legs[1].up, above3=-legs[2].up,
    )  # fmt: skip
    margins |= {f"flat{k + 1}": leg.flat for k, leg in enumerate(legs)}
    return Branch(pose, sliders, margins, core)


def _leg(ns, p, k, pose, slider):
    turn = about_z(_turns(ns)[k])
    x, y, z = _wrist(ns, p, k, pose)
    out, around, up = rod = (x / p.l, y / p.l, (z - slider) / p.l)
    flat = out * out + up * up
    across = ns.sqrt(flat)
    return SimpleNamespace(
        turn=turn,
        rod=apply(turn, rod),
        couple=apply(turn, cross((0, 1, 0), rod)),
        up=up,
        flat=flat,
        first=(-up / across, -out / across),
        second=(across, around),
    )


def joints(ns, p, core):
    """Every joint's value; the second angle of a universal joint is taken between -90 and 90 deg."""
    found = {}
    for k, leg in enumerate(core.legs):
        rod = product(leg.turn, product(product(about_y(leg.first), about_x(leg.second)), transposed(leg.turn)))
        found[f"leg{k + 1}.P"] = core.sliders[k]
        for pair in ("1", "2"):
            found[f"leg{k + 1}.B{pair}.first"] = leg.first
            found[f"leg{k + 1}.B{pair}.second"] = leg.second
            found[f"leg{k + 1}.C{pair}"] = transposed(rod)
    return found


def factors(ns, p, core):
    """Det Jp = the volume that the rods' directions span, det Jq = the product of their shares along Z."""
    return {
        "volume": core.volume,
        **{f"share{k + 1}": core.legs[k].up for k in LEGS},
        "couples": core.couples,
    }


def jacobians(ns, p, core):
    """The rods are rigid: rod_k . v = (rod_k . z) dd_k."""
    first, second, third = (leg.up for leg in core.legs)
    return core.rods, ((first, 0, 0), (0, second, 0), (0, 0, third))


_FLAT = tuple(
    Margin(f"flat{k + 1}", "1", f"the parallelogram of leg {k + 1} is flat: its rods lie along the first axis",
           unit=0, zero="degenerate", latex=rf"1-u_{{{k + 1}y}}^2")
    for k in LEGS
)  # fmt: skip

CLOSED_FORM = ClosedForm(
    complete_for="reduced",
    reduced_because="assemblies in which the platform is turned are left out",
    direct=direct,
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    signs={**{f"s{k + 1}": Sign(f"above{k + 1}", "1") for k in LEGS}, "e": Sign("below", "1")},
    direct_margins=(
        Margin("normal", "l*l*l*l", "the spheres' centres are in one line", unit=4, zero="degenerate"),
        Margin("meeting", "l*l*l*l*l*l", "the sliders are too far apart for the rods to meet", unit=6, signs=("e",)),
        *_FLAT,
    ),
    inverse_margins=(
        *(
            Margin(f"reach{k + 1}", "l*l", f"the platform is out of reach of leg {k + 1}", 2, (f"s{k + 1}",))
            for k in LEGS
        ),
        *_FLAT,
    ),
    factor_list=(
        Factor(
            "volume",
            "parallel",
            "1",
            "the three pairs of rods are parallel to one plane",
            r"\mathbf{u}_1\cdot(\mathbf{u}_2\times\mathbf{u}_3)",
            unit=0,
        ),
        *(
            Factor(f"share{k + 1}", "serial", "1", f"the rods of leg {k + 1} are level", rf"u_{{{k + 1}z}}", unit=0)
            for k in LEGS
        ),
        Factor(
            "couples",
            "other",
            "1",
            "the couples that keep the platform from turning, each across a leg's short links and rods, "
            "are parallel to one plane",
            r"\mathbf{c}_1\cdot(\mathbf{c}_2\times\mathbf{c}_3)",
            unit=0,
        ),
    ),
    constraint_singular=(("couples",), ("volume", "share1", "share2", "share3")),
)
