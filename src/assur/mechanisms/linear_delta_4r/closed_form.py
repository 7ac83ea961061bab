"""Closed form of the linear Delta: the platform is at the distance L from three points that slide on upright lines.

In the frame of limb i, turned about Z so that its rail is over the X axis, n_i is the direction of its rod from
the platform to the slider: L n_i = (R - r - x, -y, q_i - z). So q_i = z + s_i sqrt(L^2 - (R - r - x)^2 - y^2), and
the direct problem is the meeting of three spheres. Differentiated: n_i . v = (n_i . e_z) dq_i/dt.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, Sign
from assur.numerics.legs import from_leg, in_leg, pointing, thirds
from assur.numerics.meetings import three_spheres
from assur.numerics.vectors import opposite, scaled, subtract, triple

NOTHING = 1e-30
"""What 0/0 is taken as one by: beside any other number it is nothing."""


def inverse(ns, p, pose, sign):
    """Inputs at a pose. Signs: s1, s2, s3, those of cos(B)."""
    margins, inputs = {}, []
    for i, (turn, chosen) in enumerate(zip(thirds(ns), (sign.s1, sign.s2, sign.s3), strict=True), start=1):
        x, y, z = in_leg(turn, pose)
        radicand = p.L * p.L - y * y - (p.R - p.r - x) * (p.R - p.r - x)
        inputs.append(z + chosen * ns.sqrt(radicand))
        margins[f"reach{i}"] = radicand
    return Branch(tuple(pose), tuple(inputs), margins, _core(ns, p, pose, inputs))


def direct(ns, p, inputs, sign):
    """Pose at given inputs. Sign: e, that of n1 . (n2 x n3)."""
    square = p.L * p.L
    pose, radicand, normal = three_spheres(ns, _centres(ns, p, inputs), (square, square, square), -sign.e)
    return Branch(pose, tuple(inputs), {"normal": normal / square, "meeting": radicand}, _core(ns, p, pose, inputs))


def _centres(ns, p, inputs):
    return tuple(from_leg(turn, (p.R - p.r, 0, q)) for turn, q in zip(thirds(ns), inputs, strict=True))


def _core(ns, p, pose, inputs):
    rods = tuple(scaled(subtract(centre, pose), 1 / p.L) for centre in _centres(ns, p, inputs))
    return SimpleNamespace(
        inputs=tuple(inputs), rods=rods, arm1=rods[0][2], arm2=rods[1][2], arm3=rods[2][2], volume=triple(*rods)
    )


def joints(ns, p, core):
    """Every joint's value; a revolute as (cosine, sine). Short links of a flat parallelogram, free to turn, do not."""
    found = {}
    for i, (limb, q, rod) in enumerate(zip(thirds(ns), core.inputs, core.rods, strict=True), start=1):
        x, y, z = in_leg(limb, rod)
        turn, hinge, _ = pointing(ns, z, x, -y, NOTHING)
        found |= {f"leg{i}.A": q, f"leg{i}.B": turn, f"leg{i}.C": opposite(turn)}
        found |= {f"leg{i}.D{side}": hinge for side in "ab"} | {f"leg{i}.E{side}": opposite(hinge) for side in "ab"}
    return found


def factors(ns, p, core):
    """Det Jp = n1 . (n2 x n3), det Jq = arm1 arm2 arm3."""
    return {
        "volume": core.volume,
        "arm1": core.arm1,
        "arm2": core.arm2,
        "arm3": core.arm3,
    }


def jacobians(ns, p, core):
    """The rods are rigid: n_i . v = (n_i . e_z) dq_i/dt."""
    return core.rods, ((core.arm1, 0, 0), (0, core.arm2, 0), (0, 0, core.arm3))


CLOSED_FORM = ClosedForm(
    complete_for="reduced",
    reduced_because="left out are parallelograms that have crossed over, with which the platform may turn, and "
    "those with both short links turned over, half a turn about their revolute axes",
    direct=direct,
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    signs={"s1": Sign("arm1", "1"), "s2": Sign("arm2", "1"), "s3": Sign("arm3", "1"), "e": Sign("volume", "1")},
    direct_margins=(
        Margin("normal", "L*L", "the three rails, moved in by r, are one: R = r", 2, zero="degenerate"),
        Margin("meeting", "L*L*L*L*L*L", "the sliders are too far apart for the rods to meet", unit=6, signs=("e",)),
    ),
    inverse_margins=(
        *(Margin(f"reach{i}", "L*L", f"the platform is out of reach of rail {i}", 2, (f"s{i}",)) for i in "123"),
    ),
    factor_list=(
        Factor(
            "volume", "parallel", "1", "the three rods are parallel to one plane", r"n_1\cdot(n_2\times n_3)", unit=0
        ),
        *(
            Factor(f"arm{i}", "serial", "1", f"rod {i} is perpendicular to its rail", rf"n_{i}\cdot e_z", unit=0)
            for i in "123"
        ),
    ),
    # two rods that are level and parallel would be out of reach of the third
    constraint_singular=(("arm1", "arm2", "arm3", "volume"),),
)
