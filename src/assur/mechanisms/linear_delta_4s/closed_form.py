"""Closed form of the linear Delta: a rail meets a sphere in each leg, three spheres meet in the direct problem.

A leg is computed in its own frame, which is the base's turned about Z: outwards, around, up.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, SelfMotion, Sign
from assur.numerics.meetings import coincident_spheres, three_spheres
from assur.numerics.vectors import (
    about_z,
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

LEGS = (0, 1, 2)
PAIRS = ((0, 1), (1, 2), (0, 2))


def inverse(ns, p, pose, sign):
    """Places of the sliders at a position of the platform. Signs: s1, s2, s3, + where a slider is ahead of it."""
    rail = _rail(ns, p)
    sliders, margins = [], {}
    for k, ahead in enumerate((sign.s1, sign.s2, sign.s3)):
        wrist = _wrist(ns, p, k, pose)
        along = dot(rail, wrist)
        aside = cross(rail, wrist)
        reach = p.l * p.l - dot(aside, aside)
        sliders.append(along + ahead * ns.sqrt(reach))
        margins[f"reach{k + 1}"] = reach
    return _branch(ns, p, pose, tuple(sliders), margins)


def direct(ns, p, inputs, sign):
    """Position of the platform at given places of the sliders. Sign: e, + where it hangs below them."""
    squares = (p.l * p.l,) * 3
    pose, meeting, normal = three_spheres(ns, _centres(ns, p, inputs), squares, -sign.e)
    return _branch(ns, p, pose, tuple(inputs), {"normal": normal, "meeting": meeting})


def self_motion(ns, p, inputs, turn, sign):
    """Where two of the spheres' centres coincide, the platform runs on the circle in which two spheres meet."""
    pose, radicand = coincident_spheres(ns, _centres(ns, p, inputs), p.l * p.l, (0, 1, 0), turn)
    return _branch(ns, p, pose, tuple(inputs), {"meeting": (radicand + 0 * turn[0]) * p.l * p.l * p.l * p.l})


def _turns(ns):
    """Where the legs are, as (cosine, sine): 0, 120 and 240 deg."""
    one, root = ns.sqrt(1), ns.sqrt(3)
    return ((one, 0), (-one / 2, root / 2), (-one / 2, -root / 2))


def _rail(ns, p):
    """Unit vector along a rail, in its leg's frame."""
    return scaled((p.lean, 0, p.rise), 1 / ns.sqrt(p.lean * p.lean + p.rise * p.rise))


def _wrist(ns, p, k, pose):
    """From the rail's zero to the middle of the rods' lower ends, in the leg's frame."""
    x, y, z = apply(transposed(about_z(_turns(ns)[k])), pose)
    return (x + p.r - p.R, y, z)


def _centres(ns, p, sliders):
    """Per leg, about what the platform's centre turns: the slider moved by r towards the middle."""
    turns, rail = _turns(ns), _rail(ns, p)
    return tuple(apply(about_z(turns[k]), (_inner(p, rail, sliders[k]), 0, sliders[k] * rail[2])) for k in LEGS)


def _inner(p, rail, slider):
    """Distance of such a centre from the middle."""
    return p.R - p.r + slider * rail[0]


def _branch(ns, p, pose, sliders, margins):
    legs = [_leg(ns, p, k, pose, sliders[k]) for k in LEGS]
    rods = tuple(leg.rod for leg in legs)
    core = SimpleNamespace(
        legs=legs, rods=rods, volume=triple(*rods), couples=triple(*(leg.couple for leg in legs)),
        below=-triple(*rods), ahead1=-legs[0].share, ahead2=-legs[1].share, ahead3=-legs[2].share,
    )  # fmt: skip
    margins |= {f"upright{k + 1}": 1 - leg.up for k, leg in enumerate(legs)}
    return Branch(pose, sliders, margins, core)


def _leg(ns, p, k, pose, slider):
    turn, rail = about_z(_turns(ns)[k]), _rail(ns, p)
    rod = scaled(subtract(_wrist(ns, p, k, pose), scaled(rail, slider)), 1 / p.l)
    return SimpleNamespace(
        turn=turn,
        slider=slider,
        inner=_inner(p, rail, slider),
        up=rod[2],
        rod=apply(turn, rod),
        couple=apply(turn, cross((0, 1, 0), rod)),
        share=dot(rail, rod),
        tilt=taking((0, 0, -1), rod),
    )


def joints(ns, p, core):
    """Every joint's value; a rod is turned from hanging straight down by the smallest rotation: its spin is free."""
    found = {}
    for k, leg in enumerate(core.legs):
        upper = product(leg.turn, product(leg.tilt, transposed(leg.turn)))
        lower = transposed(upper)
        found[f"leg{k + 1}.P"] = leg.slider
        found |= {f"leg{k + 1}.B1": upper, f"leg{k + 1}.B2": upper, f"leg{k + 1}.C1": lower, f"leg{k + 1}.C2": lower}
    return found


def factors(ns, p, core):
    """Det Jp = the volume that the rods' directions span, det Jq = the product of their shares along the rails."""
    return {
        "volume": core.volume,
        **{f"share{k + 1}": core.legs[k].share for k in LEGS},
        "couples": core.couples,
        **{f"inner{k + 1}": core.legs[k].inner for k in LEGS},
        **{f"level{i + 1}{k + 1}": core.legs[i].slider - core.legs[k].slider for i, k in PAIRS},
    }


def jacobians(ns, p, core):
    """The rods are rigid: rod_k . v = (rod_k . rail_k) dd_k."""
    first, second, third = (leg.share for leg in core.legs)
    return core.rods, ((first, 0, 0), (0, second, 0), (0, 0, third))


_UPRIGHT = tuple(
    Margin(f"upright{k + 1}", "1", f"the rods of leg {k + 1} stand straight up: their joints have no single values",
           unit=0, zero="degenerate", latex=rf"1-u_{{{k + 1}z}}")
    for k in LEGS
)  # fmt: skip

CLOSED_FORM = ClosedForm(
    complete_for="reduced",
    reduced_because="assemblies in which the platform is turned are left out; each rod spins freely",
    direct=direct,
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    signs={**{f"s{k + 1}": Sign(f"ahead{k + 1}", "1") for k in LEGS}, "e": Sign("below", "1")},
    direct_margins=(
        Margin(
            "normal",
            "l*l*l*l",
            "the rods of two legs are parallel: the platform is free to run on a circle",
            unit=4,
            zero="degenerate",
        ),
        Margin("meeting", "l*l*l*l*l*l", "the sliders are too far apart for the rods to meet", unit=6, signs=("e",)),
        *_UPRIGHT,
    ),
    inverse_margins=(
        *(
            Margin(f"reach{k + 1}", "l*l", f"the platform is out of reach of leg {k + 1}", 2, (f"s{k + 1}",))
            for k in LEGS
        ),
        *_UPRIGHT,
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
            Factor(
                f"share{k + 1}",
                "serial",
                "1",
                f"the rods of leg {k + 1} are perpendicular to its rail",
                rf"\mathbf{{u}}_{k + 1}\cdot\mathbf{{a}}_{k + 1}",
                unit=0,
            )
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
        *(
            Factor(
                f"inner{k + 1}",
                "other",
                "R",
                f"the slider of leg {k + 1} is as far out as the rods' lower ends",
                rf"R-r+d_{k + 1}a_x",
            )
            for k in LEGS
        ),
        *(
            Factor(
                f"level{i + 1}{k + 1}",
                "other",
                "l",
                f"the sliders of legs {i + 1} and {k + 1} are equally far along their rails",
                rf"d_{i + 1}-d_{k + 1}",
            )
            for i, k in PAIRS
        ),
    ),
    self_motion_singular=tuple((f"inner{i + 1}", f"inner{k + 1}", f"level{i + 1}{k + 1}") for i, k in PAIRS),
    self_motion=SelfMotion("normal", "turn", (), self_motion, r"\psi"),
    constraint_singular=(("couples",), ("volume", "share1", "share2", "share3")),
)
