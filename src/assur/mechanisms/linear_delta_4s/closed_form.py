"""Closed form of the linear Delta: a rail meets a sphere in each leg, three spheres meet in the direct problem.

A leg's frame is the base's turned about Z: outwards, around, up. As the platform does not turn, its centre is at the
distance l from three points: the sliders moved by r towards the middle.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, SelfMotion, Sign
from assur.numerics.legs import couples, from_leg, in_leg, thirds
from assur.numerics.meetings import coincident_spheres, three_spheres
from assur.numerics.vectors import cross, dot, scaled, subtract, taking, transposed, triple

LEGS = (0, 1, 2)
PAIRS = ((0, 1), (1, 2), (0, 2))


def inverse(ns, p, pose, sign):
    """Places of the sliders at a position of the platform. Signs: s1, s2, s3, + where a slider is ahead of it."""
    rail = _rail(ns, p)
    sliders, margins = [], {}
    for k, (turn, ahead) in enumerate(zip(thirds(ns), (sign.s1, sign.s2, sign.s3), strict=True), start=1):
        x, y, z = in_leg(turn, pose)
        wrist = (x + p.r - p.R, y, z)
        aside = cross(rail, wrist)
        reach = p.l * p.l - dot(aside, aside)
        sliders.append(dot(rail, wrist) + ahead * ns.sqrt(reach))
        margins[f"reach{k}"] = reach
    return _branch(ns, p, pose, tuple(sliders), margins)


def direct(ns, p, inputs, sign):
    """Position of the platform at given places of the sliders. Sign: e, + where it hangs below them."""
    pose, meeting, normal = three_spheres(ns, _centres(ns, p, inputs), (p.l * p.l,) * 3, -sign.e)
    return _branch(ns, p, pose, tuple(inputs), {"normal": normal, "meeting": meeting})


def self_motion(ns, p, inputs, turn, sign):
    """Where two of the spheres' centres coincide, the platform runs on the circle in which two spheres meet."""
    pose, radicand = coincident_spheres(ns, _centres(ns, p, inputs), p.l * p.l, (0, 1, 0), turn)
    return _branch(ns, p, pose, tuple(inputs), {"meeting": (radicand + 0 * turn[0]) * p.l * p.l * p.l * p.l})


def _rail(ns, p):
    """Unit vector along a rail, in its leg's frame."""
    return scaled((p.lean, 0, p.rise), 1 / ns.sqrt(p.lean * p.lean + p.rise * p.rise))


def _inner(ns, p, slider):
    """Distance of a sphere's centre from the middle."""
    return p.R - p.r + slider * _rail(ns, p)[0]


def _centres(ns, p, sliders):
    rise = _rail(ns, p)[2]
    return tuple(from_leg(t, (_inner(ns, p, d), 0, d * rise)) for t, d in zip(thirds(ns), sliders, strict=True))


def _branch(ns, p, pose, sliders, margins):
    turns, rail = thirds(ns), _rail(ns, p)
    rods = tuple(scaled(subtract(pose, centre), 1 / p.l) for centre in _centres(ns, p, sliders))
    shares = tuple(dot(from_leg(turn, rail), rod) for turn, rod in zip(turns, rods, strict=True))
    volume = triple(*rods)
    core = SimpleNamespace(
        sliders=sliders, rods=rods, shares=shares, volume=volume, couples=couples(turns, rods),
        below=-volume, ahead1=-shares[0], ahead2=-shares[1], ahead3=-shares[2],
    )  # fmt: skip
    margins |= {f"upright{k}": 1 - rod[2] for k, rod in enumerate(rods, start=1)}
    return Branch(pose, sliders, margins, core)


def joints(ns, p, core):
    """Every joint's value; a rod is turned from hanging straight down by the smallest rotation: its spin is free."""
    found = {}
    for k, (slider, rod) in enumerate(zip(core.sliders, core.rods, strict=True), start=1):
        upper = taking((0, 0, -1), rod)
        lower = transposed(upper)
        found[f"leg{k}.P"] = slider
        found |= {f"leg{k}.B1": upper, f"leg{k}.B2": upper, f"leg{k}.C1": lower, f"leg{k}.C2": lower}
    return found


def factors(ns, p, core):
    """Det Jp = the volume that the rods' directions span, det Jq = the product of their shares along the rails."""
    return {
        "volume": core.volume,
        **{f"share{k + 1}": core.shares[k] for k in LEGS},
        "couples": core.couples,
        **{f"inner{k + 1}": _inner(ns, p, core.sliders[k]) for k in LEGS},
        **{f"level{i + 1}{k + 1}": core.sliders[i] - core.sliders[k] for i, k in PAIRS},
    }


def jacobians(ns, p, core):
    """The rods are rigid: rod_k . v = (rod_k . rail_k) dd_k."""
    first, second, third = core.shares
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
