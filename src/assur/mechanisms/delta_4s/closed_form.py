"""Closed form of the Delta robot: for each leg one equation a cos + b sin = c; in the direct problem three spheres.

A leg is computed in its own frame, which is the base's turned about Z: outwards, along the motor's axis, up.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, SelfMotion, Sign
from assur.numerics.meetings import angle_with, coincident_spheres, three_spheres
from assur.numerics.vectors import (
    about_y,
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
    """Angles of the arms at a position of the platform. Signs: s1, s2, s3, + where a knee points outwards."""
    arms, margins = [], {}
    for k, knee in enumerate((sign.s1, sign.s2, sign.s3)):
        x, y, z = _wrist(ns, p, k, pose)
        square = x * x + y * y + z * z
        arm, reach = angle_with(ns, 2 * p.L * x, -2 * p.L * z, square + p.L * p.L - p.l * p.l, -knee)
        arms.append(arm)
        margins[f"distance{k + 1}"] = x * x + z * z
        margins[f"reach{k + 1}"] = reach
    return _branch(ns, p, pose, tuple(arms), margins)


def direct(ns, p, inputs, sign):
    """Position of the platform at given angles of the arms. Sign: e, + where it hangs below the knees."""
    squares = (p.l * p.l,) * 3
    pose, meeting, normal = three_spheres(ns, _centres(ns, p, inputs), squares, -sign.e)
    return _branch(ns, p, pose, tuple(inputs), {"normal": normal, "meeting": meeting})


def self_motion(ns, p, inputs, turn, sign):
    """Where two of the spheres' centres coincide, the platform runs on the circle in which two spheres meet."""
    pose, radicand = coincident_spheres(ns, _centres(ns, p, inputs), p.l * p.l, (1, 0, 0), turn)
    return _branch(ns, p, pose, tuple(inputs), {"meeting": (radicand + 0 * turn[0]) * p.l * p.l * p.l * p.l})


def _turns(ns):
    """Where the legs are, as (cosine, sine): -90, 30 and 150 deg."""
    one, root = ns.sqrt(1), ns.sqrt(3)
    return ((0, -one), (root / 2, one / 2), (-root / 2, one / 2))


def _wrist(ns, p, k, pose):
    """From the motor of a leg to the middle of its rods' lower ends, in the leg's frame."""
    x, y, z = apply(transposed(about_z(_turns(ns)[k])), pose)
    return (x + p.uP - p.wB, y, z)


def _centres(ns, p, arms):
    """Per leg, about what the platform's centre turns: the knee moved by uP towards the middle."""
    turns = _turns(ns)
    return tuple(apply(about_z(turns[k]), (_inner(p, arms[k]), 0, -p.L * arms[k][1])) for k in LEGS)


def _inner(p, arm):
    """Distance of such a centre from the middle."""
    return p.wB - p.uP + p.L * arm[0]


def _branch(ns, p, pose, arms, margins):
    legs = [_leg(ns, p, k, pose, arms[k]) for k in LEGS]
    rods = tuple(leg.rod for leg in legs)
    core = SimpleNamespace(
        legs=legs, rods=rods, volume=triple(*rods), couples=triple(*(leg.couple for leg in legs)),
        below=-triple(*rods), lever1=legs[0].lever, lever2=legs[1].lever, lever3=legs[2].lever,
    )  # fmt: skip
    margins |= {f"upright{k + 1}": 1 - leg.up for k, leg in enumerate(legs)}
    return Branch(pose, arms, margins, core)


def _leg(ns, p, k, pose, arm):
    cosine, sine = arm
    turn = about_z(_turns(ns)[k])
    to_wrist = subtract(_wrist(ns, p, k, pose), (p.L * cosine, 0, -p.L * sine))
    rod = scaled(to_wrist, 1 / p.l)
    return SimpleNamespace(
        turn=turn,
        arm=arm,
        inner=_inner(p, arm),
        up=rod[2],
        rod=apply(turn, rod),
        couple=apply(turn, cross((0, 1, 0), rod)),
        lever=p.L * dot(rod, (-sine, 0, -cosine)),
        tilt=taking((0, 0, -1), rod),
    )


def joints(ns, p, core):
    """Every joint's value; a rod is turned from hanging straight down by the smallest rotation: its spin is free."""
    found = {}
    for k, leg in enumerate(core.legs):
        cosine, sine = leg.arm
        back = transposed(leg.turn)
        upper = product(leg.turn, product(product(about_y((cosine, -sine)), leg.tilt), back))
        lower = product(leg.turn, product(transposed(leg.tilt), back))
        found[f"leg{k + 1}.A"] = leg.arm
        found |= {f"leg{k + 1}.B1": upper, f"leg{k + 1}.B2": upper, f"leg{k + 1}.C1": lower, f"leg{k + 1}.C2": lower}
    return found


def factors(ns, p, core):
    """Det Jp = the volume that the rods' directions span, det Jq = the product of the levers."""
    return {
        "volume": core.volume,
        "lever1": core.lever1,
        "lever2": core.lever2,
        "lever3": core.lever3,
        "couples": core.couples,
        **{f"inner{k + 1}": core.legs[k].inner for k in LEGS},
        **{f"level{i + 1}{k + 1}": p.L * (core.legs[i].arm[1] - core.legs[k].arm[1]) for i, k in PAIRS},
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
