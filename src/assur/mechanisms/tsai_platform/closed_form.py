"""Closed form of Tsai's platform: the platform is at the distance b from three points that turn on circles.

In the frame of limb i, turned about Z so that its crank swings in the XZ plane, the rod runs from the crank's end
E = (a cos theta, 0, a sin theta) to F = (x - (r - c), y, z), and n_i is its direction. |F - E| = b is one
equation in cos theta and sin theta; the direct problem is the meeting of three spheres.
Differentiated: n_i . v = (n_i . dE/dtheta) dtheta_i/dt.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, SelfMotion, Sign
from assur.numerics.legs import from_leg, in_leg, pointing, thirds
from assur.numerics.meetings import angle_with, coincident_spheres, three_spheres
from assur.numerics.vectors import (
    cross,
    difference_of_angles,
    dot,
    length,
    opposite,
    scaled,
    subtract,
    triple,
)

NOTHING = 1e-30
"""What 0/0 is taken as one by: beside any other number it is nothing."""


def inverse(ns, p, pose, sign):
    """Crank angles at a pose. Signs: s1, s2, s3, those of sin(B)."""
    cranks, margins = [], {}
    for i, (turn, chosen) in enumerate(zip(thirds(ns), (sign.s1, sign.s2, sign.s3), strict=True), start=1):
        x, y, z = in_leg(turn, pose)
        x = x - (p.r - p.c)
        square = x * x + z * z
        flat = p.b * p.b - y * y
        crank, radicand = angle_with(ns, 2 * p.a * x, 2 * p.a * z, square + p.a * p.a - flat, -chosen)
        cranks.append(crank)
        margins |= {f"distance{i}": square, f"reach{i}": radicand}
    return Branch(tuple(pose), tuple(cranks), margins, _core(ns, p, pose, cranks))


def direct(ns, p, inputs, sign):
    """Pose at given crank angles. Sign: e, that of n1 . (n2 x n3)."""
    square = p.b * p.b
    pose, radicand, normal = three_spheres(ns, _centres(ns, p, inputs), (square, square, square), sign.e)
    return Branch(pose, tuple(inputs), {"normal": normal / square, "meeting": radicand}, _core(ns, p, pose, inputs))


def self_motion(ns, p, inputs, angle, sign):
    """Where the ends of two cranks meet, the platform runs on a circle round the line to the end of the third.

    Ends moved in by c meet on the Z axis only, so the line lies in the plane of the third crank. Where all three
    meet, the platform is free on a sphere, of which this is one circle.
    """
    pose, radicand = coincident_spheres(ns, _centres(ns, p, inputs), p.b * p.b, (0, 1, 0), angle)
    margin = (radicand + 0 * angle[0]) * p.b * p.b * p.b * p.b
    return Branch(pose, tuple(inputs), {"meeting": margin}, _core(ns, p, pose, inputs))


def _centres(ns, p, cranks):
    """The cranks' ends, moved in by c."""
    return tuple(
        from_leg(turn, (p.r - p.c + p.a * cosine, 0, p.a * sine))
        for turn, (cosine, sine) in zip(thirds(ns), cranks, strict=True)
    )


def _core(ns, p, pose, cranks):
    centres = _centres(ns, p, cranks)
    rods = tuple(scaled(subtract(pose, centre), 1 / p.b) for centre in centres)
    arms = [
        p.a * dot(rod, from_leg(turn, (-sine, 0, cosine)))
        for turn, rod, (cosine, sine) in zip(thirds(ns), rods, cranks, strict=True)
    ]
    return SimpleNamespace(
        cranks=tuple(cranks), centres=centres, rods=rods, arm1=arms[0], arm2=arms[1], arm3=arms[2], volume=triple(*rods)
    )


def joints(ns, p, core):
    """Every joint's value as (cosine, sine). Short links of a flat parallelogram, free to turn, do not."""
    found = {}
    for i, (limb, crank, rod) in enumerate(zip(thirds(ns), core.cranks, core.rods, strict=True), start=1):
        x, y, z = in_leg(limb, rod)
        tilt, hinge, _ = pointing(ns, x, z, y, NOTHING)
        found |= {f"leg{i}.A": crank, f"leg{i}.B": difference_of_angles(tilt, crank), f"leg{i}.C": opposite(tilt)}
        found |= {f"leg{i}.D{side}": hinge for side in "ab"} | {f"leg{i}.E{side}": opposite(hinge) for side in "ab"}
    return found


def factors(ns, p, core):
    """Det Jp = n1 . (n2 x n3), det Jq = arm1 arm2 arm3; and what other singularities are made of."""
    (first, second, third), (one, two, three) = core.rods, core.centres
    return {
        "volume": core.volume,
        "arm1": core.arm1,
        "arm2": core.arm2,
        "arm3": core.arm3,
        "sine12": length(ns, cross(first, second)),
        "sine23": length(ns, cross(second, third)),
        "sine31": length(ns, cross(third, first)),
        "gap12": length(ns, subtract(two, one)),
        "gap23": length(ns, subtract(three, two)),
        "gap31": length(ns, subtract(one, three)),
    }


def jacobians(ns, p, core):
    """The rods are rigid: n_i . v = (n_i . dE/dtheta) dtheta_i/dt."""
    return core.rods, ((core.arm1, 0, 0), (0, core.arm2, 0), (0, 0, core.arm3))


PAIRS = (("1", "2"), ("2", "3"), ("3", "1"))

CLOSED_FORM = ClosedForm(
    complete_for="reduced",
    reduced_because="left out are parallelograms that have crossed over, with which the platform may turn, and "
    "those with both short links turned over, half a turn about their revolute axes",
    direct=direct,
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    signs={"s1": Sign("arm1", "a"), "s2": Sign("arm2", "a"), "s3": Sign("arm3", "a"), "e": Sign("volume", "1")},
    direct_margins=(
        Margin("normal", "b*b", "the cranks' ends, moved in by c, are in one line, or two meet", 2, zero="degenerate"),
        Margin("meeting", "b*b*b*b*b*b", "the cranks' ends are too far apart for the rods to meet", 6, ("e",)),
    ),
    inverse_margins=(
        *(
            Margin(f"distance{i}", "b*b", f"the platform's joint lies on the axis of crank {i}", 2, zero="degenerate")
            for i in "123"
        ),
        *(Margin(f"reach{i}", "4*a*a*b*b", f"the platform is out of reach of crank {i}", 4, (f"s{i}",)) for i in "123"),
    ),
    factor_list=(
        Factor(
            "volume", "parallel", "1", "the three rods are parallel to one plane", r"n_1\cdot(n_2\times n_3)", unit=0
        ),
        *(
            Factor(
                f"arm{i}",
                "serial",
                "a",
                f"rod {i} lies in the plane of its crank and its axis",
                rf"n_{i}\cdot\partial E_{i}/\partial\theta_{i}",
            )
            for i in "123"
        ),
        *(
            Factor(f"sine{i}{j}", "other", "1", f"rods {i} and {j} are parallel", rf"|n_{i}\times n_{j}|", unit=0)
            for i, j in PAIRS
        ),
        *(
            Factor(f"gap{i}{j}", "other", "b", f"the ends of cranks {i} and {j}, moved in by c, meet", rf"|E_{i}E_{j}|")
            for i, j in PAIRS
        ),
    ),
    # the rods whose cranks cannot move them must be independent, or Jp and Jq lose a row together
    constraint_singular=(
        ("arm1", "arm2", "arm3", "volume"),
        *((f"arm{i}", f"arm{j}", f"sine{i}{j}") for i, j in PAIRS),
    ),
    self_motion_singular=tuple((f"gap{i}{j}",) for i, j in PAIRS),
    self_motion=SelfMotion("normal", "phi", (), self_motion, r"\varphi"),
)
