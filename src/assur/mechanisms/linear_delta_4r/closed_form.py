"""Closed form of the linear Delta: the platform is at the distance L from three points that slide on upright lines.

In the frame of limb i, turned about Z so that its rail is over the X axis, n_i is the direction of its rod from
the platform to the slider: L n_i = (R - r - x, -y, q_i - z). So q_i = z + s_i sqrt(L^2 - (R - r - x)^2 - y^2), and
the direct problem is the meeting of three spheres. Differentiated: n_i . v = (n_i . e_z) dq_i/dt.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, Sign
from assur.numerics.meetings import three_spheres
from assur.numerics.vectors import scaled, subtract, triple

NOTHING = 1e-30
"""What 0/0 is taken as one by: beside any other number it is nothing."""


def inverse(ns, p, pose, sign):
    """Inputs at a pose. Signs: s1, s2, s3, those of cos(B)."""
    radicands, inputs = [], []
    for limb, chosen in zip(_limbs(ns), (sign.s1, sign.s2, sign.s3), strict=True):
        x, y = _local(limb, pose)
        radicand = p.L * p.L - y * y - (p.R - p.r - x) * (p.R - p.r - x)
        radicands.append(radicand)
        inputs.append(pose[2] + chosen * ns.sqrt(radicand))
    margins = {f"reach{i + 1}": radicands[i] for i in range(3)}
    return Branch(tuple(pose), tuple(inputs), margins, _core(ns, p, pose, inputs))


def direct(ns, p, inputs, sign):
    """Pose at given inputs. Sign: e, that of n1 . (n2 x n3)."""
    square = p.L * p.L
    pose, radicand, normal = three_spheres(ns, _centres(ns, p, inputs), (square, square, square), -sign.e)
    return Branch(pose, tuple(inputs), {"normal": normal / square, "meeting": radicand}, _core(ns, p, pose, inputs))


def _limbs(ns):
    """Directions (cosine, sine) of the limbs, 120 deg apart."""
    cosine, sine = -ns.sqrt(1) / 2, ns.sqrt(3) / 2
    return (1, 0), (cosine, sine), (cosine, -sine)


def _local(limb, vector):
    """The first two components of a vector in the frame of a limb."""
    cosine, sine = limb
    return cosine * vector[0] + sine * vector[1], cosine * vector[1] - sine * vector[0]


def _centres(ns, p, inputs):
    reach = p.R - p.r
    return tuple((reach * limb[0], reach * limb[1], q) for limb, q in zip(_limbs(ns), inputs, strict=True))


def _core(ns, p, pose, inputs):
    rods = tuple(scaled(subtract(centre, pose), 1 / p.L) for centre in _centres(ns, p, inputs))
    local = tuple((*_local(limb, rod), rod[2]) for limb, rod in zip(_limbs(ns), rods, strict=True))
    return SimpleNamespace(
        pose=tuple(pose), inputs=tuple(inputs), rods=rods, local=local,
        widths=tuple(ns.sqrt(rod[0] * rod[0] + rod[2] * rod[2]) for rod in local),
        arm1=rods[0][2], arm2=rods[1][2], arm3=rods[2][2], volume=triple(*rods),
    )  # fmt: skip


def joints(ns, p, core):
    """Every joint's value; a revolute as (cosine, sine). Short links of a flat parallelogram, free to turn, do not."""
    found = {}
    for i, (rod, width) in enumerate(zip(core.local, core.widths, strict=True)):
        hinge, turn = (width, -rod[1]), ((rod[2] + NOTHING) / (width + NOTHING), rod[0] / (width + NOTHING))
        leg = f"leg{i + 1}"
        found |= {f"{leg}.A": core.inputs[i], f"{leg}.B": turn, f"{leg}.C": _back(turn)}
        found |= {f"{leg}.Da": hinge, f"{leg}.Db": hinge, f"{leg}.Ea": _back(hinge), f"{leg}.Eb": _back(hinge)}
    return found


def _back(angle):
    cosine, sine = angle
    return (cosine, -sine)


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
