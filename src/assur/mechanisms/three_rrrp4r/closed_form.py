"""Closed form of the inverse problem of the 3-RRRP(4R) mechanism; its direct problem has none that we know.

In the frame of limb i, turned about Z so that its crank swings in the XZ plane, crank, link and rods lead to
(x - (r - c), y, z) = l1 (cos theta, 0, sin theta) + l2 (cos psi, 0, sin psi) + l3 (0, -sin delta, cos delta). The
component along the revolute axes gives delta, and the meeting of two circles gives theta. At given cranks each limb
leaves the platform a surface of degree 4, X^2 + (Z - h)^2 = l2^2 with h^2 = l3^2 - Y^2 and (X, Y, Z) counted from the
crank's end; three of them meet in at most 64 points. Differentiated, with N the normal of that surface as it comes out
of link and rods: N_i . v = (N_i . dE/dtheta) dtheta_i/dt = l1 cos(delta_i) sin(B_i) dtheta_i/dt.
"""

from itertools import product
from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, Sign
from assur.numerics.legs import from_leg, in_leg, thirds
from assur.numerics.meetings import angle_with
from assur.numerics.vectors import cross, difference_of_angles, length, opposite, triple


def inverse(ns, p, pose, sign):
    """Crank angles at a pose. Signs: h1, h2, h3, those of cos(Da), and s1, s2, s3, those of sin(B)."""
    margins, limbs = {}, []
    signs = ((sign.h1, sign.s1), (sign.h2, sign.s2), (sign.h3, sign.s3))
    for i, (turn, (upward, bent)) in enumerate(zip(thirds(ns), signs, strict=True), start=1):
        x, y, z = in_leg(turn, pose)
        x = x - (p.r - p.c)
        level = p.l3 * p.l3 - y * y
        height = upward * ns.sqrt(level)
        z = z - height
        square = x * x + z * z
        right = square + p.l1 * p.l1 - p.l2 * p.l2
        crank, radicand = angle_with(ns, 2 * p.l1 * x, 2 * p.l1 * z, right, -bent)
        link = ((x - p.l1 * crank[0]) / p.l2, (z - p.l1 * crank[1]) / p.l2)
        limbs.append(SimpleNamespace(crank=crank, link=link, hinge=(height / p.l3, -y / p.l3)))
        margins |= {f"level{i}": level, f"distance{i}": square, f"reach{i}": radicand}
    return Branch(tuple(pose), tuple(limb.crank for limb in limbs), margins, _core(ns, p, limbs))


def _core(ns, p, limbs):
    elbows = [difference_of_angles(limb.link, limb.crank) for limb in limbs]
    normals = []
    for turn, limb in zip(thirds(ns), limbs, strict=True):
        (out, up), (cosine, sine) = limb.link, limb.hinge
        normals.append(from_leg(turn, (out * cosine, -up * sine, up * cosine)))
    return SimpleNamespace(
        limbs=tuple(limbs), elbows=tuple(elbows), normals=tuple(normals), volume=triple(*normals),
        rise1=limbs[0].hinge[0], rise2=limbs[1].hinge[0], rise3=limbs[2].hinge[0],
        arm1=p.l1 * elbows[0][1], arm2=p.l1 * elbows[1][1], arm3=p.l1 * elbows[2][1],
    )  # fmt: skip


def joints(ns, p, core):
    """Every joint's value as (cosine, sine)."""
    found = {}
    for i, (limb, elbow) in enumerate(zip(core.limbs, core.elbows, strict=True), start=1):
        found |= {f"leg{i}.A": limb.crank, f"leg{i}.B": elbow, f"leg{i}.C": opposite(limb.link)}
        found |= {f"leg{i}.Da": limb.hinge, f"leg{i}.Db": limb.hinge}
        found |= {f"leg{i}.Ea": opposite(limb.hinge), f"leg{i}.Eb": opposite(limb.hinge)}
    return found


def factors(ns, p, core):
    """Det Jp = N1 . (N2 x N3), det Jq = arm1 arm2 arm3 rise1 rise2 rise3; and what constraint singularities need."""
    first, second, third = core.normals
    return {
        "volume": core.volume,
        "arm1": core.arm1,
        "arm2": core.arm2,
        "arm3": core.arm3,
        "rise1": core.rise1,
        "rise2": core.rise2,
        "rise3": core.rise3,
        "sine12": length(ns, cross(first, second)),
        "sine23": length(ns, cross(second, third)),
        "sine31": length(ns, cross(third, first)),
    }


def jacobians(ns, p, core):
    """N_i . v = l1 cos(delta_i) sin(B_i) dtheta_i/dt."""
    rates = (core.arm1 * core.rise1, core.arm2 * core.rise2, core.arm3 * core.rise3)
    return core.normals, ((rates[0], 0, 0), (0, rates[1], 0), (0, 0, rates[2]))


PAIRS = (("1", "2"), ("2", "3"), ("3", "1"))

CLOSED_FORM = ClosedForm(
    complete_for="reduced",
    reduced_because="left out are parallelograms that have crossed over, with which the platform may turn",
    direct=None,
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    signs={f"h{i}": Sign(f"rise{i}", "1") for i in "123"} | {f"s{i}": Sign(f"arm{i}", "l1") for i in "123"},
    direct_margins=(),
    inverse_margins=(
        *(
            Margin(f"level{i}", "l3*l3", f"the platform is out of reach of the rods of limb {i}", 2, (f"h{i}",))
            for i in "123"
        ),
        *(
            Margin(f"distance{i}", "l2*l2", f"the rods' lower end lies on the axis of crank {i}", 2, zero="degenerate")
            for i in "123"
        ),
        *(
            Margin(f"reach{i}", "4*l1*l1*l2*l2", f"the platform is out of reach of crank {i}", 4, (f"s{i}",))
            for i in "123"
        ),
    ),
    factor_list=(
        Factor(
            "volume",
            "parallel",
            "1",
            "the planes of link and rods of the three limbs are parallel to one line",
            r"N_1\cdot(N_2\times N_3)",
            unit=0,
        ),
        *(Factor(f"arm{i}", "serial", "l1", f"crank and link {i} are in one line", rf"l_1\sin B_{i}") for i in "123"),
        *(Factor(f"rise{i}", "serial", "1", f"parallelogram {i} is flat", rf"\cos\delta_{i}", unit=0) for i in "123"),
        *(
            Factor(
                f"sine{i}{j}",
                "other",
                "1",
                f"the planes of link and rods {i} and {j} are parallel",
                rf"|N_{i}\times N_{j}|",
                unit=0,
            )
            for i, j in PAIRS
        ),
    ),
    # the limbs whose cranks cannot move them must have independent normals, or Jp and Jq lose a row together
    constraint_singular=(
        *((*stopped, "volume") for stopped in product(("arm1", "rise1"), ("arm2", "rise2"), ("arm3", "rise3"))),
        *(
            (*stopped, f"sine{i}{j}")
            for i, j in PAIRS
            for stopped in product((f"arm{i}", f"rise{i}"), (f"arm{j}", f"rise{j}"))
        ),
    ),
)
