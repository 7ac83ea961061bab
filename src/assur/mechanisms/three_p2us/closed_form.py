"""Closed form of the 3-[P2(US)]: a vertical rail meets a sphere in each leg, three spheres meet in the direct problem.

A leg's frame is the base's turned about Z: outwards, around, up. As the platform does not turn, its centre is at the
distance l from three points: the sliders moved by r towards the middle.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, Sign
from assur.numerics.legs import couples, from_leg, in_leg, pointing, thirds
from assur.numerics.meetings import three_spheres
from assur.numerics.vectors import about_x, about_y, about_z, opposite, product, scaled, subtract, transposed, triple

LEGS = (0, 1, 2)


def inverse(ns, p, pose, sign):
    """Heights of the sliders at a position of the platform. Signs: s1, s2, s3, + where a slider is above it."""
    sliders, margins = [], {}
    for k, (turn, above) in enumerate(zip(thirds(ns), (sign.s1, sign.s2, sign.s3), strict=True), start=1):
        x, y, z = in_leg(turn, pose)
        x = x + p.r - p.R
        reach = p.l * p.l - x * x - y * y
        sliders.append(z + above * ns.sqrt(reach))
        margins[f"reach{k}"] = reach
    return _branch(ns, p, pose, tuple(sliders), margins)


def direct(ns, p, inputs, sign):
    """Position of the platform at given heights of the sliders. Sign: e, + where it hangs below them."""
    pose, meeting, normal = three_spheres(ns, _centres(ns, p, inputs), (p.l * p.l,) * 3, -sign.e)
    return _branch(ns, p, pose, tuple(inputs), {"normal": normal, "meeting": meeting})


def _centres(ns, p, sliders):
    return tuple(from_leg(turn, (p.R - p.r, 0, slider)) for turn, slider in zip(thirds(ns), sliders, strict=True))


def _branch(ns, p, pose, sliders, margins):
    turns = thirds(ns)
    rods = tuple(scaled(subtract(pose, centre), 1 / p.l) for centre in _centres(ns, p, sliders))
    angles = []
    for k, (turn, rod) in enumerate(zip(turns, rods, strict=True), start=1):
        out, around, up = in_leg(turn, rod)
        first, second, margins[f"flat{k}"] = pointing(ns, -up, -out, around)
        angles.append((first, second))
    volume = triple(*rods)
    core = SimpleNamespace(
        sliders=sliders, rods=rods, angles=angles, volume=volume, couples=couples(turns, rods),
        below=-volume, above1=-rods[0][2], above2=-rods[1][2], above3=-rods[2][2],
    )  # fmt: skip
    return Branch(pose, sliders, margins, core)


def joints(ns, p, core):
    """Every joint's value; the second angle of a universal joint is taken between -90 and 90 deg."""
    found = {}
    for k, (turn, slider, (first, second)) in enumerate(zip(thirds(ns), core.sliders, core.angles, strict=True), 1):
        rod = product(about_z(turn), product(product(about_y(first), about_x(second)), about_z(opposite(turn))))
        found[f"leg{k}.P"] = slider
        for pair in ("1", "2"):
            found[f"leg{k}.B{pair}.first"] = first
            found[f"leg{k}.B{pair}.second"] = second
            found[f"leg{k}.C{pair}"] = transposed(rod)
    return found


def factors(ns, p, core):
    """Det Jp = the volume that the rods' directions span, det Jq = the product of their shares along Z."""
    return {
        "volume": core.volume,
        **{f"share{k + 1}": core.rods[k][2] for k in LEGS},
        "couples": core.couples,
    }


def jacobians(ns, p, core):
    """The rods are rigid: rod_k . v = (rod_k . z) dd_k."""
    first, second, third = (rod[2] for rod in core.rods)
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
