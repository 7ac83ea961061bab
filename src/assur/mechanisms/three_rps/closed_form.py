"""Closed form of the 3-RPS mechanism: no root but the legs' in the inverse problem, two quartics in the direct one.

Leg i stays in the plane of u_i and Z. In it S_i stands at e_i along u_i and h_i along Z, so that
e_i = R + rho_i sin(A_i) and h_i = rho_i cos(A_i). That the platform's corners stay in the three planes asks for
R12 = R21, so the parasitic motions are

    tan(phi) = sin(theta) sin(psi) / (cos(theta) + cos(psi)),  x = r (R11 - R22) / 2,  y = -r R21.

Two operation modes: o = sign(R11 + R22), + where the platform turns about a horizontal axis, - where it is turned
half round besides. With a = sin(theta), b = cos(theta) sin(psi) and n = 1 + cos(theta) cos(psi) = 1 + R33:

    e_i = o r (1 - P_i),  n P_1 = (3 a^2 - b^2)/2,  n P_2 = b^2 + sqrt(3) a b,  n P_3 = b^2 - sqrt(3) a b.

In the direct problem P satisfies six quadratic equations in each mode, so that it has four values there; each of them
is a pose and its mirror image. The derivation is docs/derivations/three_rps.md.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Eliminant, Factor, Margin, Quantity, Sign
from assur.numerics import vectors
from assur.numerics.expanded import coefficients_of, unknowns
from assur.numerics.meetings import linear_in_three
from assur.numerics.vectors import add, cross, dot, product, scaled, triple

LEGS = (1, 2, 3)
AWRY = (6 / 7, 2 / 7, -3 / 7)
"""The unknown is t = AWRY . P: values of P that turns or mirrors of the mechanism exchange differ in it."""
STEPS = 3
"""Of Newton's method after the root."""
SMALL = 1e-12
"""Where det Jp is about this part of its scale, R^3 r^2, the steps fade out: there is a double root."""
FLOOR = 1e-60
"""Beside 2 n it is nothing, but where the platform is upside down."""


def inverse(ns, p, pose, sign):
    """Leg lengths at a pose; they are positive. Sign: o, the operation mode."""
    core = _core(ns, p, pose, sign.o)
    margins = {f"square{k}": square for k, square in zip(LEGS, core.squares, strict=True)}
    return Branch(pose, core.lengths, {"n": core.n, "upright": core.theta[0] * core.theta[0], **margins}, core)


def _squares(root3, a, b):
    """Products n P_i: by how much the tilt pulls the corners in."""
    return (3 * a * a - b * b) / 2, b * b + root3 * a * b, b * b - root3 * a * b


def _slopes(root3, a, b):
    """Heights of the corners over the platform's middle, per r."""
    return -a, (a + root3 * b) / 2, (a - root3 * b) / 2


def coefficients(ns, p, inputs, sign):
    """The five coefficients of a mode's polynomial in t: the determinant of t P = N P + constant and t = AWRY . P."""
    (t,) = unknowns(1)
    constant, linear, factors = _times_t(p, inputs, sign)
    columns = vectors.transposed(_less(linear, factors, t))
    total = t * triple(*columns)
    for k, share in enumerate(AWRY):
        total = total + share * triple(*columns[:k], constant, *columns[k + 1 :])
    return coefficients_of(total, 5)


def _times_t(p, inputs, sign):
    """Constants c, rows N and factors f of f_i t P_i = c_i + N_i . P, by the six quadratic equations of P."""
    ratio = sign.o * p.R / p.r
    k = 2 * ratio - 1
    squares = tuple(length * length / (p.r * p.r) for length in inputs)
    mean = (squares[0] + squares[1] + squares[2]) / 3
    off = vectors.subtract(squares, (mean, mean, mean))
    spread = dot(off, off) / (6 * k * k)
    even = tuple(part - part * part / (2 * k * k) + spread for part in off)
    a, b = 4 * mean - 3 + 12 * ratio - 2 * spread, 8 * (mean - (1 - ratio) * (1 - ratio))
    others = tuple(_product_of_others(p, inputs, k, i) for i in range(3))
    factors = tuple(a - 2 * part for part in even)
    constant, linear = [], []
    for i, j, m in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        own = tuple(1.5 * (b + 2 * k * off[i]) * (n == i) for n in range(3))
        crossed = add(scaled(others[m], even[j]), scaled(others[j], even[m]))
        square = add(own, add(scaled(others[i], a), scaled(crossed, 2)))  # f_i P_i^2, but for a constant
        mixed = add(scaled(others[m], AWRY[j]), scaled(others[j], AWRY[m]))
        constant.append(-AWRY[i] * _more(p, inputs, i, j) * _more(p, inputs, i, m))
        linear.append(add(scaled(square, AWRY[i]), scaled(mixed, factors[i])))
    return tuple(constant), tuple(linear), factors


def _product_of_others(p, inputs, k, i):
    """The linear form of P that is P_j P_m."""
    j, m = (i + 1) % 3, (i + 2) % 3
    form = {j: _more(p, inputs, i, m) / (3 * k), m: _more(p, inputs, i, j) / (3 * k)}
    return tuple(form.get(n, 0) for n in range(3))


def _more(p, inputs, i, j):
    """By how much the square of one length is more than that of another, per r^2."""
    return (inputs[j] - inputs[i]) * (inputs[j] + inputs[i]) / (p.r * p.r)


def _less(linear, factors, t):
    """The rows N less f t on the diagonal."""
    return tuple(
        tuple(part - t * (factors[i] if k == i else 0) for k, part in enumerate(row)) for i, row in enumerate(linear)
    )


def back(ns, p, inputs, t, sign):
    """Pose at given lengths and t: P by least squares, then the heights by their products. Sign: side, that of Z."""
    constant, linear, factors = _times_t(p, inputs, sign)
    rows, right = (AWRY, *_less(linear, factors, t)), (t, *(-part for part in constant))
    normal = tuple(tuple(sum(row[j] * row[k] for row in rows) for k in range(3)) for j in range(3))
    values, apart = linear_in_three(normal, tuple(sum(right[k] * rows[k][j] for k in range(4)) for j in range(3)))
    products = _products_of_heights(p, inputs, tuple(sign.o * p.r * (1 - value) for value in values))
    along = vectors.apply(products, AWRY)
    aside = dot(along, AWRY)
    heights = scaled(along, sign.side / ns.sqrt(aside))
    z = (heights[0] + heights[1] + heights[2]) / 3
    a, b = (z - heights[0]) / p.r, (heights[1] - heights[2]) / (ns.sqrt(3) * p.r)
    level, tilt = 1 - 2 * (values[0] + values[1] + values[2]) / 3, 1 - a * a
    pose = (z, _unit(ns, (ns.sqrt(tilt), a)), _unit(ns, (level, b)))
    for _ in range(STEPS):
        pose = _improved(ns, p, pose, inputs, sign.o)
    margins = {"apart": apart, "heights": aside, "aside": aside, "tilt": tilt, "roll": level * level + b * b}
    return Branch(pose, tuple(inputs), {**margins, "upright": pose[1][0] * pose[1][0]}, _core(ns, p, pose, sign.o))


def _products_of_heights(p, inputs, e):
    """The matrix h_i h_j: by the lengths of the legs, and by the side between two of them."""
    own = tuple(length * length - (out - p.R) * (out - p.R) for length, out in zip(inputs, e, strict=True))
    first, second, third = (
        (inputs[i] * inputs[i] + inputs[j] * inputs[j] + e[i] * e[j] - 3 * p.r * p.r) / 2 + p.R * (e[i] + e[j] - p.R)
        for i, j in ((1, 2), (2, 0), (0, 1))
    )
    return (own[0], third, second), (third, own[1], first), (second, first, own[2])


def _improved(ns, p, pose, inputs, o):
    """The pose after one step of Newton's method on the lengths."""
    tilt = _tilted(ns, p, pose, o, FLOOR)
    one, two, three = _slopes_of_squares(ns, p, tilt)
    missing = tuple((rho * rho - square) / 2 for rho, square in zip(inputs, tilt.squares, strict=True))
    adjugate = vectors.transposed((cross(two, three), cross(three, one), cross(one, two)))
    determinant, size = triple(one, two, three), SMALL * p.R * p.R * p.R * p.r * p.r
    dz, *turns = scaled(vectors.apply(adjugate, missing), determinant / (determinant * determinant + size * size))
    theta, psi = (
        _unit(ns, vectors.sum_of_angles(angle, _small(turn))) for angle, turn in zip(pose[1:], turns, strict=True)
    )
    return (pose[0] + dz, theta, psi)


def _small(turn):
    """An angle that is near zero: twice the one that has half of it as its tangent."""
    square = turn * turn / 4
    return ((1 - square) / (1 + square), turn / (1 + square))


def _unit(ns, leg):
    size = ns.sqrt(leg[0] * leg[0] + leg[1] * leg[1])
    return (leg[0] / size, leg[1] / size)


def _tilted(ns, p, pose, o, floor):
    """Where the corners are. The floor keeps n from being zero on the way to a pose."""
    z, theta, psi = pose
    root3 = ns.sqrt(3)
    a, b, above = theta[1], theta[0] * psi[1], 1 + theta[0] * psi[0]
    # as 1 + cos(theta) cos(psi), without the loss of digits near zero
    n = (above * above + a * a + b * b + floor) / 2
    radial = tuple(o * p.r * (1 - square / n) for square in _squares(root3, a, b))
    heights = tuple(z + p.r * slope for slope in _slopes(root3, a, b))
    squares = tuple((e - p.R) * (e - p.R) + h * h for e, h in zip(radial, heights, strict=True))
    return SimpleNamespace(
        theta=theta, psi=psi, a=a, b=b, n=n, radial=radial, heights=heights, squares=squares,
        o=radial[0] + radial[1] + radial[2],
    )  # fmt: skip


def _core(ns, p, pose, o):
    tilt, root3 = _tilted(ns, p, pose, o, 0), ns.sqrt(3)
    radial, (_, theta, psi) = tilt.radial, pose
    lengths = tuple(ns.sqrt(square) for square in tilt.squares)
    phi = _unit(ns, (root3 * (4 * radial[0] + radial[1] + radial[2]), 3 * (radial[2] - radial[1])))
    rotation = product(vectors.about_z(phi), product(vectors.about_y(theta), vectors.about_x(psi)))
    legs = tuple((h / rho, (e - p.R) / rho) for e, h, rho in zip(radial, tilt.heights, lengths, strict=True))
    return SimpleNamespace(
        z=pose[0], theta=theta, psi=psi, phi=phi, a=tilt.a, b=tilt.b, n=tilt.n, rotation=rotation, radial=radial,
        heights=tilt.heights, squares=tilt.squares, lengths=lengths, legs=legs, o=tilt.o,
        x=p.r * (rotation[0][0] - rotation[1][1]) / 2, y=-p.r * rotation[1][0],
        e=_together([length / p.R for length in lengths], legs),
    )  # fmt: skip


def _along(rho, legs, i, j):
    """g_ij = (S_i - S_j) . dS_i/dA_i per rho_i, lengths being taken per R."""
    (cosine, sine), (other_cosine, other_sine) = legs[i], legs[j]
    return (3 * cosine + rho[j] * (cosine * other_sine + 2 * sine * other_cosine)) / 2


def _together(rho, legs):
    """g12 g23 g31 + g21 g32 g13: zero where the legs can turn together at fixed lengths."""
    first = _along(rho, legs, 0, 1) * _along(rho, legs, 1, 2) * _along(rho, legs, 2, 0)
    return first + _along(rho, legs, 1, 0) * _along(rho, legs, 2, 1) * _along(rho, legs, 0, 2)


def joints(ns, p, core):
    """Every joint's value: the leg's angle from Z, its length, the platform against the leg."""
    values = {}
    half = ns.sqrt(3) / 2
    limbs = ((1, 0), (-0.5, half), (-0.5, -half))
    for k, (leg, length, limb) in enumerate(zip(core.legs, core.lengths, limbs, strict=True), 1):
        frame = product(vectors.about_z(limb), product(vectors.about_y(leg), vectors.about_z((limb[0], -limb[1]))))
        values |= {
            f"leg{k}.A": leg,
            f"leg{k}.P": length,
            f"leg{k}.S": product(vectors.transposed(frame), core.rotation),
        }
    return values


def factors(ns, p, core):
    """Det Jp = cos(theta) planes, det Jq = rho1 rho2 rho3."""
    rows = _rows(ns, p, core)
    first, second, third = core.lengths
    return {
        "planes": triple(*rows), "cos_theta": core.theta[0], "rho1": first, "rho2": second, "rho3": third, "n": core.n,
    }  # fmt: skip


def jacobians(ns, p, core):
    """From (e_i - R)^2 + h_i^2 = rho_i^2."""
    first, second, third = core.lengths
    return _slopes_of_squares(ns, p, core), ((first, 0, 0), (0, second, 0), (0, 0, third))


def _slopes_of_squares(ns, p, core):
    """Rows of Jp: rates of rho_i^2 / 2."""
    return tuple((row[0], row[1], core.theta[0] * row[2]) for row in _rows(ns, p, core))


def _rows(ns, p, core):
    """Rows of Jp, the last entry per cos(theta): rates of rho_i^2 / 2 with z, theta and psi."""
    root3 = ns.sqrt(3)
    (cos_theta, sin_theta), (cos_psi, sin_psi) = core.theta, core.psi
    by_theta = _slip(root3, core, cos_theta, -sin_theta * sin_psi, -sin_theta * cos_psi)
    by_psi = _slip(root3, core, 0, cos_psi, -sin_psi)
    side = core.o * 2 / (3 * core.n * core.n)  # o r / n, as core.o = 3 o r n / 2
    return tuple(
        (
            core.heights[k],
            (core.radial[k] - p.R) * side * by_theta[0][k] + core.heights[k] * p.r * by_theta[1][k],
            (core.radial[k] - p.R) * side * by_psi[0][k] + core.heights[k] * p.r * by_psi[1][k],
        )
        for k in range(3)
    )


def _slip(root3, core, a, b, n):
    """Rates of e_i, per o r / n, and of h_i, per r, with the rates of a, b and n."""
    crossed = root3 * (a * core.b + core.a * b)
    squares = 3 * a * core.a - b * core.b, 2 * b * core.b + crossed, 2 * b * core.b - crossed
    pulled = _squares(root3, core.a, core.b)
    return tuple(q * n / core.n - square for q, square in zip(pulled, squares, strict=True)), _slopes(root3, a, b)


def quantities(ns, p, core):
    """The parasitic motions, and the angles of the legs."""
    return {"phi": core.phi, "x": core.x, "y": core.y, **{f"A{k}": leg for k, leg in enumerate(core.legs, 1)}}


UPRIGHT = Margin("upright", "1", "theta is a right angle: phi and psi turn about one axis", unit=0, zero="degenerate")
CLOSED_FORM = ClosedForm(
    complete_for="reduced",
    reduced_because="a leg of negative length is left out: the same pose with that leg turned half round",
    direct=Eliminant("t", "plain", 16, coefficients, back, signs=("o", "side")),
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    quantities=quantities,
    signs={"o": Sign("o", "r"), "e": Sign("e", "1")},
    direct_margins=(
        Margin("apart", "1", "two values of P have this t in common", unit=2, zero="degenerate"),
        Margin("heights", "R*R", "the square of the heights along AWRY: the heights of the corners are real", unit=2),
        Margin("aside", "R*R", "the direction of the heights has no part along AWRY", unit=2, zero="degenerate"),
        Margin("tilt", "1", "cos(theta)^2: a corner is higher than the platform is wide", unit=0),
        Margin("roll", "1", "cos(theta)^2 again, by P: the root leaves psi free", unit=0, zero="degenerate"),
        UPRIGHT,
    ),
    inverse_margins=(
        Margin("n", "1", "the platform is upside down: phi is free", unit=0, zero="degenerate"),
        UPRIGHT,
        *(Margin(f"square{k}", "R*R", f"A and S of leg {k} coincide", 2, zero="degenerate") for k in LEGS),
    ),
    factor_list=(
        Factor(
            "planes", "parallel", "R*R*R*r*r",
            "the planes of each S, of its leg and its revolute axis, meet in a point of the platform's plane",
            r"\Pi", unit=5,
        ),
        Factor(
            "cos_theta", "parallel", "1",
            "theta is a right angle: phi and psi turn about one axis (of the coordinates, not of the mechanism)",
            r"\cos\theta", unit=0,
        ),
        *(Factor(f"rho{k}", "serial", "R", f"leg {k} has no length: A and S coincide", rf"\rho_{k}") for k in LEGS),
        Factor("n", "other", "1", "the platform is upside down", r"1+\cos\theta\cos\psi", unit=0),
    ),
    constraint_singular=(("n",),),
    quantity_list=(
        Quantity("phi", "angle", "", latex=r"\varphi", meaning="parasitic rotation about Z"),
        Quantity("x", "length", "", ("phi",), latex="x", meaning="parasitic motion of O' along X"),
        Quantity("y", "length", "", ("phi",), latex="y", meaning="parasitic motion of O' along Y"),
        *(Quantity(f"A{k}", "angle", "", latex=rf"A_{k}", meaning=f"angle of leg {k} from Z") for k in LEGS),
    ),
)  # fmt: skip
