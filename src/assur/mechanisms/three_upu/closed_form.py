"""Closed form of the translational 3-UPU: three spheres, |p - c_i| = d_i, and the surfaces on which it begins to turn.

The platform keeps its orientation, so leg i is the vector L_i = p - (R - r) e_i, e_i its radial direction. It acts on
the platform by its force along L_i and by a couple along n_i, the part of L_i across the tangential axis: across both
axes of each of its joints. The couples are dependent where n_1 . (n_2 x n_3) = (3 sqrt(3)/8) z (4(R - r)^2 - x^2 - y^2)
vanishes: on the plane of the base, and on a cylinder about Z.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, Quantity, Sign
from assur.numerics.legs import from_leg, in_leg, pointing, thirds
from assur.numerics.meetings import three_spheres
from assur.numerics.vectors import length, opposite, subtract

LIMBS = (1, 2, 3)


def inverse(ns, p, pose, sign):
    """Leg lengths at a pose. No signs: lengths are positive, and no joint is turned right over."""
    return _branch(ns, p, pose, None, {})


def direct(ns, p, inputs, sign):
    """The pose at given leg lengths. Sign: e, that of z: over or under the plane of the centres c_i."""
    squares = tuple(own * own for own in inputs)
    pose, radicand, square = three_spheres(ns, _centres(ns, p), squares, sign.e)
    return _branch(ns, p, pose, inputs, {"apart": square, "height": radicand / square})


def _centres(ns, p):
    """Where the platform's centre would have to be for each leg to have length zero."""
    return tuple(from_leg(turn, (p.R - p.r, 0, 0)) for turn in thirds(ns))


def _branch(ns, p, pose, lengths, margins):
    vectors = tuple(subtract(pose, centre) for centre in _centres(ns, p))
    if lengths is None:
        lengths = tuple(length(ns, leg) for leg in vectors)
    angles, found = [], dict(margins)
    for n, turn, leg, own in zip(LIMBS, thirds(ns), vectors, lengths, strict=True):
        outward, tangential, up = in_leg(turn, leg)
        found[f"leg{n}"] = outward * outward + up * up
        angles.append(pointing(ns, up / own, outward / own, -tangential / own)[:2])
    core = SimpleNamespace(pose=pose, z=pose[2], lengths=lengths, vectors=vectors, angles=tuple(angles))
    return Branch(pose, lengths, found, core)


def joints(ns, p, core):
    """Every joint's value; a rotation as (cosine, sine). The upper joint turns back what the lower one turns."""
    values = {}
    for n, own, (first, second) in zip(LIMBS, core.lengths, core.angles, strict=True):
        values |= {
            f"leg{n}.A.first": first,
            f"leg{n}.A.second": second,
            f"leg{n}.P": own,
            f"leg{n}.B.first": opposite(second),
            f"leg{n}.B.second": opposite(first),
        }
    return values


def factors(ns, p, core):
    """Det Jp = (3 sqrt(3)/2) (R - r)^2 z, det Jq = d1 d2 d3; the couples divide neither."""
    x, y, z = core.pose
    gap = p.R - p.r
    return {
        "z": z,
        "triangle": 3 * ns.sqrt(3) / 2 * gap * gap + 0 * z,
        "d1": core.lengths[0],
        "d2": core.lengths[1],
        "d3": core.lengths[2],
        "cylinder": 4 * gap * gap - x * x - y * y,
    }


def jacobians(ns, p, core):
    """L_i . v = d_i dd_i/dt."""
    d1, d2, d3 = core.lengths
    return core.vectors, ((d1, 0, 0), (0, d2, 0), (0, 0, d3))


def quantities(ns, p, core):
    """Tilt of each leg about its tangential axis, and the square of the distance from the Z axis."""
    x, y, _ = core.pose
    return {**{f"tilt{n}": first for n, (first, _) in zip(LIMBS, core.angles, strict=True)}, "axial": x * x + y * y}


def constraints(ns, p, core, inputs):
    """The leg lengths that a pose needs, beside the inputs."""
    return {f"A{n}B{n}": pair for n, pair in zip(LIMBS, zip(core.lengths, inputs, strict=True), strict=True)}


_LEGS = tuple(
    Margin(
        f"leg{n}", "R*R", f"leg {n} lies along its tangential axis, about which it can turn", unit=2, zero="degenerate"
    )
    for n in LIMBS
)

CLOSED_FORM = ClosedForm(
    complete_for="reduced",
    reduced_because="assemblies in which the platform turns are left out, and those with a joint turned right over or "
    "a leg of negative length",
    direct=direct,
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    quantities=quantities,
    constraints=constraints,
    signs={"e": Sign("z", "R")},
    direct_margins=(
        Margin("apart", "R*R*R*R", "R = r: the three spheres have one centre", unit=4, zero="degenerate"),
        Margin("height", "R*R", "the three legs are too short to meet, or one is too long", unit=2, signs=("e",)),
        *_LEGS,
    ),
    inverse_margins=_LEGS,
    factor_list=(
        Factor("z", "parallel", "R", "the three legs lie in the plane of the base", "z"),
        Factor(
            "triangle", "parallel", "R*R", "R = r: the three legs are parallel", r"\frac{3\sqrt{3}}{2}(R-r)^2", unit=2
        ),
        *(Factor(f"d{n}", "serial", "R", f"leg {n} has no length", f"d_{n}") for n in LIMBS),
        Factor(
            "cylinder",
            "other",
            "R*R",
            "the normals of the three joints are parallel to one plane: the platform begins to turn",
            r"4(R-r)^2-x^2-y^2",
            unit=2,
        ),
    ),
    constraint_singular=(("z",), ("cylinder",)),
    quantity_list=(
        *(Quantity(f"tilt{n}", "angle", "", meaning=f"turn of leg {n} about its tangential axis") for n in LIMBS),
        Quantity("axial", "area", "", meaning="square of the distance from the Z axis"),
    ),
)
