"""Closed form of the Orthoglide: the platform is at the distance L from three points that slide on the axes.

In the frame of a limb its rail is the X axis and its revolute axes are along Y. With n_i the direction of rod i from
the platform to the slider, L n_i = q_i e_i - p; so q_i = x + s_i sqrt(L^2 - y^2 - z^2), and the direct
problem is the meeting of three spheres. Differentiated: n_i . v = (n_i . e_i) dq_i/dt.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, SelfMotion, Sign
from assur.numerics.legs import pointing
from assur.numerics.meetings import coincident_spheres, three_spheres
from assur.numerics.vectors import cross, length, opposite, scaled, subtract, triple

NOTHING = 1e-30
"""What 0/0 is taken as one by: beside any other number it is nothing."""


def inverse(ns, p, pose, sign):
    """Inputs at a pose. Signs: s1, s2, s3, those of cos(B)."""
    margins, inputs = {}, []
    for i, ((x, y, z), chosen) in enumerate(zip(_local(pose), (sign.s1, sign.s2, sign.s3), strict=True), start=1):
        radicand = p.L * p.L - y * y - z * z
        inputs.append(x + chosen * ns.sqrt(radicand))
        margins[f"reach{i}"] = radicand
    return Branch(tuple(pose), tuple(inputs), margins, _core(ns, p, pose, inputs))


def direct(ns, p, inputs, sign):
    """Pose at given inputs. Sign: e, that of n1 . (n2 x n3)."""
    square = p.L * p.L
    pose, radicand, normal = three_spheres(ns, _centres(inputs), (square, square, square), -sign.e)
    return Branch(pose, tuple(inputs), {"normal": normal / square, "meeting": radicand}, _core(ns, p, pose, inputs))


def self_motion(ns, p, inputs, angle, sign):
    """Where two sliders meet in the origin, the platform runs on a circle round the third rail, at an angle round it.

    Where all three meet it is free on a sphere, of which this is one circle.
    """
    pose, radicand = coincident_spheres(ns, _centres(inputs), p.L * p.L, (1, 1, 0), angle)
    margin = (radicand + 0 * angle[0]) * p.L * p.L * p.L * p.L
    return Branch(pose, tuple(inputs), {"meeting": margin}, _core(ns, p, pose, inputs))


def _local(vector):
    """A vector in the frames of the three limbs: rail, revolute axis, and the third axis."""
    x, y, z = vector
    return (x, y, z), (y, z, x), (z, x, y)


def _centres(inputs):
    q1, q2, q3 = inputs
    return (q1, 0, 0), (0, q2, 0), (0, 0, q3)


def _core(ns, p, pose, inputs):
    rods = tuple(scaled(subtract(centre, pose), 1 / p.L) for centre in _centres(inputs))
    return SimpleNamespace(
        inputs=tuple(inputs), rods=rods, arm1=rods[0][0], arm2=rods[1][1], arm3=rods[2][2], volume=triple(*rods)
    )


def joints(ns, p, core):
    """Every joint's value; a revolute as (cosine, sine). Short links of a flat parallelogram, free to turn, do not."""
    found = {}
    for i, (q, rod) in enumerate(zip(core.inputs, core.rods, strict=True)):
        x, y, z = _local(rod)[i]
        turn, hinge, _ = pointing(ns, x, -z, y, NOTHING)
        leg = f"leg{i + 1}"
        found |= {f"{leg}.A": q, f"{leg}.B": turn, f"{leg}.C": opposite(turn)}
        found |= {f"{leg}.D{side}": hinge for side in "ab"} | {f"{leg}.E{side}": opposite(hinge) for side in "ab"}
    return found


def factors(ns, p, core):
    """Det Jp = n1 . (n2 x n3), det Jq = arm1 arm2 arm3; and what other singularities are made of."""
    first, second, third = core.rods
    q1, q2, q3 = core.inputs
    return {
        "volume": core.volume,
        "arm1": core.arm1,
        "arm2": core.arm2,
        "arm3": core.arm3,
        "sine12": length(ns, cross(first, second)),
        "sine23": length(ns, cross(second, third)),
        "sine31": length(ns, cross(third, first)),
        "gap12": ns.sqrt(q1 * q1 + q2 * q2),
        "gap23": ns.sqrt(q2 * q2 + q3 * q3),
        "gap31": ns.sqrt(q3 * q3 + q1 * q1),
    }


def jacobians(ns, p, core):
    """The rods are rigid: n_i . v = (n_i . e_i) dq_i/dt."""
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
    signs={"s1": Sign("arm1", "1"), "s2": Sign("arm2", "1"), "s3": Sign("arm3", "1"), "e": Sign("volume", "1")},
    direct_margins=(
        Margin(
            "normal",
            "L*L",
            "two of the sliders meet: the platform is free to run round the third rail",
            2,
            zero="degenerate",
        ),
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
            Factor(f"arm{i}", "serial", "1", f"rod {i} is perpendicular to its rail", rf"n_{i}\cdot e_{i}", unit=0)
            for i in "123"
        ),
        *(
            Factor(f"sine{i}{j}", "other", "1", f"rods {i} and {j} are parallel", rf"|n_{i}\times n_{j}|", unit=0)
            for i, j in PAIRS
        ),
        *(
            Factor(f"gap{i}{j}", "other", "L", f"sliders {i} and {j} meet", rf"\sqrt{{\rho_{i}^2+\rho_{j}^2}}")
            for i, j in PAIRS
        ),
    ),
    # the rods whose sliders cannot move them must be independent, or Jp and Jq lose a row together
    constraint_singular=(
        ("arm1", "arm2", "arm3", "volume"),
        *((f"arm{i}", f"arm{j}", f"sine{i}{j}") for i, j in PAIRS),
    ),
    self_motion_singular=tuple((f"gap{i}{j}",) for i, j in PAIRS),
    self_motion=SelfMotion("normal", "phi", (), self_motion, r"\varphi"),
)
