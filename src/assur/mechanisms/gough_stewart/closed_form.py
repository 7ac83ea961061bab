"""Closed form of the general Gough-Stewart platform: leg i is the vector d_i = p + R b_i - a_i, of length l_i.

R turns b_i by the quaternion e, and p is the vector of g e* with a second quaternion g = p e: dual quaternions, or
soma (Study) coordinates. Times N(e), every leg's equation is quadratic in them (Wampler 1996, Mech. Mach. Theory 31):

    N(g) + 2 b_i . vec(e* g) - 2 a_i . vec(g e*) + (a_i^2 + b_i^2 - l_i^2) N(e) - 2 a_i . N(e) R b_i = 0,    e . g = 0.

The six legs and Study's quadric have 40 common points with N(e) not zero.
"""

from itertools import combinations
from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, PolynomialSystem
from assur.numerics.vectors import add, apply, cross, dot, of_quaternion, product, scaled, subtract, transposed, triple

LEGS = (1, 2, 3, 4, 5, 6)
SQUARE = "(" + "+".join(f"b{n}{axis}*b{n}{axis}" for n in LEGS for axis in "xyz") + ")/6"
SIZE = f"sqrt({SQUARE})"  # mean distance of the platform's points from its origin


def inverse(ns, p, pose, sign):
    """Leg lengths at a pose. No signs: lengths are positive, and no universal joint is turned half round."""
    return _branch(ns, p, pose, None)


def equations(ns, p, inputs, unknowns):
    """Study's quadric and the six legs, as above: homogeneous of degree 2 in the eight unknowns."""
    e, g = unknowns[:4], unknowns[4:]
    vector_e, vector_g = e[1:], g[1:]
    straight = subtract(scaled(vector_g, e[0]), scaled(vector_e, g[0]))
    turned = cross(vector_g, vector_e)
    on_base, on_platform = subtract(straight, turned), add(straight, turned)  # vec(g e*), vec(e* g)
    norm, square = _norm(e), _norm(g)
    rotation = _rotation(*e)
    legs = [
        square
        + 2 * dot(b, on_platform)
        - 2 * dot(a, on_base)
        + (dot(a, a) + dot(b, b) - length * length) * norm
        - 2 * dot(a, apply(rotation, b))
        for a, b, length in zip(_points(p, "a"), _points(p, "b"), inputs, strict=True)
    ]
    return [e[0] * g[0] + dot(vector_e, vector_g), *legs]


def finite(unknowns):
    """N(e): no pose belongs to a solution where it is zero."""
    return _norm(unknowns[:4])


def lift(ns, p, pose):
    """The unknowns e and g = p e of a pose, p as a quaternion without scalar part."""
    position, (w, *vector) = pose[:3], pose[3:]
    return (w, *vector, -dot(position, vector), *add(scaled(position, w), cross(position, vector)))


def back(ns, p, inputs, unknowns):
    """The branch of a real solution: p = vec(g e*) / N(e), and e of length one."""
    e, g = unknowns[:4], unknowns[4:]
    norm = _norm(e)
    moved = subtract(subtract(scaled(g[1:], e[0]), scaled(e[1:], g[0])), cross(g[1:], e[1:]))
    length = ns.sqrt(norm)
    return _branch(ns, p, (*(part / norm for part in moved), *(part / length for part in e)), inputs)


def _norm(quaternion):
    w, x, y, z = quaternion
    return w * w + x * x + y * y + z * z


def _rotation(w, x, y, z):
    """N(e) R: the rotation of a quaternion of any length, homogeneous."""
    return (
        (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
    )


def _points(p, letter):
    """The six points a_i or b_i."""
    return tuple(tuple(getattr(p, f"{letter}{n}{axis}") for axis in "xyz") for n in LEGS)


def _branch(ns, p, pose, lengths):
    position, rotation = pose[:3], of_quaternion(*pose[3:])
    arms = tuple(apply(rotation, b) for b in _points(p, "b"))
    legs = tuple(subtract(add(position, arm), a) for arm, a in zip(arms, _points(p, "a"), strict=True))
    if lengths is None:
        lengths = tuple(ns.sqrt(dot(leg, leg)) for leg in legs)
    squares = tuple(leg[1] * leg[1] + leg[2] * leg[2] for leg in legs)
    core = SimpleNamespace(
        rotation=rotation, arms=arms, legs=legs, lengths=lengths, across=tuple(ns.sqrt(square) for square in squares)
    )
    return Branch(pose, lengths, {f"across{n}": square for n, square in zip(LEGS, squares, strict=True)}, core)


def joints(ns, p, core):
    """Every joint's value: the universal joint turns Z onto the leg, the spherical one to the platform."""
    values: dict[str, object] = {}
    for n, leg, length, across in zip(LEGS, core.legs, core.lengths, core.across, strict=True):
        first, second = (leg[2] / across, -leg[1] / across), (across / length, leg[0] / length)
        (c1, s1), (c2, s2) = first, second
        of_leg = ((c2, 0 * s2, s2), (s1 * s2, c1, -s1 * c2), (-c1 * s2, s1, c1 * c2))  # about X, then about Y
        values |= {f"A{n}.first": first, f"A{n}.second": second, f"P{n}": length}
        values[f"B{n}"] = product(transposed(of_leg), core.rotation)
    return values


def factors(ns, p, core):
    """Det Jp, by its 3x3 minors (Laplace), and the leg lengths."""
    moments = tuple(cross(arm, leg) for arm, leg in zip(core.arms, core.legs, strict=True))
    total = 0
    for chosen in combinations(range(6), 3):
        rest = [k for k in range(6) if k not in chosen]
        sign = (-1) ** (sum(chosen) - 3)  # of the permutation that puts the chosen rows first
        total = total + sign * triple(*(core.legs[k] for k in chosen)) * triple(*(moments[k] for k in rest))
    return {"lines": total, **{f"l{n}": length for n, length in zip(LEGS, core.lengths, strict=True)}}


def jacobians(ns, p, core):
    """Each leg is a line: d_i . v + (R b_i x d_i) . omega = l_i dl_i/dt (its Pluecker coordinates, times l_i)."""
    jp = tuple((*leg, *cross(arm, leg)) for arm, leg in zip(core.arms, core.legs, strict=True))
    jq = tuple(tuple(length if k == n else 0 for k in range(6)) for n, length in enumerate(core.lengths))
    return jp, jq


_ACROSS = tuple(
    Margin(
        f"across{n}",
        SQUARE,
        f"leg {n} lies along the first axis of its universal joint",
        unit=2,
        zero="degenerate",
        latex=f"d_{{{n}y}}^2+d_{{{n}z}}^2",
    )
    for n in LEGS
)

CLOSED_FORM = ClosedForm(
    complete_for="reduced",
    reduced_because="legs of negative length or with a universal joint turned half round add no pose",
    direct=PolynomialSystem(
        unknowns=("ew", "ex", "ey", "ez", "gw", "gx", "gy", "gz"),
        units=(0, 0, 0, 0, 1, 1, 1, 1),
        degree=40,
        because="Ronga, Vust 1995; Lazard 1993; Mourrain 1993",
        equations=equations,
        finite=finite,
        lift=lift,
        back=back,
    ),
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    signs={},
    direct_margins=_ACROSS,
    inverse_margins=_ACROSS,
    factor_list=(
        Factor(
            "lines",
            "parallel",
            "*".join([*[SQUARE] * 4, SIZE]),
            "the lines of the six legs belong to one linear complex",
            r"\det(d_i,\ Rb_i\times d_i)",
            unit=9,
        ),
        *(Factor(f"l{n}", "serial", SIZE, f"A{n} and B{n} coincide: leg {n} has no length", f"l_{n}") for n in LEGS),
    ),
)
