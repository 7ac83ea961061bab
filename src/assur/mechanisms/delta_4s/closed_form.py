"""Closed form of the Delta robot: for each leg one equation a cos + b sin = c; in the direct problem three spheres.

A leg's frame is the base's turned about Z: outwards, along the motor's axis, up. As the platform does not turn, its
centre is at the distance l from three points: the knees moved by uP towards the middle.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, SelfMotion, Sign
from assur.numerics.legs import couples, from_leg, in_leg, thirds
from assur.numerics.meetings import angle_with, coincident_spheres, three_spheres
from assur.numerics.vectors import (
    about_y,
    about_z,
    dot,
    opposite,
    product,
    scaled,
    subtract,
    sum_of_angles,
    taking,
    transposed,
    triple,
)

LEGS = (0, 1, 2)
PAIRS = ((0, 1), (1, 2), (0, 2))


def inverse(ns, p, pose, sign):
    """Angles of the arms at a position of the platform. Signs: s1, s2, s3, + where a knee points outwards."""
    arms, margins = [], {}
    for k, (turn, knee) in enumerate(zip(_turns(ns), (sign.s1, sign.s2, sign.s3), strict=True), start=1):
        x, y, z = in_leg(turn, pose)
        x = x + p.uP - p.wB
        square = x * x + y * y + z * z
        arm, reach = angle_with(ns, 2 * p.L * x, -2 * p.L * z, square + p.L * p.L - p.l * p.l, -knee)
        arms.append(arm)
        margins[f"distance{k}"] = x * x + z * z
        margins[f"reach{k}"] = reach
    return _branch(ns, p, pose, tuple(arms), margins)


def direct(ns, p, inputs, sign):
    """Position of the platform at given angles of the arms. Sign: e, + where it hangs below the knees."""
    pose, meeting, normal = three_spheres(ns, _centres(ns, p, inputs), (p.l * p.l,) * 3, -sign.e)
    return _branch(ns, p, pose, tuple(inputs), {"normal": normal, "meeting": meeting})


def self_motion(ns, p, inputs, turn, sign):
    """Where two of the spheres' centres coincide, the platform runs on the circle in which two spheres meet."""
    pose, radicand = coincident_spheres(ns, _centres(ns, p, inputs), p.l * p.l, (1, 0, 0), turn)
    return _branch(ns, p, pose, tuple(inputs), {"meeting": (radicand + 0 * turn[0]) * p.l * p.l * p.l * p.l})


def _turns(ns):
    """Where the legs are, as (cosine, sine): -90, 30 and 150 deg."""
    return tuple(sum_of_angles(turn, (0, -1)) for turn in thirds(ns))


def _inner(p, arm):
    """Distance of a sphere's centre from the middle."""
    return p.wB - p.uP + p.L * arm[0]


def _centres(ns, p, arms):
    return tuple(from_leg(t, (_inner(p, arm), 0, -p.L * arm[1])) for t, arm in zip(_turns(ns), arms, strict=True))


def _branch(ns, p, pose, arms, margins):
    turns = _turns(ns)
    rods = tuple(scaled(subtract(pose, centre), 1 / p.l) for centre in _centres(ns, p, arms))
    lever1, lever2, lever3 = (
        p.L * dot(rod, from_leg(turn, (-arm[1], 0, -arm[0]))) for turn, rod, arm in zip(turns, rods, arms, strict=True)
    )
    volume = triple(*rods)
    core = SimpleNamespace(
        arms=arms, rods=rods, volume=volume, couples=couples(turns, rods),
        below=-volume, lever1=lever1, lever2=lever2, lever3=lever3,
    )  # fmt: skip
    margins |= {f"upright{k}": 1 - rod[2] for k, rod in enumerate(rods, start=1)}
    return Branch(pose, arms, margins, core)


def joints(ns, p, core):
    """Every joint's value; a rod is turned from hanging straight down by the smallest rotation: its spin is free."""
    found = {}
    for k, (turn, arm, rod) in enumerate(zip(_turns(ns), core.arms, core.rods, strict=True), start=1):
        tilt = taking((0, 0, -1), rod)
        back = product(product(about_z(turn), about_y(opposite(arm))), about_z(opposite(turn)))
        upper, lower = product(back, tilt), transposed(tilt)
        found[f"leg{k}.A"] = arm
        found |= {f"leg{k}.B1": upper, f"leg{k}.B2": upper, f"leg{k}.C1": lower, f"leg{k}.C2": lower}
    return found


def factors(ns, p, core):
    """Det Jp = the volume that the rods' directions span, det Jq = the product of the levers."""
    return {
        "volume": core.volume,
        "lever1": core.lever1,
        "lever2": core.lever2,
        "lever3": core.lever3,
        "couples": core.couples,
        **{f"inner{k + 1}": _inner(p, core.arms[k]) for k in LEGS},
        **{f"level{i + 1}{k + 1}": p.L * (core.arms[i][1] - core.arms[k][1]) for i, k in PAIRS},
    }


def jacobians(ns, p, core):
    """The rods are rigid: rod_k . v = lever_k dtheta_k."""
    return core.rods, ((core.lever1, 0, 0), (0, core.lever2, 0), (0, 0, core.lever3))


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
    signs={**{f"s{k + 1}": Sign(f"lever{k + 1}", "L") for k in LEGS}, "e": Sign("below", "1")},
    direct_margins=(
        Margin(
            "normal",
            "l*l*l*l",
            "the rods of two legs are parallel: the platform is free to run on a circle",
            unit=4,
            zero="degenerate",
        ),
        Margin("meeting", "l*l*l*l*l*l", "the knees are too far apart for the rods to meet", unit=6, signs=("e",)),
        *_UPRIGHT,
    ),
    inverse_margins=(
        *(
            Margin(f"distance{k + 1}", "L*L", f"the rods of leg {k + 1} end on the motor's axis", 2, zero="degenerate")
            for k in LEGS
        ),
        *(
            Margin(f"reach{k + 1}", "4*L*L*l*l", f"the platform is out of reach of leg {k + 1}", 4, (f"s{k + 1}",))
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
                f"lever{k + 1}",
                "serial",
                "L",
                f"the rods of leg {k + 1} lie in the plane of the arm and the motor's axis",
                rf"L\,\mathbf{{u}}_{k + 1}\cdot\mathbf{{t}}_{k + 1}",
            )
            for k in LEGS
        ),
        Factor(
            "couples",
            "other",
            "1",
            "the couples that keep the platform from turning, each across a leg's motor axis and rods, "
            "are parallel to one plane",
            r"\mathbf{c}_1\cdot(\mathbf{c}_2\times\mathbf{c}_3)",
            unit=0,
        ),
        *(
            Factor(
                f"inner{k + 1}",
                "other",
                "L",
                f"the knee of leg {k + 1} is as far out as the rods' lower ends",
                rf"w_B-u_P+L\cos\theta_{k + 1}",
            )
            for k in LEGS
        ),
        *(
            Factor(
                f"level{i + 1}{k + 1}",
                "other",
                "L",
                f"the knees of legs {i + 1} and {k + 1} are on one level",
                rf"L(\sin\theta_{i + 1}-\sin\theta_{k + 1})",
            )
            for i, k in PAIRS
        ),
    ),
    self_motion_singular=tuple((f"inner{i + 1}", f"inner{k + 1}", f"level{i + 1}{k + 1}") for i, k in PAIRS),
    self_motion=SelfMotion("normal", "turn", (), self_motion, r"\psi"),
    constraint_singular=(("couples",), ("volume", "lever1", "lever2", "lever3")),
)
