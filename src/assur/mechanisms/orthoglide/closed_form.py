"""Closed form of the Orthoglide: the platform is at the distance L from three points that slide on the axes.

In the frame of a limb its rail is the X axis and its revolute axes are along Y. With n_i the direction of rod i from
the platform to the slider, L n_i = q_i e_i - p; so q_i = x + s_i sqrt(L^2 - y^2 - z^2), and the direct
problem is the meeting of three spheres. Differentiated: n_i . v = (n_i . e_i) dq_i/dt.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, SelfMotion, Sign
from assur.numerics.meetings import three_spheres
from assur.numerics.vectors import cross, dot, scaled, subtract, triple

NOTHING = 1e-30
"""What 0/0 is taken as one by: beside any other number it is nothing."""


def inverse(ns, p, pose, sign):
    """Inputs at a pose. Signs: s1, s2, s3, those of cos(B)."""
    radicands, inputs = [], []
    for local, chosen in zip(_local(pose), (sign.s1, sign.s2, sign.s3), strict=True):
        radicand = p.L * p.L - local[1] * local[1] - local[2] * local[2]
        radicands.append(radicand)
        inputs.append(local[0] + chosen * ns.sqrt(radicand))
    margins = {f"reach{i + 1}": radicands[i] for i in range(3)}
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
    squares = [q * q for q in inputs]
    total = squares[0] + squares[1] + squares[2] + NOTHING * p.L * p.L
    weights = [(squares[0] + NOTHING * p.L * p.L) / total, squares[1] / total, squares[2] / total]
    radicand = p.L * p.L - (squares[0] + squares[1] + squares[2]) / 4
    radius = ns.sqrt(radicand)
    pose = tuple(inputs[i] / 2 + radius * (angle[0] * weights[i - 1] + angle[1] * weights[i - 2]) for i in range(3))
    return Branch(pose, tuple(inputs), {"meeting": radicand * p.L * p.L * p.L * p.L}, _core(ns, p, pose, inputs))


def _local(vector):
    """A vector in the frames of the three limbs: rail, revolute axis, and the third axis."""
    x, y, z = vector
    return (x, y, z), (y, z, x), (z, x, y)


def _centres(inputs):
    q1, q2, q3 = inputs
    return (q1, 0, 0), (0, q2, 0), (0, 0, q3)


def _core(ns, p, pose, inputs):
    rods = tuple(scaled(subtract(centre, pose), 1 / p.L) for centre in _centres(inputs))
    local = tuple(_local(rod)[i] for i, rod in enumerate(rods))
    return SimpleNamespace(
        pose=tuple(pose), inputs=tuple(inputs), rods=rods, local=local,
        widths=tuple(ns.sqrt(rod[0] * rod[0] + rod[2] * rod[2]) for rod in local),
        arm1=local[0][0], arm2=local[1][0], arm3=local[2][0], volume=triple(*rods),
    )  # fmt: skip


def joints(ns, p, core):
    """Every joint's value; a revolute as (cosine, sine). Short links of a flat parallelogram, free to turn, do not."""
    found = {}
    for i, (rod, width) in enumerate(zip(core.local, core.widths, strict=True)):
        hinge, turn = (width, rod[1]), ((rod[0] + NOTHING) / (width + NOTHING), -rod[2] / (width + NOTHING))
        leg = f"leg{i + 1}"
        found |= {f"{leg}.A": core.inputs[i], f"{leg}.B": turn, f"{leg}.C": _back(turn)}
        found |= {f"{leg}.Da": hinge, f"{leg}.Db": hinge, f"{leg}.Ea": _back(hinge), f"{leg}.Eb": _back(hinge)}
    return found


def _back(angle):
    cosine, sine = angle
    return (cosine, -sine)


def factors(ns, p, core):
    """Det Jp = n1 . (n2 x n3), det Jq = arm1 arm2 arm3; and what other singularities are made of."""
    first, second, third = core.rods
    q1, q2, q3 = core.inputs
    return {
        "volume": core.volume,
        "arm1": core.arm1,
        "arm2": core.arm2,
        "arm3": core.arm3,
        "sine12": _length(ns, cross(first, second)),
        "sine23": _length(ns, cross(second, third)),
        "sine31": _length(ns, cross(third, first)),
        "gap12": ns.sqrt(q1 * q1 + q2 * q2),
        "gap23": ns.sqrt(q2 * q2 + q3 * q3),
        "gap31": ns.sqrt(q3 * q3 + q1 * q1),
    }


def _length(ns, vector):
    return ns.sqrt(dot(vector, vector))


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
