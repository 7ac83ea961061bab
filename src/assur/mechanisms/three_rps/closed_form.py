"""Closed form of the 3-RPS mechanism: no root but the legs' in the inverse problem, degree sixteen in the direct one.

Leg i stays in the plane of u_i and Z. In it S_i stands at e_i along u_i and h_i along Z, so that
e_i = R + rho_i sin(A_i) and h_i = rho_i cos(A_i). That the platform's corners stay in the three planes asks for
R12 = R21, so the parasitic motions are

    tan(phi) = sin(theta) sin(psi) / (cos(theta) + cos(psi)),  x = r (R11 - R22) / 2,  y = -r R21.

Two operation modes: o = sign(R11 + R22), + where the platform turns about a horizontal axis, - where it is turned
half round besides. With a = sin(theta), b = cos(theta) sin(psi) and n = 1 + cos(theta) cos(psi) = 1 + o R33:

    e_i = o r (1 - Q_i / n),  Q_1 = (3 a^2 - b^2)/2,  Q_2 = b^2 + sqrt(3) a b,  Q_3 = b^2 - sqrt(3) a b.

In the direct problem |S_i S_j|^2 = 3 r^2 is linear in the cosine and sine of each leg's angle; two resultants leave
one polynomial in the tangent of half of A of leg 1. It is the same from both ends: every pose has its mirror image.
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Eliminant, Factor, Margin, Quantity, Sign
from assur.numerics.polynomials import add, half_angle, multiply, scaled, subtract
from assur.numerics.vectors import about_x, about_y, about_z, product, transposed

STEPS = 4
"""Of Newton's method after the root."""
SMALL = 1e-8
"""Where legs can turn together up to this, the steps fade out: there is a double root."""


def inverse(ns, p, pose, sign):
    """Leg lengths at a pose; they are positive. Sign: o, the operation mode."""
    z, theta, psi = pose
    tilt = _tilt(theta, psi)
    root3 = ns.sqrt(3)
    radial = tuple(sign.o * p.r * (1 - square / tilt.n) for square in _squares(root3, tilt.a, tilt.b))
    heights = tuple(z + p.r * slope for slope in _slopes(root3, tilt.a, tilt.b))
    squares = tuple((e - p.R) * (e - p.R) + h * h for e, h in zip(radial, heights, strict=True))
    phi = (sign.o * (theta[0] + psi[0]) / tilt.n, sign.o * theta[1] * psi[1] / tilt.n)
    margins = {
        "n": tilt.n,
        "upright": theta[0] * theta[0],
        **{f"square{k}": square for k, square in enumerate(squares, 1)},
    }
    lengths = tuple(ns.sqrt(square) for square in squares)
    return Branch(pose, lengths, margins, _core(ns, p, pose, phi, radial, heights, lengths))


def _tilt(theta, psi):
    return SimpleNamespace(a=theta[1], b=theta[0] * psi[1], n=1 + theta[0] * psi[0])


def _squares(root3, a, b):
    """Q_i: by how much the tilt pulls the corners in."""
    return (3 * a * a - b * b) / 2, b * b + root3 * a * b, b * b - root3 * a * b


def _slopes(root3, a, b):
    """Heights of the corners over the platform's middle, per r."""
    return -a, (a + root3 * b) / 2, (a - root3 * b) / 2


def coefficients(ns, p, inputs):
    """The seventeen coefficients of the polynomial in t = tan(A/2) of leg 1; lengths are taken per R."""
    rho = tuple(length / p.R for length in inputs)
    side = p.r * p.r / (p.R * p.R)
    second = _in_first(rho[0], rho[1], side)
    third = _in_first(rho[0], rho[2], side)
    return _resultant_with_quartic(third, _first_resultant(second, rho[1], rho[2], side))


def _in_first(first, other, side):
    """The condition of leg 1 and another: its coefficients in the other's half tangent, polynomials in leg 1's."""
    cosine = half_angle({(1, 0): -2 * first * other}, 1)
    sine = half_angle({(0, 0): 3 * other, (0, 1): first * other}, 1)
    constant = half_angle({(0, 0): 3 + first * first + other * other - 3 * side, (0, 1): 3 * first}, 1)
    return add(constant, cosine), scaled(sine, 2), subtract(constant, cosine)


def _first_resultant(quadratic, second, third, side):
    """Resultant of the conditions (1, 2) and (2, 3) by leg 2: five coefficients in leg 3, polynomials in leg 1."""
    p0, p1, p2 = quadratic
    e0, e1, e2 = _in_first(third, second, side)
    total = [()] * 5
    # (p2 e0 - p0 e2)^2 - (p2 e1 - p1 e2)(p1 e0 - p0 e1), the e being polynomials in leg 3
    for sign, left, right in (
        (1, (p2, e0), (p2, e0)), (-2, (p2, e0), (p0, e2)), (1, (p0, e2), (p0, e2)),
        (-1, (p2, e1), (p1, e0)), (1, (p2, e1), (p0, e1)), (1, (p1, e2), (p1, e0)), (-1, (p1, e2), (p0, e1)),
    ):  # fmt: skip
        in_first = scaled(multiply(left[0], right[0]), sign)
        for k, factor in enumerate(multiply(left[1], right[1])):
            total[k] = add(total[k], scaled(in_first, factor))
    return total


def _resultant_with_quartic(quadratic, quartic):
    """Resultant of q and g: q2^4 g(t') g(t'') at the roots t', t'' of q, through their power sums."""
    q0, q1, q2 = quadratic
    product02, square1 = multiply(q0, q2), multiply(q1, q1)
    sums = (
        None,
        scaled(q1, -1),
        subtract(square1, scaled(product02, 2)),
        multiply(q1, subtract(scaled(product02, 3), square1)),
        add(
            multiply(square1, subtract(square1, scaled(product02, 4))),
            scaled(multiply(product02, product02), 2),
        ),
    )
    total = ()
    for i, first in enumerate(quartic):
        for j in range(i, 5):
            term = multiply(multiply(first, quartic[j]), multiply(_power(q0, i), _power(q2, 4 - j)))
            total = add(total, term if i == j else multiply(term, sums[j - i]))
    return total


def _power(polynomial, exponent):
    total = (1,)
    for _ in range(exponent):
        total = multiply(total, polynomial)
    return total


def back(ns, p, inputs, leg1):
    """Pose at given lengths and angle of leg 1.

    Legs 2 and 3 have each two angles that fit leg 1, either side of a mean one by X and Y; that they fit each other
    is f0 + f2 X + f3 Y + f23 X Y = 0, where X^2 and Y^2 are known: so X is found without a root, and then Y.
    """
    rho = tuple(length / p.R for length in inputs)
    side = p.r * p.r / (p.R * p.R)
    mean2, across2, square2 = _fitting(rho[0], rho[1], side, leg1)
    mean3, across3, square3 = _fitting(rho[0], rho[2], side, leg1)
    f0 = _condition(rho[1], rho[2], side, mean2, mean3, 1, 1)
    f2 = _condition(rho[1], rho[2], side, across2, mean3, 0, 1)
    f3 = _condition(rho[1], rho[2], side, mean2, across3, 1, 0)
    f23 = _condition(rho[1], rho[2], side, across2, across3, 0, 0)
    apart = f0 * f2 - square3 * f3 * f23
    x = (square3 * (f3 * f3 + f23 * f23 * square2) - f0 * f0 - f2 * f2 * square2) / (2 * apart)
    y = -(f0 + f2 * x) / (f3 + f23 * x)
    legs = (leg1, _moved(mean2, across2, x), _moved(mean3, across3, y))
    for _ in range(STEPS):
        legs = _corrected(ns, rho, side, legs)
    radial = tuple(p.R + length * leg[1] for length, leg in zip(inputs, legs, strict=True))
    heights = tuple(length * leg[0] for length, leg in zip(inputs, legs, strict=True))
    return _placed(ns, p, inputs, radial, heights, apart)


def _fitting(first, other, side, leg1):
    """Mean (cosine, sine) of the angles of another leg that fit leg 1, direction across it, and square of X."""
    a, b = -2 * first * other * leg1[0], 3 * other + first * other * leg1[1]
    c = 3 + first * first + other * other - 3 * side + 3 * first * leg1[1]
    square = a * a + b * b
    return (-a * c / square, -b * c / square), (-b, a), (square - c * c) / (square * square)


def _condition(second, third, side, leg2, leg3, one2, one3):
    """The condition of legs 2 and 3, bilinear in (1, cosine, sine) of each."""
    return (
        (3 + second * second + third * third - 3 * side) * one2 * one3
        + 3 * second * leg2[1] * one3
        + 3 * third * leg3[1] * one2
        + second * third * (leg2[1] * leg3[1] - 2 * leg2[0] * leg3[0])
    )


def _moved(mean, across, factor):
    return (mean[0] + factor * across[0], mean[1] + factor * across[1])


def _corrected(ns, rho, side, legs):
    """One step of Newton's method for the three legs: the root of a polynomial of degree sixteen is a rough one."""
    g12, g23, g31 = (_along(rho, legs, i, j) for i, j in ((0, 1), (1, 2), (2, 0)))
    g21, g32, g13 = (_along(rho, legs, i, j) for i, j in ((1, 0), (2, 1), (0, 2)))
    f12, f23, f31 = (_condition(rho[i], rho[j], side, legs[i], legs[j], 1, 1) for i, j in ((0, 1), (1, 2), (2, 0)))
    together = _together(rho, legs)
    inverse_of = together / (together * together + SMALL * SMALL)
    steps = (
        f12 * g23 * g31 - f23 * g21 * g31 + f31 * g21 * g32,
        f23 * g31 * g12 - f31 * g32 * g12 + f12 * g32 * g13,
        f31 * g12 * g23 - f12 * g13 * g23 + f23 * g13 * g21,
    )
    turned = (
        _moved(leg, (-leg[1], leg[0]), -step * inverse_of / (2 * length))
        for leg, step, length in zip(legs, steps, rho, strict=True)
    )
    return tuple(_unit(ns, leg) for leg in turned)


def _unit(ns, leg):
    size = ns.sqrt(leg[0] * leg[0] + leg[1] * leg[1])
    return (leg[0] / size, leg[1] / size)


def _along(rho, legs, i, j):
    """g_ij = (S_i - S_j) . dS_i/dA_i per rho_i, lengths being taken per R."""
    (cosine, sine), (other_cosine, other_sine) = legs[i], legs[j]
    return (3 * cosine + rho[j] * (cosine * other_sine + 2 * sine * other_cosine)) / 2


def _placed(ns, p, inputs, radial, heights, apart):
    """The pose of a platform whose corners are at e_i along u_i and h_i along Z."""
    root3 = ns.sqrt(3)
    (e1, e2, e3), (h1, h2, h3) = radial, heights
    z = (h1 + h2 + h3) / 3
    a, b = (z - h1) / p.r, (h2 - h3) / (root3 * p.r)
    r11, r21 = (2 * e1 + (e2 + e3) / 2) / (3 * p.r), (e3 - e2) / (2 * root3 * p.r)
    r22 = (e2 + e3) / (2 * p.r)
    square = 1 - a * a
    cosine = ns.sqrt(square)
    theta, psi, phi = (cosine, a), _unit(ns, (r11 * r22 - r21 * r21, b)), _unit(ns, (r11, r21))
    pose = (z, theta, psi)
    core = _core(ns, p, pose, phi, radial, heights, inputs)
    return Branch(pose, tuple(inputs), {"apart": apart, "upright": square}, core)


def _core(ns, p, pose, phi, radial, heights, lengths):
    z, theta, psi = pose
    rotation = product(about_z(phi), product(about_y(theta), about_x(psi)))
    legs = tuple((h / rho, (e - p.R) / rho) for e, h, rho in zip(radial, heights, lengths, strict=True))
    return SimpleNamespace(
        z=z, theta=theta, psi=psi, phi=phi, rotation=rotation, radial=radial, heights=heights, lengths=lengths,
        legs=legs, x=p.r * (rotation[0][0] - rotation[1][1]) / 2, y=-p.r * rotation[1][0],
        o=radial[0] + radial[1] + radial[2], e=_together([length / p.R for length in lengths], legs),
        **vars(_tilt(theta, psi)),
    )  # fmt: skip


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
        frame = product(about_z(limb), product(about_y(leg), about_z((limb[0], -limb[1]))))
        values |= {
            f"leg{k}.A": leg,
            f"leg{k}.P": length,
            f"leg{k}.S": product(transposed(frame), core.rotation),
        }
    return values


def factors(ns, p, core):
    """Det Jp = cos(theta) planes, det Jq = rho1 rho2 rho3."""
    rows = _rows(ns, p, core)
    planes = (
        rows[0][0] * (rows[1][1] * rows[2][2] - rows[1][2] * rows[2][1])
        - rows[0][1] * (rows[1][0] * rows[2][2] - rows[1][2] * rows[2][0])
        + rows[0][2] * (rows[1][0] * rows[2][1] - rows[1][1] * rows[2][0])
    )
    first, second, third = core.lengths
    return {
        "planes": planes, "cos_theta": core.theta[0], "rho1": first, "rho2": second, "rho3": third, "n": core.n,
    }  # fmt: skip


def jacobians(ns, p, core):
    """From (e_i - R)^2 + h_i^2 = rho_i^2."""
    first, second, third = core.lengths
    rows = tuple((row[0], row[1], core.theta[0] * row[2]) for row in _rows(ns, p, core))
    return rows, ((first, 0, 0), (0, second, 0), (0, 0, third))


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


LEGS = (1, 2, 3)
UPRIGHT = Margin("upright", "1", "theta is a right angle: phi and psi turn about one axis", unit=0, zero="degenerate")
CLOSED_FORM = ClosedForm(
    complete_for="reduced",
    reduced_because="a leg of negative length is left out: the same pose with that leg turned half round",
    direct=Eliminant("A1", "angle", 16, coefficients, back),
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    quantities=quantities,
    signs={"o": Sign("o", "r"), "e": Sign("e", "1")},
    direct_margins=(
        Margin("apart", "1", "two poses have this angle of leg 1 in common", unit=0, zero="degenerate"),
        UPRIGHT,
    ),
    inverse_margins=(
        Margin("n", "1", "the platform is upside down: phi is free", unit=0, zero="degenerate"),
        UPRIGHT,
        *(
            Margin(f"square{k}", "R*R", f"A and S of leg {k} coincide: it has no direction", unit=2, zero="degenerate")
            for k in LEGS
        ),
    ),
    factor_list=(
        Factor(
            "planes",
            "parallel",
            "R*R*R*r*r",
            "the planes of each S, of its leg and its revolute axis, meet in a point of the platform's plane",
            r"\det(J_p)/\cos\theta",
            unit=5,
        ),
        Factor(
            "cos_theta",
            "parallel",
            "1",
            "theta is a right angle: phi and psi turn about one axis (of the coordinates, not of the mechanism)",
            r"\cos\theta",
            unit=0,
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
)
